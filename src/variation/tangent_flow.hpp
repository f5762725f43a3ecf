/// The linearised flow along a motion: how small differences of the state grow from its start.
///
/// In flight the closed form of free motion; in contact the variational equation
///     δz'' + 2ζ δz' + δz = K δz / (m ωn²)
/// along the path of the contact (`contact_stiffness.hpp`), by Gauss's method of order 16; at an event e = 0
/// where the acceleration jumps by Δa the saltation matrix I + (0, Δa) ∇eᵀ / ė. Source: Müller, Calculation
/// of Lyapunov exponents for dynamic systems with discontinuities (1995); Hairer, Nørsett, Wanner, II.7.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "observables/motion_piece.hpp"
#include "rotor/free_motion.hpp"
#include "settings/scene.hpp"
#include "variation/contact_stiffness.hpp"

namespace rubatlas::variation {

/// δ(x, y, x', y') at the end against that at the start, column by column.
using Tangents = Eigen::Matrix4d;

class TangentFlow {
 public:
  explicit TangentFlow(const settings::Scene& line);

  /// A point at the speed ratio Ω starts, or goes on, with these tangents.
  void begin(double speed_ratio, const Tangents& tangents);
  /// `between` is called again and again during a long flight, while no tangent has become so small, or so
  /// nearly parallel to another, that its direction is lost; it may set other tangents.
  void piece(observables::MotionPiece& piece, const std::function<void()>& between = {});
  /// Between two pieces: a blade touches down or lifts off; the slip of a tip turns round.
  void passes_ring(int blade) { events_.push_back({blade, false}); }
  void slip_reverses(int blade) { events_.push_back({blade, true}); }
  /// An event whose saltation is not known: there are no tangents from here on.
  void loses_track() { known_ = false; }

  /// False where a part of the motion has no linearisation.
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] const Tangents& tangents() const { return tangents_; }
  void set_tangents(const Tangents& tangents) { tangents_ = tangents; }
  /// Sum of ln|det| of the saltations so far: what the flow contracts besides e^{−4ζτ}.
  [[nodiscard]] double log_saltation() const { return log_saltation_; }

 private:
  struct Event {
    int blade;
    bool of_slip;
  };
  void fly(double duration);
  /// Longest flight over which tangents that were orthogonal keep their directions.
  [[nodiscard]] double longest_flight() const;
  void follow(observables::MotionPiece& piece);
  void jump(observables::MotionPiece& piece, const Eigen::Vector2d& force);
  [[nodiscard]] static Eigen::Vector2d force_in(observables::MotionPiece& piece, double time);

  /// Acceleration by all that does not depend on the shaft's place [m per unit τ²].
  [[nodiscard]] Eigen::Vector2d forcing(double time) const;

  double force_unit_;                                      ///< 1/(m ωn²) [m/N]
  double misalignment_;                                    ///< y0 [m]
  double specific_moment_ = 0.0;                           ///< me/m [m]
  double phase_ = 0.0;                                     ///< γ [rad]
  double speed_ratio_ = 0.0;                               ///< Ω [-]
  Eigen::Vector2d static_load_ = Eigen::Vector2d::Zero();  ///< deflection under it [m]
  rotor::FreeMotion free_;
  ContactStiffness stiffness_;
  Tangents tangents_ = Tangents::Identity();
  std::vector<Event> events_;                              ///< since the last piece
  Eigen::Vector2d force_ = Eigen::Vector2d::Zero();        ///< at the end of the last piece [N]
  std::vector<observables::PathPoint::Contact> contacts_;  ///< there
  observables::PathPoint point_;
  bool known_ = true;
  double log_saltation_ = 0.0;
};

}  // namespace rubatlas::variation
