/// Slopes of the force of an elastic blade whose friction depends on the slip velocity.
///
/// Its unknowns κ and φ follow from h = 0 and d = 0 (`contact/directed_elastica.hpp`). With w the place of
/// the tip, u = c' − ΩJc and J a quarter turn,
///     f = −(F/|w|)(w + c Jw),   F = P/√(1 + c²),   c = c(v),   v = Jw·u/|w| + ΩR,
///     h_c = 2w,   d_c = −c'(v)/(1 + c²) v_c,   d_c' = −c'(v)/(1 + c²) Jw/|w|,
/// |w| = R. With D = ∂(h, d)/∂(κ, φ) the bend changes by −D⁻¹(h_c δc, d_c δc + d_c' δc'), and D is singular
/// at touch-downs and folds, where time hardly moves along the path: D⁻¹ τ_θ = λ adj D, λ = τ_θ/det D, is
/// regular.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>

#include "contact/directed_elastica.hpp"
#include "contact/pose.hpp"
#include "trajectory/motion_piece.hpp"
#include "variation/force_slopes.hpp"

namespace rubatlas::variation {

/// Where a blade stands, how it moves, and how its bend changes along the path.
struct DirectedContact {
  contact::BladeDirection er;
  contact::Pose pose;
  double speed_ratio;            ///< Ω [-]
  Eigen::Vector2d acceleration;  ///< of the shaft [m per unit τ²]
  double time_rate;              ///< τ_θ
  const trajectory::PathPoint::Contact* contact;
};

/// `law`: of an axial load.
inline ForceSlopes slopes_of_directed_blade(const contact::DirectedElastica& law, const DirectedContact& at,
                                            const PathScale& scale) {
  const auto& contact = *at.contact;
  const contact::Pose& pose = at.pose;
  const double speed = at.speed_ratio;
  const auto there =
      law.constraint_or_unloaded(pose, contact.slip, speed, {contact.modulus, contact.amplitude});
  // All along and across the blade.
  const auto quarter_turn = [](const Eigen::Vector2d& vector) {
    return Eigen::Vector2d(-vector[1], vector[0]);
  };
  const Eigen::Vector2d w(there.radial, there.tangential);
  const double distance = w.norm();
  const Eigen::Vector2d normal = w / distance;
  const Eigen::Vector2d tangent = quarter_turn(normal);
  const Eigen::Vector2d u(pose.radial_velocity + speed * pose.tangential,
                          pose.tangential_velocity - speed * pose.radial);

  const double c = there.coefficient;
  const double share = 1.0 / (1.0 + c * c);
  const double load_unit = law.load_unit() * std::sqrt(share);
  const double load = load_unit * there.blade.load.value;
  const double slope = law.friction().slope(law.force_of(pose, speed, there).slip_velocity);
  // The tip's place turns the normal, and with it the slip velocity; so does that of the shaft, besides Ω.
  const Eigen::RowVector2d velocity_by_tip = -(normal.dot(u) / distance) * tangent.transpose();
  const Eigen::RowVector2d velocity_by_place = velocity_by_tip - speed * normal.transpose();
  const Eigen::RowVector2d velocity_by_velocity = tangent.transpose();

  const Eigen::Vector2d direction = normal + c * tangent;
  const Eigen::Vector2d by_coefficient = load * (share * c * direction - tangent);
  Eigen::Matrix2d by_tip = slope * by_coefficient * velocity_by_tip;
  const double turning = load / distance;
  by_tip -= turning * (Eigen::Matrix2d() << 1.0, -c, c, 1.0).finished();
  const Eigen::Matrix2d force_by_place =
      by_tip + slope * by_coefficient * (velocity_by_place - velocity_by_tip);
  const Eigen::Matrix2d force_by_velocity = slope * by_coefficient * velocity_by_velocity;
  const double length = law.length();
  const auto by_bend = [&](double shortening, double deflection, double load_slope) -> Eigen::Vector2d {
    return by_tip * Eigen::Vector2d(-length * shortening, -length * deflection) -
           (load_unit * load_slope) * direction;
  };
  const auto& blade = there.blade;
  Eigen::Matrix2d force_by_bend;
  force_by_bend << by_bend(blade.shortening.by_modulus, blade.deflection.by_modulus, blade.load.by_modulus),
      by_bend(blade.shortening.by_amplitude, blade.deflection.by_amplitude, blade.load.by_amplitude);

  Eigen::Matrix2d closing_by_place;  // rows: h, d
  closing_by_place << 2.0 * w.transpose(), (-slope * share) * velocity_by_place;
  Eigen::Matrix2d closing_by_velocity;
  closing_by_velocity << Eigen::RowVector2d::Zero(), (-slope * share) * velocity_by_velocity;
  Eigen::Matrix2d adjugate;
  adjugate << there.misdirection_by_amplitude, -there.residual_by_amplitude, -there.misdirection_by_modulus,
      there.residual_by_modulus;

  // λ from whichever of τ, κ and φ moves along the path: all three are λ times a number that is known.
  const std::complex<double> turned(at.er.cosine, -at.er.sine);
  const std::complex<double> along = std::complex<double>(at.acceleration[0], at.acceleration[1]) * turned;
  const auto drift = law.drift(pose, speed, 0.0, along, there);
  const Eigen::Vector2d bends = -adjugate * Eigen::Vector2d(drift.residual, drift.misdirection);
  const double by_time = there.determinant() / (scale.time_rate * scale.time_rate);
  const Eigen::Vector2d by_bending = bends / (scale.bending_rate * scale.bending_rate);
  const double lambda = contact.carried ? (at.time_rate * by_time + contact.modulus_rate * by_bending[0] +
                                           contact.amplitude_rate * by_bending[1]) /
                                              (there.determinant() * by_time + bends.dot(by_bending))
                                        : at.time_rate / there.determinant();

  const Eigen::Matrix2d by_closing = lambda * force_by_bend * adjugate;
  const Eigen::Matrix2d frame =
      (Eigen::Matrix2d() << at.er.cosine, -at.er.sine, at.er.sine, at.er.cosine).finished();
  ForceSlopes slopes;
  slopes.by_place =
      frame * (at.time_rate * force_by_place - by_closing * closing_by_place) * frame.transpose();
  slopes.by_velocity =
      frame * (at.time_rate * force_by_velocity - by_closing * closing_by_velocity) * frame.transpose();
  return slopes;
}

}  // namespace rubatlas::variation
