#include "motion/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rubatlas::motion {

namespace {

/// τ: the slip reversals of a tip accumulate where the tip reverses its slip and reverses it again within
/// this time. Each cycle of an accumulating sequence is a fixed share of the one before. Among 4800 reversals
/// of randomly kicked rotors all cycles this short belonged to such sequences.
constexpr double kShortestCycle = 1e-9;

}  // namespace

Motion::Motion(rotor::Machine machine, std::unique_ptr<modes::Law> law, const modes::ContactLimits& limits,
               modes::MakePhases* make_phases)
    : machine_(std::move(machine)),
      modes_(machine_, std::move(law), limits, meter_, make_phases),
      flight_(machine_),
      search_(flight_, geometries(), meter_, !modes_.law().ends_at_ring()),
      reversals_(static_cast<std::size_t>(machine_.blades.count())) {
  contacts_.reserve(static_cast<std::size_t>(machine_.blades.count()));
}

ending::StatusDetail Motion::start(const PointStart& start) {
  state_ = rotor::shaft_and_ring(rotor::as_state(start.state));
  // Without a memory the ring starts at its place of rest, without velocity.
  const std::span<const double> ring = start.memory.view();
  if (machine_.ring_moves() && !ring.empty()) state_.tail<4>() = rotor::State(ring.data());
  time_ = start.time;
  ended_by_ = start.blade >= 0 ? modes::Guard::touch_down : modes::Guard::horizon;
  phase_ = nullptr;
  // Who looks for an orbit may ask for a place that is none.
  if (!state_.allFinite()) return ending::StatusDetail::beyond_precision;
  if (!find_contacts({}, start.blade)) return ending::StatusDetail::no_equilibrium;
  if (!place_ring()) return ending::StatusDetail::ring_unbalanced;
  if (!flight_.resolves(machine_.constants.period())) return ending::StatusDetail::beyond_precision;
  modes::RestJudge* judge = modes_.rest_judge();
  if (judge != nullptr && !judge->settle(unbent(), contacts_)) return ending::StatusDetail::slip_undecided;
  return state_.isFinite().all() ? ending::StatusDetail::none : ending::StatusDetail::beyond_precision;
}

ending::StatusDetail Motion::take_over(PointMotion& before) {
  auto& other = dynamic_cast<Motion&>(before);
  state_ = other.state_;
  meter_ = other.meter_;
  work_ = other.work();
  reversals_ = other.reversals_;
  std::vector<modes::OpenContact> held = other.contacts_;
  if (other.modes_.under_law_of_rest(held))
    std::ranges::for_each(held, modes::ContactModes::leave_law_of_rest);
  constexpr int kNone = -1;
  return find_contacts(held, kNone, true) ? ending::StatusDetail::none : ending::StatusDetail::no_equilibrium;
}

ending::StatusDetail Motion::revolution(modes::MotionListener& listener, const modes::GoOn& go_on,
                                        int /*number*/) {
  const double period = machine_.constants.period();
  meter_.begin_revolution(go_on);
  while (meter_.spend(modes::Work::events, modes::WorkPrice::kEvent)) {
    if (ended_by_) {
      if (const auto why = begin_mode(); why != ending::StatusDetail::none) return why;
    }
    const modes::ModeEnd end = phase_ == nullptr ? fly(period, listener) : touch(period, listener);
    if (end.guard == modes::Guard::horizon) return finish_revolution(period);
    if (end.guard == modes::Guard::failed || end.guard == modes::Guard::left_validity) return end.why;
    const std::int64_t price_before = modes::price_of_searches(law());
    if (const auto why = reset(end, listener); why != ending::StatusDetail::none) return why;
    if (!place_ring()) return ending::StatusDetail::ring_unbalanced;
    meter_.spend(modes::Work::events, modes::price_of_searches(law()) - price_before);
  }
  return meter_.why();
}

Memory Motion::memory() const {
  if (!machine_.ring_moves()) return {};
  return Memory(rotor::as_array(rotor::ring(state_)));
}

WorkCounts Motion::work() const {
  WorkCounts result = work_;
  modes_.each_phase([&](const modes::Phase& phase) {
    result.right_hand_sides += phase.evaluations();
    result.steps += phase.steps();
    result.rejected_steps += phase.rejected();
  });
  result.elastica_evaluations += law().evaluations();
  result.price = meter_.total();
  result.gap_evaluations += search_.evaluations();
  return result;
}

std::vector<contact::Geometry> Motion::geometries() const {
  std::vector<contact::Geometry> result;
  result.reserve(static_cast<std::size_t>(machine_.blades.count()));
  for (int k = 0; k < machine_.blades.count(); ++k) result.push_back(law().geometry(k));
  return result;
}

// Modes.

modes::ModeEnd Motion::fly(double period, modes::MotionListener& listener) {
  using modes::Guard;
  flight_.start(time_, state_);
  const auto touchdown = search_.find(period);
  const double end = touchdown ? touchdown->time : period;
  const bool leaves = search_.shaft_at_ring(end);
  if (meter_.ended()) return {Guard::failed, -1, meter_.why()};
  if (leaves) return {Guard::left_validity, -1, ending::StatusDetail::shaft_at_ring};
  if (end > time_) {
    listener.piece(search_.piece(end));
    if (meter_.ended()) return {Guard::failed, -1, meter_.why()};
    state_ = flight_.state(end);
    time_ = end;
    if (!state_.isFinite().all()) return {Guard::failed, -1, ending::StatusDetail::beyond_precision};
  }
  if (!touchdown) return {Guard::horizon};
  return {Guard::touch_down, touchdown->blade};
}

modes::ModeEnd Motion::touch(double period, modes::MotionListener& listener) {
  const modes::ModeEnd end = phase_->advance(period, listener);
  if (end.guard == modes::Guard::failed) return end;
  phase_->hand_over(time_, state_, contacts_);
  if (end.guard == modes::Guard::horizon) {
    phase_->shift_time(period);
    return end;
  }
  if (modes_.under_law_of_rest(contacts_)) {
    // Tips that slip beside a tip at rest go on under their own law, which finds their bending anew. The
    // reset does this for the blade of the event.
    for (modes::OpenContact& open : contacts_) {
      if (open.slip != 0.0 && open.blade != end.blade && !law().bend_anew(place(open.blade), open))
        return {modes::Guard::left_validity, -1, ending::StatusDetail::no_equilibrium};
    }
  }
  if (!state_.isFinite().all()) return {modes::Guard::failed, -1, ending::StatusDetail::beyond_precision};
  return end;
}

ending::StatusDetail Motion::finish_revolution(double period) {
  ++work_.revolutions;
  time_ -= period;  // exactly 0
  for (Reversals& reversals : reversals_) reversals = {reversals.last - period, reversals.before - period};
  return state_.isFinite().all() ? ending::StatusDetail::none : ending::StatusDetail::beyond_precision;
}

/// From the contacts to the mode for them, or why none can begin.
ending::StatusDetail Motion::begin_mode() {
  const bool touches_down = std::exchange(ended_by_, std::nullopt) == modes::Guard::touch_down;
  phase_ = nullptr;
  if (contacts_.empty()) return ending::StatusDetail::none;
  if (touches_down && law().may_skim() && !modes::any_rests(contacts_) &&
      modes_.begins_to_skim(unbent(), contacts_))
    contacts_.front().skims = true;
  phase_ = &modes_.phase_of(contacts_);
  return phase_->start(time_, state_, contacts_);
}

// Contacts.

/// The contacts where the blades stand now. Those that were `held` go on; others open whose tips are in the
/// ring, or that of `touching`, which is at it. False where no force exists (MODEL 5). `goes_on`: a tip that
/// is not held and moves inwards inside a ring with dampers stays free there (MODEL 7.16).
bool Motion::find_contacts(const std::vector<modes::OpenContact>& held, int touching, bool goes_on) {
  contacts_.clear();
  for (int k = 0; k < machine_.blades.count(); ++k) {
    const modes::TipPlace at = place(k);
    const auto before = std::ranges::find(held, k, &modes::OpenContact::blade);
    const bool may_be_free = goes_on && !law().ends_at_ring();
    const bool touches =
        k == touching || (at.pose.gap > 0.0 &&
                          !(may_be_free && contact::gap_rate(law().geometry(k), at.pose, at.speed) < 0.0));
    if (before != held.end()) {
      modes::OpenContact contact = *before;
      const modes::Standing standing = law().keep(at, contact);
      if (standing == modes::Standing::lost) return false;
      if (standing == modes::Standing::stands) contacts_.push_back(contact);
      if (standing == modes::Standing::free) ++work_.liftoffs;
    } else if (touches && !open(k, at)) {
      return false;
    }
  }
  return true;
}

/// Opens the contact of a blade at the tip's place. False where no force exists (MODEL 5).
bool Motion::open(int blade, const modes::TipPlace& at) {
  const double velocity = contact::undeformed_slip_velocity(law().geometry(blade), at.pose, at.speed);
  modes::OpenContact contact{blade, velocity >= 0.0 ? 1.0 : -1.0, 0.0};
  if (modes_.rest_judge() != nullptr && std::abs(velocity) <= modes_.slip_rounding(state_))
    contact.slip = 0.0;
  if (!law().open(at, contact)) return false;
  contacts_.push_back(contact);
  reversals(blade) = {};
  return true;
}

bool Motion::place_ring() {
  if (machine_.following_ring() == nullptr) return true;
  return modes_.place_ring(state_, time_, contacts_, [this](int blade) { return open(blade, place(blade)); });
}

/// Frees the tips at rest that friction cannot hold after an event of one blade; the listener is told of the
/// others.
ending::StatusDetail Motion::settle_others(int blade, modes::MotionListener& listener) {
  modes::RestJudge* judge = modes_.rest_judge();
  if (judge == nullptr || !modes::any_rests(contacts_)) return ending::StatusDetail::none;
  const std::vector<modes::OpenContact> before = contacts_;
  if (!judge->settle(unbent(), contacts_)) return ending::StatusDetail::slip_undecided;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const modes::OpenContact& open = contacts_[i];
    if (before[i].slip == 0.0 && open.slip != 0.0 && open.blade != blade)
      tell(listener, modes::Guard::comes_loose, open.blade, open.slip);
  }
  return ending::StatusDetail::none;
}

/// How long the last two reversals of a tip and this one took [τ].
double Motion::reversal_cycle(int blade) {
  auto& [last, before] = reversals(blade);
  const double cycle = time_ - before;
  before = std::exchange(last, time_);
  return cycle;
}

// Resets.

void Motion::tell(modes::MotionListener& listener, modes::Guard guard, int blade, double slip) const {
  listener.event(modes::Event{guard, blade, time_, slip, rotor::shaft(state_)});
}

/// From the guard that has ended a mode to the contacts of the next mode.
ending::StatusDetail Motion::reset(const modes::ModeEnd& end, modes::MotionListener& listener) {
  using modes::Guard;
  ended_by_ = end.guard;
  for (modes::OpenContact& open : contacts_) open.skims = false;
  const auto contact = std::ranges::find(contacts_, end.blade, &modes::OpenContact::blade);
  switch (end.guard) {
    case Guard::touch_down:
      return touch_down(end.blade, listener);
    case Guard::lift_off:
      if (law().straightens(place(end.blade), *contact)) return ending::StatusDetail::none;
      return lift_off(contact, listener);
    case Guard::snap:
      return snap(contact, listener);
    case Guard::comes_loose:
      return come_loose(contact, listener);
    case Guard::slip_reversal:
      return reverse_slip(contact, listener);
    case Guard::pressed_in:  // a tip that has skimmed goes on under its full force, a straight blade bends
      contact->straight = false;
      [[fallthrough]];
    default:
      return ending::StatusDetail::none;
  }
}

ending::StatusDetail Motion::touch_down(int blade, modes::MotionListener& listener) {
  ++work_.touchdowns;
  // It is at the ring: what rounding leaves of the gap of a fast tip would bend a blade, or end its contact.
  modes::TipPlace at = place(blade);
  const bool off_ring = std::abs(at.pose.gap) > contact::gap_rounding(law().geometry(blade), at.pose);
  if (off_ring && law().ends_at_ring()) at.pose.gap = 0.0;
  if (!open(blade, at)) return ending::StatusDetail::no_equilibrium;
  const ending::StatusDetail settled = settle_others(blade, listener);
  tell(listener, modes::Guard::touch_down, blade, contacts_.back().slip);
  return settled;
}

ending::StatusDetail Motion::lift_off(Contact contact, modes::MotionListener& listener) {
  const int blade = contact->blade;
  ++work_.liftoffs;
  tell(listener, modes::Guard::lift_off, blade, contact->slip);
  contacts_.erase(contact);
  return settle_others(blade, listener);
}

/// A blade has come to the end of its branch.
ending::StatusDetail Motion::snap(Contact contact, modes::MotionListener& listener) {
  switch (law().snap(place(contact->blade), *contact)) {
    case modes::Standing::lost:
      return ending::StatusDetail::no_equilibrium;
    case modes::Standing::free:
      return lift_off(contact, listener);
    default:
      tell(listener, modes::Guard::snap, contact->blade, contact->slip);
      return ending::StatusDetail::none;
  }
}

/// A tip at rest is no longer held, and slips in the direction of the pull.
ending::StatusDetail Motion::come_loose(Contact contact, modes::MotionListener& listener) {
  if (!modes_.let_go(unbent(), contacts_, *contact)) return ending::StatusDetail::slip_undecided;
  if (contact->slip == 0.0) {  // it has been let go a little early, and rests on
    const bool has_moved = reversal_cycle(contact->blade) > 0.0;
    return has_moved ? ending::StatusDetail::none : ending::StatusDetail::slip_undecided;
  }
  const modes::TipPlace at = place(contact->blade);
  if (!law().bend_anew(at, *contact)) return ending::StatusDetail::no_equilibrium;
  modes_.set_out_from_rest(state_, at, time_, *contact);
  const ending::StatusDetail settled = settle_others(contact->blade, listener);
  tell(listener, modes::Guard::comes_loose, contact->blade, contact->slip);
  return settled;
}

/// The slip velocity of a tip has come to zero: it reverses its slip, or comes to rest where it can stick.
ending::StatusDetail Motion::reverse_slip(Contact contact, modes::MotionListener& listener) {
  ++work_.slip_reversals;
  ending::StatusDetail settled = ending::StatusDetail::none;
  const double cycle = reversal_cycle(contact->blade);
  if (modes::RestJudge* judge = modes_.rest_judge()) {
    // Nothing moves: it neither rests nor slips.
    if (!(cycle > 0.0) || !judge->arrest(unbent(), contacts_, *contact))
      return ending::StatusDetail::slip_undecided;
    settled = settle_others(contact->blade, listener);
  } else {
    const bool accumulated = cycle < kShortestCycle;  // MODEL 4.4
    if (accumulated && !law().knows_rest()) return ending::StatusDetail::slip_undecided;
    if (accumulated && modes_.comes_to_rest(unbent(), *contact)) {
      ++work_.slip_accumulations;
      reversals(contact->blade) = {};
    } else {
      contact->slip = -contact->slip;
      const modes::TipPlace at = place(contact->blade);
      if (!law().bend_anew(at, *contact)) {
        // A tip that was held beyond the ring is free where the reversed friction cannot hold it.
        if (!law().releases_at_fold(contact->blade) || at.pose.gap >= 0.0)
          return ending::StatusDetail::no_equilibrium;
        tell(listener, modes::Guard::slip_reversal, contact->blade, contact->slip);
        return lift_off(contact, listener);
      }
    }
  }
  tell(listener, modes::Guard::slip_reversal, contact->blade, contact->slip);
  return settled;
}

}  // namespace rubatlas::motion
