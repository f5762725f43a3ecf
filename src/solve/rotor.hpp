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

/// Directions of n equal blades; blade 0 is the paper's blade 1, at angle 0 when the revolution starts.
class BladeSet {
 public:
  BladeSet(int count, double speed_ratio) : speed_ratio_(speed_ratio) {
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / count;
      offsets_.push_back({std::cos(angle), std::sin(angle)});
    }
  }

  [[nodiscard]] int count() const { return static_cast<int>(offsets_.size()); }

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

 private:
  double speed_ratio_;
  std::vector<contact::BladeDirection> offsets_;
};

/// Pose of a blade for a state of the rotor.
inline contact::Pose pose_of(const RotorConstants& rotor, const contact::Geometry& geometry,
                             const contact::BladeDirection& direction, const State& state) {
  return contact::pose(geometry, direction, state[0], state[1] + rotor.misalignment, state[2], state[3]);
}

}  // namespace rubatlas::solve
