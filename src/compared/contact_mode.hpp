/// What the modes in contact have in common: who touches, where, and how a step is judged.
///
/// A mode is the motion while a fixed set of blades touches with fixed slip directions, in one form of its
/// equations. Its state is (x, y, x', y', τ, u), and behind it that of a ring that moves
/// (`rotor/bodies.hpp`). Each mode is one file and owns
///     open(time, bodies, contacts, state)   the state that it starts from; false: it cannot start there
///     operator()(state, derivative)         its equations
///     guards(search)                        what ends it
///     project(state), place(state)          its constraints, where it has some
///     contact_in(contact, state)            what it hands over to the mode that follows
/// and hides whatever of the defaults below does not hold for it. `integrate::ControlledStep` says what a
/// step asks of a mode.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "collocation/tip_places.hpp"
#include "compared/guards.hpp"
#include "compared/kind_of_law.hpp"
#include "contact/tip.hpp"
#include "modes/phase.hpp"
#include "modes/rest_judge.hpp"
#include "modes/seen_tip.hpp"
#include "modes/work_meter.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::compared {

template <class State = rotor::ContactState>
class ContactMode : public TipPlaces {
 public:
  using FullState = State;
  using Bodies = rotor::ShaftAndRing;  ///< what moves, without time and u

  explicit ContactMode(const ContactSetup& setup)
      : TipPlaces(*setup.machine, *setup.law), kind_(*law_), limits_(setup.limits), meter_(setup.meter) {
    contacts_.reserve(static_cast<std::size_t>(blades().count()));
    forces_.reserve(static_cast<std::size_t>(blades().count()));
  }

  [[nodiscard]] const std::vector<OpenContact>& contacts() const { return contacts_; }
  [[nodiscard]] const ContactLimits& limits() const { return limits_; }
  [[nodiscard]] double gap_rounding() const { return rotor().gap_rounding(law_->geometry(0)); }

  /// Starts with these contacts in a state between modes. False where the mode cannot start there.
  bool open(double time, const Bodies& state, const std::vector<OpenContact>& contacts, FullState& full) {
    full = rotor::full_state(state, time, 0.0);
    stand(contacts);
    // From here on each blade stays on the side to which it is bent.
    return std::ranges::all_of(contacts_, [&](OpenContact& contact) {
      contact::TipForce force{};
      return respond_paid({pose(contact.blade, full), blades().angular_speed(time)}, contact, force);
    });
  }

  // How a step is judged (`integrate::ControlledStep`).

  static constexpr double kSmallestSize = 1e-15;  ///< in σ
  /// A tip whose slip velocity comes to zero may rest at once, as in MODEL 7.14.
  [[nodiscard]] bool rests_at_once() const { return law_->sticks(); }
  /// The contacts of `trajectory::PathPoint` say how far blades are bent.
  static constexpr bool kBendsFollowPath = false;

  /// A guess holds the side to which a blade is bent, or the branch on which it stands: what a step that goes
  /// too far has made of it is no guess for a shorter one.
  void begins_step(const FullState& /*state*/) {
    if (kind_.remembers()) remembered_ = contacts_;
  }
  void takes_back() {
    if (kind_.remembers()) contacts_ = remembered_;
  }

  /// Pays for an attempt, and for what was asked of the step before. False where no work is left.
  bool begins_attempt() {
    const auto touching = static_cast<std::int64_t>(contacts_.size());
    return meter_->spend(Work::contact,
                         WorkPrice::kAttempt + touching * WorkPrice::kForce + price_of_curves());
  }
  [[nodiscard]] bool is_stopped() const { return meter_->ended(); }

  /// Near a force that starts or ends like a root of the gap many steps are rejected, and their sizes hang on
  /// the last digits. They come from a coarse grid: a motion that comes to the same place goes on by the same
  /// steps, and repeats itself to rounding instead of to the tolerance.
  [[nodiscard]] bool has_coarse_sizes() const { return !kind_.load_follows_gap(); }
  template <class Step>
  [[nodiscard]] double proposed_size(const Step& /*step*/, double relative) const {
    if (!has_coarse_sizes()) return relative;
    return std::exp2(std::floor(kSizesPerOctave * std::log2(relative)) / kSizesPerOctave);
  }
  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    return error_of(step, acceleration_, kind_.load_follows_gap(), [](const FullState&) { return 0.0; });
  }
  /// The first state has been evaluated.
  void begun() { stage_shortening_ = shortening(); }
  void accepted() { end_shortening_ = shortening(); }
  void goes_on() { stage_shortening_ = end_shortening_; }
  void project(FullState& /*state*/) const {}
  void place(FullState& /*state*/) const {}
  void keep() {
    kept_contacts_ = contacts_;
    kept_shortening_ = stage_shortening_;
  }
  void restore() {
    contacts_ = kept_contacts_;
    stage_shortening_ = kept_shortening_;
  }

  // What is asked of a mode.

  /// What an open contact does in a state; nothing where no work is left to find it with.
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    contact::TipForce force{};
    if (is_stopped()) return force;
    OpenContact guess = contacts_[contact];
    law_->respond(tip_place(guess.blade, state), guess, force);
    pay_curves();
    return force;
  }
  /// Slip velocity of an open contact in the last evaluation [m per unit τ].
  [[nodiscard]] double slip_velocity(std::size_t contact) const { return forces_[contact].slip_velocity; }
  /// Largest δ/L of the open contacts in the last evaluation.
  [[nodiscard]] double shortening() const {
    double largest = 0.0;
    for (const contact::TipForce& force : forces_) largest = std::max(largest, force.shortening);
    return largest;
  }
  /// An open contact in a state, from where the next mode goes on.
  [[nodiscard]] OpenContact contact_in(std::size_t contact, const FullState& state) const {
    OpenContact open = contacts_[contact];
    contact::TipForce force{};
    if (!is_stopped()) law_->respond(tip_place(open.blade, state), open, force);
    return open;
  }
  /// What ends the motion, or leads to the next mode, where no force can be found.
  [[nodiscard]] ModeEnd without_force() const {
    return {Guard::left_validity, -1, ending::StatusDetail::no_equilibrium};
  }

  /// How far a straight column is past the end of its branch, in Euler loads; negative before. Of a law with
  /// branches.
  [[nodiscard]] double beyond_straight(std::size_t contact, const FullState& state) const {
    const OpenContact& open = contacts_[contact];
    return -kind_.straight_reserve(pose(open.blade, state), open);
  }

  [[nodiscard]] BladeGap gap(int blade, const FullState& state) const {
    const contact::Pose at = pose(blade, state);
    return {at.gap,
            contact::gap_rate(law_->geometry(blade), at, blades().angular_speed(state[rotor::kTime]))};
  }
  [[nodiscard]] trajectory::Tip tip(int blade, const FullState& state) const {
    return tip_of(law_->geometry(blade), pose(blade, state), blades().angular_speed(state[rotor::kTime]));
  }
  /// c [-] of an open contact under `force` in a state.
  [[nodiscard]] double friction_of(std::size_t contact, const contact::TipForce& force,
                                   const FullState& /*state*/) const {
    return law_->friction().coefficient(force.slip_velocity, contacts_[contact].slip);
  }
  /// What such a contact does to the rotor.
  [[nodiscard]] trajectory::ContactForce on_rotor(std::size_t contact, const contact::TipForce& force,
                                                  double coefficient, const FullState& state) const {
    const OpenContact& open = contacts_[contact];
    return modes::contact_force(force, open.slip, coefficient, direction(open.blade, state),
                                pose(open.blade, state), blades().angular_speed(state[rotor::kTime]));
  }
  /// |c|² − R² [m²]: the shaft's centre reaches the ring where it is positive (MODEL 5).
  [[nodiscard]] double beyond_ring(const FullState& state) const {
    const rotor::State seen = rotor::from_ring(state);
    const double y = seen[1] + rotor().misalignment;
    return seen[0] * seen[0] + y * y - ring_radius() * ring_radius();
  }
  [[nodiscard]] bool load_follows_gap() const { return kind_.load_follows_gap(); }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 protected:
  static constexpr double kSizesPerOctave = 8.0;  ///< where they are coarse
  static constexpr double kShareOfRoots = 0.01;   ///< of the tolerance: estimates beside roots of the time
  /// Of the limit of δ/L: what no stage of a step has met is not met between them.
  static constexpr double kFarFromLimit = 0.75;

  void stand(const std::vector<OpenContact>& contacts) {
    contacts_ = contacts;
    forces_.resize(contacts.size());
    paid_evaluations_ = law_->evaluations();
  }

  /// Of the evaluations of curves that are not paid yet.
  std::int64_t price_of_curves() const {
    const std::uint64_t evaluations = law_->evaluations();
    const auto unpaid = static_cast<std::int64_t>(evaluations - paid_evaluations_);
    paid_evaluations_ = evaluations;
    return unpaid * kind_.price_of_curve();
  }
  /// Searches without a table can take milliseconds for many blades, and are paid for at once. False where no
  /// work is left.
  bool pay_curves() const { return !law_->leans() || meter_->spend(Work::contact, price_of_curves()); }
  /// Finds the force of a contact and pays for it. False where there is none, or no work left.
  bool respond_paid(const TipPlace& at, OpenContact& contact, contact::TipForce& force) {
    const bool found = law_->respond(at, contact, force);
    return pay_curves() && found;
  }

  /// Whether the contact of a blade whose force is found where it stands ends at g = 0 there.
  [[nodiscard]] bool ends_at_ring(int blade, const FullState& state) const {
    if (!law_->releases_at_fold(blade)) return true;
    const auto open = std::ranges::find(contacts_, blade, &OpenContact::blade);
    return kind_.ends_unloaded(pose(blade, state), *open);
  }

  /// Called after each evaluation that has found its forces.
  void watch_shortening(double shortening) { stage_shortening_ = std::max(stage_shortening_, shortening); }

  /// Local error of a step in units of the tolerance: of the state at fixed time, of the time along the path,
  /// and of what bends, as `square_of_bending` has it from a difference of states. Each of them passes
  /// through zero at places, the sum does not. `smooth`: no force starts or ends like a root of the time.
  /// Beside one that does errors are larger than their estimate; those of a smooth one are smaller by
  /// `Tableau::estimate_excess`.
  template <class Step, class Acceleration, class SquareOfBending>
  [[nodiscard]] double error_of(const Step& step, const Acceleration& acceleration, bool smooth,
                                SquareOfBending square_of_bending) const {
    const Bodies rate = rotor::rate_of(step.end(), acceleration);
    const double fastest = rate.abs().maxCoeff();
    const double estimate = step.error_estimate([&](const FullState& difference) {
      // An error of the time is an error of the state along its path.
      const double time = difference[rotor::kTime];
      const double along = fastest * time;
      const Bodies state = rotor::bodies(difference) - rate * time;
      return std::sqrt(state.square().sum() + along * along + square_of_bending(difference));
    });
    if (smooth) return estimate / (step.table().estimate_excess * limits_.tolerance);
    // No estimate can be less than the rounding of places.
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * ring_radius();
    return estimate / std::max(kShareOfRoots * limits_.tolerance, std::min(rounding, limits_.tolerance));
  }

  /// How far from the ring's centre the shaft gets in a step, and how fast, as seen from the ring: bounds
  /// from the ends of the step, as `integrate::cubic_range` has them.
  struct Bounds {
    double distance;  ///< of |c| [m]
    double speed;     ///< of |c'| [m per unit τ]
  };
  template <class Step>
  [[nodiscard]] Bounds bounds(const Step& step) const {
    using rotor::from_ring;
    const rotor::State begin = from_ring(step.start());
    const rotor::State end = from_ring(step.end());
    const rotor::State second = begin + step.size() / 3.0 * from_ring(step.start_derivative());
    const rotor::State third = end - step.size() / 3.0 * from_ring(step.end_derivative());
    const rotor::State margin =
        0.1 * ((third - 2.0 * second + begin).abs() + (end - 2.0 * third + second).abs());
    const rotor::State least = begin.min(end).min(second.min(third)) - margin;
    const rotor::State greatest = begin.max(end).max(second.max(third)) + margin;
    rotor::State farthest = least.abs().max(greatest.abs());
    farthest[1] =
        std::max(std::abs(least[1] + rotor().misalignment), std::abs(greatest[1] + rotor().misalignment));
    return {std::sqrt(farthest[0] * farthest[0] + farthest[1] * farthest[1]),
            std::sqrt(farthest[2] * farthest[2] + farthest[3] * farthest[3])};
  }
  /// No tip's slip can turn round within such bounds: v = c'·t + Ω (rk − c)·n, and |rk| >= R in contact.
  [[nodiscard]] bool slip_lasts(const Bounds& bounds) const {
    return blades().slowest() * (ring_radius() - bounds.distance) > bounds.speed;
  }

  [[nodiscard]] bool all_at_rest() const {
    return std::ranges::all_of(contacts_, [](const OpenContact& open) { return open.slip == 0.0; });
  }

  /// Guards of the slip of an open contact that is not at rest.
  template <class Mode, class Search>
  static void slip_guard(const Mode& mode, Search& search, std::size_t contact, bool lasts) {
    if (!mode.law_->has_slip_state()) return;
    if (mode.rests_at_once()) return slip_comes_to_rest(mode, search, contact, lasts);
    // Beside a tip at rest each force is searched for anew, which may take a thousand times as long as to
    // carry it: v is taken to turn round once in a step at most.
    if (mode.law_->sticks()) {
      const WatchedBlade& blade = search.of_contact(contact);
      if (blade.slip_velocity * blade.end_slip_velocity > 0.0) return;
    }
    slip_reversal(mode, search, contact, lasts);
  }
  /// Where forces are found from the place of the tip: `farthest` of the shaft in the step, all stages known.
  template <class Mode, class Search>
  static void loss_of_validity(const Mode& mode, Search& search, double farthest) {
    shaft_at_ring(mode, search, farthest);
    if (mode.kind_.load_follows_gap() || mode.stage_shortening_ < kFarFromLimit * mode.limits_.max_shortening)
      return;
    shortening_limit(mode, search);
  }
  /// All guards of a mode whose tips slip, or are at rest (s = 0).
  template <class Mode, class Search>
  static void guards_of_tips(const Mode& mode, Search& search) {
    touch_downs_and_lift_offs(mode, search);
    const auto bounds = mode.bounds(search.step());
    for (std::size_t i = 0; i < mode.contacts_.size(); ++i) {
      if (mode.contacts_[i].slip == 0.0) {
        loosening(mode, search, i);
      } else {
        slip_guard(mode, search, i, mode.slip_lasts(bounds));
      }
    }
    loss_of_validity(mode, search, bounds.distance);
  }

  KindOfLaw kind_;
  ContactLimits limits_;
  WorkMeter* meter_;
  std::vector<OpenContact> contacts_;      ///< with the first guesses of their roots
  std::vector<contact::TipForce> forces_;  ///< of the last evaluation, one a contact
  rotor::Acceleration acceleration_{};     ///< of the last evaluation
  double stage_shortening_ = 0.0;          ///< largest δ/L that the stages of a step have met
  std::uint64_t evaluations_ = 0;

 private:
  std::vector<OpenContact> remembered_;
  std::vector<OpenContact> kept_contacts_;
  double kept_shortening_ = 0.0;
  double end_shortening_ = 0.0;
  mutable std::uint64_t paid_evaluations_ = 0;  ///< of curves: what has been spent, not what the mode is
};

}  // namespace rubatlas::compared
