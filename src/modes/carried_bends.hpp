/// Right-hand side of the rotor in contact with elastic blades whose bends (κ, φ) are states.
///
/// Each open contact has two equations (`contact/directed_elastica.hpp`), h(κ, φ) = 0 and d(κ, φ) = 0, and
/// with D = ∂(h, d)/∂(κ, φ) the bend changes at the rates
///     κ' = −(h_τ d_φ − h_φ d_τ) / D,   φ' = −(h_κ d_τ − h_τ d_κ) / D,
/// h_τ and d_τ taken at a fixed bend. D vanishes where the blade lifts off (φ = 0) and at the folds where it
/// snaps through. There the bend is no smooth function of the time, but bend and time are smooth functions of
/// the arc σ in the space of τ and all bends:
///     dτ/dσ = N ΠDk,   dκk/dσ = N κk' ΠDj,   dφk/dσ = N φk' ΠDj,   dz/dσ = z' dτ/dσ,
/// with N such that the arc has length one. No root is solved, a contact is as smooth at its ends as in
/// between, and a blade that has passed φ = 0 or a fold goes back along the same path, or the one behind the
/// fold, with time running backwards.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "blade/inclined_elastica.hpp"
#include "contact/pose.hpp"
#include "modes/contact_system.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

template <class Law, class Forcing, class Blades = rotor::BladeSet>
class CarriedBends {
 public:
  using FullState = rotor::BendsState;
  using Constraint = typename Law::OfBlade::Constraint;
  static constexpr bool kCarriesBends = true;

  CarriedBends(const rotor::RotorConstants& rotor, const Blades& blades, const Law& law,
               const Forcing& forcing)
      : rotor_(&rotor), blades_(&blades), law_(&law), forcing_(&forcing) {
    const auto most = static_cast<std::size_t>(blades.count());
    contacts_.reserve(most);
    last_.contacts.reserve(most);
    kept_.contacts.reserve(most);
    scales_.reserve(most);
  }

  /// Opens the contacts where the rotor stands and gives the full state there. A contact goes on from its
  /// bend where that is in equilibrium but for the errors of dense output; elsewhere (a new contact, friction
  /// that has turned round, other blades) its equilibrium is looked for. False where a blade has none.
  bool open(const std::vector<OpenContact>& contacts, const rotor::State& bodies, double time,
            FullState& state) {
    contacts_ = contacts;
    last_.contacts.resize(contacts.size());
    scales_.resize(contacts.size());
    state.resize(rotor::kFirstBend + 2 * static_cast<Eigen::Index>(contacts.size()));
    state.head<4>() = bodies;
    state[rotor::kTime] = time;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      OpenContact& open = contacts_[i];
      const contact::Pose at = pose(open.blade, state);
      if (!goes_on(open, at, blades_->speed(time), kNear)) {
        contact::TipForce force{};
        if (!respond(law_->of(open.blade), at, blades_->speed(time), open, force)) return false;
      }
      state[modulus_of(i)] = open.bending;
      state[amplitude_of(i)] = open.amplitude;
    }
    // The unit of σ is the arc in the space of τ, κ and φ of each contact there.
    std::ranges::fill(scales_, 1.0);
    FullState derivative;
    if (!(*this)(state, derivative)) return false;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const Rates& rates = last_.contacts[i].rates;
      scales_[i] = 1.0 / std::hypot(rates.time, rates.modulus, rates.amplitude);
      if (!std::isfinite(scales_[i])) return false;
    }
    return true;
  }

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    const double time = state[rotor::kTime];
    const double speed = blades_->speed(time);
    const contact::BladeDirection first = blades_->first(time);
    double force_x = 0.0;
    double force_y = 0.0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      Evaluated& contact = last_.contacts[i];
      const auto& law = law_->of(contacts_[i].blade);
      if (!law.has_chart(bend(i, state))) return false;
      contact.direction = blades_->direction(contacts_[i].blade, first);
      contact.pose = rotor::pose_of(*rotor_, law.geometry(), contact.direction, state.head<4>());
      contact.there = law.constraint_or_unloaded(contact.pose, contacts_[i].slip, speed, bend(i, state));
      contact.force = law.force_of(contact.pose, speed, contact.there);
      const contact::BladeDirection& er = contact.direction;
      force_x += contact.force.radial * er.cosine - contact.force.tangential * er.sine;
      force_y += contact.force.radial * er.sine + contact.force.tangential * er.cosine;
    }
    rotor::FullStateOf<Forcing> shaft = rotor::FullStateOf<Forcing>::Zero();
    shaft.template head<5>() = state.head<5>();
    last_.acceleration = acceleration(*rotor_, *forcing_, shaft, force_x, force_y);

    double time_rate = 1.0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const contact::BladeDirection& er = last_.contacts[i].direction;
      const std::complex<double> along = last_.acceleration * std::complex<double>(er.cosine, -er.sine);
      Rates& rates = last_.contacts[i].rates;
      rates = rates_of(i, time, along);
      time_rate *= rates.time;
    }
    derivative.resize(state.size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      double share = 1.0;
      for (std::size_t j = 0; j < contacts_.size(); ++j) {
        if (j != i) share *= last_.contacts[j].rates.time;
      }
      derivative[modulus_of(i)] = share * last_.contacts[i].rates.modulus;
      derivative[amplitude_of(i)] = share * last_.contacts[i].rates.amplitude;
    }
    derivative.head<4>() = time_rate * rotor::rate_of(state, last_.acceleration);
    derivative[rotor::kTime] = time_rate;
    return derivative.isFinite().all();
  }

  /// Moves the bends back onto h = 0 and d = 0 by one step of Newton's method where the last evaluation was,
  /// if these determine them well.
  void project(FullState& state) const {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const Rates& rates = last_.contacts[i].rates;
      if (rates.time < kWellDetermined * std::hypot(rates.modulus, rates.amplitude)) continue;
      const blade::Bend change = law_->of(contacts_[i].blade).correction(last_.contacts[i].there);
      state[modulus_of(i)] += change.modulus;
      state[amplitude_of(i)] += change.amplitude;
    }
  }

  /// Moves the bends of a state of dense output onto their equilibria, if these are close: friction and rest
  /// depend on where the tip stands to the last digits.
  void place(FullState& state) const {
    const double speed = blades_->speed(state[rotor::kTime]);
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      OpenContact open = contacts_[i];
      open.bending = state[modulus_of(i)];
      open.amplitude = state[amplitude_of(i)];
      if (!goes_on(open, pose(open.blade, state), speed, kClose)) continue;
      state[modulus_of(i)] = open.bending;
      state[amplitude_of(i)] = open.amplitude;
    }
  }

  /// Keeps what is known of the last evaluation, and goes back to it.
  void keep() { kept_ = last_; }
  void restore() { last_ = kept_; }

  [[nodiscard]] static Eigen::Index modulus_of(std::size_t contact) {
    return rotor::kFirstBend + 2 * static_cast<Eigen::Index>(contact);
  }
  [[nodiscard]] static Eigen::Index amplitude_of(std::size_t contact) { return modulus_of(contact) + 1; }
  [[nodiscard]] static blade::Bend bend(std::size_t contact, const FullState& state) {
    return {state[modulus_of(contact)], state[amplitude_of(contact)]};
  }

  /// What a contact does in a state.
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    const OpenContact& open = contacts_[contact];
    const auto& law = law_->of(open.blade);
    const contact::Pose at = pose(open.blade, state);
    const double speed = blades_->speed(state[rotor::kTime]);
    return law.force_of(at, speed, law.constraint_or_unloaded(at, open.slip, speed, bend(contact, state)));
  }
  /// D of a contact in a state [m² rad]: negative beyond a fold.
  [[nodiscard]] double determinant(std::size_t contact, const FullState& state) const {
    const OpenContact& open = contacts_[contact];
    return law_->of(open.blade)
        .constraint_or_unloaded(pose(open.blade, state), open.slip, blades_->speed(state[rotor::kTime]),
                                bend(contact, state))
        .determinant();
  }

  // Of the last evaluation.
  [[nodiscard]] const contact::TipForce& last_force(std::size_t contact) const {
    return last_.contacts[contact].force;
  }
  /// Whether time runs backwards along the path of a contact.
  [[nodiscard]] bool turns_back(std::size_t contact) const {
    return last_.contacts[contact].rates.time < 0.0;
  }
  [[nodiscard]] const std::complex<double>& last_acceleration() const { return last_.acceleration; }
  [[nodiscard]] const std::vector<OpenContact>& contacts() const { return contacts_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  /// Of the arc of one contact, along the time: below it the bend is not well known from h = 0.
  static constexpr double kWellDetermined = 1e-2;
  static constexpr double kNear = 1e-3;   ///< of κ and φ: a bend that goes on differs by less
  static constexpr double kClose = 1e-5;  ///< the same of dense output where D is not small
  static constexpr double kHere = 1e-9;   ///< of κ and φ: Newton's next step is below rounding

  /// Along the arc in the space of τ, κ and φ of one contact.
  struct Rates {
    double time;
    double modulus;
    double amplitude;
  };
  struct Evaluated {
    contact::BladeDirection direction;
    contact::Pose pose;
    Constraint there;
    contact::TipForce force;
    Rates rates;
  };
  struct Evaluation {
    std::vector<Evaluated> contacts;
    std::complex<double> acceleration;  ///< z''
  };

  [[nodiscard]] contact::Pose pose(int blade, const FullState& state) const {
    return rotor::pose_of(*rotor_, law_->of(blade).geometry(),
                          blades_->direction(blade, blades_->first(state[rotor::kTime])), state.head<4>());
  }

  /// `along`: acceleration of the shaft along (real) and across the blade.
  [[nodiscard]] Rates rates_of(std::size_t contact, double time, const std::complex<double>& along) const {
    const Evaluated& now = last_.contacts[contact];
    const Constraint& there = now.there;
    double angular_acceleration = 0.0;
    if constexpr (Blades::kRipples) angular_acceleration = blades_->angular_acceleration(time);
    const auto drift = law_->of(contacts_[contact].blade)
                           .drift(now.pose, contacts_[contact].slip, blades_->speed(time),
                                  angular_acceleration, along, there);
    const Rates rates{
        there.determinant(),
        drift.misdirection * there.residual_by_amplitude - drift.residual * there.misdirection_by_amplitude,
        drift.residual * there.misdirection_by_modulus - drift.misdirection * there.residual_by_modulus};
    const double scale = scales_[contact];
    return {scale * rates.time, scale * rates.modulus, scale * rates.amplitude};
  }

  /// Moves a contact onto its equilibrium if that is as near to its bend as said.
  bool goes_on(OpenContact& open, const contact::Pose& at, double speed, double near) const {
    if (open.bending == 0.0 || !(open.amplitude > 0.0)) return false;
    const auto& law = law_->of(open.blade);
    blade::Bend bend{open.bending, open.amplitude};
    for (int i = 0; i < 4; ++i) {
      const Constraint there = law.constraint(at, open.slip, speed, bend);
      const blade::Bend change = law.correction(there);
      const double size =
          std::max(std::abs(change.modulus / bend.modulus), std::abs(change.amplitude / bend.amplitude));
      if (!(size < near)) return false;
      bend = {bend.modulus + change.modulus, bend.amplitude + change.amplitude};
      if (size < kHere) break;
    }
    open.bending = bend.modulus;
    open.amplitude = bend.amplitude;
    return true;
  }

  const rotor::RotorConstants* rotor_;
  const Blades* blades_;
  const Law* law_;
  const Forcing* forcing_;
  std::vector<OpenContact> contacts_;
  std::vector<double> scales_;  ///< unit of σ against the rates of each contact [1/(m² rad)]
  Evaluation last_;
  Evaluation kept_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace rubatlas::modes
