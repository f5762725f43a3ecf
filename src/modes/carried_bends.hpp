/// Mode: elastic blades under an inclined load in contact, whose bends (κ, φ) are states.
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

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "blade/inclined_elastica.hpp"
#include "contact/pose.hpp"
#include "integrate/root_between.hpp"
#include "modes/contact_mode.hpp"
#include "modes/guards.hpp"
#include "modes/open_contact.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

template <class Law>
class CarriedBends : public ContactMode<Law, rotor::BendsState> {
 public:
  using Base = ContactMode<Law, rotor::BendsState>;
  using FullState = rotor::BendsState;
  using typename Base::Setup;
  using Constraint = typename Law::OfBlade::Constraint;
  static constexpr double kSmallestSize = 1e-12;
  static constexpr bool kTimeTurns = true;
  static constexpr bool kHasPath = true;
  static constexpr bool kCoarseSizes = false;

  explicit CarriedBends(const Setup& setup) : Base(setup) {
    const auto most = static_cast<std::size_t>(this->blades().count());
    last_.contacts.reserve(most);
    kept_.contacts.reserve(most);
    scales_.reserve(most);
  }

  /// Opens the contacts where the rotor stands and gives the full state there. A contact goes on from its
  /// bend where that is in equilibrium but for the errors of dense output; elsewhere (a new contact, friction
  /// that has turned round, other blades) its equilibrium is looked for. False where a blade has none.
  bool open(double time, const rotor::ShaftAndRing& bodies, const std::vector<OpenContact>& contacts,
            FullState& state) {
    this->stand(contacts);
    last_.contacts.resize(contacts.size());
    scales_.resize(contacts.size());
    state.resize(rotor::kFirstBend + 2 * static_cast<Eigen::Index>(contacts.size()));
    state.head<4>() = bodies.head<4>();
    state[rotor::kTime] = time;
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      OpenContact& open = this->contacts_[i];
      const contact::Pose at = this->pose(open.blade, state);
      if (!goes_on(open, at, this->blades().angular_speed(time), kNear)) {
        contact::TipForce force{};
        if (!this->respond_paid(at, this->blades().angular_speed(time), open, force)) return false;
      }
      state[modulus_of(i)] = open.bend.modulus;
      state[amplitude_of(i)] = open.bend.amplitude;
    }
    // The unit of σ is the arc in the space of τ, κ and φ of each contact there.
    std::ranges::fill(scales_, 1.0);
    FullState derivative;
    if (!(*this)(state, derivative)) return false;
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      const Rates& rates = last_.contacts[i].rates;
      scales_[i] = 1.0 / std::hypot(rates.time, rates.modulus, rates.amplitude);
      if (!std::isfinite(scales_[i])) return false;
    }
    return true;
  }

  bool operator()(const FullState& state, FullState& derivative) {
    ++this->evaluations_;
    const double time = state[rotor::kTime];
    const double speed = this->blades().angular_speed(time);
    const contact::BladeDirection first = this->blades().first(time);
    std::complex<double> force;
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      Evaluated& contact = last_.contacts[i];
      const auto& law = this->law_->of(this->contacts_[i].blade);
      if (!law.has_chart(bend(i, state))) return false;
      contact.direction = this->blades().direction(this->contacts_[i].blade, first);
      contact.pose = rotor::pose_of(this->rotor(), law.geometry(), contact.direction, state.head<4>());
      contact.there =
          law.constraint_or_unloaded(contact.pose, this->contacts_[i].slip, speed, bend(i, state));
      contact.force = law.force_of(contact.pose, speed, contact.there);
      force += contact::on_rotor(contact.force, contact.direction);
    }
    last_.acceleration = this->machine().acceleration(state, force);

    double time_rate = 1.0;
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      const contact::BladeDirection& er = last_.contacts[i].direction;
      const std::complex<double> along = last_.acceleration.shaft * std::complex<double>(er.cosine, -er.sine);
      Rates& rates = last_.contacts[i].rates;
      rates = rates_of(i, time, along);
      time_rate *= rates.time;
    }
    derivative.resize(state.size());
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      double share = 1.0;
      for (std::size_t j = 0; j < this->contacts_.size(); ++j) {
        if (j != i) share *= last_.contacts[j].rates.time;
      }
      derivative[modulus_of(i)] = share * last_.contacts[i].rates.modulus;
      derivative[amplitude_of(i)] = share * last_.contacts[i].rates.amplitude;
    }
    derivative.head<4>() = time_rate * rotor::rate_of(state, last_.acceleration).template head<4>();
    derivative[rotor::kTime] = time_rate;
    if (!derivative.isFinite().all()) return false;
    this->watch_shortening(shortening());
    return true;
  }

  /// Moves the bends back onto h = 0 and d = 0 by one step of Newton's method where the last evaluation was,
  /// if these determine them well.
  void project(FullState& state) const {
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      const Rates& rates = last_.contacts[i].rates;
      if (rates.time < kWellDetermined * std::hypot(rates.modulus, rates.amplitude)) continue;
      const blade::Bend change = this->law_->of(this->contacts_[i].blade).correction(last_.contacts[i].there);
      state[modulus_of(i)] += change.modulus;
      state[amplitude_of(i)] += change.amplitude;
    }
  }

  /// Moves the bends of a state of dense output onto their equilibria, if these are close: friction and rest
  /// depend on where the tip stands to the last digits.
  void place(FullState& state) const {
    const double speed = this->blades().angular_speed(state[rotor::kTime]);
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      OpenContact open = this->contacts_[i];
      open.bend = {state[modulus_of(i)], state[amplitude_of(i)]};
      if (!goes_on(open, this->pose(open.blade, state), speed, kClose)) continue;
      state[modulus_of(i)] = open.bend.modulus;
      state[amplitude_of(i)] = open.bend.amplitude;
    }
  }

  void keep() {
    kept_ = last_;
    kept_shortening_ = this->stage_shortening_;
  }
  void restore() {
    last_ = kept_;
    this->stage_shortening_ = kept_shortening_;
  }
  void begins_step(const FullState& /*state*/) {}
  void takes_back() {}

  // How a step is judged.

  template <class Step>
  [[nodiscard]] double proposed_size(const Step& /*step*/, double relative) const {
    return relative;
  }
  template <class Step>
  [[nodiscard]] double aimed(const Step& step, double size) const {
    for (std::size_t i = 0; i < this->contacts_.size(); ++i)
      size = Base::aimed_at_zero(step, amplitude_of(i), size);
    return size;
  }
  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    const double weight = kBendingWeight * this->rotor().length_scale;
    return this->error_of(step, last_.acceleration, true, [&](const FullState& difference) {
      double square = difference.tail(difference.size() - rotor::kFirstBend).square().sum();
      square *= weight * weight;
      return square;
    });
  }
  template <class Step>
  [[nodiscard]] bool trusts(const Step& step) const {
    return !holds_whole_contact(step) &&
           !(Base::time_may_turn_twice(step) && step.size() > Base::kFoldResolution);
  }
  void begun() { this->stage_shortening_ = shortening(); }
  void accepted() { end_shortening_ = shortening(); }
  void goes_on() { this->stage_shortening_ = end_shortening_; }

  [[nodiscard]] static int modulus_of(std::size_t contact) {
    return rotor::kFirstBend + 2 * static_cast<int>(contact);
  }
  [[nodiscard]] static int amplitude_of(std::size_t contact) { return modulus_of(contact) + 1; }
  [[nodiscard]] static blade::Bend bend(std::size_t contact, const FullState& state) {
    return {state[modulus_of(contact)], state[amplitude_of(contact)]};
  }

  /// What a contact does in a state.
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    const OpenContact& open = this->contacts_[contact];
    const auto& law = this->law_->of(open.blade);
    const contact::Pose at = this->pose(open.blade, state);
    const double speed = this->blades().angular_speed(state[rotor::kTime]);
    return law.force_of(at, speed, law.constraint_or_unloaded(at, open.slip, speed, bend(contact, state)));
  }
  /// D of a contact in a state [m² rad]: negative beyond a fold.
  [[nodiscard]] double determinant(std::size_t contact, const FullState& state) const {
    const OpenContact& open = this->contacts_[contact];
    return this->law_->of(open.blade)
        .constraint_or_unloaded(this->pose(open.blade, state), open.slip,
                                this->blades().angular_speed(state[rotor::kTime]), bend(contact, state))
        .determinant();
  }

  [[nodiscard]] double slip_velocity(std::size_t contact) const {
    return last_.contacts[contact].force.slip_velocity;
  }
  [[nodiscard]] double shortening() const {
    double largest = 0.0;
    for (const Evaluated& contact : last_.contacts) largest = std::max(largest, contact.force.shortening);
    return largest;
  }
  [[nodiscard]] OpenContact contact_in(std::size_t contact, const FullState& state) const {
    OpenContact open = this->contacts_[contact];
    open.bend = {state[modulus_of(contact)], state[amplitude_of(contact)]};
    return open;
  }

  // Guards.

  /// Where the branch of a blade ends: φ = 0, where it lifts off; a fold, where it snaps; the largest bend.
  template <class Search>
  void end_of_branch(Search& search) {
    auto& step = search.step();
    lifts_off_ = -1;
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      const int amplitude = amplitude_of(i);
      const int blade = this->contacts_[i].blade;
      const auto ends = [&](double fraction, Guard guard) {
        if (search.end().guard != Guard::horizon && !(fraction < search.fraction())) return;
        search.ends_latest(fraction, {guard, blade});
        lifts_off_ = guard == Guard::lift_off ? blade : -1;
      };
      const double at_end = step.end()[amplitude];
      if (at_end <= 0.0) {
        ends(step.crossing_of(amplitude, 0.0), Guard::lift_off);
      } else if (last_.contacts[i].rates.time < 0.0) {
        ends(fold_fraction(step, i), Guard::snap);
      }
      if (at_end > blade::kLargestAmplitude)
        ends(step.crossing_of(amplitude, blade::kLargestAmplitude), Guard::snap);
    }
    if (search.end().guard == Guard::horizon) return;
    const FullState end = step.at_fraction(search.last());
    for (std::size_t i = 0; i < this->contacts_.size(); ++i)
      search.of_contact(i).end_slip_velocity = force(i, end).slip_velocity;
  }

  template <class Search>
  void guards(Search& search) {
    for (int k = 0; k < search.blades(); ++k) {
      const WatchedBlade& blade = search.blade(k);
      if (!blade.open) {
        touch_down(*this, search, k);
      } else if (k == lifts_off_) {
        // A blade that comes to φ = 0 from outside the ring has left it before; g = 0 there to rounding.
        WatchedBlade unloaded = blade;
        unloaded.at_end.value = this->gap_rounding();
        if (!stays_in_ring(*this, search, unloaded)) leaves_ring(*this, search, k, unloaded);
      } else {
        lift_off_at_ring(*this, search, k);
      }
    }
    const auto bounds = this->bounds(search.step());
    for (std::size_t i = 0; i < this->contacts_.size(); ++i)
      this->slip_guard(*this, search, i, this->slip_lasts(bounds));
    this->loss_of_validity(*this, search, bounds.distance);
  }

 private:
  /// Of the arc of one contact, along the time: below it the bend is not well known from h = 0.
  static constexpr double kWellDetermined = 1e-2;
  static constexpr double kBendingWeight = 0.3;  ///< of the relative error of κ and φ against the state's
  static constexpr double kNear = 1e-3;          ///< of κ and φ: a bend that goes on differs by less
  static constexpr double kClose = 1e-5;         ///< the same of dense output where D is not small
  static constexpr double kHere = 1e-9;          ///< of κ and φ: Newton's next step is below rounding

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
    rotor::Acceleration acceleration;
  };

  /// A step from rising load to beyond lift-off. Its error may be small at its end, but lift-off would be
  /// read from the middle of dense output, whose order is one less.
  template <class Step>
  [[nodiscard]] bool holds_whole_contact(const Step& step) const {
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      const int amplitude = amplitude_of(i);
      if (step.end()[amplitude] <= 0.0 && step.start_derivative()[amplitude] > 0.0 &&
          step.size() > kSmallestSize)
        return true;
    }
    return false;
  }
  /// Fraction where a contact's equilibrium ends in a fold, in a step that has passed it.
  template <class Step>
  [[nodiscard]] double fold_fraction(Step& step, std::size_t contact) const {
    const auto determinant_at = [&](double part) { return determinant(contact, step.interpolated(part)); };
    const double at_end = determinant_at(1.0);
    // D vanishes at the unloaded blade where a contact may start, too.
    const double at_start = step.start()[amplitude_of(contact)] > 0.0 ? determinant_at(0.0) : -at_end;
    if (std::isnan(at_end)) return 1.0;
    if (!(at_start > 0.0)) return 0.0;
    return integrate::root_between(determinant_at, 0.0, 1.0, at_start, at_end);
  }

  /// `along`: acceleration of the shaft along (real) and across the blade.
  [[nodiscard]] Rates rates_of(std::size_t contact, double time, const std::complex<double>& along) const {
    const Evaluated& now = last_.contacts[contact];
    const Constraint& there = now.there;
    const auto drift = this->law_->of(this->contacts_[contact].blade)
                           .drift(now.pose, this->contacts_[contact].slip, this->blades().angular_speed(time),
                                  this->blades().angular_acceleration(time), along, there);
    const Rates rates{
        there.determinant(),
        drift.misdirection * there.residual_by_amplitude - drift.residual * there.misdirection_by_amplitude,
        drift.residual * there.misdirection_by_modulus - drift.misdirection * there.residual_by_modulus};
    const double scale = scales_[contact];
    return {scale * rates.time, scale * rates.modulus, scale * rates.amplitude};
  }

  /// Moves a contact onto its equilibrium if that is as near to its bend as said.
  bool goes_on(OpenContact& open, const contact::Pose& at, double speed, double near) const {
    if (open.bend.modulus == 0.0 || !(open.bend.amplitude > 0.0)) return false;
    const auto& law = this->law_->of(open.blade);
    blade::Bend bend = open.bend;
    for (int i = 0; i < 4; ++i) {
      const Constraint there = law.constraint(at, open.slip, speed, bend);
      const blade::Bend change = law.correction(there);
      const double size =
          std::max(std::abs(change.modulus / bend.modulus), std::abs(change.amplitude / bend.amplitude));
      if (!(size < near)) return false;
      bend = {bend.modulus + change.modulus, bend.amplitude + change.amplitude};
      if (size < kHere) break;
    }
    open.bend = bend;
    return true;
  }

  std::vector<double> scales_;  ///< unit of σ against the rates of each contact [1/(m² rad)]
  Evaluation last_;
  Evaluation kept_;
  double kept_shortening_ = 0.0;
  double end_shortening_ = 0.0;  ///< δ/L at the end of the step
  int lifts_off_ = -1;           ///< the blade that ends the step by φ = 0
};

}  // namespace rubatlas::modes
