/// Contact law `elastica`: large-deflection blades in a rigid ring (MODEL 3, 4).
///
/// The contact equation h = 0 couples the tip's position to the ring. It is used in two ways: as a constraint
/// that an integrator carries along with the bending parameter u as a state (`constraint`), and as an
/// equation to solve for u where several blades share the rotor (`solve`).
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "blade/elastica_curve.hpp"
#include "contact/pose.hpp"

namespace rubatlas::contact {

class ElasticaContact {
 public:
  /// An open contact is described by its bending parameter u.
  static constexpr bool kHasBending = true;

  struct Blade {
    double length;             ///< L [m]
    double thickness;          ///< h [m]
    double bending_stiffness;  ///< EI = E b h³ / 12 [N m²]
  };

  ElasticaContact(Geometry geometry, Blade blade, std::shared_ptr<const blade::ElasticaCurve> curve)
      : geometry_(geometry),
        length_(blade.length),
        load_unit_(blade.bending_stiffness / (blade.length * blade.length)),
        strain_unit_(0.5 * blade.thickness / blade.length),
        friction_(curve->friction()),
        curve_(std::move(curve)) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  /// The law of one blade: the same for all.
  using OfBlade = ElasticaContact;
  [[nodiscard]] const OfBlade& of(int /*blade*/) const { return *this; }
  [[nodiscard]] const blade::ElasticaCurve& curve() const { return *curve_; }
  [[nodiscard]] double length() const { return length_; }            ///< L [m]
  [[nodiscard]] double load_unit() const { return load_unit_; }      ///< EI / L² [N]
  [[nodiscard]] double strain_unit() const { return strain_unit_; }  ///< h / (2 L) [-]

  /// A contact at one bending parameter, with the rates that carry it along h = 0.
  struct Constraint {
    TipForce force;
    double residual;       ///< h [m²]
    double bending_slope;  ///< ∂h/∂u [m²]
    double time_slope;     ///< dh/dτ at fixed u [m²]
  };

  [[nodiscard]] Constraint constraint(const Pose& at, double slip, double bending, double speed_ratio) const {
    const blade::CurvePoint point = curve_at(bending);
    const double shortening = length_ * point.shortening;  // δ
    const double deflection = length_ * point.deflection;  // Δ
    const double a = at.radial + geometry_.reach - shortening;
    const double b = at.tangential - slip * deflection;
    Constraint result;
    // h = a² + b² − R² written from g, so that a light contact keeps its digits.
    result.residual = at.gap + shortening * (shortening - 2.0 * (at.radial + geometry_.reach)) +
                      deflection * (deflection - 2.0 * slip * at.tangential);
    result.bending_slope = -2.0 * length_ * (a * point.shortening_slope + slip * b * point.deflection_slope);
    result.time_slope = 2.0 * a * (at.radial_velocity + speed_ratio * at.tangential) +
                        2.0 * b * (at.tangential_velocity - speed_ratio * at.radial);
    const double inverse_distance = 1.0 / std::sqrt(a * a + b * b);
    const double normal_radial = a * inverse_distance;
    const double normal_tangential = b * inverse_distance;
    const double load = load_unit_ * point.load;
    const double friction = slip * friction_ * load;
    // Fk = −F n − s μ F t with t = n turned by +90°.
    result.force.radial = -load * normal_radial + friction * normal_tangential;
    result.force.tangential = -load * normal_tangential - friction * normal_radial;
    result.force.normal = load;
    result.force.shortening = point.shortening;
    // (h/2) θ'(0) with EI θ'(0) = F Δ + μF (L − δ)
    result.force.root_strain =
        strain_unit_ * point.load * (point.deflection + friction_ * (1.0 - point.shortening));
    result.force.slip_velocity =
        normal_radial * at.tangential_velocity - normal_tangential * at.radial_velocity +
        speed_ratio *
            ((geometry_.reach - shortening) * normal_radial - slip * deflection * normal_tangential);
    return result;
  }

  /// Root of h = 0 that an increase of the load from zero reaches first (MODEL 4.2), or none (MODEL 5).
  [[nodiscard]] std::optional<double> solve(const Pose& at, double slip) const;

  /// The same root found from a neighbouring one; falls back on `solve`.
  [[nodiscard]] std::optional<double> solve_near(const Pose& at, double slip, double bending) const;

  /// Force at a root found near `bending`, which is updated; false where there is none. Smooth a little
  /// beyond the end of the contact (g < 0), where Runge–Kutta stages may land: the force is continued as an
  /// odd function.
  bool respond(const Pose& at, double slip, double speed_ratio, double& bending, TipForce& force) const;

  /// Force by the published scheme (MODEL 4.2): F ← F + dF from 0 until h changes sign; `increment` dF [N].
  /// Where g > 0; false where the table ends before. The curve is followed in its own parameter, mostly one
  /// evaluation an increment.
  bool respond_upwards(const Pose& at, double slip, double speed_ratio, double increment,
                       TipForce& force) const;

  /// How often the curve has been evaluated for this law. A law belongs to one motion and one thread.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }
  /// Counts evaluations that were made elsewhere on behalf of this law.
  void count_evaluations(std::uint64_t more) const { evaluations_ += more; }

 private:
  [[nodiscard]] blade::CurvePoint curve_at(double bending) const {
    ++evaluations_;
    return curve_->at(bending);
  }
  [[nodiscard]] double residual(const Pose& at, double slip, double shortening, double deflection) const {
    const double delta = length_ * shortening;
    const double lateral = length_ * deflection;
    return at.gap + delta * (delta - 2.0 * (at.radial + geometry_.reach)) +
           lateral * (lateral - 2.0 * slip * at.tangential);
  }

  Geometry geometry_;
  double length_;
  double load_unit_;
  double strain_unit_;
  double friction_;
  std::shared_ptr<const blade::ElasticaCurve> curve_;
  mutable std::uint64_t evaluations_ = 0;  ///< what a motion cost, not what it is
};

}  // namespace rubatlas::contact
