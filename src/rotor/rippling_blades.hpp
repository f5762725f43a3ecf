/// Directions of blades whose spin speed may ripple.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "contact/pose.hpp"
#include "rotor/blade_set.hpp"
#include "settings/effects/speed_ripple.hpp"

namespace rubatlas::rotor {

/// The interface of `BladeSet`, with φ' = Ω (1 + a cos(pΩτ + ψ)) (`effects/speed_ripple.hpp`); a may be 0.
/// Others cannot take it for a `BladeSet`, whose speed is its mean.
class RipplingBlades : private BladeSet {
 public:
  using BladeSet::Anchor;
  using BladeSet::count;
  using BladeSet::direction;

  /// `angles`: of each blade from blade 0's place [rad].
  RipplingBlades(std::span<const double> angles, double speed_ratio, const effects::SpeedRipple& ripple)
      : BladeSet(angles, speed_ratio),
        amplitude_(ripple.amplitude),
        frequency_(ripple.order * speed_ratio),
        depth_(ripple.amplitude / ripple.order),
        phase_(ripple.phase) {}
  /// Blades at constant speed are blades whose speed may ripple. NOLINTNEXTLINE(google-explicit-constructor)
  RipplingBlades(const BladeSet& blades)
      : BladeSet(blades), amplitude_(0.0), frequency_(0.0), depth_(0.0), phase_(0.0) {}

  [[nodiscard]] bool ripples() const { return amplitude_ != 0.0; }
  [[nodiscard]] double mean_speed() const { return BladeSet::angular_speed(0.0); }  ///< Ω [-]
  [[nodiscard]] double ripple_amplitude() const { return amplitude_; }              ///< a [-]
  [[nodiscard]] double ripple_frequency() const { return frequency_; }              ///< pΩ [per unit τ]
  [[nodiscard]] double ripple_depth() const { return depth_; }                      ///< a/p [rad]
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

  /// The last one is kept: an event asks for it many times.
  [[nodiscard]] contact::BladeDirection first(double time) const {
    if (time == time_of_last_) return last_;
    time_of_last_ = time;
    if (!ripples()) return last_ = BladeSet::first(time);
    const double phi = angle(time);
    return last_ = {std::cos(phi), std::sin(phi)};
  }

  [[nodiscard]] Anchor anchor(int blade, double time) const {
    return ripples() ? Anchor{blade, time, {}} : BladeSet::anchor(blade, time);
  }
  [[nodiscard]] contact::BladeDirection direction_near(const Anchor& anchor, double time) const {
    // The angle of a speed that ripples is no linear function of time: nothing is gained from where the blade
    // stood.
    return ripples() ? direction(anchor.blade, first(time)) : BladeSet::direction_near(anchor, time);
  }

 private:
  double amplitude_;  ///< a [-]
  double frequency_;  ///< pΩ [per unit τ]
  double depth_;      ///< a/p [rad]
  double phase_;      ///< ψ [rad]
  mutable double time_of_last_ = std::numeric_limits<double>::quiet_NaN();
  mutable contact::BladeDirection last_{};
};

}  // namespace rubatlas::rotor
