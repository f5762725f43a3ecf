/// A rigid blade's tip that sticks to the ring: the friction that keeps its slip velocity at rest.
///
/// With r = c + (rh+L) er, n = r/|r|, t = n turned by +90°, the slip velocity is v = r'·t, hence
///     dv/dτ = t·c'' + Ω² (rh+L) ct/|r| − v (n·r')/|r|
/// (here from r as the turning blade sees it), and c'' contains the blade's own friction as −c F t/(m ωn²).
/// So dv/dτ is linear in the friction coefficient c, and sticking is the one c that makes it zero: Coulomb's
/// law as an inclusion, c ∈ [−μ, μ] at v = 0 (Filippov; Leine, Nijmeijer, Dynamics and Bifurcations of
/// Non-Smooth Mechanical Systems, Springer 2004). The tip begins to slip where |c| reaches the static μ, in
/// the direction s = sign c.
#pragma once

#include <complex>
#include <cstddef>
#include <span>

#include "contact/friction_law.hpp"
#include "contact/tip.hpp"

namespace rubatlas::contact {

/// |c| up to which a rigid tip is held: so much beyond μs that rounding does not lead it back.
inline double largest_at_rest(const Friction& friction) {
  constexpr double kShareBeyondCone = 1e-9;
  return (1.0 + kShareBeyondCone) * friction.static_friction;
}

/// Of rigid tips: with v = Ω (|r| − p·n), p the rotor's instantaneous centre, all that are at rest touch the
/// ring where a tangent to it leads to p.
inline constexpr std::size_t kMostAtRest = 2;

/// A rigid tip that is kept at rest.
struct AtRest {
  std::complex<double> tangent;  ///< t
  double pull;                   ///< q of it alone, then of all that are kept at rest
};
/// The pulls along the tangents that take away the rates of all of them, which are the pulls that each would
/// need if it were alone.
inline void share_out(std::span<AtRest> tips) {
  if (tips.size() != kMostAtRest) return;
  const std::complex<double> between = std::conj(tips[0].tangent) * tips[1].tangent;
  const double square = between.imag() * between.imag();
  const double first = (tips[0].pull - between.real() * tips[1].pull) / square;
  tips[1].pull = (tips[1].pull - between.real() * tips[0].pull) / square;
  tips[0].pull = first;
}

/// Direction t of the slip of a rigid blade's tip, along (real) and across the blade.
inline std::complex<double> tangent(const Geometry& geometry, const Pose& at) {
  const std::complex<double> outward(at.radial + geometry.reach, at.tangential);
  return outward / std::abs(outward) * std::complex<double>(0.0, 1.0);
}

/// dv/dτ [m per unit τ²] of a rigid blade's tip at the distance |r| in the direction n; `rate` and
/// `acceleration`: of r as seen from the blade (`tip.hpp`).
template <class Number, class Speed>
Number slip_acceleration(const BladeVector<Number>& normal, const Number& distance,
                         const BladeVector<Number>& rate, const BladeVector<Number>& acceleration,
                         const Speed& angular_speed) {
  return cross(normal, acceleration) + dot(normal, rate) * (angular_speed - cross(normal, rate) / distance);
}
/// The same where the shaft's centre moves with `acceleration`, without the friction of this tip: by support,
/// unbalance and other blades. The normal force of this one does not change dv/dτ.
inline double slip_acceleration(const Geometry& geometry, const Pose& at, double angular_speed,
                                const BladeVector<double>& acceleration) {
  const BladeVector<double> tip = unbent_tip(geometry, at);
  const double distance = magnitude(tip);
  return slip_acceleration(tip / distance, distance, tip_rate(at, angular_speed),
                           tip_acceleration(at, angular_speed, acceleration), angular_speed);
}

}  // namespace rubatlas::contact
