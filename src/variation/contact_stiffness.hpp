/// How the force of a contact, and the guard of its slip, change with the place of the shaft.
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
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <variant>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "observables/motion_piece.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"
#include "settings/scene.hpp"

namespace rubatlas::variation {

class ContactStiffness {
 public:
  /// `line`: the scene with the line's values. Its blades are equal, its law is elastica, beam-column or
  /// elastic ring, as `settings` allows it for exponents.
  explicit ContactStiffness(const settings::Scene& line);

  /// A speed ratio Ω of the line.
  void begin(const rotor::RotorConstants& rotor);

  /// (df/dc) τ_θ, summed over the contacts of a place on the path [N/m]. `scale`: sizes of τ_θ and u_θ on the
  /// piece, against which their errors count. Nothing where a blade has no force.
  struct PathScale {
    double time_rate = 1.0;
    double bending_rate = 1.0;
  };
  [[nodiscard]] std::optional<Eigen::Matrix2d> along_path(const observables::PathPoint& point,
                                                          const PathScale& scale) const;

  /// A guard e of a blade: its gradient by the shaft's state, and its rate along the motion.
  struct Guard {
    Eigen::RowVector4d gradient;
    double rate;
  };
  /// e = g, of touch-downs and lift-offs at the ring; `state` of the shaft at time τ.
  [[nodiscard]] Guard gap(int blade, double time, const observables::State& state) const;
  /// e = v |w|, of slip reversals, where the shaft has this acceleration [m per unit τ²]. Nothing where the
  /// blade has no force.
  [[nodiscard]] std::optional<Guard> slip(const observables::PathPoint::Contact& contact, double time,
                                          const observables::State& state,
                                          const Eigen::Vector2d& acceleration) const;

 private:
  /// A tip in contact. `by_u`: slopes by the bending; zero of rigid blades.
  struct TipInContact {
    Eigen::Vector2d centre;     ///< c [m]
    Eigen::Vector2d tip;        ///< w [m]
    Eigen::Vector2d tip_by_u;   ///< [m]
    double load = 0.0;          ///< F [N]
    double load_by_u = 0.0;     ///< [N]
    double closing_by_u = 0.0;  ///< h_u [m²]
    double friction = 0.0;      ///< sμ [-]
  };
  [[nodiscard]] std::optional<TipInContact> tip(const observables::PathPoint::Contact& contact, double time,
                                                const observables::State& state) const;
  [[nodiscard]] contact::BladeDirection direction(int blade, double time) const;

  std::variant<contact::ElasticaContact, contact::ElasticRingContact> law_;
  rotor::RotorConstants rotor_{};
  rotor::BladeSet blades_;
};

}  // namespace rubatlas::variation
