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
#include <concepts>

#include "contact/pose.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::modes {

class FlightRow {
 public:
  static constexpr int kTimes = 8;
  using Values = Eigen::Array<double, kTimes, 1>;

  /// The rows of an isotropic shaft at constant speed, under no forcing or one of a single frequency.
  template <class Forcing>
  FlightRow(const rotor::RotorConstants& rotor, const rotor::FreeMotion& free, const Forcing& forcing)
      : speed_ratio_(rotor.speed_ratio),
        damping_ratio_(rotor.damping_ratio),
        misalignment_(rotor.misalignment),
        spacing_(kSpacing / std::max(1.0, std::abs(rotor.speed_ratio))) {
    for (int i = 0; i < kTimes; ++i) {
      const double elapsed = (i + 1) * spacing_;
      const auto kernel = free.kernel(elapsed);
      cosine_[i] = kernel.cosine;
      sine_[i] = kernel.sine;
      turn_cosine_[i] = std::cos(speed_ratio_ * elapsed);
      turn_sine_[i] = std::sin(speed_ratio_ * elapsed);
      if constexpr (Forcing::kPresent) {
        const auto response = forcing.from_rest(0.0, elapsed, free, kernel);
        response_x_[i] = response.position.real();
        response_y_[i] = response.position.imag();
        response_vx_[i] = response.velocity.real();
        response_vy_[i] = response.velocity.imag();
      }
    }
  }

  /// h [τ].
  [[nodiscard]] double spacing() const { return spacing_; }

  /// Moves the row to a state of the flight; `forcing`: the direction of the forcing there against that at
  /// τ = 0, or null where none acts; `fourth_bound`: of |g''''| from there on.
  void start(const rotor::State& state, const std::complex<double>* forcing, double fourth_bound) {
    start_ = state;
    const double square = spacing_ * spacing_;
    remainder_ = fourth_bound * square * square / 288.0 + kRounding;
    const auto free = [&](double place, double velocity, Values& places, Values& velocities) {
      places = place * cosine_ + (velocity + damping_ratio_ * place) * sine_;
      velocities = velocity * cosine_ - (place + damping_ratio_ * velocity) * sine_;
    };
    free(state[0], state[2], x_, vx_);
    free(state[1], state[3], y_, vy_);
    if (forcing != nullptr) {
      const double along = forcing->real();
      const double across = forcing->imag();
      x_ += along * response_x_ - across * response_y_;
      y_ += along * response_y_ + across * response_x_;
      vx_ += along * response_vx_ - across * response_vy_;
      vy_ += along * response_vy_ + across * response_vx_;
    }
    y_ += misalignment_;
    square_ = x_ * x_ + y_ * y_;
    square_rate_ = 2.0 * (x_ * vx_ + y_ * vy_);
  }

  /// The first of the eight intervals of the row in which a tip of this geometry may touch; kTimes: none.
  /// `er`: direction of its blade at the start of the row.
  [[nodiscard]] int first_doubt(const contact::Geometry& geometry, const contact::BladeDirection& er) const {
    const Values cosine = er.cosine * turn_cosine_ - er.sine * turn_sine_;
    const Values sine = er.sine * turn_cosine_ + er.cosine * turn_sine_;
    const double reach = 2.0 * geometry.reach;
    const Values gap = square_ + (reach * (x_ * cosine + y_ * sine) + geometry.closing());
    const Values rate =
        square_rate_ + reach * ((vx_ * cosine + vy_ * sine) + speed_ratio_ * (y_ * cosine - x_ * sine));
    const contact::Pose at_start =
        contact::pose(geometry, er, start_[0], start_[1] + misalignment_, start_[2], start_[3]);
    // The tip of a blade that has just lifted off starts at the ring, up to rounding.
    double before = std::min(at_start.gap, 0.0);
    double rate_before = contact::gap_rate(geometry, at_start, speed_ratio_);
    const double third = spacing_ / 3.0;
    Values inner = gap - third * rate;
    for (int i = 0; i < kTimes; ++i) {
      const double first = before + third * rate_before;
      if (!(std::max(first, inner[i]) + remainder_ < 0.0 && gap[i] < 0.0)) return i;
      before = gap[i];
      rate_before = rate[i];
    }
    return kTimes;
  }

 private:
  /// [τ]: a few rows reach from contact to contact, and the remainder is small against usual gaps.
  static constexpr double kSpacing = 0.3;
  static constexpr double kRounding = 1e-16;  ///< [m²]: more than the gaps are rounded by

  double speed_ratio_;
  double damping_ratio_;
  double misalignment_;
  double spacing_;
  Values cosine_, sine_;                                        ///< of free motion, `FreeMotion::kernel`
  Values turn_cosine_, turn_sine_;                              ///< of the angle by which the hub turns
  Values response_x_, response_y_, response_vx_, response_vy_;  ///< from rest at τ = 0
  rotor::State start_ = rotor::State::Zero();
  Values x_, y_, vx_, vy_;  ///< c and c'
  Values square_, square_rate_;
  double remainder_ = 0.0;
};

/// Forcings under which flight goes by rows.
template <class Forcing>
concept FliesInRows = !Forcing::kPresent || std::derived_from<Forcing, rotor::Harmonic>;

}  // namespace rubatlas::modes
