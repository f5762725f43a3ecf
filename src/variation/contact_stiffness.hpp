/// How the force of a contact, and the guard of its slip, change with place and velocity of the shaft.
///
/// In the frame of the ring the tip lies at w = a er + b et, c + (rh+L−δ) er − sΔ et (MODEL 2). The rotor
/// feels
///     f = −(F/|w|) (w + sμ Jw)                                                 (MODEL 4.3),
/// J a quarter turn. Elastic blades have F, δ and Δ as functions of the bending u, and h = |w|² − R² = 0
/// (MODEL 4.1), so that the derivative by c is
///     df/dc = f_c − f_u h_cᵀ / h_u,   f_c = −(F/R)(I + sμJ),   h_c = 2w.
/// Where h_u passes through zero it grows beyond all bounds, and with it the time hardly moves along the path
/// (τ(θ), u(θ)) of the contact: h_u u_θ + h_τ τ_θ = 0. So what is integrated is
///     (df/dc) τ_θ = f_c τ_θ − λ f_u h_cᵀ,   λ = τ_θ / h_u = −u_θ / h_τ,
/// which is regular unless the tip grazes, where both h_u and h_τ vanish. Source: the variational equation of
/// a constrained system, by implicit differentiation.
///
/// Friction that depends on the slip velocity, c(v) in place of sμ, adds df/dc'. Rigid blades have both in
/// closed form; elastic blades then have two unknowns, κ and φ (`directed_stiffness.hpp`).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <variant>

#include "contact/directed_elastica.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"
#include "settings/scene.hpp"
#include "trajectory/motion_piece.hpp"

#include "variation/force_slopes.hpp"

namespace rubatlas::variation {

class ContactStiffness {
 public:
  /// `line`: the scene with the line's values. Its blades are equal, its law and friction as
  /// `settings::refusal_of_linearisation` allows them.
  explicit ContactStiffness(const settings::Scene& line);

  /// A speed ratio Ω of the line.
  void begin(const rotor::RotorConstants& rotor);

  /// Slopes of the force, times τ_θ, summed over the contacts of a place on the path. `acceleration` of the
  /// shaft there [m per unit τ²] is read only where `needs_acceleration`. Nothing where a blade has no force.
  [[nodiscard]] std::optional<ForceSlopes> along_path(const trajectory::PathPoint& point,
                                                      const PathScale& scale,
                                                      const Eigen::Vector2d& acceleration) const;
  /// The bending of a blade changes with the acceleration of the shaft, through the slip velocity.
  [[nodiscard]] bool needs_acceleration() const { return std::holds_alternative<DirectedBlade>(law_); }

  /// A guard e of a blade: its gradient by the shaft's state, and its rate along the motion.
  struct Guard {
    Eigen::RowVector4d gradient;
    double rate;
  };
  /// e = g, of touch-downs and lift-offs at the ring; `state` of the shaft at time τ.
  [[nodiscard]] Guard gap(int blade, double time, const trajectory::State& state) const;
  /// e = v |w|, of slip reversals, where the shaft has this acceleration [m per unit τ²]. Nothing where the
  /// blade has no force.
  [[nodiscard]] std::optional<Guard> slip(const trajectory::PathPoint::Contact& contact, double time,
                                          const trajectory::State& state,
                                          const Eigen::Vector2d& acceleration) const;

 private:
  /// A tip in contact, of which `by_u` are slopes by the bending. Of a rigid one its place alone; not of a
  /// directed blade.
  struct TipInContact {
    Eigen::Vector2d centre;     ///< c [m]
    Eigen::Vector2d tip;        ///< w [m]
    Eigen::Vector2d tip_by_u;   ///< [m]
    double load = 0.0;          ///< F [N]
    double load_by_u = 0.0;     ///< [N]
    double closing_by_u = 0.0;  ///< h_u [m²]
    double friction = 0.0;      ///< sμ [-]
  };
  [[nodiscard]] std::optional<TipInContact> tip(const trajectory::PathPoint::Contact& contact, double time,
                                                const trajectory::State& state) const;
  [[nodiscard]] contact::BladeDirection direction(int blade, double time) const;

  /// Rigid blades on the elastic ring.
  struct RigidBlade {
    double stiffness;  ///< kr [N/m]
    contact::Friction friction;
  };
  /// Elastic blades with friction that depends on the slip velocity.
  using DirectedBlade = contact::DirectedElastica;
  using Law = std::variant<contact::ElasticaContact, RigidBlade, DirectedBlade>;
  static Law law_of(const settings::Scene& line);
  [[nodiscard]] ForceSlopes of_rigid_blade(const RigidBlade& law,
                                           const trajectory::PathPoint::Contact& contact, double time,
                                           const trajectory::State& state) const;

  contact::Geometry geometry_;
  Law law_;
  rotor::RotorConstants rotor_{};
  rotor::BladeSet blades_;
};

}  // namespace rubatlas::variation
