/// How the force of a contact, and the guards, change with place and velocity of the shaft.
///
/// In the frame of the ring the tip of a blade lies at w, c + (rh+L−δ) er − sΔ et (MODEL 2). The rotor feels
///     f = −F (n + c_f Jn),   n = w/|w|                                         (MODEL 4.3),
/// J a quarter turn and c_f the friction coefficient, which may depend on the slip velocity v (MODEL 4.4).
/// Elastic blades have F and the tip as functions of their bend b, which is u, or κ and φ, and follows from
/// g(b, c, c', τ) = 0: the contact equation h, and the direction of the load. Written in numbers that carry
/// their slopes, f and g give, by implicit differentiation,
///     df/dc = f_c − f_b D⁻¹ g_c,   D = ∂g/∂b,   and likewise by c'.
/// At touch-downs and folds D is singular, and time hardly moves along the path (τ(θ), b(θ)) of the contact:
/// D b_θ + g_τ τ_θ = 0, g_τ along the motion. So what is integrated is
///     (df/dc) τ_θ = f_c τ_θ − λ f_b (adj D) g_c,   λ = τ_θ / det D,   b_θ = −λ (adj D) g_τ,
/// which is regular unless the tip grazes; λ comes from whichever of τ and b moves along the path. Source:
/// the variational equation of a constrained system.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"
#include "rotor/machine.hpp"
#include "settings/scene.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::variation {

/// Derivatives of a contact's force on the rotor by c [N/m] and c' [N per (m per unit τ)], times τ_θ.
using ForceSlopes = Eigen::Matrix<double, 2, 4, Eigen::RowMajor>;

/// Sizes of τ_θ, and of u_θ or κ_θ and φ_θ, on a piece, against which their errors count.
struct PathScale {
  double time_rate = 1.0;
  double bending_rate = 1.0;
};

class ContactStiffness {
 public:
  /// `line`: the scene with the line's values, its law and friction as `settings::refusal_of_linearisation`
  /// allows them.
  explicit ContactStiffness(const settings::Scene& line);

  /// A speed ratio Ω of the line.
  void begin(const rotor::Machine& machine);

  /// Slopes of the force, times τ_θ, summed over the contacts of a place on the path. `acceleration` of the
  /// shaft there [m per unit τ²] is read only where `needs_acceleration`. Nothing where a blade has no force.
  [[nodiscard]] std::optional<ForceSlopes> along_path(const trajectory::PathPoint& point,
                                                      const PathScale& scale,
                                                      const Eigen::Vector2d& acceleration) const;
  /// The bending of a blade changes with the acceleration of the shaft, through the slip velocity.
  [[nodiscard]] bool needs_acceleration() const { return !friction_.has_slip_state() && !is_rigid(); }

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
  [[nodiscard]] const contact::ElasticBladeInRing& of_blade(int blade) const {
    return in_ring_[static_cast<std::size_t>(blade)];
  }
  [[nodiscard]] bool is_rigid() const { return ring_stiffness_ > 0.0; }

  struct Tip;
  [[nodiscard]] std::optional<Tip> tip(const trajectory::PathPoint::Contact& contact, double time,
                                       const trajectory::State& state) const;

  contact::Friction friction_;
  double ring_stiffness_ = 0.0;  ///< kr of a ring that yields to rigid blades [N/m]; 0: blades are elastic
  std::shared_ptr<const blade::ElasticaCurve> curve_;  ///< of elastic blades whose friction has the sign of s
  std::vector<contact::ElasticBladeInRing> in_ring_;
  rotor::RotorConstants rotor_{};
  rotor::BladeSet blades_{0, 0.0};
};

}  // namespace rubatlas::variation
