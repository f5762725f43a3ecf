/// The constants of one grid point, as the equations of motion use them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "contact/pose.hpp"

namespace rubatlas::solve {

/// x, y, dx/dτ, dy/dτ [m].
using State = Eigen::Array4d;

inline std::array<double, 4> as_array(const State& state) {
  return {state[0], state[1], state[2], state[3]};
}
inline State as_state(const std::array<double, 4>& state) {
  return {state[0], state[1], state[2], state[3]};
}

struct RotorConstants {
  double speed_ratio;    ///< Ω [-]
  double damping_ratio;  ///< ζ [-]
  double misalignment;   ///< y0 [m]
  double force_unit;     ///< 1/(m ωn²) [m/N]: acceleration per unit τ² of one newton
  double length_scale;   ///< δc, or L/10 where δc = 0 [m]: what tolerances are relative to

  /// τ of one revolution. A negative speed ratio is a spin the other way, the mirror image.
  [[nodiscard]] double period() const { return 2.0 * std::numbers::pi / std::abs(speed_ratio); }
};

/// Directions of n equally spaced blades at constant speed; blade 0 is the paper's blade 1, at angle 0 when
/// the revolution starts.
class BladeSet {
 public:
  BladeSet(int count, double speed_ratio) : speed_ratio_(speed_ratio) {
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / count;
      offsets_.push_back({std::cos(angle), std::sin(angle)});
    }
  }

  [[nodiscard]] int count() const { return static_cast<int>(offsets_.size()); }

  /// dφ/dτ at time τ of the revolution.
  [[nodiscard]] double speed(double /*time*/) const { return speed_ratio_; }

  /// Direction of blade 0 at time τ of the revolution.
  [[nodiscard]] contact::BladeDirection first(double time) const {
    return {std::cos(speed_ratio_ * time), std::sin(speed_ratio_ * time)};
  }
  /// Direction of a blade when blade 0 stands at `first`.
  [[nodiscard]] contact::BladeDirection direction(int blade, const contact::BladeDirection& first) const {
    const contact::BladeDirection& offset = offsets_[static_cast<std::size_t>(blade)];
    return {first.cosine * offset.cosine - first.sine * offset.sine,
            first.sine * offset.cosine + first.cosine * offset.sine};
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
    const double square = angle * angle;
    if (!(square < kFarTurned)) return direction(anchor.blade, first(time));
    const double fourth = square * square;
    const double sine = angle + (angle * square) * ((-1.0 / 6 + square * (1.0 / 120)) +
                                                    fourth * (-1.0 / 5040 + square * (1.0 / 362880)));
    const double cosine_less_one =
        square * ((-0.5 + square * (1.0 / 24)) + fourth * (-1.0 / 720 + square * (1.0 / 40320)));
    const contact::BladeDirection& from = anchor.direction;
    return {from.cosine + (from.cosine * cosine_less_one - from.sine * sine),
            from.sine + (from.sine * cosine_less_one + from.cosine * sine)};
  }

 private:
  /// [rad²]: below it the first terms left out, angle^11/11! and angle^10/10!, are less than 1e-18.
  static constexpr double kFarTurned = 0.0039;

  double speed_ratio_;
  std::vector<contact::BladeDirection> offsets_;
};

/// Pose of a blade for a state of the rotor.
inline contact::Pose pose_of(const RotorConstants& rotor, const contact::Geometry& geometry,
                             const contact::BladeDirection& direction, const State& state) {
  return contact::pose(geometry, direction, state[0], state[1] + rotor.misalignment, state[2], state[3]);
}

}  // namespace rubatlas::solve
