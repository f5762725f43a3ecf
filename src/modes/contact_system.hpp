/// Right-hand sides of the rotor in contact, in the two forms that the integrator uses.
///
/// Both have the state (x, y, x', y', τ, u), and behind it that of a ring that moves (`bodies.hpp`), so that
/// steps, events and dense output look the same; both are smooth across lift-off and between slip reversals.
///
/// `CarriedContact`: one elastica blade. The bending parameter u is a state and the contact equation h = 0
/// carries itself (no root is solved): with a new independent variable σ
///     dτ/dσ = −∂h/∂u,   du/dσ = dh/dτ at fixed u,   dz/dσ = z' dτ/dσ,
/// which is regular at a head-on touch-down and at lift-off, where ∂h/∂u = 0 and the force is not Lipschitz
/// in τ. All rates are times one constant, which gives σ a sensible unit.
///
/// Other blades may touch besides the one that is carried: their forces are found where they stand.
///
/// `SolvedContacts`: any law, any number of blades; σ = τ, and each blade's force is found where it stands.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "contact/pose.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::modes {

/// A contact that is open: which blade, its slip direction s = ±1 (0 where it sticks) and, for elastic
/// blades, its bending parameter.
struct OpenContact {
  int blade;
  double slip;
  double bending;
  double amplitude = 0.0;  ///< second first guess of a law that has two unknowns a blade; 0: not known
  /// τ of the last slip reversal, and of the one before.
  double reversed = -std::numeric_limits<double>::infinity();
  double reversed_before = -std::numeric_limits<double>::infinity();
};

/// A law under which h = 0 may have several roots, or lose the one that it has.
template <class Law>
inline constexpr bool kMayHaveBranches = requires {
  requires Law::kMayHaveBranches;
};

/// Of Ω R: slip velocities below it are zero, as where a slip reversal has been located.
constexpr double kSlipRounding = 1e-12;

/// The force of an open contact where its blade stands; updates its guesses.
template <class Law>
bool respond(const Law& law, const contact::Pose& at, double speed_ratio, OpenContact& contact,
             contact::TipForce& force) {
  if constexpr (requires {
                  law.respond(at, contact.slip, speed_ratio, contact.bending, contact.amplitude, force);
                }) {
    return law.respond(at, contact.slip, speed_ratio, contact.bending, contact.amplitude, force);
  } else {
    return law.respond(at, contact.slip, speed_ratio, contact.bending, force);
  }
}

/// Finds the force of an open contact in a state and adds it to that on the rotor [N]; blade 0 stands at
/// `first`. False where there is none.
template <class Law, class Blades, class FullState>
bool add_force(const rotor::RotorConstants& rotor, const Blades& blades, const Law& law,
               const FullState& state, const contact::BladeDirection& first, OpenContact& contact,
               contact::TipForce& force, double& force_x, double& force_y) {
  const contact::BladeDirection er = blades.direction(contact.blade, first);
  const auto& law_of_blade = law.of(contact.blade);
  const contact::Pose pose = rotor::pose_of(rotor, law_of_blade.geometry(), er, rotor::from_ring(state));
  if (!respond(law_of_blade, pose, blades.speed(state[rotor::kTime]), contact, force)) return false;
  force_x += force.radial * er.cosine - force.tangential * er.sine;
  force_y += force.radial * er.sine + force.tangential * er.cosine;
  return true;
}

/// x'' and y'' [m per unit τ²] from a force on the rotor in newtons.
template <class Forcing>
std::complex<double> acceleration(const rotor::RotorConstants& rotor, const Forcing& forcing,
                                  const rotor::FullStateOf<Forcing>& state, double force_x, double force_y) {
  if constexpr (rotor::kRingMoves<Forcing>) {
    return acceleration(rotor, forcing.shaft, rotor::ContactState(state.template head<6>()), force_x,
                        force_y);
  } else if constexpr (requires { Forcing::kAnySupport; }) {
    return forcing.support.acceleration(state[rotor::kTime], state.template head<4>().matrix()) +
           rotor.force_unit * std::complex<double>(force_x, force_y);
  } else {
    const double damping = 2.0 * rotor.damping_ratio;
    std::complex<double> result(force_x * rotor.force_unit - damping * state[2] - state[0],
                                force_y * rotor.force_unit - damping * state[3] - state[1]);
    if constexpr (Forcing::kPresent) result += forcing.acceleration(state[rotor::kTime]);
    return result;
  }
}

template <class Law, class Forcing, class Blades = rotor::BladeSet>
class CarriedContact {
 public:
  using FullState = rotor::FullStateOf<Forcing>;

  CarriedContact(const rotor::RotorConstants& rotor, const Blades& blades, const Law& law,
                 const Forcing& forcing)
      : rotor_(&rotor), blades_(&blades), law_(&law), forcing_(&forcing) {}

  /// Opens the contact in a state. The unit of σ is set so that it is the arc in the plane (τ, u) there: u
  /// where the blade touches, τ where it bends most.
  /// False where both rates vanish, a tip at rest on the ring, from which this form cannot start.
  bool open(const OpenContact& contact, const FullState& state) {
    contact_ = contact;
    law_of_blade_ = &law_->of(contact.blade);
    const contact::BladeDirection er =
        blades_->direction(contact_.blade, blades_->first(state[rotor::kTime]));
    const contact::Pose pose =
        rotor::pose_of(*rotor_, law_of_blade_->geometry(), er, rotor::from_ring(state));
    const auto there = law_of_blade_->constraint(pose, contact_.slip, state[rotor::kBending],
                                                 blades_->speed(state[rotor::kTime]));
    const double rate = std::hypot(there.bending_slope, there.time_slope);
    scale_ = 1.0 / rate;
    const double radius = law_of_blade_->geometry().ring_radius;
    return rate > kRestingRate * radius * radius;
  }

  /// Takes all contacts, the carried one first. Only where that may be not the only one.
  void stand_beside(const std::vector<OpenContact>& contacts) {
    contacts_ = contacts;
    forces_.resize(contacts.size());
    without_force_ = 0;
  }
  /// Sets the first guesses of the roots back to what `contacts` gave before.
  void restore(const std::vector<OpenContact>& contacts) { contacts_ = contacts; }
  [[nodiscard]] const std::vector<OpenContact>& contacts() const { return contacts_; }
  /// Of the last evaluation; not of the carried contact.
  [[nodiscard]] const std::vector<contact::TipForce>& forces() const { return forces_; }
  /// The contact that has found no force in the last evaluation that failed.
  [[nodiscard]] std::size_t without_force() const { return without_force_; }
  /// Whether an evaluation since `forget_folds` has been past a fold of the carried contact.
  [[nodiscard]] bool has_met_fold() const { return met_fold_; }
  void forget_folds() { met_fold_ = false; }

  /// Takes the blade's direction at a time from which those of the stages near it are turned.
  void anchor(double time) { anchor_ = blades_->anchor(contact_.blade, time); }

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    const contact::BladeDirection er = blades_->direction_near(anchor_, state[rotor::kTime]);
    const contact::Pose pose =
        rotor::pose_of(*rotor_, law_of_blade_->geometry(), er, rotor::from_ring(state));
    last_ = law_of_blade_->constraint(pose, contact_.slip, state[rotor::kBending],
                                      blades_->speed(state[rotor::kTime]));
    double force_x = last_.force.radial * er.cosine - last_.force.tangential * er.sine;
    double force_y = last_.force.radial * er.sine + last_.force.tangential * er.cosine;
    if constexpr (kMayHaveBranches<Law>) {
      if (law_of_blade_->fold_measure(state[rotor::kBending], last_.bending_slope) > 0.0) met_fold_ = true;
      if (contacts_.size() > 1) {
        const contact::BladeDirection first = blades_->first(state[rotor::kTime]);
        for (std::size_t i = 1; i < contacts_.size(); ++i) {
          if (!add_force(*rotor_, *blades_, *law_, state, first, contacts_[i], forces_[i], force_x,
                         force_y)) {
            without_force_ = i;
            return false;
          }
        }
      }
    }
    const std::complex<double> of_shaft = acceleration(*rotor_, *forcing_, state, force_x, force_y);
    acceleration_ = rotor::acceleration_of_all(state, *forcing_, of_shaft, {-force_x, -force_y});
    const double time_rate = -scale_ * last_.bending_slope;
    derivative = rotor::full_state(rotor::BodiesOf<Forcing>(time_rate * rotor::rate_of(state, acceleration_)),
                                   time_rate, scale_ * last_.time_slope);
    return true;
  }

  /// Of the last evaluation.
  [[nodiscard]] const auto& last() const { return last_; }
  [[nodiscard]] const rotor::AccelerationOf<Forcing>& last_acceleration() const { return acceleration_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

  /// All that a right-hand side depends on besides the state, for those that evaluate several of them side by
  /// side.
  struct Parameters {
    const rotor::RotorConstants* rotor;
    const Blades* blades;
    const typename Law::OfBlade* law;
    const Forcing* forcing;
    double slip;
    double scale;
    typename Blades::Anchor anchor;
  };
  [[nodiscard]] Parameters parameters() const {
    return {rotor_, blades_, law_of_blade_, forcing_, contact_.slip, scale_, anchor_};
  }
  /// Takes over evaluations that were made elsewhere by the same operations, and what the last of them gave.
  void adopt(const typename Law::OfBlade::Constraint& last,
             const rotor::AccelerationOf<Forcing>& acceleration, std::uint64_t evaluations) {
    last_ = last;
    acceleration_ = acceleration;
    evaluations_ += evaluations;
    law_of_blade_->count_evaluations(evaluations);
  }

 private:
  static constexpr double kRestingRate = 1e-15;  ///< of R²: rounding of the rates of h

  const rotor::RotorConstants* rotor_;
  const Blades* blades_;
  const Law* law_;
  const Forcing* forcing_;
  const typename Law::OfBlade* law_of_blade_ = nullptr;
  OpenContact contact_{};
  std::vector<OpenContact> contacts_;  ///< all, where others may stand beside the carried one
  std::vector<contact::TipForce> forces_;
  std::size_t without_force_ = 0;
  bool met_fold_ = false;
  typename Blades::Anchor anchor_{};
  double scale_ = 1.0;  ///< unit of σ against the rates of h [1/m²]
  typename Law::OfBlade::Constraint last_{};
  rotor::AccelerationOf<Forcing> acceleration_{};
  std::uint64_t evaluations_ = 0;
};

template <class Law, class Forcing, class Blades = rotor::BladeSet>
class SolvedContacts {
 public:
  using FullState = rotor::FullStateOf<Forcing>;

  SolvedContacts(const rotor::RotorConstants& rotor, const Blades& blades, const Law& law,
                 const Forcing& forcing)
      : rotor_(&rotor), blades_(&blades), law_(&law), forcing_(&forcing) {
    contacts_.reserve(static_cast<std::size_t>(blades.count()));
    forces_.reserve(static_cast<std::size_t>(blades.count()));
  }

  void open(const std::vector<OpenContact>& contacts) {
    contacts_ = contacts;
    forces_.resize(contacts.size());
    without_force_ = 0;
  }

  /// Sets the first guesses of the roots back to what `contacts` gave before.
  void restore(const std::vector<OpenContact>& contacts) { contacts_ = contacts; }

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    const contact::BladeDirection first = blades_->first(state[rotor::kTime]);
    double force_x = 0.0;
    double force_y = 0.0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (!add_force(*rotor_, *blades_, *law_, state, first, contacts_[i], forces_[i], force_x, force_y)) {
        without_force_ = i;
        return false;
      }
    }
    const std::complex<double> of_shaft = acceleration(*rotor_, *forcing_, state, force_x, force_y);
    acceleration_ = rotor::acceleration_of_all(state, *forcing_, of_shaft, {-force_x, -force_y});
    derivative = rotor::full_state(rotor::rate_of(state, acceleration_), 1.0, 0.0);
    return true;
  }

  /// The contact that has found no force in the last evaluation that failed.
  [[nodiscard]] std::size_t without_force() const { return without_force_; }
  /// Of the last evaluation.
  [[nodiscard]] const std::vector<contact::TipForce>& forces() const { return forces_; }
  [[nodiscard]] const std::vector<OpenContact>& contacts() const { return contacts_; }
  [[nodiscard]] const rotor::AccelerationOf<Forcing>& last_acceleration() const { return acceleration_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  const rotor::RotorConstants* rotor_;
  const Blades* blades_;
  const Law* law_;
  const Forcing* forcing_;
  std::vector<OpenContact> contacts_;
  std::vector<contact::TipForce> forces_;
  std::size_t without_force_ = 0;
  rotor::AccelerationOf<Forcing> acceleration_{};
  std::uint64_t evaluations_ = 0;
};

}  // namespace rubatlas::modes
