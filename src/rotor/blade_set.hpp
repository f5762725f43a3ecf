/// Where the blades stand: directions of n blades on a rotor that turns, whose speed may ripple.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "contact/pose.hpp"
#include "settings/effects/speed_ripple.hpp"

namespace rubatlas::rotor {

/// Angles of n equally spaced blades from blade 0 [rad].
inline std::vector<double> equal_angles(int count) {
  std::vector<double> angles;
  angles.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) angles.push_back(2.0 * std::numbers::pi * k / count);
  return angles;
}

/// Blades with φ' = Ω (1 + a cos(pΩτ + ψ)) (`effects/speed_ripple.hpp`); a may be 0. Blade 0 is the paper's
/// blade 1, at angle 0 when the revolution starts.
class BladeSet {
 public:
  /// `angles`: of each blade from blade 0's place [rad].
  BladeSet(std::span<const double> angles, double speed_ratio, const effects::SpeedRipple& ripple = {})
      : speed_ratio_(speed_ratio),
        amplitude_(ripple.amplitude),
        frequency_(ripple.order * speed_ratio),
        depth_(ripple.amplitude / ripple.order),
        phase_(ripple.phase) {
    for (const double angle : angles) offsets_.push_back({std::cos(angle), std::sin(angle)});
  }
  /// Equally spaced.
  BladeSet(int count, double speed_ratio) : BladeSet(equal_angles(count), speed_ratio) {}

  [[nodiscard]] int count() const { return static_cast<int>(offsets_.size()); }
  /// Direction of a blade when the hub has turned to `first`.
  [[nodiscard]] contact::BladeDirection direction(int blade, const contact::BladeDirection& first) const {
    const contact::BladeDirection& offset = offsets_[static_cast<std::size_t>(blade)];
    return {first.cosine * offset.cosine - first.sine * offset.sine,
            first.sine * offset.cosine + first.cosine * offset.sine};
  }

  [[nodiscard]] bool ripples() const { return amplitude_ != 0.0; }
  [[nodiscard]] double mean_speed() const { return speed_ratio_; }      ///< Ω [-]
  [[nodiscard]] double ripple_amplitude() const { return amplitude_; }  ///< a [-]
  [[nodiscard]] double ripple_frequency() const { return frequency_; }  ///< pΩ [per unit τ]
  [[nodiscard]] double ripple_depth() const { return depth_; }          ///< a/p [rad]
  /// pΩτ + ψ, as a direction.
  [[nodiscard]] contact::BladeDirection ripple(double time) const {
    const double angle = frequency_ * time + phase_;
    return {std::cos(angle), std::sin(angle)};
  }
  [[nodiscard]] double angle(double time) const {
    return mean_speed() * time + depth_ * (std::sin(frequency_ * time + phase_) - std::sin(phase_));
  }
  /// dφ/dτ and d²φ/dτ² at time τ of the revolution.
  [[nodiscard]] double angular_speed(double time) const {
    if (!ripples()) return mean_speed();
    return mean_speed() * (1.0 + amplitude_ * std::cos(frequency_ * time + phase_));
  }
  [[nodiscard]] double angular_acceleration(double time) const {
    if (!ripples()) return 0.0;
    return -mean_speed() * amplitude_ * frequency_ * std::sin(frequency_ * time + phase_);
  }
  /// Least |φ'|.
  [[nodiscard]] double slowest() const { return std::abs(mean_speed()) * (1.0 - amplitude_); }
  /// Bounds of |φ'|, |φ''|, |φ'''| and |φ''''|.
  [[nodiscard]] double speed_bound() const { return std::abs(mean_speed()) * (1.0 + amplitude_); }
  [[nodiscard]] double angular_acceleration_bound() const {
    return std::abs(mean_speed() * frequency_) * amplitude_;
  }
  [[nodiscard]] double angular_jerk_bound() const {
    return std::abs(mean_speed()) * frequency_ * frequency_ * amplitude_;
  }
  [[nodiscard]] double angular_snap_bound() const { return std::abs(frequency_) * angular_jerk_bound(); }

  /// Direction of blade 0 at time τ of the revolution. The last one is kept: an event asks for it many times.
  [[nodiscard]] contact::BladeDirection first(double time) const {
    if (time == time_of_last_) return last_;
    time_of_last_ = time;
    const double phi = ripples() ? angle(time) : speed_ratio_ * time;
    return last_ = {std::cos(phi), std::sin(phi)};
  }

 private:
  std::vector<contact::BladeDirection> offsets_;
  double speed_ratio_;  ///< Ω [-]
  double amplitude_;    ///< a [-]
  double frequency_;    ///< pΩ [per unit τ]
  double depth_;        ///< a/p [rad]
  double phase_;        ///< ψ [rad]
  mutable double time_of_last_ = std::numeric_limits<double>::quiet_NaN();
  mutable contact::BladeDirection last_{};
};

}  // namespace rubatlas::rotor
