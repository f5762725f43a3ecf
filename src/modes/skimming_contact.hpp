/// A tip that skims the ring: the motion to which ever smaller hops tend where the force starts from a finite
/// value (MODEL 4.2, 4.6).
///
/// On the receding side a blade that touches down is thrown back at once. Where the free motion then leads it
/// to the ring again, the hops grow smaller without end; in their limit the tip stays on g = 0 under the
/// share λ of its force that holds it there,
///     g'' (free) + λ g'' (full force) = 0,   0 <= λ <= 1
/// (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988, §4: the convex combination of
/// the two sides; in λ also the share of time that hops spend in contact). At λ = 0 the tip leaves the ring,
/// at λ = 1 it is pressed in.
#pragma once

#include <complex>
#include <cstdint>
#include <limits>
#include <vector>

#include "contact/pose.hpp"
#include "modes/contact_system.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

/// Right-hand side in τ while one blade skims, with the interface of `SolvedContacts`.
template <class Law, class Forcing, class Blades = rotor::BladeSet>
class SkimmingContact {
 public:
  using FullState = rotor::FullStateOf<Forcing>;

  SkimmingContact(const rotor::RotorConstants& rotor, const Blades& blades, const Law& law,
                  const Forcing& forcing)
      : rotor_(&rotor), blades_(&blades), law_(&law), forcing_(&forcing), contacts_(1), forces_(1) {}

  void open(const std::vector<OpenContact>& contacts) { contacts_ = contacts; }
  void restore(const std::vector<OpenContact>& contacts) { contacts_ = contacts; }

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    Balance balance;
    if (!weigh(state, contacts_.front(), balance)) return false;
    forces_.front() = balance.force;
    const std::complex<double> pushed = balance.share * balance.pushed;
    acceleration_ =
        rotor::acceleration_of_all(state, *forcing_, balance.free + pushed, -pushed / rotor_->force_unit);
    derivative = rotor::full_state(rotor::rate_of(state, acceleration_), 1.0, 0.0);
    return true;
  }

  /// λ in a state; NaN where the blade has no force.
  [[nodiscard]] double share(const FullState& state) const {
    OpenContact contact = contacts_.front();
    Balance balance;
    return weigh(state, contact, balance) ? balance.share : std::numeric_limits<double>::quiet_NaN();
  }
  /// λ times what the blade does in full.
  [[nodiscard]] contact::TipForce force(const FullState& state) const {
    OpenContact contact = contacts_.front();
    Balance balance;
    weigh(state, contact, balance);
    return balance.force;
  }

  /// Whether a blade that touches down in a state begins to skim: it would be thrown back and return, at most
  /// `hop` [m] away from the ring.
  [[nodiscard]] bool begins(const FullState& state, OpenContact contact, double hop) const {
    // Hops are seldom that low: the force is asked for only where they are.
    const FreeMotion free = free_motion(state, contact.blade);
    const contact::Geometry& geometry = law_->of(contact.blade).geometry();
    const double rate = contact::gap_rate(geometry, free.pose, blades_->speed(state[rotor::kTime]));
    if (!(rate * rate <= 4.0 * geometry.ring_radius * hop * free.curvature)) return false;
    Balance balance;
    return weigh(state, contact, balance) && balance.share > 0.0 && balance.share < 1.0;
  }

  /// Puts a state back on g = 0, dg/dτ = 0, the shortest way for the shaft.
  void project(FullState& state) const {
    const contact::Geometry& geometry = law_->of(contacts_.front().blade).geometry();
    const contact::BladeDirection er = direction(state, contacts_.front().blade);
    const rotor::State seen = rotor::from_ring(state);
    const double outward_x = seen[0] + geometry.reach * er.cosine;
    const double outward_y = seen[1] + rotor_->misalignment + geometry.reach * er.sine;
    const double inverse = 0.5 / (outward_x * outward_x + outward_y * outward_y);
    const double gap = pose(state, contacts_.front().blade).gap;
    state[0] -= gap * inverse * outward_x;
    state[1] -= gap * inverse * outward_y;
    const double rate = contact::gap_rate(geometry, pose(state, contacts_.front().blade),
                                          blades_->speed(state[rotor::kTime]));
    state[2] -= rate * inverse * outward_x;
    state[3] -= rate * inverse * outward_y;
  }

  /// Of the last evaluation.
  [[nodiscard]] const std::vector<contact::TipForce>& forces() const { return forces_; }
  [[nodiscard]] const std::vector<OpenContact>& contacts() const { return contacts_; }
  [[nodiscard]] const rotor::AccelerationOf<Forcing>& last_acceleration() const { return acceleration_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  /// Free motion against the blade's full force.
  struct Balance {
    std::complex<double> free;    ///< z'' without the blade
    std::complex<double> pushed;  ///< what its full force adds
    double share;                 ///< λ
    contact::TipForce force;      ///< λ times the force
  };

  [[nodiscard]] contact::BladeDirection direction(const FullState& state, int blade) const {
    return blades_->direction(blade, blades_->first(state[rotor::kTime]));
  }
  [[nodiscard]] contact::Pose pose(const FullState& state, int blade) const {
    return rotor::pose_of(*rotor_, law_->of(blade).geometry(), direction(state, blade),
                          rotor::from_ring(state));
  }

  /// The motion without the blade, as that sees it.
  struct FreeMotion {
    contact::BladeDirection direction;
    contact::Pose pose;
    std::complex<double> acceleration;  ///< z''
    double curvature;                   ///< g'' [m²]
  };
  [[nodiscard]] FreeMotion free_motion(const FullState& state, int blade) const {
    const contact::Geometry& geometry = law_->of(blade).geometry();
    FreeMotion free;
    free.direction = direction(state, blade);
    const rotor::State seen = rotor::from_ring(state);
    free.pose = rotor::pose_of(*rotor_, geometry, free.direction, seen);
    free.acceleration = acceleration(*rotor_, *forcing_, state, 0.0, 0.0);
    std::complex<double> closing = free.acceleration;
    if constexpr (rotor::kRingMoves<Forcing>) closing -= forcing_->ring.acceleration(rotor::ring(state), 0.0);
    free.curvature =
        contact::gap_curvature(geometry, free.direction, free.pose, {seen[0], seen[1] + rotor_->misalignment},
                               {seen[2], seen[3]}, closing, blades_->speed(state[rotor::kTime]));
    if constexpr (Blades::kRipples) {
      free.curvature +=
          2.0 * geometry.reach * blades_->angular_acceleration(state[rotor::kTime]) * free.pose.tangential;
    }
    return free;
  }

  bool weigh(const FullState& state, OpenContact& contact, Balance& balance) const {
    const FreeMotion free = free_motion(state, contact.blade);
    const contact::BladeDirection& er = free.direction;
    const contact::Pose& at = free.pose;
    const auto& law = law_->of(contact.blade);
    contact::TipForce& force = balance.force;
    if (!law.respond(at, contact.slip, blades_->speed(state[rotor::kTime]), contact.bending, force))
      return false;
    balance.free = free.acceleration;
    balance.pushed = rotor_->force_unit * std::complex<double>(force.radial, force.tangential) *
                     std::complex<double>(er.cosine, er.sine);
    const double pushed_curvature =
        2.0 * rotor::closing_unit(*rotor_, *forcing_) *
        ((at.radial + law.geometry().reach) * force.radial + at.tangential * force.tangential);
    balance.share = -free.curvature / pushed_curvature;
    force.radial *= balance.share;
    force.tangential *= balance.share;
    force.normal *= balance.share;
    force.root_strain *= balance.share;
    return true;
  }

  const rotor::RotorConstants* rotor_;
  const Blades* blades_;
  const Law* law_;
  const Forcing* forcing_;
  std::vector<OpenContact> contacts_;
  std::vector<contact::TipForce> forces_;
  rotor::AccelerationOf<Forcing> acceleration_{};
  std::uint64_t evaluations_ = 0;
};

}  // namespace rubatlas::modes
