/// Directions of blades whose spin speed ripples, and that may stand at unequal angles.
#pragma once

#include <cmath>
#include <span>

#include "contact/pose.hpp"
#include "rotor/blade_set.hpp"
#include "settings/effects/speed_ripple.hpp"

namespace rubatlas::rotor {

/// The interface of `BladeSet`, with φ' = Ω (1 + a cos(pΩτ + ψ)) (`effects/speed_ripple.hpp`).
class RipplingBlades : public BladePlaces {
 public:
  static constexpr bool kRipples = true;

  /// `angles`: of each blade from blade 0's place [rad].
  RipplingBlades(std::span<const double> angles, double speed_ratio, const effects::SpeedRipple& ripple)
      : BladePlaces(angles),
        speed_ratio_(speed_ratio),
        amplitude_(ripple.amplitude),
        frequency_(ripple.order * speed_ratio),
        depth_(ripple.amplitude / ripple.order),
        phase_(ripple.phase) {}

  [[nodiscard]] double angle(double time) const {
    return speed_ratio_ * time + depth_ * (std::sin(frequency_ * time + phase_) - std::sin(phase_));
  }
  /// dφ/dτ and d²φ/dτ² at time τ of the revolution.
  [[nodiscard]] double angular_speed(double time) const {
    return speed_ratio_ * (1.0 + amplitude_ * std::cos(frequency_ * time + phase_));
  }
  [[nodiscard]] double angular_acceleration(double time) const {
    return -speed_ratio_ * amplitude_ * frequency_ * std::sin(frequency_ * time + phase_);
  }
  /// Least |φ'|.
  [[nodiscard]] double slowest() const { return std::abs(speed_ratio_) * (1.0 - amplitude_); }
  /// Bounds of |φ'|, |φ''| and |φ'''|.
  [[nodiscard]] double speed_bound() const { return std::abs(speed_ratio_) * (1.0 + amplitude_); }
  [[nodiscard]] double angular_acceleration_bound() const {
    return std::abs(speed_ratio_ * frequency_) * amplitude_;
  }
  [[nodiscard]] double angular_jerk_bound() const {
    return std::abs(speed_ratio_) * frequency_ * frequency_ * amplitude_;
  }

  [[nodiscard]] contact::BladeDirection first(double time) const {
    const double phi = angle(time);
    return {std::cos(phi), std::sin(phi)};
  }

  /// Nothing is gained from where a blade stood before: the angle is no linear function of time.
  struct Anchor {
    int blade = 0;
  };
  [[nodiscard]] Anchor anchor(int blade, double /*time*/) const { return {blade}; }
  [[nodiscard]] contact::BladeDirection direction_near(const Anchor& anchor, double time) const {
    return direction(anchor.blade, first(time));
  }

 private:
  double speed_ratio_;  ///< Ω, the mean [-]
  double amplitude_;    ///< a [-]
  double frequency_;    ///< pΩ [per unit τ]
  double depth_;        ///< a/p [rad]
  double phase_;        ///< ψ [rad]
};

}  // namespace rubatlas::rotor
