/// The motion of the rotor from revolution to revolution: flight and contact phases in turn.
///
/// Knows in which order things happen, not what is kept of them: a listener receives each piece of motion
/// and each event, and asks the piece for the states that it wants. Time counts from the start of the
/// revolution, so that the last digits do not wear off in a long run.
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

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "modes/contact_phase.hpp"
#include "modes/flight_piece.hpp"
#include "modes/motion_listener.hpp"
#include "motion/motion_phases.hpp"
#include "point/line_solver.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair = integrate::DormandPrince853, class Blades = rotor::BladeSet>
class Motion {
 public:
  using Bodies = rotor::BodiesOf<Forcing>;  ///< the shaft, and the ring where that is a body

  Motion(const rotor::RotorConstants& rotor, Blades blades, Law law, Forcing forcing,
         const modes::ContactLimits& limits)
      : rotor_(rotor),
        free_(rotor.damping_ratio),
        forcing_(std::move(forcing)),
        law_(std::move(law)),
        limits_(limits),
        blades_(std::move(blades)),
        flight_(rotor_, free_, forcing_),
        search_(rotor_, law_, blades_),
        solved_(rotor_, blades_, law_, limits_,
                typename Phases::SolvedSystem(rotor_, blades_, law_, forcing_)) {
    if constexpr (Law::kHasBending) {
      carried_.emplace(rotor_, blades_, law_, limits_,
                       modes::CarriedContact<Law, Forcing, Blades>(rotor_, blades_, law_, forcing_));
      skimming_.emplace(rotor_, blades_, law_, limits_,
                        modes::SkimmingContact<Law, Forcing, Blades>(rotor_, blades_, law_, forcing_));
    }
    if constexpr (contact::Sticks<Law>) {
      judge_.emplace(rotor_, blades_, law_, forcing_);
      sticking_.emplace(rotor_, blades_, law_, limits_,
                        typename Phases::Judge(rotor_, blades_, law_, forcing_));
    }
    if constexpr (Phases::kRests) {
      if (auto resting_law = contact::resting_law(law_, blades_.count())) {
        resting_law_.emplace(std::move(*resting_law));
        resting_judge_.emplace(rotor_, blades_, *resting_law_, forcing_);
        resting_.emplace(rotor_, blades_, *resting_law_, limits_,
                         typename Phases::RestingSystem(rotor_, blades_, *resting_law_, forcing_));
      }
    }
    if constexpr (rotor::kRingFollows<Forcing>) ring_placer_.emplace(rotor_, blades_, law_, forcing_);
    contacts_.reserve(static_cast<std::size_t>(blades_.count()));
  }
  Motion(const Motion&) = delete;  // parts point at each other
  Motion& operator=(const Motion&) = delete;

  /// Starts at phase 0; blades with g > 0 are in contact (MODEL 4.4).
  point::PointStatus start(const Bodies& state) {
    state_ = state;
    time_ = 0.0;
    phase_ = Phase::undecided;
    contacts_.clear();
    const contact::BladeDirection first = blades_.first(0.0);
    for (int k = 0; k < blades_.count(); ++k) {
      const contact::Pose at = rotor::pose_of(rotor_, law_.of(k).geometry(), blades_.direction(k, first),
                                              rotor::from_ring(state_));
      if (at.gap > 0.0 && !open(k, at)) return ends(point::StatusDetail::no_equilibrium);
    }
    if (!place_ring()) return ends(point::StatusDetail::ring_unbalanced);
    if constexpr (requires { flight_.resolves(0.0); }) {
      if (!flight_.resolves(rotor_.period())) return ends(point::StatusDetail::beyond_precision);
    }
    settle([](const modes::OpenContact&) {});
    flight_.start(time_, state_);
    never_touches_ = contacts_.empty() && search_.never_touches(flight_, state_);
    return ends(state_.isFinite().all() ? point::StatusDetail::none : point::StatusDetail::beyond_precision);
  }

  /// A motion at the end of a revolution, for another to go on from.
  struct Handover {
    Bodies state;
    std::vector<modes::OpenContact> contacts;
    modes::WorkMeter meter;
  };
  [[nodiscard]] Handover hand_over() {
    Handover handed{state_, contacts_, meter_};
    const auto ask = [&](auto& phase) {
      for (std::size_t i = 0; i < contacts_.size(); ++i) handed.contacts[i] = phase.contact_at(i, time_);
    };
    if (phase_ == Phase::solved) ask(solved_);
    if constexpr (Law::kHasBending) {
      if (phase_ == Phase::carried) ask(*carried_);
      if (phase_ == Phase::skimming) ask(*skimming_);
    }
    if constexpr (Phases::kRests) {
      // Another machine tears a tip at rest loose: it slips to the side to which its blade is bent.
      if (phase_ == Phase::resting) {
        ask(*resting_);
        for (modes::OpenContact& open : handed.contacts) {
          if (open.slip == 0.0) open.slip = std::copysign(1.0, open.bending);
          if (Law::kHasBending) open.bending = 0.0;
        }
      }
    }
    return handed;
  }
  /// Goes on at phase 0 from where a motion with another speed or other blades has ended: contacts stay, with
  /// their slip directions (MODEL 4.4), where the blade still reaches the ring.
  point::PointStatus take_over(const Handover& handed) {
    state_ = handed.state;
    meter_ = handed.meter;
    contacts_.clear();
    const contact::BladeDirection first = blades_.first(0.0);
    for (int k = 0; k < blades_.count(); ++k) {
      const contact::Pose at = rotor::pose_of(rotor_, law_.of(k).geometry(), blades_.direction(k, first),
                                              rotor::from_ring(state_));
      const auto held = std::find_if(handed.contacts.begin(), handed.contacts.end(),
                                     [&](const modes::OpenContact& open) { return open.blade == k; });
      const bool found = held == handed.contacts.end() ? at.gap <= 0.0 || open(k, at) : keep(*held, at);
      if (!found) return ends(point::StatusDetail::no_equilibrium);
    }
    flight_.start(time_, state_);
    never_touches_ = contacts_.empty() && search_.never_touches(flight_, state_);
    return point::PointStatus::done;
  }

  /// One revolution.
  point::PointStatus revolution(modes::MotionListener& listener, const modes::GoOn& go_on = {}) {
    const double period = rotor_.period();
    meter_.begin_revolution(go_on);
    while (meter_.spend(modes::Work::events, price_of_last_event())) {
      modes::PhaseEnd end{};
      if (phase_ == Phase::undecided) {
        if (!begin_phase()) return ends(refusal_);
      }
      switch (phase_) {
        case Phase::flight:
          end = fly(period, listener);
          break;
        case Phase::carried:
        case Phase::skimming:
          if constexpr (Law::kHasBending) {
            end = phase_ == Phase::carried ? touch(*carried_, period, listener)
                                           : touch(*skimming_, period, listener);
          }
          break;
        case Phase::sticking:
          if constexpr (contact::Sticks<Law>) end = touch(*sticking_, period, listener);
          break;
        case Phase::resting:
          if constexpr (Phases::kRests) end = touch(*resting_, period, listener);
          break;
        default:
          end = touch(solved_, period, listener);
      }
      if (end.event == modes::PhaseEvent::horizon) {
        if (phase_ != Phase::flight) time_ = period;
        return finish_revolution(period);
      }
      if (end.event == modes::PhaseEvent::failed || end.event == modes::PhaseEvent::left_validity) {
        const auto unsaid = end.event == modes::PhaseEvent::failed ? point::StatusDetail::beyond_precision
                                                                   : point::StatusDetail::no_equilibrium;
        return ends(end.why == point::StatusDetail::none ? unsaid : end.why);
      }
      const point::PointStatus status = change_contacts(end, listener);
      if (status != point::PointStatus::done) return status;
      if (!place_ring()) return ends(point::StatusDetail::ring_unbalanced);
    }
    return ends(meter_.why());
  }
  /// What ended the motion, where that is not done.
  [[nodiscard]] point::StatusDetail status_detail() const { return detail_; }

  /// At the end of the last revolution.
  [[nodiscard]] const Bodies& state() const { return state_; }

  [[nodiscard]] WorkCounts work() const {
    WorkCounts result = work_;
    const auto add = [&](const auto& phase) {
      result.right_hand_sides += phase.evaluations();
      result.steps += phase.steps();
      result.rejected_steps += phase.rejected();
    };
    add(solved_);
    if constexpr (contact::Sticks<Law>) add(*sticking_);
    if constexpr (Phases::kRests) {
      if (resting_) add(*resting_);
    }
    if constexpr (Law::kHasBending) {
      add(*carried_);
      add(*skimming_);
    }
    result.elastica_evaluations = modes::curve_evaluations(law_);
    result.price = meter_.total();
    result.gap_evaluations = search_.evaluations();
    return result;
  }

 private:
  using Phases = MotionPhases<Law, Forcing, Pair, Blades>;
  enum class Phase : std::uint8_t { undecided, flight, carried, skimming, sticking, resting, solved };

  point::PointStatus ends(point::StatusDetail why) {
    detail_ = why;
    return point::status_of(why);
  }

  /// Of the search for new equilibria in it, too, where that is long.
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

  modes::PhaseEnd fly(double period, modes::MotionListener& listener) {
    flight_.start(time_, state_);
    std::optional<typename modes::TouchdownSearch<Law, Blades>::Touchdown> touchdown;
    if (!never_touches_) {
      touchdown = search_.find(flight_, period, meter_);
      if (meter_.ended()) return {modes::PhaseEvent::failed, -1, meter_.why()};
    }
    const double end = touchdown ? touchdown->time : period;
    if (search_.shaft_at_ring(flight_, end, meter_))
      return {modes::PhaseEvent::left_validity, -1, point::StatusDetail::shaft_at_ring};
    if (meter_.ended()) return {modes::PhaseEvent::failed, -1, meter_.why()};
    if (end > time_) {
      modes::FlightPiece<Forcing> piece(flight_, time_, end,
                                        flight_.displacement_bound(time_, state_, end - time_));
      listener.piece(piece);
      state_ = flight_.state(end);
      time_ = end;
      if (!state_.isFinite().all())
        return {modes::PhaseEvent::failed, -1, point::StatusDetail::beyond_precision};
    }
    if (!touchdown) return {modes::PhaseEvent::horizon};
    return {modes::PhaseEvent::touch_down, touchdown->blade};
  }

  template <class AnyPhase>
  modes::PhaseEnd touch(AnyPhase& phase, double period, modes::MotionListener& listener) {
    const modes::PhaseEnd end = phase.advance(period, meter_, listener);
    if (end.event == modes::PhaseEvent::horizon) {
      state_ = phase.state_at(period);
      phase.shift_time(period);
      return end;
    }
    const auto full = phase.end_state();
    state_ = rotor::bodies(full);
    time_ = full[rotor::kTime];
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const modes::OpenContact there = phase.contact_at_end(i);
      contacts_[i].bending = there.bending;
      contacts_[i].amplitude = there.amplitude;
    }
    // Tips that slip beside one at rest go on under their own law; the blade of the event does so there.
    if constexpr (Phases::kRests && Law::kHasBending && std::is_same_v<AnyPhase, typename Phases::Resting>) {
      for (modes::OpenContact& open : contacts_) {
        if (open.slip != 0.0 && open.blade != end.blade && !bend_anew(open))
          return {modes::PhaseEvent::left_validity, -1, point::StatusDetail::no_equilibrium};
      }
    }
    if (!state_.isFinite().all())
      return {modes::PhaseEvent::failed, -1, point::StatusDetail::beyond_precision};
    return end;
  }

  point::PointStatus finish_revolution(double period) {
    if (phase_ == Phase::flight) phase_ = Phase::undecided;
    ++work_.revolutions;
    time_ -= period;  // exactly 0
    for (modes::OpenContact& open : contacts_) {
      open.reversed -= period;
      open.reversed_before -= period;
    }
    return ends(state_.isFinite().all() ? point::StatusDetail::none : point::StatusDetail::beyond_precision);
  }

  template <class AnyPhase>
  bool begin_in(AnyPhase& phase, const std::vector<modes::OpenContact>& contacts) {
    const bool started = phase.start(time_, state_, contacts);
    refusal_ = phase.refusal();
    return started;
  }
  /// Begins the phase that goes with the contacts; false where `refusal_` says why there is none.
  bool begin_phase() {
    refusal_ = point::StatusDetail::no_equilibrium;
    if (contacts_.empty()) {
      phase_ = Phase::flight;
      return true;
    }
    if constexpr (Phases::kRests) {
      if (std::ranges::count(contacts_, 0.0, &modes::OpenContact::slip) > 0) {
        phase_ = Phase::resting;
        return begin_in(*resting_, of_resting_law());
      }
    }
    if constexpr (Law::kHasBending) {
      if (begins_to_skim()) {
        phase_ = Phase::skimming;
        return begin_in(*skimming_, contacts_);
      }
      phase_ = Phase::carried;
      const bool near_fold = std::exchange(near_fold_, false);
      if (near_fold || (contacts_.size() == 1 && law_.of(contacts_.front().blade).carried())) {
        modes::OpenContact& contact = contacts_.front();
        // What other phases leave is a first guess; an unloaded blade starts at u = 0 exactly.
        if (contact.bending > 0.0) {
          const auto root = follow(contact, pose(contact.blade));
          if (!root) return false;
          contact.bending = *root;
        }
        // A column that stands straight by now is solved for.
        const bool bends = law_.of(contact.blade).carried() || contact.bending > 0.0;
        if (bends && begin_in(*carried_, contacts_)) return true;
      }
    }
    if constexpr (contact::Sticks<Law>) {
      if (std::ranges::count(contacts_, 0.0, &modes::OpenContact::slip) > 0) {
        phase_ = Phase::sticking;
        return begin_in(*sticking_, contacts_);
      }
    }
    phase_ = Phase::solved;
    return begin_in(solved_, contacts_);
  }

  /// The bending of a contact where its tip stands now: on its branch, or on the next one where a change of
  /// the blade or of its speed, or rounding next to a fold, has taken it past the end.
  [[nodiscard]] std::optional<double> follow(const modes::OpenContact& contact,
                                             const contact::Pose& at) const requires Law::kHasBending {
    const auto& law = law_.of(contact.blade);
    const auto root = law.solve_near(at, contact.slip, contact.bending);
    if (root || !law.has_branches()) return root;
    return law.snap(at, contact.slip, contact.bending, blades_.speed(time_));
  }

  /// The one blade in contact has just touched down, hops less far than a step may err, and would return.
  [[nodiscard]] bool begins_to_skim() requires Law::kHasBending {
    const bool touched_down = std::exchange(touched_down_, false);
    if (!touched_down || contacts_.size() != 1) return false;
    // A blade released at the fold returns from a distance, and a column that is compressed starts from no
    // force: neither hops without end.
    if (Law::kReleasesAtFold || !law_.of(contacts_.front().blade).carried()) return false;
    return skimming_->system().begins(unbent(), contacts_.front(), kUnresolvedHop * limits_.tolerance);
  }

  [[nodiscard]] contact::Pose pose(int blade) const {
    return rotor::pose_of(rotor_, law_.of(blade).geometry(), blades_.direction(blade, blades_.first(time_)),
                          rotor::from_ring(state_));
  }

  /// Opens a contact where it stands. False where no force exists (MODEL 5).
  bool open(int blade, const contact::Pose& at) {
    const double velocity =
        contact::undeformed_slip_velocity(law_.of(blade).geometry(), at, blades_.speed(time_));
    modes::OpenContact contact{blade, velocity >= 0.0 ? 1.0 : -1.0, 0.0};
    if constexpr (contact::Sticks<Law>) {
      const double tip_speed = std::abs(rotor_.speed_ratio) * law_.of(blade).geometry().ring_radius;
      if (std::abs(velocity) <= modes::kSlipRounding * tip_speed) contact.slip = 0.0;
    }
    if constexpr (Law::kHasBending) {
      // On the approaching side the force starts from zero, on the receding side from a finite value
      // (MODEL 4.2).
      const bool starts_unloaded = at.gap <= kGapRounding && law_.of(blade).starts_unloaded(at, contact.slip);
      if (!starts_unloaded) {
        const auto root = law_.of(blade).solve(at, contact.slip);
        if (!root) return false;
        contact.bending = *root;
      }
    }
    contacts_.push_back(contact);
    return true;
  }

  /// Puts a ring without mass where the blades in contact push it. False where that is nowhere (MODEL 5).
  bool place_ring() {
    if constexpr (rotor::kRingFollows<Forcing>) {
      const auto touches = [this](int blade) { return open(blade, pose(blade)); };
      return ring_placer_->settle(state_, time_, contacts_, touches);
    }
    return true;
  }

  /// Goes on with a contact where the tip stands now, or lets it go where that has left the ring. False where
  /// no force exists (MODEL 5).
  bool keep(modes::OpenContact contact, const contact::Pose& at) {
    bool leaves = at.gap <= 0.0;
    if constexpr (Law::kHasBending) {
      const auto& law = law_.of(contact.blade);
      if (at.gap <= kGapRounding && law.ends_unloaded(at, contact.slip, contact.bending)) {
        contact.bending = 0.0;
      } else if (!leaves || Law::kReleasesAtFold) {
        const auto root = contact.bending > 0.0 ? follow(contact, at) : law.solve(at, contact.slip);
        if (!root && !leaves) return false;
        leaves = !root;
        contact.bending = root.value_or(0.0);
      }
    }
    if (leaves) {
      ++work_.liftoffs;
    } else {
      contacts_.push_back(contact);
    }
    return true;
  }

  [[nodiscard]] rotor::FullStateOf<Forcing> unbent() const { return rotor::full_state(state_, time_, 0.0); }

  /// Lets go of the tips at rest that friction cannot hold where the rotor stands, and tells it of each.
  template <class Tell>
  void settle(Tell let_go) {
    if constexpr (contact::Sticks<Law>) {
      judge_->settle(unbent(), contacts_, let_go);
    }
  }

  /// The slip velocity of a tip has come to zero, or friction no longer holds it there. False where Coulomb's
  /// law leaves the tip nothing to do.
  bool change_slip(modes::OpenContact& contact, modes::PhaseEvent event, modes::MotionListener& listener) {
    const auto place = static_cast<std::size_t>(&contact - contacts_.data());
    if (event == modes::PhaseEvent::comes_loose) {
      judge_->let_go(contacts_, place, unbent());
    } else {
      ++work_.slip_reversals;
      if (!judge_->arrest(contacts_, place, unbent())) return false;
    }
    tell_of_others(contact.blade, listener);
    tell(listener, event, contact.blade, contact.slip);
    return true;
  }

  /// Settles after an event of one blade.
  void tell_of_others(int blade, modes::MotionListener& listener) {
    settle([&](const modes::OpenContact& other) {
      if (other.blade != blade) tell(listener, modes::PhaseEvent::comes_loose, other.blade, other.slip);
    });
  }

  void tell(modes::MotionListener& listener, modes::PhaseEvent event, int blade, double slip) const {
    listener.event(modes::Event{event, blade, time_, slip, rotor::shaft(state_)});
  }

  /// A column that has been carried to u = 0 while its tip is in the ring stands straight from there on.
  bool straightens([[maybe_unused]] modes::OpenContact& contact) {
    if constexpr (Law::kHasBending) {
      if (law_.of(contact.blade).carried() || pose(contact.blade).gap <= kGapRounding) return false;
      contact.bending = 0.0;
      return true;
    }
    return false;
  }

  /// A blade has come to the end of its branch: on to the next equilibrium in the direction in which it
  /// moves, for a blade bent to one of two sides the other one on its side, or that on the other side. False
  /// where there is none.
  bool snap([[maybe_unused]] modes::OpenContact& contact) const {
    if constexpr (Law::kHasBending) {
      const auto root = law_.of(contact.blade)
                            .snap(pose(contact.blade), contact.slip, contact.bending, blades_.speed(time_));
      contact.bending = root.value_or(contact.bending);
      return root.has_value();
    }
    if constexpr (Phases::kBends) {
      constexpr double kSame = 1e-3;  // of κ: a root next to the fold is the one that ends there
      const auto& law = law_.of(contact.blade);
      const contact::Pose at = pose(contact.blade);
      const double side = std::copysign(1.0, contact.bending);
      auto root = law.solve(at, contact.slip, blades_.speed(time_), side);
      if (root && std::abs(root->modulus - contact.bending) < kSame * std::abs(contact.bending))
        root = std::nullopt;
      if (!root) root = law.solve(at, contact.slip, blades_.speed(time_), -side);
      if (!root) return false;
      contact.bending = root->modulus;
      contact.amplitude = root->amplitude;
      return true;
    }
    return false;
  }
  /// Whether what comes next there is no load at all: the ring opens, and the undeformed tip is outside it.
  [[nodiscard]] bool is_free([[maybe_unused]] const modes::OpenContact& contact) const {
    if constexpr (Law::kHasBending) {
      const contact::Pose at = pose(contact.blade);
      return at.gap <= 0.0 &&
             !law_.of(contact.blade).closes_in(at, contact.slip, contact.bending, blades_.speed(time_));
    }
    return false;
  }

  /// Whether the last reversals of a tip follow each other so fast that they have no end.
  [[nodiscard]] bool accumulates(modes::OpenContact& contact) const {
    const double cycle = time_ - contact.reversed_before;
    contact.reversed_before = std::exchange(contact.reversed, time_);
    return cycle < kShortestCycle;
  }
  /// Whether the model says what follows where slip reversals of a tip accumulate. For some elastic blades it
  /// does not. The slip velocity of a rigid tip does not jump at a reversal, so that none accumulate.
  [[nodiscard]] bool has_law_of_rest() const {
    if constexpr (Phases::kRests) return resting_.has_value();
    return !(Law::kHasBending || Phases::kBends);
  }
  /// A contact as the law of tips at rest knows it: found anew where that has another parameter.
  [[nodiscard]] static modes::OpenContact of_resting_law(modes::OpenContact contact) {
    if (Law::kHasBending && contact.slip != 0.0) contact.bending = contact.amplitude = 0.0;
    return contact;
  }
  [[nodiscard]] std::vector<modes::OpenContact> of_resting_law() const {
    std::vector<modes::OpenContact> contacts;
    for (const modes::OpenContact& open : contacts_) contacts.push_back(of_resting_law(open));
    return contacts;
  }
  /// The limit of slip reversals that accumulate: the tip comes to rest where friction can hold it, and
  /// slips on, reversed, where not yet.
  [[nodiscard]] bool comes_to_rest(modes::OpenContact& contact) {
    if constexpr (Phases::kRests) {
      if (!resting_) return false;
      modes::OpenContact there = of_resting_law(contact);
      if (!resting_judge_->come_to_rest(there, unbent())) return false;
      contact = there;
      return true;
    }
    return false;
  }
  /// A tip at rest is no longer held, and slips the way it is pulled. False where it has no force then.
  [[nodiscard]] bool leave_rest(modes::OpenContact& contact) {
    if constexpr (Phases::kRests) {
      std::vector<modes::OpenContact> contacts = of_resting_law();
      const auto place = static_cast<std::size_t>(&contact - contacts_.data());
      resting_judge_->let_go(contacts, place, unbent());
      const modes::OpenContact freed{contact.blade, contacts[place].slip, contact.bending, contact.amplitude};
      contact = freed;
    }
    return bend_anew(contact);
  }
  /// Finds the bending of a contact whose slip direction has changed. False where it has no force.
  [[nodiscard]] bool bend_anew(modes::OpenContact& contact) const {
    if constexpr (Law::kHasBending) {
      const auto root = law_.of(contact.blade).solve(pose(contact.blade), contact.slip);
      contact.bending = root.value_or(0.0);
      return root.has_value();
    }
    return true;
  }

  point::PointStatus change_contacts(const modes::PhaseEnd& end, modes::MotionListener& listener) {
    phase_ = Phase::undecided;
    const auto contact =
        std::find_if(contacts_.begin(), contacts_.end(),
                     [&](const modes::OpenContact& open) { return open.blade == end.blade; });
    switch (end.event) {
      case modes::PhaseEvent::lift_off:
        if (straightens(*contact)) return point::PointStatus::done;
        ++work_.liftoffs;
        tell(listener, end.event, end.blade, contact->slip);
        contacts_.erase(contact);
        tell_of_others(end.blade, listener);
        return point::PointStatus::done;
      case modes::PhaseEvent::snap:
        if (snap(*contact)) {
          tell(listener, end.event, end.blade, contact->slip);
          return point::PointStatus::done;
        }
        if (!is_free(*contact)) return ends(point::StatusDetail::no_equilibrium);
        ++work_.liftoffs;
        tell(listener, modes::PhaseEvent::lift_off, end.blade, contact->slip);
        contacts_.erase(contact);
        return point::PointStatus::done;
      case modes::PhaseEvent::nears_fold:
        std::iter_swap(contacts_.begin(), contact);
        near_fold_ = true;
        return point::PointStatus::done;
      case modes::PhaseEvent::touch_down:
        ++work_.touchdowns;
        if (!open(end.blade, pose(end.blade))) return ends(point::StatusDetail::no_equilibrium);
        touched_down_ = true;
        tell_of_others(end.blade, listener);
        tell(listener, end.event, end.blade, contacts_.back().slip);
        return point::PointStatus::done;
      case modes::PhaseEvent::pressed_in:
        return point::PointStatus::done;
      default: {
        if constexpr (contact::Sticks<Law>) {
          const bool decided = change_slip(*contact, end.event, listener);
          return ends(decided ? point::StatusDetail::none : point::StatusDetail::slip_undecided);
        }
        if (end.event == modes::PhaseEvent::comes_loose) {
          if (!leave_rest(*contact)) return ends(point::StatusDetail::no_equilibrium);
          tell(listener, end.event, end.blade, contact->slip);
          return point::PointStatus::done;
        }
        ++work_.slip_reversals;
        if (accumulates(*contact)) {
          if (!has_law_of_rest()) return ends(point::StatusDetail::slip_undecided);
          if (comes_to_rest(*contact)) {
            ++work_.slip_accumulations;
            tell(listener, end.event, end.blade, contact->slip);
            return point::PointStatus::done;
          }
        }
        contact->slip = -contact->slip;
        if (!bend_anew(*contact)) {
          // A tip that was held beyond the ring is free where friction turns to the other side.
          if (Law::kReleasesAtFold && pose(contact->blade).gap < 0.0) {
            tell(listener, end.event, end.blade, contact->slip);
            ++work_.liftoffs;
            tell(listener, modes::PhaseEvent::lift_off, end.blade, contact->slip);
            contacts_.erase(contact);
            return point::PointStatus::done;
          }
          return ends(point::StatusDetail::no_equilibrium);
        }
        tell(listener, end.event, end.blade, contact->slip);
        return point::PointStatus::done;
      }
    }
  }

  /// Tolerances: hops lower than that are taken in their limit. They may grow by some tens while the force
  /// changes along the ring.
  static constexpr double kUnresolvedHop = 1.0;
  static constexpr double kGapRounding = 1e-17;  ///< [m²]: g where a touch-down has been located

  /// τ: a tip that reverses its slip and reverses it again within this time does so without end. Each cycle
  /// of what accumulates is a fixed share of the last, and no other one is a millionth of this long.
  static constexpr double kShortestCycle = 1e-9;

  rotor::RotorConstants rotor_;
  rotor::FreeMotion free_;
  Forcing forcing_;
  Law law_;
  modes::ContactLimits limits_;
  Blades blades_;
  modes::Flight<Forcing> flight_;
  modes::TouchdownSearch<Law, Blades> search_;
  typename Phases::Solved solved_;
  std::optional<typename Phases::Carried> carried_;
  std::optional<typename Phases::Skimming> skimming_;
  std::optional<typename Phases::Sticking> sticking_;
  std::optional<typename Phases::Judge> judge_;
  std::optional<typename Phases::RingPlacer> ring_placer_;
  std::optional<std::conditional_t<Phases::kRests, typename Phases::RestingLaw, std::monostate>> resting_law_;
  std::optional<typename Phases::RestingSystem> resting_judge_;
  std::optional<typename Phases::Resting> resting_;
  std::vector<modes::OpenContact> contacts_;
  Bodies state_ = Bodies::Zero();
  double time_ = 0.0;
  modes::WorkMeter meter_;
  std::uint64_t paid_evaluations_ = 0;  ///< of curves, whose price the meter knows
  point::StatusDetail detail_ = point::StatusDetail::none;
  point::StatusDetail refusal_ = point::StatusDetail::none;  ///< why the last phase could not begin
  WorkCounts work_;
  Phase phase_ = Phase::undecided;
  bool near_fold_ = false;      ///< the first contact is about to come to the end of its branch
  bool touched_down_ = false;   ///< the present contacts began with a touch-down
  bool never_touches_ = false;  ///< proven at the start of the point
};

}  // namespace rubatlas::motion
