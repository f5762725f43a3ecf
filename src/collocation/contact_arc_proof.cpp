// The proof that an interval holds: that no guard is met in it but the one that ends it.

#include <algorithm>
#include <cmath>
#include <limits>

#include "collocation/contact_arc.hpp"
#include "collocation/interval_samples.hpp"

namespace rubatlas::collocation {

/// No slip reverses but the one that ends the interval, no blade snaps, the shaft stays within the ring and
/// the blades within their limit.
bool ContactArc::stays_valid(const Ending& ending) const {
  const auto keeps_slip = [&](const TipStart& tip, double least) {
    if (!reverses(tip.slip)) return true;
    const bool reverses_here = ending.guard == Guard::slip_reversal && ending.blade == tip.number;
    // Where v has been located as zero it has any sign. From zero a tip slips on by the square of the time,
    // at first less than the rounding of v.
    const double rounding = reverses_here ? std::max(rounding_at_end_, slip_rounding())
                            : slips_from_zero(tip.at_start.slip_velocity) ? slip_rounding()
                                                                          : 0.0;
    const bool slips_on = rounding > 0.0 ? least >= -rounding : least > 0.0;
    return slips_on && (tip.slip * tip.at_start.slip_velocity > 0.0 || law_->may_slip_back());
  };
  if (!(bounds_.distance < machine().ring_radius) && ending.guard != Guard::shaft_at_ring) return false;
  for (std::size_t k = 0; k < tips_.size(); ++k) {
    const int blade = tips_[k].number;
    const bool limit_ends_it = ending.guard == Guard::shortening_limit && ending.blade == blade;
    const bool stays_short = limit_ends_it || bounds_.tips[k].shortening < tips_[k].blade->valid_shortening;
    if (!stays_short || !keeps_slip(tips_[k], bounds_.tips[k].slip_velocity)) return false;
  }
  if (!(bounds_.cone_left > 0.0)) return false;
  return !law_->leans() || (bounds_.time_slope > 0.0 && bounds_.chart_left > 0.0);
}

/// Whether another tip does not touch within an interval, or only where it ends: its gap [m²] stays below
/// zero, or, where it starts inside the ring, half of the rate of that.
bool ContactArc::stays_off(int blade, const Interval& interval, bool touches_at_end) const {
  const double at_end = touches_at_end ? 2.0 * machine().ring_radius * tolerance_ : 0.0;
  if (starts_inside(blade)) return solver_.upper_bound(course_of_tip(interval, blade).rate) < at_end;
  const double bound = gap_bound(blade, interval);
  // A tip that has just lifted off may stand at the ring for a while.
  if (bound < whole_->constants.gap_rounding(law_->geometry(blade))) return true;
  if (touches_at_end) return bound < at_end;
  // Between the nodes places err, and a tip may come closer by that; not where it starts.
  const double error =
      2.0 * machine().ring_radius * error_between_nodes(interval) * interval.elapsed.at_end();
  return bound < (pose(blade, end_).gap < -error ? -error : 0.0);
}

/// Whether a fold is the lift-off of an unbent blade: time stands still there, too, so that rounding, or an
/// error between the nodes where there can be no fold, is taken for one.
bool ContactArc::is_next_to_unbent(const Interval& interval) const {
  constexpr double kNear = 0.03;
  if (law_->leans() && !(interval.leader().lean.at_end() > 0.0)) return false;  // it is bent against its load
  const double argument = interval.argument.at_end();
  // A column that may stand straight bends from above the ring, where a fold may be one; a blade whose p
  // grows does not unbend.
  return argument < kNextToUnbent ||
         (argument < kNear && interval.argument_slope.at_end() < 0.0 && !law_->may_stand_straight(leader()) &&
          law_->starts_unloaded(leader(), leading().slip, pose(leader(), end_of(interval))));
}

/// Whether an interval is to be made: what ends it, and that nothing does before.
ContactArc::Verdict ContactArc::judge(Ending& ending) {
  const Interval& next = trial();
  const bool reaches_zero = next.chord.time == 0.0;
  solver_.bounds(machine(), next, bounds_);
  const auto first = touch_down(next, guard_of_contacts(next));
  if (!first) {
    // A tip that came off its place at the ring by less than rounding, and comes back.
    const int blade = begins_ ? kNoBlade : touches_at_once();
    ending = {Guard::touch_down, 0.0, blade};
    return blade == kNoBlade ? Verdict::too_long : Verdict::at_once;
  }
  ending = *first;
  const bool in_part = ending.guard != Guard::none;
  Interval& part = intervals_[made_];  // what has been made before is not asked for again
  if (in_part) {
    // It has been snapped to, or has set in, at the fold of its branch.
    constexpr double kAtStart = 1e-11;  // θ
    if (begins_ && seeks_fold_ && ending.guard == Guard::fold && ending.fraction < kAtStart) {
      ending.guard = guard_of_tip(ending.guard);
      return Verdict::at_once;
    }
    if (!cut_at(next, ending, part)) return Verdict::too_long;
    // The load that would bend a blade has a kink where its tip passes the deepest place: beyond it the
    // polynomial tells nothing of where it was pressed in, but that it is within times' rounding.
    constexpr double kPressedIn = 1e-8;  // of F
    if (ending.guard == Guard::pressed_in && is_straight(ending.blade) &&
        std::abs(left_at_end(ending, part)) > kPressedIn * tip_of(part, ending.blade).normal_force.at_end())
      return next.elapsed.at_end() > kImpact ? Verdict::too_long : Verdict::at_once;
    // Beyond its ending the interval is no motion.
    const bool lifts = ending.guard == Guard::unbent || ending.guard == Guard::under_load;
    if (!lifts || tips_.size() > 1 || !stays_valid(ending)) solver_.bounds(machine(), part, bounds_);
    for (const int blade : others_) {
      if (!stays_off(blade, part, blade == ending.blade)) return Verdict::too_long;
    }
  }
  // Another is close to its fold, where it may have been solved for on the wrong side.
  const auto leads_next = std::ranges::find(bounds_.tips, false, &Bounds::OfTip::stays);
  const bool may_change = leads_next != bounds_.tips.end() && lead_changes_ < kMostLeadChanges;
  const auto change_leader = [&] {
    begin_anew(static_cast<std::size_t>(leads_next - bounds_.tips.begin()));
    ++lead_changes_;
    return Verdict::another_leads;
  };
  // Bounds of shorter intervals tell.
  if (!stays_valid(ending)) return begins_ && may_change ? change_leader() : Verdict::too_long;
  // A blade that has just bent on a ring with dampers moves away from where it stood straight by the square
  // of the time, at first by less than sweeps leave.
  const bool stays_bent = begins_ ? bounds_.gap_measure > -kClosest * tolerance_
                                  : bounds_.gap_measure > 0.0 && leading().start_gap_measure > 0.0;
  if (ending.guard != Guard::under_load && !is_held_beyond_ring() && !stays_bent) return Verdict::too_long;
  const Interval& kept = in_part ? part : next;
  if (ending.guard == Guard::fold) {
    // h is even in p: a node may have found −p, and the polynomial turns round on its way to it.
    const bool has_jumped = *std::ranges::min_element(next.argument.value) < 0.0;
    if (is_next_to_unbent(kept)) {
      ending.guard = Guard::unbent;
    } else if (has_jumped) {
      return Verdict::too_long;
    }
  }
  ending.guard = guard_of_tip(ending.guard);
  // Time goes on, but for rounding next to the unbent blade.
  const bool is_all_but_unbent =
      reaches_zero && next.chord.argument < 0.0 && next.start_argument < kNextToUnbent;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const bool may_turn = is_all_but_unbent || (i + 1 == kNodes && (reaches_zero || in_part));
    if (!(kept.time_slope[i] > 0.0) && !may_turn) return Verdict::too_long;
  }
  // To the one that is close to its fold, and back to one that is closer.
  if (may_change) return change_leader();
  if (leads_next != bounds_.tips.end()) return Verdict::too_long;
  return in_part ? Verdict::holds_in_part : Verdict::holds;
}

}  // namespace rubatlas::collocation
