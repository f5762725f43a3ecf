#include "modes/flight_row.hpp"

#include "integrate/newton_between.hpp"

namespace rubatlas::modes {

FlightRow::FlightRow(const rotor::Machine& machine, double spacing)
    : misalignment_(machine.constants.misalignment),
      states_(machine, spacing),
      turn_(machine.blades, spacing) {
  if (const rotor::RingBody* body = machine.ring_body())
    ring_ = Ring{FreeRow(body->free_motion(), body->frequency() * spacing), body->frequency(), {}};
}

void FlightRow::start(double time, const rotor::ShaftAndRing& bodies, double fourth_bound) {
  remainder_ = remainder(fourth_bound, spacing());
  turn_.start(time);
  start_ = rotor::from_ring(bodies);
  states_.start(time, rotor::shaft(bodies));
  seen_ = states_.states();
  if (ring_) {
    const rotor::RingBody::State from = rotor::ring(bodies);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto place = static_cast<Eigen::Index>(i);
      ring_->free.move(from[place], from[place + 2] / ring_->frequency, ring_->states[i],
                       ring_->states[i + 2]);
      ring_->states[i + 2] *= ring_->frequency;
    }
    for (std::size_t i = 0; i < 4; ++i) seen_[i] -= ring_->states[i];
  }
  auto& [x, y, vx, vy] = seen_;
  y += misalignment_;
  square_ = x * x + y * y;
  square_rate_ = 2.0 * (x * vx + y * vy);
}

double FlightRow::crossing(const Gaps& gaps, int interval) const {
  constexpr double kClosest = 1e-3;  // of the interval
  const double h = spacing();
  const auto [from, from_rate, to, to_rate] = ends_of(gaps, interval);
  const double square = 3.0 * (to - from) - (2.0 * from_rate + to_rate) * h;
  const double cube = (from_rate + to_rate) * h - 2.0 * (to - from);
  const auto gap = [&, start = from, rate = from_rate * h](double share) {
    return integrate::ValueAndSlope{start + share * (rate + share * (square + share * cube)),
                                    rate + share * (2.0 * square + share * 3.0 * cube)};
  };
  return h * integrate::newton_between(gap, 0.0, 1.0, from / (from - to), true, kClosest);
}

rotor::ShaftAndRing FlightRow::state(int i) const {
  rotor::ShaftAndRing bodies = rotor::shaft_and_ring(states_.state(i));
  if (ring_) {
    for (std::size_t k = 0; k < 4; ++k) bodies[static_cast<Eigen::Index>(4 + k)] = ring_->states[k][i];
  }
  return bodies;
}

}  // namespace rubatlas::modes
