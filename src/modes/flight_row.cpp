#include "modes/flight_row.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "integrate/newton_between.hpp"

namespace rubatlas::modes {
namespace {

/// An angle [rad] below which the first terms that `turn_by` leaves out, angle^15/15! and angle^16/16!, are
/// less than 3e-17.
constexpr double kFarTurnedInRow = 0.5;
constexpr std::array kSine{-1.0 / 6.0,     1.0 / 120.0,       -1.0 / 5040.0,
                           1.0 / 362880.0, -1.0 / 39916800.0, 1.0 / 6227020800.0};
constexpr std::array kCosine{
    -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40320.0, -1.0 / 3628800.0, 1.0 / 479001600.0, -1.0 / 87178291200.0};

/// The polynomial with these coefficients, the first of which is its value at zero.
template <std::size_t kCount>
RowValues polynomial(const std::array<double, kCount>& coefficients, const RowValues& argument) {
  RowValues sum = RowValues::Constant(coefficients.back());
  for (std::size_t k = kCount - 1; k-- > 0;) sum = coefficients[k] + argument * sum;
  return sum;
}

/// Directions turned by small angles, by the series of sine and cosine.
void turn_by(const RowValues& angle, RowValues& cosine, RowValues& sine) {
  const RowValues square = angle * angle;
  const RowValues of_sine = angle + angle * square * polynomial(kSine, square);
  const RowValues of_cosine_less_one = square * polynomial(kCosine, square);
  const RowValues before = cosine;
  cosine += cosine * of_cosine_less_one - sine * of_sine;
  sine += sine * of_cosine_less_one + before * of_sine;
}

}  // namespace

TurnRow::TurnRow(const rotor::BladeSet& blades, double spacing)
    : blades_(&blades), speed_at_start_(blades.mean_speed()) {
  for (int i = 0; i < kTimesOfRow; ++i) {
    const double elapsed = (i + 1) * spacing;
    mean_cosine_[i] = std::cos(blades.mean_speed() * elapsed);
    mean_sine_[i] = std::sin(blades.mean_speed() * elapsed);
    ripple_cosine_[i] = std::cos(blades.ripple_frequency() * elapsed);
    ripple_sine_[i] = std::sin(blades.ripple_frequency() * elapsed);
  }
  cosine_ = mean_cosine_;
  sine_ = mean_sine_;
  speed_.setConstant(speed_at_start_);
}

void TurnRow::start_in_ripple(double time) {
  const contact::BladeDirection ripple = blades_->ripple(time);
  const RowValues cosine = ripple.cosine * ripple_cosine_ - ripple.sine * ripple_sine_;
  const RowValues sine = ripple.sine * ripple_cosine_ + ripple.cosine * ripple_sine_;
  const double amplitude = blades_->ripple_amplitude();
  speed_at_start_ = blades_->mean_speed() * (1.0 + amplitude * ripple.cosine);
  speed_ = blades_->mean_speed() * (1.0 + amplitude * cosine);
  const RowValues ahead = blades_->ripple_depth() * (sine - ripple.sine);
  cosine_ = mean_cosine_;
  sine_ = mean_sine_;
  if (ahead.abs().maxCoeff() < kFarTurnedInRow) {
    turn_by(ahead, cosine_, sine_);
    return;
  }
  for (int i = 0; i < kTimesOfRow; ++i) {
    const double turned_cosine = std::cos(ahead[i]);
    const double turned_sine = std::sin(ahead[i]);
    cosine_[i] = mean_cosine_[i] * turned_cosine - mean_sine_[i] * turned_sine;
    sine_[i] = mean_sine_[i] * turned_cosine + mean_cosine_[i] * turned_sine;
  }
}

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
