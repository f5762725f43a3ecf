/// Eight equally spaced times of free motion at once. Their distance is fixed, so that the free motion
/// between them, and the response to a forcing from rest, is known once for a point.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <concepts>

#include "rotor/constants.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::modes {

/// Forcings under which flight goes by rows.
template <class Forcing>
concept FliesInRows = !Forcing::kPresent || std::derived_from<Forcing, rotor::Harmonic>;

class StateRow {
 public:
  static constexpr int kTimes = 8;
  using Values = Eigen::Array<double, kTimes, 1>;

  /// The rows of an isotropic shaft at constant speed, under no forcing or one of a single frequency.
  /// `spacing`: between two times [τ].
  template <FliesInRows Forcing>
  StateRow(const rotor::FreeMotion& free, const Forcing& forcing, double spacing)
      : damping_ratio_(free.damping_ratio()), spacing_(spacing) {
    for (int i = 0; i < kTimes; ++i) {
      const double elapsed = (i + 1) * spacing_;
      const auto kernel = free.kernel(elapsed);
      cosine_[i] = kernel.cosine;
      sine_[i] = kernel.sine;
      if constexpr (Forcing::kPresent) {
        const auto response = forcing.from_rest(0.0, elapsed, free, kernel);
        response_x_[i] = response.position.real();
        response_y_[i] = response.position.imag();
        response_vx_[i] = response.velocity.real();
        response_vy_[i] = response.velocity.imag();
      }
    }
  }

  [[nodiscard]] double spacing() const { return spacing_; }

  /// Moves the row to a state, whose eight times follow it by one to eight spacings. `forcing`: the direction
  /// of the forcing there against that at τ = 0, or null where none acts.
  void start(const rotor::State& state, const std::complex<double>* forcing) {
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
  }

  [[nodiscard]] const Values& x() const { return x_; }    ///< [m]
  [[nodiscard]] const Values& y() const { return y_; }    ///< [m]
  [[nodiscard]] const Values& vx() const { return vx_; }  ///< [m per unit τ]
  [[nodiscard]] const Values& vy() const { return vy_; }  ///< [m per unit τ]
  [[nodiscard]] rotor::State state(int i) const { return {x_[i], y_[i], vx_[i], vy_[i]}; }

 private:
  double damping_ratio_;
  double spacing_;
  Values cosine_, sine_;                                        ///< of free motion, `FreeMotion::kernel`
  Values response_x_, response_y_, response_vx_, response_vy_;  ///< from rest at τ = 0
  Values x_, y_, vx_, vy_;
};

}  // namespace rubatlas::modes
