/// Contact law of elastic blades under an inclined tip load, with any friction law. The normal force loads
/// the blade along its axis, as the paper assumes, or along the contact normal.
///
/// The ring acts on the tip with −F n − c F t: n the normal where the deformed tip stands, (cos α, sin α)
/// along and across the blade, t = n turned by +90°, c the signed friction coefficient. Along and across the
/// blade that is one load P = F sqrt(1 + c²) at the angle b against the axis,
///     b = α + atan c   (normal: as it is)      b = atan c   (axial: MODEL 3.1, α left out),
/// and the blade is the elastica under an inclined load. The unknowns are its κ and φ
/// (blade/inclined_elastica.hpp); the equations are the contact equation h(κ, φ) = 0 (MODEL 4) and the
/// direction of the load
///     d(κ, φ) = b(κ, φ) − [α] − atan c(v) = 0,
/// where α, under the normal load only, and the slip velocity v (MODEL 4.4) follow from the place of the tip.
///
/// Sides. Under an axial load with friction the blade bends to the side to which friction pushes it. Where b
/// passes through zero (the normal turns, or c(v) changes sign) a blade that is bent stays bent to its side,
/// held there by the load that bends it, until its equilibrium ends in a fold and it snaps through. So the
/// side is a discrete state, as with any column; the sign of `bending` keeps it. A blade that has just
/// touched has no side yet (`bending` = 0). It bends to the side of its first load, the sign of b of the
/// undeformed tip, or to the side of s where that b is exactly 0. Under an axial load with Coulomb friction b
/// never passes through zero, and the side is always that of s (MODEL 2). Where tips stick, the c of a tip at
/// rest passes through zero, and the side is a discrete state, too.
#pragma once

#include <cmath>
#include <optional>

#include "blade/inclined_elastica.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "contact/pose.hpp"
#include "contact/sticking_elastica.hpp"
#include "contact/tip.hpp"

namespace rubatlas::contact {

class DirectedElastica : public ElasticBladeInRing {
 public:
  DirectedElastica(LoadDirection direction, const Geometry& geometry, const Blade& blade,
                   const Friction& friction)
      : ElasticBladeInRing(geometry, blade), direction_(direction), friction_(friction) {}

  [[nodiscard]] LoadDirection direction() const { return direction_; }
  [[nodiscard]] const Friction& friction() const { return friction_; }
  /// The same blade, shorter at its tip by `lost` [m].
  [[nodiscard]] DirectedElastica shortened(double lost) const {
    return {direction_, geometry_.shortened(lost), blade(lost), friction_};
  }
  /// The same blade under another friction law.
  [[nodiscard]] DirectedElastica with_friction(const Friction& friction) const {
    return {direction_, geometry_, blade(), friction};
  }

  using Bend = blade::Bend;

  /// Both equations at a bend, which are zero in equilibrium, or what they change by.
  struct Equations {
    double residual;      ///< h [m²]
    double misdirection;  ///< d [rad]; of a tip at rest v in its place, times R [m² per unit τ]
  };
  /// A contact at one bend. Of a tip at rest (s = 0) c is what holds it there.
  struct Constraint : Equations {
    blade::InclinedPoint blade;
    BladeVector<double> tip;  ///< [m]
    double coefficient;       ///< c [-]
    Equations by_modulus, by_amplitude;

    /// ∂(h, d)/∂(κ, φ): zero at a fold, where a bent blade snaps through.
    [[nodiscard]] double determinant() const {
      return by_modulus.residual * by_amplitude.misdirection -
             by_amplitude.residual * by_modulus.misdirection;
    }
    /// The change of the bend that takes back a change of both equations, times the determinant.
    [[nodiscard]] Bend against(const Equations& change) const {
      return {change.misdirection * by_amplitude.residual - change.residual * by_amplitude.misdirection,
              change.residual * by_modulus.misdirection - change.misdirection * by_modulus.residual};
    }
    /// Newton's step from the bend towards h = 0 and d = 0.
    [[nodiscard]] Bend correction() const {
      const Bend step = against(*this);
      return {step.modulus / determinant(), step.amplitude / determinant()};
    }
  };

  [[nodiscard]] Constraint constraint(const Pose& at, double slip, double angular_speed,
                                      const Bend& bend) const {
    ++evaluations_;
    Constraint result;
    result.blade = blade::inclined_equilibrium(bend);
    const blade::InclinedPoint& point = result.blade;
    const BladeVector<double> unbent = unbent_tip(geometry_, at);
    const BladeVector<double> bent{length_ * point.shortening.value, length_ * point.deflection.value};
    const BladeVector<double>& tip = result.tip = unbent - bent;
    result.residual = contact_equation(at.gap, unbent, bent);
    const LoadAngle load = load_angle(at, slip, angular_speed, tip);
    result.coefficient = load.coefficient;
    result.misdirection = point.load_angle.value - load.angle;
    const bool rests = slip == 0.0;
    const BladeVector<double> rate = tip_rate(at, angular_speed);
    if (rests) {
      result.coefficient = std::tan(result.misdirection);  // where friction has not been taken off yet
      result.misdirection = cross(tip, rate) + angular_speed * geometry_.ring_radius * geometry_.ring_radius;
    }
    const double per_square = 1.0 / dot(tip, tip);
    const auto slopes = [&](double shortening, double deflection, double load_angle) -> Equations {
      const BladeVector<double> change{-length_ * shortening, -length_ * deflection};
      // dα = (a db − b da)/|r|²
      return {square_change(tip, change),
              rests ? length_ * (deflection * rate.along - shortening * rate.across)
                    : load_angle - load.angle_by_normal * per_square * cross(tip, change)};
    };
    result.by_modulus =
        slopes(point.shortening.by_modulus, point.deflection.by_modulus, point.load_angle.by_modulus);
    result.by_amplitude =
        slopes(point.shortening.by_amplitude, point.deflection.by_amplitude, point.load_angle.by_amplitude);
    return result;
  }

  /// Force of a blade in equilibrium.
  [[nodiscard]] TipForce force_of(const Pose& at, double angular_speed, const Constraint& there) const;
  /// By τ, at a fixed bend and a constant angular speed. `acceleration`: that of the shaft's centre [m per
  /// unit τ²].
  [[nodiscard]] Equations drift(const Pose& at, double slip, double angular_speed,
                                const BladeVector<double>& acceleration, const Constraint& there) const {
    const BladeVector<double>& tip = there.tip;
    const BladeVector<double> rate = tip_rate(at, angular_speed);
    const double across = cross(tip, tip_acceleration(at, angular_speed, acceleration));
    Equations result{square_change(tip, rate), 0.0};
    if (slip == 0.0) return {result.residual, across};
    const double distance = magnitude(tip);
    const double turning = cross(tip, rate) / distance;
    if (follows_normal()) result.misdirection -= turning / distance;
    if (!friction_.has_slip_state()) {
      const double velocity = turning + angular_speed * geometry_.ring_radius;
      const double velocity_rate = (across - turning * dot(tip, rate) / distance) / distance;
      result.misdirection -=
          friction_.at(velocity, slip).slope * velocity_rate / (1.0 + there.coefficient * there.coefficient);
    }
    return result;
  }

  /// On the approaching side a contact opens from zero force, with a blade that is not bent (MODEL 4.2).
  [[nodiscard]] bool opens_unbent(const Pose& at, double slip, double angular_speed) const {
    return first_load_angle(at, slip, angular_speed) * at.tangential > 0.0 &&
           at.gap <= gap_rounding(geometry_, at);
  }
  /// The first equilibrium on the given side (±1) that is reached when the bending grows from the unloaded
  /// blade, or from the fold where the equilibria on that side begin; none where the blade cannot stand on
  /// that side. Slow, since it walks along the equilibria. A contact that bends the blade by less than a
  /// rounding error has κ = sin(b/2), φ = 0 and no load.
  [[nodiscard]] std::optional<Bend> solve(const Pose& at, double slip, double angular_speed,
                                          double side) const;

  /// Force at an equilibrium found near `bend`, which is updated; false where there is none. κ = 0: a new
  /// contact. The blade stays on the side of κ where it has an equilibrium there, and else snaps to the other
  /// side. Beyond the end of the contact (g < 0), where Runge–Kutta stages may land, the
  /// force is continued as in `ElasticaContact`.
  bool respond(const Pose& at, double slip, double angular_speed, Bend& bend, TipForce& force) const;

  /// The blade that holds its tip at rest on the ring, found from the bend `near`; none where no blade can.
  [[nodiscard]] std::optional<RestingBlade> rest(const Pose& at, double angular_speed,
                                                 const Bend& near) const;

  /// b of the undeformed blade [rad]; a blade that has just touched bends to the side of its sign.
  [[nodiscard]] double first_load_angle(const Pose& at, double slip, double angular_speed) const {
    return load_angle(at, slip, angular_speed, unbent_tip(geometry_, at)).angle;
  }

 private:
  [[nodiscard]] bool follows_normal() const { return direction_ == LoadDirection::normal; }
  /// Does a contact remember the side to which its blade is bent?
  [[nodiscard]] bool remembers_side() const {
    return follows_normal() || !friction_.has_slip_state() || friction_.sticks;
  }

  class Walk;
  struct LoadAngle {
    double angle;            ///< [α] + atan c [rad]
    double angle_by_normal;  ///< its derivative by α [-]
    double coefficient;      ///< c [-]
  };

  /// Angle of the load on a tip. The slip velocity depends on the tip's place only through the direction of
  /// the normal.
  [[nodiscard]] LoadAngle load_angle(const Pose& at, double slip, double angular_speed,
                                     const BladeVector<double>& tip) const {
    const BladeVector<double> rate = tip_rate(at, angular_speed);
    const double per_distance = 1.0 / magnitude(tip);
    const double velocity = slip_velocity(tip, rate, angular_speed, per_distance, geometry_.ring_radius);
    const double velocity_by_normal = -per_distance * dot(tip, rate);
    const auto [coefficient, slope] = friction_.at(velocity, slip);
    return {(follows_normal() ? std::atan2(tip.across, tip.along) : 0.0) + std::atan(coefficient),
            (follows_normal() ? 1.0 : 0.0) + slope * velocity_by_normal / (1.0 + coefficient * coefficient),
            coefficient};
  }

  /// Newton's method from a bend; none where it leaves the side, or ends on another branch than `solve`.
  [[nodiscard]] std::optional<Bend> newton(const Pose& at, double slip, double angular_speed,
                                           Bend bend) const;
  /// `solve` for friction that depends on v: an outer search for the coefficient c with c = c(v), and `solve`
  /// under each c.
  [[nodiscard]] std::optional<Bend> solve_for_coefficient(const Pose& at, double slip, double angular_speed,
                                                          double side) const;

  LoadDirection direction_;
  Friction friction_;
};

}  // namespace rubatlas::contact
