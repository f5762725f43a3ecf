/// States of the shaft in which the tip of one blade stands on the ring.
///
/// With er along the blade at angle β = Ωτ + βk, n the direction of the tip w from the centre of the ring at
/// angle β + ψ, t = Jn and ρ = rh + L,
///     c = R n − ρ er,   c' = (v − Ωρ sin ψ) n + v_t t,
/// so that time τ, tangential place ψ, approach speed v = d|w|/dτ and v_t are four coordinates of such
/// states. An orbit whose touch-down has them as unknowns is a smooth function of them, also where v vanishes
/// and the tip grazes.
#pragma once

#include <Eigen/Core>
#include <array>

#include "contact/pose.hpp"
#include "rotor/blade_set.hpp"
#include "settings/scene.hpp"

namespace rubatlas::branch {

/// Ωτ [rad], Rψ [m], v and v_t [m per unit τ].
using TouchdownCoordinates = Eigen::Vector4d;
/// The coordinate that vanishes at a grazing.
inline constexpr Eigen::Index kApproachSpeed = 2;

class TouchdownChart {
 public:
  /// `line`: the scene with the values of a point; a blade, from 0.
  TouchdownChart(const settings::Scene& line, double speed_ratio, int blade);

  /// x, y [m], x', y' [m per unit τ] of the shaft.
  [[nodiscard]] Eigen::Vector4d state(const TouchdownCoordinates& at) const;
  /// Its derivative by the coordinates.
  [[nodiscard]] Eigen::Matrix4d derivative(const TouchdownCoordinates& at) const;
  /// Coordinates of a state at a time τ; the tip is moved along its own direction onto the ring.
  [[nodiscard]] TouchdownCoordinates coordinates(double time, const std::array<double, 4>& state) const;

 private:
  struct Frame {
    Eigen::Vector2d er, et;  ///< along and across the blade
    Eigen::Vector2d n, t;    ///< along and across the direction of the tip
    double along_n;          ///< c'·n [m per unit τ]
  };
  [[nodiscard]] Frame frame(const TouchdownCoordinates& at) const;

  contact::Geometry geometry_;
  double misalignment_;  ///< y0 [m]
  double speed_ratio_;   ///< Ω [-]
  int blade_;
  rotor::BladeSet blades_;
};

}  // namespace rubatlas::branch
