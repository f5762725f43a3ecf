/// Where a blade stands against the ring: everything that the contact of one blade needs to know of the
/// rotor.
///
/// All in the frame of the ring, resolved along the blade (er) and across it (et) (MODEL 2, 4). Equations
/// that are evaluated for several motions side by side, one in each SIMD lane, are templates of the number;
/// names without `Of` are those of one motion.
#pragma once

#include <cmath>
#include <complex>
#include <type_traits>

namespace rubatlas::contact {

/// The undeformed blade and the ring.
template <class Number>
struct GeometryOf {
  Number reach;        ///< rh + L [m]: from the shaft centre to the undeformed tip
  Number ring_radius;  ///< R [m]

  /// (rh + L)² − R² [m²], as a product: R² and (rh+L)² agree in their leading digits.
  [[nodiscard]] Number closing() const { return (reach - ring_radius) * (reach + ring_radius); }
};
using Geometry = GeometryOf<double>;

/// A blade's angle, as its unit vector er = (cosine, sine).
template <class Number>
struct DirectionOf {
  Number cosine;
  Number sine;
};
using BladeDirection = DirectionOf<double>;

/// Shaft centre and its velocity seen from one blade.
template <class Number>
struct PoseOf {
  Number radial;               ///< cr = c·er [m]
  Number tangential;           ///< ct = c·et [m]
  Number radial_velocity;      ///< c'·er [m per unit τ]
  Number tangential_velocity;  ///< c'·et [m per unit τ]
  Number gap;                  ///< g = |c + (rh+L) er|² − R² [m²]: in contact exactly while positive
};
using Pose = PoseOf<double>;

/// `cx, cy` is c = (x, y + y0) [m]; `vx, vy` its velocity.
template <class Number>
PoseOf<Number> pose(const GeometryOf<Number>& geometry, const DirectionOf<Number>& er, const Number& cx,
                    const Number& cy, const Number& vx, const Number& vy) {
  const Number radial = cx * er.cosine + cy * er.sine;
  return {radial, cy * er.cosine - cx * er.sine, vx * er.cosine + vy * er.sine, vy * er.cosine - vx * er.sine,
          cx * cx + cy * cy + 2.0 * geometry.reach * radial + geometry.closing()};
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

/// Slip velocity of the undeformed tip [m per unit τ], which gives the slip direction of a new contact
/// (MODEL 4.4).
inline double undeformed_slip_velocity(const Geometry& geometry, const Pose& at, double angular_speed) {
  const double a = at.radial + geometry.reach;
  const double b = at.tangential;
  return (a * at.tangential_velocity - b * at.radial_velocity + angular_speed * geometry.reach * a) /
         std::hypot(a, b);
}

/// What a contact does: the force on the rotor, resolved along and across the blade, and what is recorded of
/// it.
template <class Number>
struct TipForceOf {
  Number radial;         ///< Fk·er [N]
  Number tangential;     ///< Fk·et [N]
  Number normal;         ///< F [N]
  Number shortening;     ///< δ/L [-]
  Number root_strain;    ///< bending strain at the root [-]; 0 for a rigid blade
  Number slip_velocity;  ///< v of the deformed tip [m per unit τ]
};
using TipForce = TipForceOf<double>;

/// A vector in the plane of the rotor, x + iy, of a number for which `std::complex` is not specified.
template <class Number>
class PlaneVectorOf {
 public:
  PlaneVectorOf(const Number& x, const Number& y) : x_(x), y_(y) {}
  [[nodiscard]] const Number& real() const { return x_; }
  [[nodiscard]] const Number& imag() const { return y_; }
  PlaneVectorOf operator-() const { return {-x_, -y_}; }
  PlaneVectorOf& operator+=(const PlaneVectorOf& other) {
    x_ += other.x_;
    y_ += other.y_;
    return *this;
  }

 private:
  Number x_;
  Number y_;
};
template <class Number>
using PlaneVector =
    std::conditional_t<std::is_same_v<Number, double>, std::complex<double>, PlaneVectorOf<Number>>;

/// Force on the rotor along x and y of a tip whose blade stands at `er` [N].
template <class Number>
PlaneVector<Number> on_rotor(const TipForceOf<Number>& force, const DirectionOf<Number>& er) {
  return {force.radial * er.cosine - force.tangential * er.sine,
          force.radial * er.sine + force.tangential * er.cosine};
}

}  // namespace rubatlas::contact
