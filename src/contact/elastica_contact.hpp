/// Contact law `elastica`: large-deflection blades in a rigid ring (MODEL 3, 4). The curve that it is given
/// may as well be a beam-column, with axial compliance or without.
///
/// The contact equation h = 0 couples the tip's position to the ring. It is used in two ways: as a constraint
/// that an integrator carries along with the bending parameter u as a state (`constraint`), and as an
/// equation to solve for u where several blades share the rotor (`solve`).
///
/// The ring may yield under each tip, in series with the blade,
///     h = a² + b² − (R + F/kr)²
/// and says where a contact ends. The paper's ring does not yield, and a contact ends at it.
///
/// Branches. Where something gives way in series with the bending (axial compliance, a ring that yields) h
/// may fall with the load, rise and fall again on the receding side: the blade stands compressed, or bent,
/// and what lies between is unstable. A contact opens on the branch that load increased from zero meets
/// first, and stays on its branch until that ends in a fold, ∂h/∂u = 0, where the blade snaps to the next one
/// (MODEL 4.2). The bending parameter from which a root is asked for (`solve_near`, `respond`) says which
/// branch is meant.
///
/// The column (μ = 0) of such a blade or in such a ring is compressed straight up to its Euler load before it
/// bends: straight, `bending` = 0, and bent are its two branches. It is solved for.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "blade/elastica_curve.hpp"
#include "contact/friction_law.hpp"
#include "contact/pose.hpp"
#include "contact/tip.hpp"

namespace rubatlas::contact {

/// The ring, the paper's unless it is said to be another.
struct Ring {
  double stiffness = std::numeric_limits<double>::infinity();  ///< kr > 0 [N/m], under each tip by itself
                                                               ///< (MODEL 4.7); infinite: rigid
  /// A contact ends where the force does, at u = 0, or at the fold ∂h/∂u = 0 beyond which there is no root.
  /// Else where the undeformed tip leaves the ring, g = 0 (MODEL 4.1).
  bool releases_at_fold = false;
};

/// What the laws of elastic blades have in common: a blade and its ring.
class ElasticBladeInRing {
 public:
  /// What a law knows of an elastic blade.
  struct Blade {
    double length;             ///< L [m]
    double thickness;          ///< h [m]
    double bending_stiffness;  ///< EI = E b h³ / 12 [N m²]
  };

  ElasticBladeInRing(const Geometry& geometry, const Blade& blade)
      : geometry_(geometry),
        length_(blade.length),
        load_unit_(blade.bending_stiffness / (blade.length * blade.length)),
        strain_unit_(0.5 * blade.thickness / blade.length) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] double length() const { return length_; }            ///< L [m]
  [[nodiscard]] double load_unit() const { return load_unit_; }      ///< EI / L² [N]
  [[nodiscard]] double strain_unit() const { return strain_unit_; }  ///< h / (2 L) [-]
  /// The blade, shorter at its tip by `lost` [m].
  [[nodiscard]] Blade blade(double lost = 0.0) const {
    return {length_ - lost, 2.0 * strain_unit_ * length_, load_unit_ * length_ * length_};
  }
  /// How often equilibria have been evaluated for this law. A law belongs to one motion and one thread.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 protected:
  Geometry geometry_;
  double length_;
  double load_unit_;
  double strain_unit_;
  mutable std::uint64_t evaluations_ = 0;  ///< what a motion cost, not what it is
};

class ElasticaContact : public ElasticBladeInRing {
 public:
  ElasticaContact(const Geometry& geometry, const Blade& blade,
                  std::shared_ptr<const blade::ElasticaCurve> curve, Ring ring = {})
      : ElasticBladeInRing(geometry, blade), ring_(ring), curve_(std::move(curve)) {}

  [[nodiscard]] const blade::ElasticaCurve& curve() const { return *curve_; }
  [[nodiscard]] Friction friction() const { return Friction::coulomb(friction_); }
  /// EI/(L² kr) [m]: yielding of the ring under F = EI/L²; 0 where it does not.
  [[nodiscard]] double yield_unit() const { return yield_unit_; }
  [[nodiscard]] double axial_unit() const { return axial_unit_; }  ///< axial shortening under F = EI/L² [m]
  /// δ/Δ and (F/kr)/Δ of a blade that is hardly bent, where μ > 0 [-].
  [[nodiscard]] double first_shortening() const { return axial_relief_; }
  [[nodiscard]] double first_yielding() const { return ring_relief_ / geometry_.ring_radius; }
  /// The same blade, shorter at its tip by `lost` [m]. The curve stays, and with it the axial compliance
  /// relative to the length.
  [[nodiscard]] ElasticaContact shortened(double lost) const {
    return {geometry_.shortened(lost), blade(lost), curve_, ring_};
  }

  /// Whether a contact on the receding side goes on while it has a force, with g < 0.
  [[nodiscard]] bool releases_at_fold() const { return ring_.releases_at_fold; }
  /// A column that something gives way in series with: up to its Euler load it is compressed straight.
  [[nodiscard]] bool may_stand_straight() const { return !(friction_ > 0.0) && has_branches(); }
  /// Whether h = 0 may have more than one root where a blade can stand.
  [[nodiscard]] bool has_branches() const { return axial_unit_ > 0.0 || yield_unit_ > 0.0; }

  /// Whether the force vanishes with the gap where the blade stands: h falls with the load from the unloaded
  /// blade on, −dh/dF = 2 (rh + L + cr) dδ/dF + 2 s ct dΔ/dF + 2R/kr >= 0 with Δ = μ F L³/(3 EI) there.
  /// Without compliance: the approaching side (MODEL 4.2).
  [[nodiscard]] bool starts_unloaded(const Pose& at, double slip) const {
    if (may_stand_straight()) return true;
    return slip * at.tangential + (axial_relief_ * (at.radial + geometry_.reach) + ring_relief_) >= 0.0;
  }
  /// The same for an open contact, which may stand on another branch.
  [[nodiscard]] bool ends_unloaded(const Pose& at, double slip, double bending) const;

  /// A contact at one bending parameter, with the rates that carry it along h = 0.
  struct Constraint {
    TipForce force;
    double bending_slope;  ///< ∂h/∂u [m²]
    double time_slope;     ///< dh/dτ at fixed u [m²]
  };

  [[nodiscard]] Constraint constraint(const Pose& at, double slip, double bending,
                                      double angular_speed) const {
    return constraint_at(at, slip, curve_at(bending), angular_speed);
  }

  /// g/Δ [m] of a blade bent by u, as h = 0 has it. At the unloaded blade it is finite, and has the sign of
  /// `starts_unloaded`: it is zero where g is, but for u = 0.
  [[nodiscard]] double gap_per_deflection(const Pose& at, double slip, double bending) const {
    const blade::CurvePoint point = curve_at(bending);
    const double shortening = length_ * point.shortening;
    const double deflection = length_ * point.deflection;
    if (deflection == 0.0) {
      return 2.0 * (slip * at.tangential + axial_relief_ * (at.radial + geometry_.reach) + ring_relief_);
    }
    const double yielding = yield_unit_ * point.load;  // F/kr
    return 2.0 * slip * at.tangential - deflection +
           shortening / deflection * (2.0 * (at.radial + geometry_.reach) - shortening) +
           yielding / deflection * (2.0 * geometry_.ring_radius + yielding);
  }

  /// Root of h = 0 that an increase of the load from zero reaches first (MODEL 4.2), or none (MODEL 5).
  [[nodiscard]] std::optional<double> solve(const Pose& at, double slip) const;

  /// The root on the branch of a neighbouring one; none where that branch has ended.
  [[nodiscard]] std::optional<double> solve_near(const Pose& at, double slip, double bending) const;

  /// The root to which a blade snaps that has come to the end of its branch at `bending`: the next one in the
  /// direction in which it moves, more load where the ring closes in on the tip, dh/dτ > 0 at fixed u, less
  /// where it opens. None: the load goes to zero, or there is nothing to stand on (`closes_in`).
  [[nodiscard]] std::optional<double> snap(const Pose& at, double slip, double bending,
                                           double angular_speed) const;
  /// Whether the ring closes in on the tip of a blade bent by u.
  [[nodiscard]] bool closes_in(const Pose& at, double slip, double bending, double angular_speed) const {
    return constraint(at, slip, bending, angular_speed).time_slope > 0.0;
  }
  /// F L²/EI of a straight column whose tip lies on the ring: the smaller root of h = 0, which is quadratic
  /// in F at Δ = 0. At most the Euler load where the column is straight indeed.
  [[nodiscard]] double straight_load(const Pose& at) const {
    const double linear = (at.radial + geometry_.reach) * axial_unit_ + geometry_.ring_radius * yield_unit_;
    const double square = axial_unit_ * axial_unit_ - yield_unit_ * yield_unit_;
    return at.gap / (linear + std::sqrt(linear * linear - square * at.gap));
  }
  /// Its force, beyond the Euler load, too.
  [[nodiscard]] TipForce straight_force(const Pose& at, double slip, double angular_speed) const {
    const double load = straight_load(at);
    return constraint_at(at, slip, {load, curve_->axial_compliance() * load, 0.0, 0.0, 0.0, 0.0},
                         angular_speed)
        .force;
  }

  /// Force at the root on the branch of `bending`, which is updated; false where there is none. Smooth a
  /// little beyond the end of the contact (g < 0), where Runge–Kutta stages may land: the force is continued
  /// as an odd function. Smooth beyond the Euler load of a straight column that will snap there, too.
  bool respond(const Pose& at, double slip, double angular_speed, double& bending, TipForce& force) const;

  /// A point of the curve, which counts as an evaluation.
  [[nodiscard]] blade::CurvePoint curve_at(double bending) const {
    ++evaluations_;
    return curve_->at(bending);
  }
  /// h [m²] there. `point`: of the curve or one of its knots.
  [[nodiscard]] double residual(const Pose& at, double slip, const blade::CurvePoint& point) const {
    return contact_equation(at.gap, unbent_tip(geometry_, at), bent_by(slip, point)) -
           widening(yield_unit_ * point.load, geometry_.ring_radius);
  }

 private:
  /// (δ, s Δ) [m].
  [[nodiscard]] BladeVector<double> bent_by(double slip, const blade::CurvePoint& point) const {
    return {length_ * point.shortening, slip * length_ * point.deflection};
  }
  [[nodiscard]] BladeVector<double> tip(const Pose& at, double slip, const blade::CurvePoint& point) const {
    return unbent_tip(geometry_, at) - bent_by(slip, point);
  }
  /// A slope of h, and the sum of the magnitudes of which it is made [m²].
  struct Slope {
    double sum, size;
  };
  /// ∂h/∂u: of the bend, and of the ring that yields.
  [[nodiscard]] Slope slope(const Pose& at, double slip, const blade::CurvePoint& point) const {
    const BladeVector<double> there = tip(at, slip, point);
    const double twice = -2.0 * length_;
    const double by_shortening = twice * there.along * point.shortening_slope;
    const double by_deflection = twice * slip * there.across * point.deflection_slope;
    const double by_ring =
        -2.0 * yield_unit_ * (geometry_.ring_radius + yield_unit_ * point.load) * point.load_slope;
    return {by_shortening + by_deflection + by_ring,
            std::abs(by_shortening) + std::abs(by_deflection) + std::abs(by_ring)};
  }
  /// dh/dF (dh/du for the column) as `Knot` has its slopes.
  [[nodiscard]] Slope rise(const Pose& at, double slip, const blade::CurvePoint& point) const {
    const Slope by_bend = slope(at, slip, point);
    return friction_ > 0.0 ? Slope{by_bend.sum / point.load_slope, by_bend.size / point.load_slope} : by_bend;
  }
  [[nodiscard]] Constraint constraint_at(const Pose& at, double slip, const blade::CurvePoint& point,
                                         double angular_speed) const;

  /// The bending with which the force sets in at g = 0 (MODEL 4.2): the first root of g/Δ, which is well
  /// determined where h rises from the unloaded blade by less than the rounding of g. 0 on the approaching
  /// side.
  [[nodiscard]] double bending_at_ring(const Pose& at, double slip) const;
  /// A stretch of the curve on which h falls, where a blade can stand.
  struct Branch {
    double begin;  ///< u of a fold; 0: the unloaded blade
    double end;    ///< u of a fold, or the end of the table
    double crest;  ///< u before it where h rises most steeply; 0: nowhere
  };
  /// In the order of the load. In 24 000 random poses there were never more than two.
  [[nodiscard]] std::vector<Branch> branches(const Pose& at, double slip) const;
  /// Place of the branch of a blade bent by u, or whose end it has just passed.
  static std::size_t place_of(double bending, const std::vector<Branch>& branches) {
    std::size_t place = 0;
    while (place + 1 < branches.size() && bending >= branches[place + 1].crest) ++place;
    return place;
  }
  [[nodiscard]] std::optional<double> root_on(const Pose& at, double slip, const Branch& branch) const;

  Ring ring_;
  std::shared_ptr<const blade::ElasticaCurve> curve_;
  double friction_ = curve_->friction();                      ///< μ [-]
  double yield_unit_ = load_unit_ / ring_.stiffness;          ///< 0 where the ring does not yield [m]
  double axial_unit_ = length_ * curve_->axial_compliance();  ///< L ε [m]: axial shortening under F = EI/L²
  double per_lateral_ = friction_ > 0.0 ? 3.0 / (friction_ * length_) : 0.0;  ///< 3/(μL) [1/m]
  double axial_relief_ = per_lateral_ * axial_unit_;                          ///< 3ε/μ [-]
  double ring_relief_ = per_lateral_ * yield_unit_ * geometry_.ring_radius;   ///< 3 EI R / (μ L³ kr) [m]
};

}  // namespace rubatlas::contact
