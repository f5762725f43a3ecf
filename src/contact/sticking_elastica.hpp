/// A flexible blade's tip that sticks to the ring: where it stands, the load that holds it there, and the
/// friction which that takes.
///
/// Where a tip sticks its place is given and its load is asked for: with the tip at the normal angle α on the
/// ring, δ = cr + rh + L − R cos α and D = ct − R sin α are known, and the elastica's two equations δ(κ, φ),
/// D(κ, φ) have the unknowns κ and φ. The load's angle b against the blade then takes the friction
/// coefficient c = tan(b − α) (tan b where the load is axial); the tip can stick while |c| <= μ.
///
/// Of α there are two readings. In the model the slip velocity is that of a rigid body (MODEL 4.4), so v = 0
/// is a condition on α alone, `resting_normal_angle`: the sliding mode of MODEL 4.4, an index-1 constraint. A
/// tip that is held at one point of the ring, elastic velocity and all, keeps its α (plus Ωτ) in the ring's
/// frame instead. `hold` serves both.
///
/// An inextensible blade can be held by pressure only where it is bent enough: δ >= D²/(2L) or so. Where the
/// given place needs a pull there is no such blade, and `hold` says none.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "blade/inclined_elastica.hpp"
#include "contact/pose.hpp"

namespace rubatlas::contact {

/// The normal angle α [rad] next to `near` at which the slip velocity of a tip on the ring vanishes,
/// v = A cos α − B sin α + ΩR = 0 with A = c'·et − Ω cr, B = c'·er + Ω ct; none while the ring outruns the
/// rotor.
inline std::optional<double> resting_normal_angle(const Geometry& geometry, const Pose& at,
                                                  double speed_ratio, double near) {
  const double across = at.tangential_velocity - speed_ratio * at.radial;
  const double along = at.radial_velocity + speed_ratio * at.tangential;
  const double ratio = -speed_ratio * geometry.ring_radius / std::hypot(across, along);
  if (!(std::abs(ratio) <= 1.0)) return std::nullopt;
  const double centre = -std::atan2(along, across);
  const double spread = std::acos(ratio);
  const auto distance = [&](double angle) {
    return std::abs(std::remainder(angle - near, 2.0 * std::acos(-1.0)));
  };
  const double one = centre + spread;
  const double other = centre - spread;
  return near + std::remainder((distance(one) < distance(other) ? one : other) - near, 2.0 * std::acos(-1.0));
}

/// A blade whose tip is held at a place on the ring.
struct HeldBlade {
  blade::Bend bend;
  double load;         ///< P L² / EI [-]
  double coefficient;  ///< c that holds it [-]
};

/// Blade of length L [m] with its tip at the normal angle α on the ring, found by Newton's method from a
/// neighbouring bend, to its side; none where that does not converge to a blade under pressure.
template <class Direction>
std::optional<HeldBlade> hold(const Geometry& geometry, double length, const Pose& at, double normal_angle,
                              const blade::Bend& near) {
  const double a = geometry.ring_radius * std::cos(normal_angle);
  const double b = geometry.ring_radius * std::sin(normal_angle);
  const double shortening = (at.radial + geometry.reach - a) / length;
  const double deflection = (at.tangential - b) / length;
  const double side = std::copysign(1.0, near.modulus);
  blade::Bend bend = near;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const blade::InclinedPoint point = blade::inclined_equilibrium(bend.modulus, bend.amplitude);
    const double excess = shortening - point.shortening.value;
    const double offset = deflection - point.deflection.value;
    const double determinant = point.shortening.by_modulus * point.deflection.by_amplitude -
                               point.shortening.by_amplitude * point.deflection.by_modulus;
    const double by_modulus =
        (excess * point.deflection.by_amplitude - offset * point.shortening.by_amplitude) / determinant;
    const double by_amplitude =
        (offset * point.shortening.by_modulus - excess * point.deflection.by_modulus) / determinant;
    const double size =
        std::max(std::abs(by_modulus / bend.modulus), std::abs(by_amplitude / bend.amplitude));
    if (!(size < 1e3)) return std::nullopt;
    bend.modulus = side * std::clamp(side * (bend.modulus + by_modulus), 0.25 * side * bend.modulus,
                                     blade::kLargestModulus);
    bend.amplitude =
        std::clamp(bend.amplitude + by_amplitude, 0.25 * bend.amplitude, blade::kLargestAmplitude);
    if (size < 1e-9) {
      const double load_angle = 2.0 * std::asin(bend.modulus * std::cos(bend.amplitude));
      return HeldBlade{bend, point.load,
                       std::tan(Direction::kFollowsNormal ? load_angle - normal_angle : load_angle)};
    }
  }
  return std::nullopt;
}

}  // namespace rubatlas::contact
