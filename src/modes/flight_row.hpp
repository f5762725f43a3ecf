/// Eight times of a flight at once: where the shaft and the tips are, and between which of these times a tip
/// may touch the ring.
///
/// The times are equally spaced, so that the free motion between them is known once for a point. Between two
/// of them the gap g of a blade is a cubic through its values and slopes, but for a remainder that a bound of
/// the fourth derivative bounds: |g − cubic| <= max|g''''| h⁴ θ²(1 − θ)²/24 at the share θ of their distance
/// h. Since θ²(1 − θ)² <= θ(1 − θ)/4, it is enough to add max|g''''| h⁴/288 to both inner Bernstein
/// coefficients of the cubic: where all four are negative, so is g.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>

#include "contact/pose.hpp"
#include "modes/state_row.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"
#include "rotor/free_motion.hpp"

namespace rubatlas::modes {

class FlightRow {
 public:
  static constexpr int kTimes = StateRow::kTimes;
  using Values = StateRow::Values;

  template <FliesInRows Forcing>
  FlightRow(const rotor::RotorConstants& rotor, const rotor::FreeMotion& free, const Forcing& forcing)
      : speed_ratio_(rotor.speed_ratio),
        misalignment_(rotor.misalignment),
        states_(free, forcing, kSpacing / std::max(1.0, std::abs(rotor.speed_ratio))) {
    for (int i = 0; i < kTimes; ++i) {
      const double elapsed = (i + 1) * spacing();
      turn_cosine_[i] = std::cos(speed_ratio_ * elapsed);
      turn_sine_[i] = std::sin(speed_ratio_ * elapsed);
    }
  }

  /// h [τ].
  [[nodiscard]] double spacing() const { return states_.spacing(); }

  /// Moves the row to a state of the flight; `forcing`: the direction of the forcing there against that at
  /// τ = 0, or null where none acts; `fourth_bound`: of |g''''| from there on.
  void start(const rotor::State& state, const std::complex<double>* forcing, double fourth_bound) {
    start_ = state;
    const double square = spacing() * spacing();
    remainder_ = fourth_bound * square * square / 288.0;
    states_.start(state, forcing);
    y_ = states_.y() + misalignment_;
    square_ = states_.x() * states_.x() + y_ * y_;
    square_rate_ = 2.0 * (states_.x() * states_.vx() + y_ * states_.vy());
  }

  /// g [m²] and dg/dτ of a blade at the start of the row and at its eight times.
  struct Gaps {
    double before;
    double rate_before;
    Values gap;
    Values rate;
  };
  /// `er`: direction of the blade at the start of the row.
  [[nodiscard]] Gaps gaps(const contact::Geometry& geometry, const contact::BladeDirection& er) const {
    const contact::Pose at_start =
        contact::pose(geometry, er, start_[0], start_[1] + misalignment_, start_[2], start_[3]);
    const Values cosine = er.cosine * turn_cosine_ - er.sine * turn_sine_;
    const Values sine = er.sine * turn_cosine_ + er.cosine * turn_sine_;
    const double reach = 2.0 * geometry.reach;
    const Values& x = states_.x();
    return {at_start.gap, contact::gap_rate(geometry, at_start, speed_ratio_),
            square_ + (reach * (x * cosine + y_ * sine) + geometry.closing()),
            square_rate_ + reach * ((states_.vx() * cosine + states_.vy() * sine) +
                                    speed_ratio_ * (y_ * cosine - x * sine))};
  }
  [[nodiscard]] rotor::State state(int i) const { return states_.state(i); }

  /// The first of the eight intervals of the row in which a tip with these gaps may touch; kTimes: none.
  /// `rounding`: more than the gaps are rounded by [m²].
  [[nodiscard]] int first_doubt(const Gaps& gaps, double rounding) const {
    const double remainder = remainder_ + rounding;
    // The tip of a blade that has just lifted off starts at the ring, up to rounding.
    double before = std::min(gaps.before, 0.0);
    double rate_before = gaps.rate_before;
    const double third = spacing() / 3.0;
    Values inner = gaps.gap - third * gaps.rate;
    for (int i = 0; i < kTimes; ++i) {
      const double first = before + third * rate_before;
      if (!(std::max(first, inner[i]) + remainder < 0.0 && gaps.gap[i] < 0.0)) return i;
      before = gaps.gap[i];
      rate_before = gaps.rate[i];
    }
    return kTimes;
  }

 private:
  /// [τ]: a few rows reach from contact to contact, and the remainder is small against usual gaps.
  static constexpr double kSpacing = 0.3;

  double speed_ratio_;
  double misalignment_;
  StateRow states_;
  Values turn_cosine_, turn_sine_;  ///< of the angle by which the hub turns
  rotor::State start_ = rotor::State::Zero();
  Values y_;                     ///< of c; its x and c' are the shaft's
  Values square_, square_rate_;  ///< |c|² and its derivative
  double remainder_ = 0.0;
};

}  // namespace rubatlas::modes
