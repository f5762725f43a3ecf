#include "modes/flight_row.hpp"

#include "integrate/newton_between.hpp"

namespace rubatlas::modes {

FlightRow::FlightRow(const rotor::Machine& machine, double spacing)
    : misalignment_(machine.constants.misalignment),
      states_(machine, spacing),
      turn_(machine.blades, spacing) {
  if (const rotor::RingBody* body = machine.ring_body()) ring_.emplace(*body, spacing);
}

void FlightRow::start(double time, const rotor::ShaftAndRing& bodies, double fourth_bound) {
  remainder_ = remainder(fourth_bound, spacing());
  turn_.start(time);
  if (!ring_) {
    start_ = rotor::shaft(bodies);
    states_.start(time, start_);
    see(states_.x(), states_.y(), states_.vx(), states_.vy());
    return;
  }
  start_ = rotor::from_ring(bodies);
  states_.start(time, rotor::shaft(bodies));
  const rotor::RingBody::State from = rotor::ring(bodies);
  ring_->free.move(from[0], from[2] / ring_->frequency, ring_->rx, ring_->rvx);
  ring_->free.move(from[1], from[3] / ring_->frequency, ring_->ry, ring_->rvy);
  ring_->rvx *= ring_->frequency;
  ring_->rvy *= ring_->frequency;
  ring_->x = states_.x() - ring_->rx;
  ring_->vx = states_.vx() - ring_->rvx;
  ring_->vy = states_.vy() - ring_->rvy;
  see(ring_->x, states_.y() - ring_->ry, ring_->vx, ring_->vy);
}

/// `x`, `y`, `vx`, `vy`: of the shaft, from the ring.
void FlightRow::see(const Values& x, const Values& y, const Values& vx, const Values& vy) {
  y_ = y + misalignment_;
  square_ = x * x + y_ * y_;
  square_rate_ = 2.0 * (x * vx + y_ * vy);
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
  if (ring_) bodies.tail<4>() << ring_->rx[i], ring_->ry[i], ring_->rvx[i], ring_->rvy[i];
  return bodies;
}

}  // namespace rubatlas::modes
