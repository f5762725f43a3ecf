/// Right-hand sides of the rotor in contact, in the two forms that the integrator uses.
///
/// Both have the state (x, y, x', y', τ, u), so that steps, events and dense output look the same; both are
/// smooth across lift-off and between slip reversals.
///
/// `CarriedContact`: one elastica blade. The bending parameter u is a state and the contact equation h = 0
/// carries itself (no root is solved): with a new independent variable σ
///     dτ/dσ = −∂h/∂u,   du/dσ = dh/dτ at fixed u,   dz/dσ = z' dτ/dσ,
/// which is regular at a head-on touch-down and at lift-off, where ∂h/∂u = 0 and the force is not Lipschitz
/// in τ. All rates are times one constant, which gives σ a sensible unit.
///
/// `SolvedContacts`: any law, any number of blades; σ = τ, and each blade's force is found where it stands.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "contact/elastica_contact.hpp"
#include "contact/pose.hpp"
#include "effects/unbalance.hpp"
#include "solve/rotor.hpp"

namespace rubatlas::solve {

using ContactState = Eigen::Array<double, 6, 1>;
constexpr int kTime = 4;
constexpr int kBending = 5;

/// A contact that is open: which blade, its slip direction s = ±1 and, for elastic blades, its bending
/// parameter.
struct OpenContact {
  int blade;
  double slip;
  double bending;
};

/// x'' and y'' [m per unit τ²] from a force on the rotor in newtons.
template <class Forcing>
std::complex<double> acceleration(const RotorConstants& rotor, const Forcing& forcing,
                                  const ContactState& state, double force_x, double force_y) {
  const double damping = 2.0 * rotor.damping_ratio;
  std::complex<double> result(force_x * rotor.force_unit - damping * state[2] - state[0],
                              force_y * rotor.force_unit - damping * state[3] - state[1]);
  if constexpr (Forcing::kPresent) result += forcing.acceleration(state[kTime]);
  return result;
}

template <class Forcing>
class CarriedContact {
 public:
  CarriedContact(const RotorConstants& rotor, const BladeSet& blades, const contact::ElasticaContact& law,
                 const Forcing& forcing)
      : rotor_(&rotor), blades_(&blades), law_(&law), forcing_(&forcing) {}

  /// Opens the contact in a state. The unit of σ is set so that it is the arc in the plane (τ, u) there: u
  /// where the blade touches, τ where it bends most.
  /// False where both rates vanish, a tip at rest on the ring, from which this form cannot start.
  bool open(const OpenContact& contact, const ContactState& state) {
    contact_ = contact;
    const contact::BladeDirection er = blades_->direction(contact_.blade, blades_->first(state[kTime]));
    const contact::Pose pose = pose_of(*rotor_, law_->geometry(), er, state.head<4>());
    const auto there = law_->constraint(pose, contact_.slip, state[kBending], rotor_->speed_ratio);
    const double rate = std::hypot(there.bending_slope, there.time_slope);
    scale_ = 1.0 / rate;
    const double radius = law_->geometry().ring_radius;
    return rate > kRestingRate * radius * radius;
  }

  /// Takes the blade's direction at a time from which those of the stages near it are turned.
  void anchor(double time) {
    anchor_time_ = time;
    anchor_ = blades_->direction(contact_.blade, blades_->first(time));
  }

  bool operator()(const ContactState& state, ContactState& derivative) {
    ++evaluations_;
    const contact::BladeDirection er = turned(state[kTime]);
    const contact::Pose pose = pose_of(*rotor_, law_->geometry(), er, state.head<4>());
    last_ = law_->constraint(pose, contact_.slip, state[kBending], rotor_->speed_ratio);
    acceleration_ = acceleration(*rotor_, *forcing_, state,
                                 last_.force.radial * er.cosine - last_.force.tangential * er.sine,
                                 last_.force.radial * er.sine + last_.force.tangential * er.cosine);
    const double time_rate = -scale_ * last_.bending_slope;
    derivative << time_rate * state[2], time_rate * state[3], time_rate * acceleration_.real(),
        time_rate * acceleration_.imag(), time_rate, scale_ * last_.time_slope;
    return true;
  }

  /// Of the last evaluation.
  [[nodiscard]] const contact::ElasticaContact::Constraint& last() const { return last_; }
  [[nodiscard]] std::complex<double> last_acceleration() const { return acceleration_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

  /// All that a right-hand side depends on besides the state, for those that evaluate several of them side by
  /// side.
  struct Parameters {
    const RotorConstants* rotor;
    const BladeSet* blades;
    const contact::ElasticaContact* law;
    const Forcing* forcing;
    OpenContact contact;
    double scale;
    double anchor_time;
    contact::BladeDirection anchor;
  };
  [[nodiscard]] Parameters parameters() const {
    return {rotor_, blades_, law_, forcing_, contact_, scale_, anchor_time_, anchor_};
  }
  /// Takes over evaluations that were made elsewhere by the same operations, and what the last of them gave.
  void adopt(const contact::ElasticaContact::Constraint& last, std::complex<double> acceleration,
             std::uint64_t evaluations) {
    last_ = last;
    acceleration_ = acceleration;
    evaluations_ += evaluations;
    law_->count_evaluations(evaluations);
  }

  /// [rad²], square of the angle from the anchor: below it the first terms that the series leaves out,
  /// angle^11/11! and angle^10/10!, are less than 1e-18.
  static constexpr double kFarTurned = 0.0039;

 private:
  /// Direction of the blade, from that at the anchor by the series of sine and cosine: within a step the
  /// blade turns by some hundredths, and a sine and cosine in full are a quarter of a right-hand side.
  [[nodiscard]] contact::BladeDirection turned(double time) const {
    const double angle = rotor_->speed_ratio * (time - anchor_time_);
    const double square = angle * angle;
    if (!(square < kFarTurned)) return blades_->direction(contact_.blade, blades_->first(time));
    const double fourth = square * square;
    const double sine = angle + (angle * square) * ((-1.0 / 6 + square * (1.0 / 120)) +
                                                    fourth * (-1.0 / 5040 + square * (1.0 / 362880)));
    const double cosine_less_one =
        square * ((-0.5 + square * (1.0 / 24)) + fourth * (-1.0 / 720 + square * (1.0 / 40320)));
    return {anchor_.cosine + (anchor_.cosine * cosine_less_one - anchor_.sine * sine),
            anchor_.sine + (anchor_.sine * cosine_less_one + anchor_.cosine * sine)};
  }

  static constexpr double kRestingRate = 1e-15;  ///< of R²: rounding of the rates of h

  const RotorConstants* rotor_;
  const BladeSet* blades_;
  const contact::ElasticaContact* law_;
  const Forcing* forcing_;
  OpenContact contact_{};
  double anchor_time_ = 0.0;
  contact::BladeDirection anchor_{};
  double scale_ = 1.0;  ///< unit of σ against the rates of h [1/m²]
  contact::ElasticaContact::Constraint last_{};
  std::complex<double> acceleration_;
  std::uint64_t evaluations_ = 0;
};

template <class Law, class Forcing>
class SolvedContacts {
 public:
  SolvedContacts(const RotorConstants& rotor, const BladeSet& blades, const Law& law, const Forcing& forcing)
      : rotor_(&rotor), blades_(&blades), law_(&law), forcing_(&forcing) {
    contacts_.reserve(static_cast<std::size_t>(blades.count()));
    forces_.reserve(static_cast<std::size_t>(blades.count()));
  }

  void open(const std::vector<OpenContact>& contacts) {
    contacts_ = contacts;
    forces_.resize(contacts.size());
  }

  /// Sets the first guesses of the roots back to what `contacts` gave before.
  void restore(const std::vector<OpenContact>& contacts) { contacts_ = contacts; }

  bool operator()(const ContactState& state, ContactState& derivative) {
    ++evaluations_;
    const contact::BladeDirection first = blades_->first(state[kTime]);
    double force_x = 0.0;
    double force_y = 0.0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      OpenContact& contact = contacts_[i];
      const contact::BladeDirection er = blades_->direction(contact.blade, first);
      const contact::Pose pose = pose_of(*rotor_, law_->geometry(), er, state.head<4>());
      contact::TipForce& force = forces_[i];
      if (!law_->respond(pose, contact.slip, rotor_->speed_ratio, contact.bending, force)) return false;
      force_x += force.radial * er.cosine - force.tangential * er.sine;
      force_y += force.radial * er.sine + force.tangential * er.cosine;
    }
    acceleration_ = acceleration(*rotor_, *forcing_, state, force_x, force_y);
    derivative << state[2], state[3], acceleration_.real(), acceleration_.imag(), 1.0, 0.0;
    return true;
  }

  /// Of the last evaluation.
  [[nodiscard]] const std::vector<contact::TipForce>& forces() const { return forces_; }
  [[nodiscard]] const std::vector<OpenContact>& contacts() const { return contacts_; }
  [[nodiscard]] std::complex<double> last_acceleration() const { return acceleration_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  const RotorConstants* rotor_;
  const BladeSet* blades_;
  const Law* law_;
  const Forcing* forcing_;
  std::vector<OpenContact> contacts_;
  std::vector<contact::TipForce> forces_;
  std::complex<double> acceleration_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace rubatlas::solve
