/// An elastic blade's tip that sticks to the ring: its place, the load that holds it there, and the friction
/// coefficient of that load.
///
/// The place of a tip that sticks is given, and its load is unknown: with the tip at the normal angle α on
/// the ring, δ = cr + rh + L − R cos α and D = ct − R sin α are known, and the elastica's two functions δ(κ,
/// φ) and D(κ, φ) are solved for κ and φ. The load's angle b against the blade then gives the friction
/// coefficient c = tan(b − α) (tan b where the load is axial); the tip can stick while |c| is within the
/// static coefficient.
///
/// Rest may be defined in two ways, with different α. In the model the slip velocity is that of a rigid body
/// (MODEL 4.4), so that v = 0 is a condition on α alone (`resting_normal_angle`): a sliding mode, an index-1
/// constraint. If the elastic part of the tip's velocity were included, a tip at rest would stay at one point
/// of the ring, with a constant α + Ωτ. `hold` serves both.
///
/// An inextensible blade can be held by pressure only where it is bent enough, roughly δ >= D²/(2L). Where
/// the given place would need a pull, `hold` returns none.
///
/// With the model's α, Coulomb's inclusion c ∈ μ Sign(v) is algebraic: at a given pose v is a function of c
/// along the blade's equilibria, of slope dv/dc ~ dv/dα ∂(δ, D)/∂(κ, φ). Where v falls as c grows, rest is
/// the limit of a friction law that becomes ever steeper in v. Where v rises as c grows, rest is unstable,
/// and at the same pose the tip may slip in either direction. `firmness` tells these cases apart. v mostly
/// falls while the blade unbends, and mostly rises while it is pressed in, since dv/dα = −A sin α − B cos α,
/// in which B is about the speed at which the tip is pressed in.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "blade/inclined_elastica.hpp"
#include "contact/pose.hpp"
#include "contact/tip.hpp"

namespace rubatlas::contact {

/// The normal angle α [rad] next to `near` at which the slip velocity of a tip on the ring vanishes, v = A
/// cos α − B sin α + ΩR = 0 with A = c'·et − Ω cr, B = c'·er + Ω ct; none where |ΩR| exceeds (A² + B²)^½, so
/// that no tip on the ring can be at rest.
inline std::optional<double> resting_normal_angle(const Geometry& geometry, const Pose& at,
                                                  double angular_speed, double near) {
  const BladeVector<double> rate = tip_rate(at, angular_speed);
  const double ratio = -angular_speed * geometry.ring_radius / magnitude(rate);
  if (!(std::abs(ratio) <= 1.0)) return std::nullopt;
  const double centre = -std::atan2(rate.along, rate.across);
  const double spread = std::acos(ratio);
  const auto distance = [&](double angle) {
    return std::abs(std::remainder(angle - near, 2.0 * std::acos(-1.0)));
  };
  const double one = centre + spread;
  const double other = centre - spread;
  return near + std::remainder((distance(one) < distance(other) ? one : other) - near, 2.0 * std::acos(-1.0));
}

/// A blade whose tip is held at a place on the ring.
struct RestingBlade {
  blade::Bend bend;
  double coefficient;  ///< c that holds it [-]
  /// How firmly the tip rests: dv/dα / (Ω R), with the sign that makes it positive where v falls as c grows,
  /// so that rest is stable, and negative where rest is unstable.
  double firmness;
};

/// Blade of length L [m] with its tip at the normal angle α on the ring, found by Newton's method from a
/// neighbouring bend and on its side; none where the method does not converge to a blade under pressure.
inline std::optional<RestingBlade> hold(LoadDirection direction, const Geometry& geometry, double length,
                                        const Pose& at, double angular_speed, double normal_angle,
                                        const blade::Bend& near) {
  constexpr double kLeast = 0.25;  // factors by which a step may change κ and φ
  constexpr double kMost = 4.0;
  const double a = geometry.ring_radius * std::cos(normal_angle);
  const double b = geometry.ring_radius * std::sin(normal_angle);
  const double shortening = (at.radial + geometry.reach - a) / length;
  const double deflection = (at.tangential - b) / length;
  const double side = std::copysign(1.0, near.modulus);
  if (!(shortening > 0.0) || !(side * deflection > 0.0)) return std::nullopt;
  // For small bending δ/D² depends on φ alone, and grows with φ.
  const double bow = std::log(shortening / (deflection * deflection));
  const double aside = std::log(side * deflection);
  blade::Bend bend = near;
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 40; ++iteration) {
    const blade::InclinedPoint point = blade::inclined_equilibrium(bend);
    const blade::Inclined& delta = point.shortening;
    const blade::Inclined& aside_now = point.deflection;
    if (!(delta.value > 0.0) || !(side * aside_now.value > 0.0)) return std::nullopt;
    // Derivatives of ln D and ln δ/D² by ln κ and ln φ.
    const double aside_by_modulus = bend.modulus * aside_now.by_modulus / aside_now.value;
    const double aside_by_amplitude = bend.amplitude * aside_now.by_amplitude / aside_now.value;
    const double bow_by_modulus = bend.modulus * delta.by_modulus / delta.value - 2.0 * aside_by_modulus;
    const double bow_by_amplitude =
        bend.amplitude * delta.by_amplitude / delta.value - 2.0 * aside_by_amplitude;
    const double of_bow = bow - std::log(delta.value / (aside_now.value * aside_now.value));
    const double of_aside = aside - std::log(side * aside_now.value);
    const double determinant = bow_by_modulus * aside_by_amplitude - bow_by_amplitude * aside_by_modulus;
    const double by_modulus = (of_bow * aside_by_amplitude - of_aside * bow_by_amplitude) / determinant;
    const double by_amplitude = (of_aside * bow_by_modulus - of_bow * aside_by_modulus) / determinant;
    const double size = std::max(std::abs(by_modulus), std::abs(by_amplitude));
    if (!(size < 1e6)) return std::nullopt;
    bend.modulus = side * std::min(side * bend.modulus * std::clamp(1.0 + by_modulus, kLeast, kMost),
                                   blade::kLargestModulus);
    bend.amplitude =
        std::min(bend.amplitude * std::clamp(1.0 + by_amplitude, kLeast, kMost), blade::kLargestAmplitude);
    // The rounding of δ limits the accuracy of a light contact; the steps then no longer shrink.
    if (size < 1e-9 || (size < 1e-5 && size >= 0.5 * previous)) {
      const double load_angle = 2.0 * std::asin(bend.modulus * std::cos(bend.amplitude));
      const double angle = direction == LoadDirection::normal ? load_angle - normal_angle : load_angle;
      if (!(std::cos(angle) > 0.0)) return std::nullopt;  // the ring would have to pull
      const BladeVector<double> rate = tip_rate(at, angular_speed);
      const double by_angle = -rate.across * std::sin(normal_angle) - rate.along * std::cos(normal_angle);
      // The determinant has the sign of ∂(δ, D)/∂(κ, φ).
      return RestingBlade{
          bend, std::tan(angle),
          -std::copysign(1.0, determinant) * by_angle / std::abs(angular_speed * geometry.ring_radius)};
    }
    previous = size;
  }
  return std::nullopt;
}

/// Of `firmness`, at which a tip comes loose: where dv/dα passes through zero, c changes within times that
/// vanish with it.
inline constexpr double kLeastFirmness = 1e-6;
/// Of μs, beyond which a tip comes loose. A tip comes to rest at the very edge of the cone, where its
/// coefficient is known to some 1e-8: whether it rests must not depend on that.
inline constexpr double kBeyondCone = 1e-7;
/// κ, of μs, below which the blade of a tip at rest is a straight strut between hub and ring, as stiff as
/// 1/κ², and about to leave the ring: the tip comes loose.
inline constexpr double kLeastModulus = 2e-4;

}  // namespace rubatlas::contact
