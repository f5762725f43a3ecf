/// The linearised flow along a motion: how small differences of the state grow from its start.
///
/// With q = (x, y), or (x, y, rx, ry) where the ring is a body, the motion is q'' + C q' + S q = B f(G q) +
/// …, f the force on the rotor and G q the shaft's place as the ring sees it. In flight the closed form of
/// free motion; in contact the variational equation
///     δq'' + C δq' + S δq = B (K G δq + D G δq'),   K = df/dc, D = df/dc',
/// along the path of the contact (`contact_stiffness.hpp`), by Gauss's method of order 16; at an event e = 0
/// where the acceleration jumps by Δa the saltation matrix I + (0, Δa) ∇eᵀ / ė. Source: Müller, Calculation
/// of Lyapunov exponents for dynamic systems with discontinuities (1995); Hairer, Nørsett, Wanner, II.7.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "rotor/machine.hpp"
#include "settings/scene.hpp"
#include "trajectory/motion_piece.hpp"
#include "variation/contact_stiffness.hpp"
#include "variation/tangents.hpp"

namespace rubatlas::variation {

class TangentFlow {
 public:
  explicit TangentFlow(const settings::Scene& line);

  /// A point at the speed ratio Ω starts, with unit tangents.
  void begin(double speed_ratio);
  /// `between` is called again and again during a long flight, while no tangent has become so small, or so
  /// nearly parallel to another, that its direction is lost; it may set other tangents. Where it would be
  /// called without end, by a ring or shaft whose motion dies at once, there are no tangents from here on.
  void piece(trajectory::MotionPiece& piece, const std::function<void()>& between = {});
  /// Between two pieces: a blade touches down or lifts off; the slip of a tip turns round.
  void passes_ring(int blade) { events_.push_back({blade, false}); }
  void slip_reverses(int blade) { events_.push_back({blade, true}); }
  /// An event whose saltation is not known: there are no tangents from here on.
  void loses_track() { known_ = false; }

  /// False where a part of the motion has no linearisation.
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] const Tangents& tangents() const { return tangents_; }
  void set_tangents(const Tangents& tangents) { tangents_ = tangents; }
  /// The logarithm of what phase volume has grown by so far besides `phase_volume_rate`: sum of ln|det| of
  /// the saltations, and the integral of tr BDG where friction depends on the slip velocity.
  [[nodiscard]] double log_volume() const { return log_volume_; }
  /// d/dτ of the logarithm of phase volume between events: −4ζ of the plain shaft, −tr C of any.
  [[nodiscard]] double phase_volume_rate() const { return -damping_.trace(); }

  /// The tangents after a flight of this duration from here, which may be negative.
  [[nodiscard]] Tangents after_flight(double duration) const;
  /// d/dτ of the shaft's state at a time, under a force [N].
  [[nodiscard]] std::array<double, 4> rate(double time, const trajectory::State& state,
                                           const Eigen::Vector2d& force) const;
  /// What the contacts of a piece do to the rotor [N].
  [[nodiscard]] static Eigen::Vector2d force_in(trajectory::MotionPiece& piece, double time);

 private:
  struct Event {
    int blade;
    bool of_slip;
  };

  /// Longest flight over which tangents that were orthogonal keep their directions.
  [[nodiscard]] double longest_flight() const;
  template <int kCoordinates>
  void follow(trajectory::MotionPiece& piece);
  void jump(trajectory::MotionPiece& piece, const Eigen::Vector2d& force);
  /// z'' less r'' of the bodies under the force on the rotor [m per unit τ²].
  [[nodiscard]] Eigen::Vector2d seen_acceleration(const trajectory::PathPoint& at,
                                                  const Eigen::Vector2d& force) const;

  using OfBodies = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostCoordinates,
                                 kMostCoordinates>;

  settings::Scene line_;
  ContactStiffness contact_;
  std::optional<rotor::Machine> machine_;  ///< at Ω
  std::optional<double> longest_flight_;   ///< once it is asked for [τ]
  OfBodies stiffness_, damping_;           ///< S, C
  OfBodies by_force_;                      ///< B [m/N]
  OfBodies seen_;                          ///< G
  Tangents tangents_;
  std::vector<Event> events_;                        ///< since the last piece
  Eigen::Vector2d force_ = Eigen::Vector2d::Zero();  ///< at the end of the last piece [N]
  trajectory::PathPoint point_;                      ///< there
  bool known_ = true;
  double log_volume_ = 0.0;
};

}  // namespace rubatlas::variation
