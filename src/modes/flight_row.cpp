#include "modes/flight_row.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "rotor/harmonic.hpp"
#include "rotor/linear_support.hpp"

namespace rubatlas::modes {
namespace {

DirectionsOfRow of_angles(const RowValues& angles) {
  return {angles.unaryExpr([](double angle) { return std::cos(angle); }),
          angles.unaryExpr([](double angle) { return std::sin(angle); })};
}

}  // namespace

StateRow::StateRow(const rotor::Machine& machine, double spacing)
    : spacing_(spacing), isotropic_(rotor::FreeMotion(machine.constants.damping_ratio), spacing) {
  if (const rotor::Harmonics* harmonics = machine.harmonics()) {
    const rotor::FreeMotion free(machine.constants.damping_ratio);
    for (const rotor::Harmonic& term : harmonics->terms()) {
      Response& response = responses_.emplace_back();
      response.frequency = term.frequency();
      for (int i = 0; i < kTimesOfRow; ++i) {
        const double elapsed = (i + 1) * spacing_;
        const auto [position, velocity] = term.from_rest(0.0, elapsed, free, free.kernel(elapsed));
        response.along.row(i) << position.real(), position.imag(), velocity.real(), velocity.imag();
      }
      const StatesOfRow& along = response.along;
      response.across << -along.col(1), along.col(0), -along.col(3), along.col(2);
    }
    return;
  }
  const rotor::LinearSupport& support = machine.supported()->support;
  supported_.resize(4);
  responses_.resize(support.terms().size());
  for (int i = 0; i < kTimesOfRow; ++i) {
    const double elapsed = (i + 1) * spacing_;
    for (std::size_t from = 0; from < 4; ++from) {
      const auto unit = Eigen::Vector4d::Unit(static_cast<Eigen::Index>(from));
      supported_[from].row(i) = support.free(unit, elapsed).transpose();
    }
    const auto forced = support.from_rest(elapsed);
    for (std::size_t j = 0; j < responses_.size(); ++j) {
      const auto& [amplitude, frequency] = support.terms()[j];
      responses_[j].frequency = frequency;
      responses_[j].along.row(i) =
          (forced[j] * Eigen::Vector2d(amplitude.real(), amplitude.imag())).transpose();
      responses_[j].across.row(i) =
          (forced[j] * Eigen::Vector2d(-amplitude.imag(), amplitude.real())).transpose();
    }
  }
}

void StateRow::start(double time, const rotor::State& state) {
  if (supported_.empty()) {
    isotropic_.move(state, states_);
  } else {
    states_ = (state[0] * supported_[0] + state[1] * supported_[1]) +
              (state[2] * supported_[2] + state[3] * supported_[3]);
  }
  for (const Response& response : responses_) {
    const std::complex<double> direction = std::polar(1.0, response.frequency * time);
    states_ += direction.real() * response.along + direction.imag() * response.across;
  }
}

TurnRow::TurnRow(const rotor::BladeSet& blades, double spacing)
    : blades_(&blades), speed_at_start_(blades.mean_speed()) {
  const RowValues elapsed = spacing * RowValues::LinSpaced(1.0, double{kTimesOfRow});
  mean_ = turned_ = of_angles(blades.mean_speed() * elapsed);
  ripple_ = of_angles(blades.ripple_frequency() * elapsed);
  speed_.setConstant(speed_at_start_);
}

void TurnRow::start(double time) {
  if (!blades_->ripples()) return;
  const contact::BladeDirection start = blades_->ripple(time);
  const auto [cosine, sine] = ripple_.turned(start);
  const double amplitude = blades_->ripple_amplitude();
  speed_at_start_ = blades_->mean_speed() * (1.0 + amplitude * start.cosine);
  speed_ = blades_->mean_speed() * (1.0 + amplitude * cosine);
  turned_ = mean_.turned(of_angles(blades_->ripple_depth() * (sine - start.sine)));
}

FlightRow::FlightRow(const rotor::Machine& machine, double spacing)
    : misalignment_(machine.constants.misalignment),
      states_(machine, spacing),
      turn_(machine.blades, spacing) {
  if (const rotor::RingBody* body = machine.ring_body()) ring_.emplace(*body, spacing);
}

void FlightRow::start(double time, const rotor::ShaftAndRing& bodies, double fourth_bound) {
  remainder_ = remainder(fourth_bound, spacing());
  turn_.start(time);
  start_ = rotor::from_ring(bodies);
  states_.start(time, rotor::shaft(bodies));
  if (ring_) ring_->move(rotor::ring(bodies), ring_states_);
  seen_ = states_.states() - ring_states_;
  seen_.col(1) += misalignment_;
  const auto x = seen_.col(0), y = seen_.col(1), vx = seen_.col(2), vy = seen_.col(3);
  square_ = x * x + y * y;
  square_rate_ = 2.0 * (x * vx + y * vy);
}

std::optional<double> FlightRow::only_crossing(const Gaps& gaps, int interval, double rounding) const {
  constexpr double kOfRate = 2.31;   // √3/216 over 1/288, which is in `remainder`
  constexpr double kClosest = 1e-3;  // of the interval
  const double h = spacing();
  // |g' − cubic'| <= max|g''''| h³ √3/216.
  const double remainder = kOfRate * remainder_ / h;
  const auto [from, from_rate] = gaps.at(interval);
  const auto [to, to_rate] = gaps.at(interval + 1);
  const double middle = 3.0 * (to - from) / h - from_rate - to_rate;
  if (!(from < -rounding && to > rounding && std::min({from_rate, middle, to_rate}) > remainder))
    return std::nullopt;
  const double square = 3.0 * (to - from) - (2.0 * from_rate + to_rate) * h;
  const double cube = (from_rate + to_rate) * h - 2.0 * (to - from);
  const auto gap = [=, gap = from, rate = from_rate * h](double share) {
    return integrate::ValueAndSlope{gap + share * (rate + share * (square + share * cube)),
                                    rate + share * (2.0 * square + share * 3.0 * cube)};
  };
  return h * integrate::newton_between(gap, 0.0, 1.0, from / (from - to), true, kClosest);
}

rotor::ShaftAndRing FlightRow::state(int i) const {
  rotor::ShaftAndRing bodies;
  bodies.head<4>() = states_.state(i);
  bodies.tail<4>() = ring_states_.row(i).transpose();
  return bodies;
}

}  // namespace rubatlas::modes
