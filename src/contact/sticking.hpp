/// A rigid blade's tip that sticks to the ring: the friction that keeps its slip velocity at rest.
///
/// With r = c + (rh+L) er, n = r/|r|, t = n turned by +90°, the slip velocity is v = r'·t, hence
///     dv/dτ = t·c'' + Ω² (rh+L) ct/|r| − v (n·r')/|r|,
/// and c'' contains the blade's own friction as −c F t/(m ωn²). So dv/dτ is linear in the friction
/// coefficient c, and sticking is the one c that makes it zero: Coulomb's law as an inclusion, c ∈ [−μ, μ] at
/// v = 0 (Filippov; Leine, Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems, Springer
/// 2004). The tip begins to slip where |c| reaches the static μ, in the direction s = sign c.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <span>

#include "contact/friction_law.hpp"
#include "contact/pose.hpp"

namespace rubatlas::contact {

/// Acceleration of the shaft's centre without the friction at the blade in question, along and across that
/// blade [m per unit τ²]: from shaft, damping, unbalance and other blades. It may include the blade's own
/// normal force, which does not change dv/dτ.
struct OtherAcceleration {
  double radial;      ///< ·er
  double tangential;  ///< ·et
};

/// Of μs, beyond which a tip comes loose: rounding does not lead it back.
inline constexpr double kShareBeyondCone = 1e-9;
/// |c| up to which a rigid tip is held.
inline double largest_at_rest(const Friction& friction) {
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
/// need if it were alone. `Tip`: has `tangent` and `pull`.
template <class Tip>
void share_out(std::span<Tip> tips) {
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

/// dv/dτ [m per unit τ²] of a rigid blade's tip under the friction coefficient c; `load_acceleration` is
/// F/(m ωn²) [m per unit τ²].
inline double slip_acceleration(const Geometry& geometry, const Pose& at, double angular_speed,
                                const OtherAcceleration& other, double load_acceleration,
                                double coefficient) {
  const double a = at.radial + geometry.reach;
  const double b = at.tangential;
  const double distance = std::sqrt(a * a + b * b);
  const double across = at.tangential_velocity + angular_speed * geometry.reach;
  const double slip_velocity = (a * across - b * at.radial_velocity) / distance;
  const double outward_velocity = (a * at.radial_velocity + b * across) / distance;
  return (a * other.tangential - b * other.radial + angular_speed * angular_speed * geometry.reach * b -
          slip_velocity * outward_velocity) /
             distance -
         coefficient * load_acceleration;
}

}  // namespace rubatlas::contact
