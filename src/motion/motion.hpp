/// The motion of the rotor from revolution to revolution, as a hybrid system: modes, the guards that end
/// them, and the resets from one to the next.
///
/// This class executes modes and resets and does not know their equations: a mode owns its equations and its
/// guards (`modes/`), and `contact_reset.hpp` says what becomes of a contact at a reset. Nor does it know
/// what is kept of the motion: a listener receives each piece of the motion and each event, and asks the
/// piece for the states that it needs. Time counts from the start of the revolution, so that it does not lose
/// digits in a long run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "integrate/dormand_prince_853.hpp"
#include "modes/flight_piece.hpp"
#include "modes/motion_listener.hpp"
#include "modes/touchdown_search.hpp"
#include "motion/contact_reset.hpp"
#include "motion/modes_of.hpp"
#include "motion/work_counts.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair = integrate::DormandPrince853, class Blades = rotor::BladeSet>
class Motion {
 public:
  using Bodies = rotor::BodiesOf<Forcing>;  ///< the shaft, and the ring where the ring is a body

  /// `collocates`: contacts that collocation can solve are left to it.
  Motion(const rotor::RotorConstants& rotor, Blades blades, Law law, Forcing forcing,
         const modes::ContactLimits& limits, [[maybe_unused]] bool collocates = false)
      : rotor_(rotor),
        forcing_(std::move(forcing)),
        law_(std::move(law)),
        limits_(limits),
        blades_(std::move(blades)),
        machine_(rotor::machine_of(rotor_, blades_, forcing_)),
        flight_(machine_),
        search_(machine_, geometries()),
        solved_(setup(law_)),
        carried_(made<decltype(carried_)>(&law_)),
        skimming_(made<decltype(skimming_)>(&law_)),
        sticking_(made<decltype(sticking_)>(&law_)),
        judge_(made<decltype(judge_)>(&law_)),
        ring_placer_(made<decltype(ring_placer_)>(&law_)),
        resting_law_(law_of_rest()),
        resting_judge_(made<decltype(resting_judge_)>(resting_law_ ? &*resting_law_ : nullptr)),
        resting_(made<decltype(resting_)>(resting_law_ ? &*resting_law_ : nullptr)) {
    if constexpr (Modes::kCollocates) {
      auto arc_law = collocates ? Modes::arc_law(law_, blades_.count(), limits_.max_shortening) : nullptr;
      if (arc_law) collocated_.emplace(machine_, std::move(arc_law), limits_.tolerance, meter_);
    }
    contacts_.reserve(static_cast<std::size_t>(blades_.count()));
  }
  Motion(const Motion&) = delete;  // members hold pointers to each other
  Motion& operator=(const Motion&) = delete;

  /// Starts at phase 0; blades with g > 0 are in contact (MODEL 4.4).
  ending::PointStatus start(const Bodies& state) { return start(state, 0.0, kNoBlade); }
  /// Starts at time τ of the first revolution, where the tip of `touching` stands on the ring and touches
  /// down.
  ending::PointStatus start(const Bodies& state, double time, int touching) {
    state_ = state;
    time_ = time;
    mode_ = Mode::undecided;
    contacts_.clear();
    for (int k = 0; k < blades_.count(); ++k) {
      const TipPlace at = place(k);
      const bool touches = k == touching || at.pose.gap > 0.0;
      if (touches && !open(k, at)) return ends(ending::StatusDetail::no_equilibrium);
    }
    touched_down_ = touching != kNoBlade;
    if (!place_ring()) return ends(ending::StatusDetail::ring_unbalanced);
    if (!flight_.resolves(rotor_.period())) return ends(ending::StatusDetail::beyond_precision);
    if (!settle([](const modes::OpenContact&) {})) return ends(ending::StatusDetail::slip_undecided);
    begin_flight();
    return ends(state_.isFinite().all() ? ending::StatusDetail::none
                                        : ending::StatusDetail::beyond_precision);
  }

  /// A motion at the end of a revolution, from which another motion goes on.
  struct Handover {
    Bodies state;
    std::vector<modes::OpenContact> contacts;
    modes::WorkMeter meter;
  };
  [[nodiscard]] Handover hand_over() {
    Handover handed{state_, contacts_, meter_};
    if (mode_ == Mode::undecided || mode_ == Mode::flight) return handed;
    in_phase([&](auto& phase) {
      for (std::size_t i = 0; i < contacts_.size(); ++i) handed.contacts[i] = phase.contact_at(i, time_);
    });
    if (mode_ == Mode::resting) {
      // A tip at rest comes loose where the machine changes: s becomes the side to which its blade is bent.
      for (modes::OpenContact& open : handed.contacts) {
        if (open.slip == 0.0) open.slip = std::copysign(1.0, open.bend.modulus);
        if (Modes::kCarries) open.bending = 0.0;
      }
    }
    return handed;
  }
  /// Goes on at phase 0 from where a motion with another speed or other blades has ended: contacts stay, with
  /// their slip directions (MODEL 4.4), where the blade still reaches the ring.
  ending::PointStatus take_over(const Handover& handed) {
    state_ = handed.state;
    meter_ = handed.meter;
    contacts_.clear();
    for (int k = 0; k < blades_.count(); ++k) {
      const TipPlace at = place(k);
      const auto held = std::ranges::find(handed.contacts, k, &modes::OpenContact::blade);
      const bool found = held == handed.contacts.end() ? at.pose.gap <= 0.0 || open(k, at) : keep(*held, at);
      if (!found) return ends(ending::StatusDetail::no_equilibrium);
    }
    begin_flight();
    return ending::PointStatus::done;
  }

  /// Computes one revolution.
  ending::PointStatus revolution(modes::MotionListener& listener, const modes::GoOn& go_on = {}) {
    const double period = rotor_.period();
    meter_.begin_revolution(go_on);
    while (meter_.spend(modes::Work::events, price_of_last_event())) {
      if (mode_ == Mode::undecided && !begin_mode()) return ends(refusal_);
      const modes::ModeEnd end = mode_ == Mode::flight
                                     ? fly(period, listener)
                                     : in_phase([&](auto& phase) { return touch(phase, period, listener); });
      if (end.guard == modes::Guard::horizon) {
        if (mode_ != Mode::flight) time_ = period;
        return finish_revolution(period);
      }
      if (end.guard == modes::Guard::failed || end.guard == modes::Guard::left_validity) return ends(end.why);
      const ending::PointStatus status = reset(end, listener);
      if (status != ending::PointStatus::done) return status;
      if (!place_ring()) return ends(ending::StatusDetail::ring_unbalanced);
    }
    return ends(meter_.why());
  }
  /// What ended the motion, where its status is not `done`.
  [[nodiscard]] ending::StatusDetail status_detail() const { return detail_; }

  /// State at the end of the last revolution.
  [[nodiscard]] const Bodies& state() const { return state_; }

  [[nodiscard]] WorkCounts work() const {
    WorkCounts result = work_;
    const auto add = [&](const auto& phase) {
      result.right_hand_sides += phase.evaluations();
      result.steps += phase.steps();
      result.rejected_steps += phase.rejected();
    };
    add(solved_);
    if constexpr (Modes::kCollocates) {
      if (collocated_) add(*collocated_);
    }
    if constexpr (Modes::kSticks) add(*sticking_);
    if constexpr (Modes::kRests) {
      if (resting_) add(*resting_);
    }
    if constexpr (Modes::kCarries) {
      add(*carried_);
      add(*skimming_);
    }
    result.elastica_evaluations = modes::curve_evaluations(law_);
    result.price = meter_.total();
    result.gap_evaluations = search_.evaluations();
    return result;
  }

 private:
  using Modes = ModesOf<Law, Forcing, Pair, Blades>;
  using Reset = typename Modes::Reset;
  template <bool kOccurs, class Type>
  using Optional = std::optional<std::conditional_t<kOccurs, Type, std::monostate>>;
  enum class Mode : std::uint8_t {
    undecided,
    flight,
    collocated,
    carried,
    skimming,
    sticking,
    resting,
    solved
  };

  template <class AnyLaw>
  [[nodiscard]] modes::ContactSetup<AnyLaw, Forcing, Blades> setup(const AnyLaw& law) {
    return {&rotor_, &blades_, &law, &forcing_, limits_, &meter_};
  }
  /// A part of the motion, made where it occurs and there is a law for it.
  template <class Part, class AnyLaw>
  [[nodiscard]] Part made(const AnyLaw* law) {
    if constexpr (std::is_same_v<typename Part::value_type, std::monostate>)
      return Part();
    else
      return law != nullptr ? Part(std::in_place, setup(*law)) : Part();
  }
  [[nodiscard]] Optional<Modes::kRests, typename Modes::RestingLaw> law_of_rest() const {
    if constexpr (Modes::kRests) return resting_law(law_, blades_.count());
    return {};
  }

  ending::PointStatus ends(ending::StatusDetail why) {
    detail_ = why;
    return ending::status_of(why);
  }

  /// Price of the last event. Where the search for new equilibria is long, it is included.
  [[nodiscard]] std::int64_t price_of_last_event() {
    std::int64_t price = modes::WorkPrice::kEvent;
    if constexpr (!Law::kHasBending) {
      const std::uint64_t evaluations = modes::curve_evaluations(law_);
      if (!contacts_.empty()) {
        price += static_cast<std::int64_t>(evaluations - paid_evaluations_) * modes::price_of_curve<Law>();
      }
      paid_evaluations_ = evaluations;
    }
    return price;
  }

  /// Calls `use` with the phase of the present mode in contact.
  template <class Use>
  auto in_phase(Use use) {
    if constexpr (Modes::kCollocates) {
      if (mode_ == Mode::collocated) return use(*collocated_);
    }
    if constexpr (Modes::kCarries) {
      if (mode_ == Mode::carried) return use(*carried_);
      if (mode_ == Mode::skimming) return use(*skimming_);
    }
    if constexpr (Modes::kSticks) {
      if (mode_ == Mode::sticking) return use(*sticking_);
    }
    if constexpr (Modes::kRests) {
      if (mode_ == Mode::resting) return use(*resting_);
    }
    return use(solved_);
  }

  [[nodiscard]] std::vector<contact::Geometry> geometries() const {
    std::vector<contact::Geometry> result;
    result.reserve(static_cast<std::size_t>(blades_.count()));
    for (int k = 0; k < blades_.count(); ++k) result.push_back(law_.of(k).geometry());
    return result;
  }
  /// Finds out whether blades can ever touch.
  void begin_flight() {
    const rotor::ShaftAndRing bodies = rotor::shaft_and_ring(state_);
    flight_.start(time_, bodies);
    never_touches_ = contacts_.empty() && search_.never_touches(flight_, bodies);
  }
  modes::ModeEnd fly(double period, modes::MotionListener& listener) {
    using modes::Guard;
    flight_.start(time_, rotor::shaft_and_ring(state_));
    std::optional<modes::TouchdownSearch::Touchdown> touchdown;
    if (!never_touches_) {
      touchdown = search_.find(flight_, period, meter_);
      if (meter_.ended()) return {Guard::failed, -1, meter_.why()};
    }
    const double end = touchdown ? touchdown->time : period;
    if (search_.shaft_at_ring(flight_, end, meter_))
      return {Guard::left_validity, -1, ending::StatusDetail::shaft_at_ring};
    if (meter_.ended()) return {Guard::failed, -1, meter_.why()};
    if (end > time_) {
      modes::FlightPiece piece(flight_, search_, end);
      listener.piece(piece);
      state_ = rotor::bodies_of<Forcing>(touchdown ? touchdown->bodies : flight_.state(end));
      time_ = end;
      if (!state_.isFinite().all()) return {Guard::failed, -1, ending::StatusDetail::beyond_precision};
    }
    if (!touchdown) return {Guard::horizon};
    return {Guard::touch_down, touchdown->blade};
  }

  template <class Phase>
  modes::ModeEnd touch(Phase& phase, double period, modes::MotionListener& listener) {
    const modes::ModeEnd end = phase.advance(period, listener);
    paid_evaluations_ = modes::curve_evaluations(law_);  // the phase has paid for its own
    if (end.guard == modes::Guard::horizon) {
      state_ = rotor::as<Bodies>(phase.state_at(period));
      phase.shift_time(period);
      return end;
    }
    const auto full = phase.end_state();
    state_ = rotor::as<Bodies>(rotor::bodies(full));
    time_ = full[rotor::kTime];
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const modes::OpenContact there = phase.contact_at_end(i);
      contacts_[i].bending = there.bending;
      contacts_[i].bend = there.bend;
      contacts_[i].yielding = there.yielding;
    }
    if (mode_ == Mode::resting) {
      // Tips that slip beside a tip at rest go on under their own law, which finds their bending anew. The
      // reset does this for the blade of the event.
      for (modes::OpenContact& open : contacts_) {
        if (open.slip != 0.0 && open.blade != end.blade && !bend_anew(open))
          return {modes::Guard::left_validity, -1, ending::StatusDetail::no_equilibrium};
      }
    }
    if (!state_.isFinite().all()) return {modes::Guard::failed, -1, ending::StatusDetail::beyond_precision};
    return end;
  }

  ending::PointStatus finish_revolution(double period) {
    if (mode_ == Mode::flight) mode_ = Mode::undecided;
    ++work_.revolutions;
    time_ -= period;  // exactly 0
    for (modes::OpenContact& open : contacts_) {
      open.reversed -= period;
      open.reversed_before -= period;
    }
    return ends(state_.isFinite().all() ? ending::StatusDetail::none
                                        : ending::StatusDetail::beyond_precision);
  }

  // From the contacts to the mode for them.

  template <class Phase>
  bool begin_in(Mode mode, Phase& phase, const std::vector<modes::OpenContact>& contacts) {
    mode_ = mode;
    const bool started = phase.start(time_, rotor::as<typename Phase::Bodies>(state_), contacts);
    refusal_ = phase.refusal();
    return started;
  }
  /// False where no mode can begin; `refusal_` says why.
  bool begin_mode() {
    refusal_ = ending::StatusDetail::no_equilibrium;
    if (contacts_.empty()) {
      mode_ = Mode::flight;
      return true;
    }
    const bool any_rests = std::ranges::count(contacts_, 0.0, &modes::OpenContact::slip) > 0;
    if constexpr (Modes::kRests) {
      if (any_rests) return begin_in(Mode::resting, *resting_, of_resting_law());
    }
    if constexpr (Modes::kSticks) {
      if (any_rests) return begin_in(Mode::sticking, *sticking_, contacts_);
    }
    if constexpr (Modes::kCarries) {
      if (begins_to_skim()) return begin_in(Mode::skimming, *skimming_, contacts_);
      const bool near_fold = std::exchange(near_fold_, false);
      modes::OpenContact& first = contacts_.front();
      if (near_fold || (contacts_.size() == 1 && law_.of(first.blade).carried())) {
        // The bending that another mode has left is a first guess; an unloaded blade starts at u = 0 exactly.
        if (first.bending > 0.0) {
          const auto root = Reset::follow(law_.of(first.blade), place(first.blade), first);
          if (!root) return false;
          first.bending = *root;
        }
        if constexpr (Modes::kCollocates) {
          if (collocated_ && contacts_.size() == 1 && !handed_over_)
            return begin_in(Mode::collocated, *collocated_, contacts_);
        }
        // A column that now stands straight is solved for.
        const bool bends = law_.of(first.blade).carried() || first.bending > 0.0;
        if (bends && begin_in(Mode::carried, *carried_, contacts_)) return true;
      }
    }
    if constexpr (Modes::kCollocates) {
      const bool few = (contacts_.size() > 1 || !Modes::kCarries) && collocated_ &&
                       contacts_.size() <= collocated_->most_contacts();
      if (few && !handed_over_ && all_follow()) return begin_in(Mode::collocated, *collocated_, contacts_);
    }
    return begin_in(Mode::solved, solved_, contacts_);
  }

  /// Finds the bending of all contacts, from where another mode has left it. False where one has no force.
  [[nodiscard]] bool all_follow() {
    if constexpr (Reset::kCarries) {
      return std::ranges::all_of(contacts_, [&](modes::OpenContact& open) {
        if (open.bending == 0.0) return true;
        const auto root = Reset::follow(law_.of(open.blade), place(open.blade), open);
        if (root) open.bending = *root;
        return root.has_value();
      });
    } else {
      return true;  // the mode finds where they stand
    }
  }

  /// Whether the one blade in contact has just touched down, would hop less high than the tolerated error,
  /// and would return to the ring.
  [[nodiscard]] bool begins_to_skim() requires Modes::kCarries {
    const bool touched_down = std::exchange(touched_down_, false);
    if (!touched_down || contacts_.size() != 1) return false;
    // A blade released at the fold returns from a finite distance, and the force of a compressed column
    // starts from zero: neither hops without end.
    const auto& law = law_.of(contacts_.front().blade);
    if (law.releases_at_fold() || !law.carried()) return false;
    return skimming_->mode().begins(unbent(), contacts_.front(), kUnresolvedHop * limits_.tolerance);
  }

  // Contacts.

  [[nodiscard]] TipPlace place(int blade) const {
    return {rotor::pose_of(rotor_, law_.of(blade).geometry(), blades_.direction(blade, blades_.first(time_)),
                           rotor::from_ring(state_)),
            blades_.angular_speed(time_)};
  }
  /// Whether the contact of a blade goes on beyond the ring while it has a force.
  [[nodiscard]] bool released_at_fold(int blade) const {
    if constexpr (Law::kHasBending) return law_.of(blade).releases_at_fold();
    return false;
  }
  [[nodiscard]] rotor::FullStateOf<Forcing> unbent() const { return rotor::full_state(state_, time_, 0.0); }

  /// Opens the contact of a blade at the tip's place. False where no force exists (MODEL 5).
  bool open(int blade, const TipPlace& at) {
    const double velocity = contact::undeformed_slip_velocity(law_.of(blade).geometry(), at.pose, at.speed);
    modes::OpenContact contact{blade, velocity >= 0.0 ? 1.0 : -1.0, 0.0};
    if constexpr (Modes::kSticks) {
      const double tip_speed = std::abs(rotor_.speed_ratio) * law_.of(blade).geometry().ring_radius;
      if (std::abs(velocity) <= contact::kSlipRounding * tip_speed) contact.slip = 0.0;
    }
    if (!Reset::open(law_.of(blade), at, contact)) return false;
    contacts_.push_back(contact);
    return true;
  }
  /// Goes on with a contact at the tip's present place, or closes it where the tip has left the ring. False
  /// where no force exists (MODEL 5).
  bool keep(modes::OpenContact contact, const TipPlace& at) {
    const Standing standing = Reset::keep(law_.of(contact.blade), at, contact);
    if (standing == Standing::stands) contacts_.push_back(contact);
    if (standing == Standing::free) ++work_.liftoffs;
    return standing != Standing::lost;
  }
  /// Finds the bending of a contact whose slip direction has changed. False where it has no force.
  [[nodiscard]] bool bend_anew(modes::OpenContact& contact) const {
    return Reset::bend_anew(law_.of(contact.blade), place(contact.blade), contact);
  }

  /// Puts a ring without mass where its spring balances the blades in contact. False where there is no such
  /// place (MODEL 5).
  bool place_ring() {
    if constexpr (Modes::kRingFollows) {
      const auto touches = [this](int blade) { return open(blade, place(blade)); };
      return ring_placer_->settle(state_, time_, contacts_, touches);
    }
    return true;
  }

  // Rest.

  /// Frees the tips at rest that friction cannot hold in the present state, and calls `tell` for each of
  /// them. False where a tip is left neither rest nor a direction of slip.
  template <class Tell>
  [[nodiscard]] bool settle(Tell tell) {
    if constexpr (Modes::kSticks) return judge_->settle(unbent(), contacts_, tell);
    return true;
  }
  /// The same after an event of one blade; the listener is told of the other tips that come loose.
  ending::StatusDetail settle_others(int blade, modes::MotionListener& listener) {
    const bool settled = settle([&](const modes::OpenContact& other) {
      if (other.blade != blade) tell(listener, modes::Guard::comes_loose, other.blade, other.slip);
    });
    return settled ? ending::StatusDetail::none : ending::StatusDetail::slip_undecided;
  }

  /// Whether the last reversals of a tip follow each other so fast that they accumulate (MODEL 4.4).
  [[nodiscard]] bool accumulates(modes::OpenContact& contact) const {
    const double cycle = time_ - contact.reversed_before;
    contact.reversed_before = std::exchange(contact.reversed, time_);
    return cycle < kShortestCycle;
  }
  /// Whether the model says what follows where slip reversals of a tip accumulate. For some elastic blades
  /// the model does not. The slip velocity of a rigid tip does not jump at a reversal, so that its reversals
  /// do not accumulate.
  [[nodiscard]] bool has_law_of_rest() const {
    if constexpr (Modes::kRests) return resting_.has_value();
    return !Law::OfBlade::kElastic;
  }
  /// A contact in the unknowns of the law of tips at rest. They are zero, to be found anew, for a slipping
  /// blade whose own law has the bending parameter u.
  [[nodiscard]] static modes::OpenContact of_resting_law(modes::OpenContact contact) {
    if (Modes::kCarries && contact.slip != 0.0) contact.bend = {};
    return contact;
  }
  [[nodiscard]] std::vector<modes::OpenContact> of_resting_law() const {
    std::vector<modes::OpenContact> contacts;
    for (const modes::OpenContact& open : contacts_) contacts.push_back(of_resting_law(open));
    return contacts;
  }
  /// The limit of slip reversals that accumulate: the tip comes to rest where friction can hold it. False
  /// where friction cannot hold it yet; the tip then reverses and slips on.
  [[nodiscard]] bool comes_to_rest(modes::OpenContact& contact) {
    if constexpr (Modes::kRests) {
      modes::OpenContact there = of_resting_law(contact);
      if (!resting_judge_->come_to_rest(there, unbent())) return false;
      contact = there;
      return true;
    }
    return false;
  }

  // Resets.

  void tell(modes::MotionListener& listener, modes::Guard guard, int blade, double slip) const {
    listener.event(modes::Event{guard, blade, time_, slip, rotor::shaft(state_)});
  }
  using Contact = std::vector<modes::OpenContact>::iterator;

  /// From the guard that has ended a mode to the contacts of the next mode.
  ending::PointStatus reset(const modes::ModeEnd& end, modes::MotionListener& listener) {
    using modes::Guard;
    mode_ = Mode::undecided;
    const auto contact = std::ranges::find(contacts_, end.blade, &modes::OpenContact::blade);
    switch (end.guard) {
      case Guard::touch_down:
        return ends(touch_down(end.blade, listener));
      case Guard::lift_off:
        if (Reset::straightens(law_.of(end.blade), place(end.blade), *contact))
          return ends(ending::StatusDetail::none);
        return ends(lift_off(contact, listener));
      case Guard::snap:
        return ends(snap(contact, listener));
      case Guard::nears_fold:
        std::iter_swap(contacts_.begin(), contact);
        near_fold_ = true;
        return ends(ending::StatusDetail::none);
      case Guard::comes_loose:
        return ends(come_loose(contact, listener));
      case Guard::slip_reversal:
        return ends(reverse_slip(contact, listener));
      case Guard::hands_over:
        handed_over_ = true;
        return ends(ending::StatusDetail::none);
      case Guard::pressed_in:  // a tip that has skimmed goes on under its full force, a straight blade bends
        contact->straight = false;
        return ends(ending::StatusDetail::none);
      default:
        return ends(ending::StatusDetail::none);
    }
  }

  ending::StatusDetail touch_down(int blade, modes::MotionListener& listener) {
    ++work_.touchdowns;
    if (!open(blade, place(blade))) return ending::StatusDetail::no_equilibrium;
    touched_down_ = true;
    handed_over_ = false;
    const ending::StatusDetail settled = settle_others(blade, listener);
    tell(listener, modes::Guard::touch_down, blade, contacts_.back().slip);
    return settled;
  }
  ending::StatusDetail lift_off(Contact contact, modes::MotionListener& listener) {
    const int blade = contact->blade;
    ++work_.liftoffs;
    handed_over_ = false;
    tell(listener, modes::Guard::lift_off, blade, contact->slip);
    contacts_.erase(contact);
    return settle_others(blade, listener);
  }
  /// A blade has come to the end of its branch.
  ending::StatusDetail snap(Contact contact, modes::MotionListener& listener) {
    handed_over_ = false;
    switch (Reset::snap(law_.of(contact->blade), place(contact->blade), *contact)) {
      case Standing::lost:
        return ending::StatusDetail::no_equilibrium;
      case Standing::free:
        return lift_off(contact, listener);
      default:
        tell(listener, modes::Guard::snap, contact->blade, contact->slip);
        return ending::StatusDetail::none;
    }
  }
  /// A tip at rest is no longer held, and slips in the direction of the pull.
  ending::StatusDetail come_loose(Contact contact, modes::MotionListener& listener) {
    handed_over_ = false;
    const auto place_in_list = static_cast<std::size_t>(contact - contacts_.begin());
    ending::StatusDetail settled = ending::StatusDetail::none;
    if constexpr (Modes::kSticks) {
      if (!judge_->let_go(contacts_, place_in_list, unbent())) return ending::StatusDetail::slip_undecided;
      settled = settle_others(contact->blade, listener);
    } else if constexpr (Modes::kRests) {
      std::vector<modes::OpenContact> contacts = of_resting_law();
      resting_judge_->let_go(contacts, place_in_list, unbent());
      *contact = {contact->blade, contacts[place_in_list].slip, contact->bending, contact->bend};
      if (!bend_anew(*contact)) return ending::StatusDetail::no_equilibrium;
    }
    tell(listener, modes::Guard::comes_loose, contact->blade, contact->slip);
    return settled;
  }
  /// The slip velocity of a tip has come to zero: it reverses its slip, or comes to rest where it can stick.
  ending::StatusDetail reverse_slip(Contact contact, modes::MotionListener& listener) {
    ++work_.slip_reversals;
    handed_over_ = false;
    ending::StatusDetail settled = ending::StatusDetail::none;
    if constexpr (Modes::kSticks) {
      const auto place_in_list = static_cast<std::size_t>(contact - contacts_.begin());
      if (!judge_->arrest(contacts_, place_in_list, unbent())) return ending::StatusDetail::slip_undecided;
      settled = settle_others(contact->blade, listener);
    } else {
      const bool accumulated = accumulates(*contact);
      if (accumulated && !has_law_of_rest()) return ending::StatusDetail::slip_undecided;
      if (accumulated && comes_to_rest(*contact)) {
        ++work_.slip_accumulations;
      } else {
        contact->slip = -contact->slip;
        if (!bend_anew(*contact)) {
          // A tip that was held beyond the ring is free where the reversed friction cannot hold it.
          if (!released_at_fold(contact->blade) || place(contact->blade).pose.gap >= 0.0)
            return ending::StatusDetail::no_equilibrium;
          tell(listener, modes::Guard::slip_reversal, contact->blade, contact->slip);
          return lift_off(contact, listener);
        }
      }
    }
    tell(listener, modes::Guard::slip_reversal, contact->blade, contact->slip);
    return settled;
  }

  /// In tolerances: hops lower than this are replaced by their limit (MODEL 4.9). Their height may grow by
  /// some tens of tolerances while the force changes along the ring.
  static constexpr double kUnresolvedHop = 1.0;
  /// τ: the slip reversals of a tip accumulate where the tip reverses its slip and reverses it again within
  /// this time. Each cycle of an accumulating sequence is a fixed share of the one before. Among 4800
  /// reversals of randomly kicked rotors all cycles this short belonged to such sequences.
  static constexpr double kShortestCycle = 1e-9;

  static constexpr int kNoBlade = -1;

  rotor::RotorConstants rotor_;
  Forcing forcing_;
  Law law_;
  modes::ContactLimits limits_;
  Blades blades_;
  modes::WorkMeter meter_;
  rotor::Machine machine_;
  modes::Flight flight_;
  modes::TouchdownSearch search_;
  typename Modes::template Phase<typename Modes::Solved> solved_;
  Optional<Modes::kCollocates, typename Modes::Collocated> collocated_;
  Optional<Modes::kCarries, typename Modes::template Phase<typename Modes::Carried>> carried_;
  Optional<Modes::kCarries, typename Modes::template Phase<typename Modes::Skimming>> skimming_;
  Optional<Modes::kSticks, typename Modes::template Phase<typename Modes::Sticking>> sticking_;
  Optional<Modes::kSticks, typename Modes::Sticking> judge_;
  Optional<Modes::kRingFollows, typename Modes::FollowingRing> ring_placer_;
  Optional<Modes::kRests, typename Modes::RestingLaw> resting_law_;
  Optional<Modes::kRests, typename Modes::Resting> resting_judge_;
  Optional<Modes::kRests, typename Modes::template Phase<typename Modes::Resting>> resting_;
  std::vector<modes::OpenContact> contacts_;
  Bodies state_ = Bodies::Zero();
  double time_ = 0.0;
  std::uint64_t paid_evaluations_ = 0;  ///< of curves, whose price has been added to the meter
  ending::StatusDetail detail_ = ending::StatusDetail::none;
  ending::StatusDetail refusal_ = ending::StatusDetail::none;  ///< why the last mode could not begin
  WorkCounts work_;
  Mode mode_ = Mode::undecided;
  bool handed_over_ = false;    ///< collocation has left the present contacts to other modes
  bool near_fold_ = false;      ///< the first contact is about to come to the end of its branch
  bool touched_down_ = false;   ///< the present contacts began with a touch-down
  bool never_touches_ = false;  ///< proven at the start of the point: no blade can touch
};

}  // namespace rubatlas::motion
