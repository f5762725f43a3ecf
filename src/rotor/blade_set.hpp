/// Where the blades stand: directions of n blades on a rotor that turns.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "contact/pose.hpp"

namespace rubatlas::rotor {

/// Angles of n equally spaced blades from blade 0 [rad].
inline std::vector<double> equal_angles(int count) {
  std::vector<double> angles;
  angles.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) angles.push_back(2.0 * std::numbers::pi * k / count);
  return angles;
}

/// Places of the blades on the hub; blade 0 is the paper's blade 1, at angle 0 when the revolution starts.
class BladePlaces {
 public:
  explicit BladePlaces(std::span<const double> angles) {
    for (const double angle : angles) offsets_.push_back({std::cos(angle), std::sin(angle)});
  }

  [[nodiscard]] int count() const { return static_cast<int>(offsets_.size()); }

  /// Direction of a blade when the hub has turned to `first`.
  [[nodiscard]] contact::BladeDirection direction(int blade, const contact::BladeDirection& first) const {
    const contact::BladeDirection& offset = offsets_[static_cast<std::size_t>(blade)];
    return {first.cosine * offset.cosine - first.sine * offset.sine,
            first.sine * offset.cosine + first.cosine * offset.sine};
  }

 private:
  std::vector<contact::BladeDirection> offsets_;
};

/// Square of an angle [rad²] below which the first terms that `turned` leaves out, angle^11/11! and
/// angle^10/10!, are less than 1e-18.
inline constexpr double kFarTurned = 0.0039;

/// A direction turned by a small angle [rad], by the series of sine and cosine.
inline contact::BladeDirection turned(const contact::BladeDirection& from, double angle) {
  const double square = angle * angle;
  const double fourth = square * square;
  const double sine = angle + (angle * square) * ((-1.0 / 6 + square * (1.0 / 120)) +
                                                  fourth * (-1.0 / 5040 + square * (1.0 / 362880)));
  const double cosine_less_one =
      square * ((-0.5 + square * (1.0 / 24)) + fourth * (-1.0 / 720 + square * (1.0 / 40320)));
  return {from.cosine + (from.cosine * cosine_less_one - from.sine * sine),
          from.sine + (from.sine * cosine_less_one + from.cosine * sine)};
}

/// Blades at constant speed.
class BladeSet : public BladePlaces {
 public:
  BladeSet(std::span<const double> angles, double speed_ratio)
      : BladePlaces(angles), speed_ratio_(speed_ratio) {}
  /// Equally spaced.
  BladeSet(int count, double speed_ratio) : BladeSet(equal_angles(count), speed_ratio) {}

  /// dφ/dτ at time τ of the revolution.
  [[nodiscard]] double angular_speed(double /*time*/) const { return speed_ratio_; }
  /// Least |dφ/dτ|.
  [[nodiscard]] double slowest() const { return std::abs(speed_ratio_); }

  /// Direction of blade 0 at time τ of the revolution.
  [[nodiscard]] contact::BladeDirection first(double time) const {
    return {std::cos(speed_ratio_ * time), std::sin(speed_ratio_ * time)};
  }

  /// Where a blade stood at a time near which its direction is asked for.
  struct Anchor {
    int blade = 0;
    double time = 0.0;
    contact::BladeDirection direction{};
  };
  [[nodiscard]] Anchor anchor(int blade, double time) const {
    return {blade, time, direction(blade, first(time))};
  }
  /// Direction of the anchor's blade, from that at the anchor by the series of sine and cosine: within a step
  /// the blade turns by some hundredths, and a sine and cosine in full are a quarter of a right-hand side.
  [[nodiscard]] contact::BladeDirection direction_near(const Anchor& anchor, double time) const {
    const double angle = speed_ratio_ * (time - anchor.time);
    if (!(angle * angle < kFarTurned)) return direction(anchor.blade, first(time));
    return turned(anchor.direction, angle);
  }

 private:
  double speed_ratio_;
};

}  // namespace rubatlas::rotor
