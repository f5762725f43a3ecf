/// Where a blade stands against the ring: everything that the contact of one blade needs to know of the
/// rotor.
///
/// All in the frame of the ring, resolved along the blade (er) and across it (et) (MODEL 2, 4).
#pragma once

#include <cmath>
#include <complex>
#include <cstdint>

namespace rubatlas::contact {

/// How the ring loads an elastic blade. `axial`: the paper's small-angle assumption, the normal load presses
/// along the undeformed blade, friction across it. `normal`: along the normal and tangent at the deformed
/// tip.
enum class LoadDirection : std::uint8_t { axial, normal };

/// The undeformed blade and the ring.
struct Geometry {
  double reach;        ///< rh + L [m]: from the shaft centre to the undeformed tip
  double ring_radius;  ///< R [m]

  /// (rh + L)² − R² [m²], as a product: R² and (rh+L)² agree in their leading digits.
  [[nodiscard]] double closing() const { return (reach - ring_radius) * (reach + ring_radius); }
  /// Of the blade shorter at its tip by `lost` [m].
  [[nodiscard]] Geometry shortened(double lost) const { return {reach - lost, ring_radius}; }
  /// g where a touch-down or a lift-off has been located [m²], `distance` of the shaft from the ring's
  /// centre: what rounding of the shaft's place and of the time leave of 2 (rh + L) cr.
  [[nodiscard]] double gap_rounding(double distance) const { return kGapRounding * ring_radius * distance; }
  static constexpr double kGapRounding = 1e-14;
};

/// A blade's angle, as its unit vector er = (cosine, sine).
struct BladeDirection {
  double cosine;
  double sine;
};

/// Shaft centre and its velocity seen from one blade. `Number`: `double`, eight nodes in lanes, or a number
/// that carries its slopes.
template <class Number>
struct PoseOf {
  Number radial;               ///< cr = c·er [m]
  Number tangential;           ///< ct = c·et [m]
  Number radial_velocity;      ///< c'·er [m per unit τ]
  Number tangential_velocity;  ///< c'·et [m per unit τ]
  Number gap;                  ///< g = |c + (rh+L) er|² − R² [m²]: in contact exactly while positive
};
using Pose = PoseOf<double>;

/// `er_x, er_y` is er; `cx, cy` is c = (x, y + y0) [m]; `vx, vy` its velocity.
template <class Number>
PoseOf<Number> pose(const Geometry& geometry, const Number& er_x, const Number& er_y, const Number& cx,
                    const Number& cy, const Number& vx, const Number& vy) {
  const Number radial = cx * er_x + cy * er_y;
  return {radial, cy * er_x - cx * er_y, vx * er_x + vy * er_y, vy * er_x - vx * er_y,
          cx * cx + cy * cy + 2.0 * geometry.reach * radial + geometry.closing()};
}
inline Pose pose(const Geometry& geometry, const BladeDirection& er, double cx, double cy, double vx,
                 double vy) {
  return pose<double>(geometry, er.cosine, er.sine, cx, cy, vx, vy);
}

/// Rounding of g there [m²].
inline double gap_rounding(const Geometry& geometry, const Pose& at) {
  return geometry.gap_rounding(std::sqrt(at.radial * at.radial + at.tangential * at.tangential));
}

/// dg/dτ [m²].
inline double gap_rate(const Geometry& geometry, const Pose& at, double angular_speed) {
  return 2.0 * (at.radial * at.radial_velocity + at.tangential * at.tangential_velocity) +
         2.0 * geometry.reach * (at.radial_velocity + angular_speed * at.tangential);
}

/// d²g/dτ² [m²] where the shaft's centre c moves with `velocity` and `acceleration`, all in the ring's frame.
inline double gap_curvature(const Geometry& geometry, const BladeDirection& er, const Pose& at,
                            const std::complex<double>& centre, const std::complex<double>& velocity,
                            const std::complex<double>& acceleration, double angular_speed) {
  const double outward = acceleration.real() * er.cosine + acceleration.imag() * er.sine;
  return 2.0 * (velocity.real() * velocity.real() + velocity.imag() * velocity.imag() +
                centre.real() * acceleration.real() + centre.imag() * acceleration.imag()) +
         2.0 * geometry.reach *
             (outward + angular_speed * (2.0 * at.tangential_velocity - angular_speed * at.radial));
}

inline constexpr double kSlipRounding = 1e-12;  ///< of the larger of Ω R and the shaft's speed
/// |v| where a slip reversal has been located [m per unit τ]. `tip_speed`: Ω R; `vx`, `vy`: z'.
inline double slip_rounding(double tip_speed, double vx, double vy) {
  return kSlipRounding * std::fmax(std::abs(tip_speed), std::sqrt(vx * vx + vy * vy));
}

}  // namespace rubatlas::contact
