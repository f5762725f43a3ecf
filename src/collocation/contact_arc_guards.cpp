// What ends an interval: the guards of the blades in contact, touch-downs of others, and the proof that no
// other guard is met before.

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "collocation/contact_arc.hpp"
#include "collocation/interval_samples.hpp"
#include "contact/sticking.hpp"

namespace rubatlas::collocation {
namespace {

/// Slope by θ of the polynomial through values at the places, just before θ.
double slope_before(const AtPlaces& values, double fraction) {
  constexpr double kApart = 1e-4;
  const double rise =
      sum_of_products(basis_at(fraction), values) - sum_of_products(basis_at(fraction - kApart), values);
  return rise / kApart;
}

}  // namespace

/// No slip reverses but the one that ends the interval, no blade snaps, the shaft stays within the ring and
/// the blades within their limit.
bool ContactArc::stays_valid(const Bounds& bounds, const Ending& ending) const {
  const auto keeps_slip = [&](int blade, double slip, double start, double least) {
    if (!reverses(slip)) return true;
    const bool reverses_here = ending.guard == Guard::slip_reversal && ending.blade == blade;
    const bool slips_on = reverses_here ? least >= -rounding_at_end_ : least > 0.0;
    return slips_on && (slip * start > 0.0 || law_->may_slip_back());
  };
  if (!(bounds.distance < machine().ring_radius)) return false;
  if (!(bounds.argument < law_->valid_argument(blade_))) return false;
  if (!keeps_slip(blade_, contact_.slip, at_end_.force.slip_velocity, bounds.slip_velocity[0])) return false;
  for (std::size_t k = 0; k < further_.size(); ++k) {
    const FurtherStart& further = further_[k];
    if (!(bounds.further_argument[k] < law_->valid_argument(further.blade)) ||
        !keeps_slip(further.blade, further.slip, further.tip.start_slip_velocity,
                    bounds.slip_velocity[1 + k]))
      return false;
  }
  if (!(bounds.cone_left > 0.0)) return false;
  return !contact_.leans || (bounds.time_slope > 0.0 && bounds.chart_left > 0.0);
}

/// The first guard of the blades in contact.
ContactArc::Ending ContactArc::guard_of_contacts(const Interval& interval) const {
  Ending first;
  std::size_t place_of_first = kPlaces;
  // A quantity that keeps its sign while the contact lasts, at the first `count` nodes.
  const auto look = [&](Guard guard, int blade, double start, const AtNodes& nodes, double sign,
                        std::size_t count = kNodes) {
    std::size_t node = 0;
    while (node < count && !(sign * nodes[node] < 0.0)) ++node;
    if (node == count || node + 1 > place_of_first) return;
    AtPlaces values = at_places(start, nodes);
    for (double& value : values) value *= sign;
    const double fraction = crossing(values, node + 1);
    if (node + 1 < place_of_first || fraction < first.fraction) {
      first = {guard, fraction, blade, slope_before(values, fraction)};
      place_of_first = node + 1;
    }
  };
  const bool releases_at_fold = law_->releases_at_fold(blade_);
  if (!releases_at_fold)
    look(Guard::under_load, blade_, interval.start_gap_measure, interval.gap_measure, 1.0);
  // Over p itself the last node is the unbent blade.
  const std::size_t count = interval.chord.time == 0.0 ? kNodes - 1 : kNodes;
  look(Guard::unbent, blade_, interval.start_argument, interval.argument, 1.0, count);
  if (releases_at_fold || law_->has_branches(blade_))
    look(Guard::fold, blade_, sum_of_products(node_tables().value_at_start, interval.time_slope),
         interval.time_slope, 1.0, count);
  if (contact_.leans) look(Guard::chart_end, blade_, interval.start_chart_left, interval.chart_left, 1.0);
  const auto look_at_slip = [&](int blade, double slip, const TipInTime& tip) {
    if (slip == 0.0) look(Guard::loosening, blade, tip.start_cone_left, tip.cone_left, 1.0);
    if (!reverses(slip)) return;
    const double sign = std::copysign(1.0, tip.start_slip_velocity);
    look(Guard::slip_reversal, blade, tip.start_slip_velocity, tip.slip_velocity, sign);
  };
  look_at_slip(blade_, contact_.slip, interval);
  for (std::size_t k = 0; k < further_.size(); ++k)
    look_at_slip(further_[k].blade, further_[k].slip, interval.further[k]);
  return first;
}

/// The first touch-down of another blade, if it comes before this ending. None where it cannot be told.
std::optional<ContactArc::Ending> ContactArc::touch_down(const Interval& interval, Ending before) {
  gap_bound_of_others_ = -std::numeric_limits<double>::infinity();
  for (const Other& other : others_) {
    const Blade& blade = numbers(other.blade);
    const double bound = solver_.largest_gap(contact_, interval, blade, other.offset);
    gap_bound_of_others_ = std::max(gap_bound_of_others_, bound);
    if (bound < 0.0) continue;
    const auto clear_of_ring = [&](double x, double y, double er_x, double er_y) {
      const double centre = y + machine().misalignment;
      const double along = er_x * other.offset[0] - er_y * other.offset[1];
      const double across = er_y * other.offset[0] + er_x * other.offset[1];
      return -(x * x + centre * centre + 2.0 * blade.reach * (x * along + centre * across) + blade.closing);
    };
    const Body& shaft = interval.shaft;
    const Body& ring = interval.ring;
    AtPlaces values;
    values[0] = clear_of_ring(shaft.start[0] - ring.start[0], shaft.start[1] - ring.start[1],
                              interval.blade[0], interval.blade[1]);
    std::size_t place = kPlaces;
    for (std::size_t i = 0; i < kNodes; ++i) {
      values[i + 1] = clear_of_ring(shaft.x[i] - ring.x[i], shaft.y[i] - ring.y[i], interval.blade_x[i],
                                    interval.blade_y[i]);
      if (place == kPlaces && values[i + 1] < 0.0) place = i + 1;
    }
    // It may come near the ring without touching it, or it touches at the start: shorter intervals tell.
    if (place == kPlaces || (place == 1 && !(values[0] > 0.0))) return std::nullopt;
    const double fraction = crossing(values, place);
    if (fraction < before.fraction)
      before = {Guard::touch_down, fraction, other.blade, slope_before(values, fraction)};
  }
  return before;
}

/// What is left of the guard's quantity at the end of an interval that it ends.
double ContactArc::left_at_end(const Ending& ending, const Interval& interval) const {
  const TipInTime& tip = ending.guard == Guard::touch_down || ending.blade == blade_
                             ? static_cast<const TipInTime&>(interval)
                             : interval.further[number_of(ending.blade)];
  switch (ending.guard) {
    case Guard::touch_down:
      return -pose(ending.blade, end_of(interval)).gap;
    case Guard::under_load:
      return interval.gap_measure.at_end();
    case Guard::unbent:
      return interval.argument.at_end();
    case Guard::fold:
      return interval.time_slope.at_end();
    case Guard::chart_end:
      return interval.chart_left.at_end();
    case Guard::loosening:
      return tip.cone_left.at_end();
    default:
      return std::copysign(1.0, tip.start_slip_velocity) * tip.slip_velocity.at_end();
  }
}

/// The same up to a guard, which the polynomials have only as accurately as velocities between the nodes.
bool ContactArc::cut_at(const Interval& whole, Ending& ending, Interval& shorter) {
  constexpr int kTimes = 4;
  constexpr double kClosestFraction = 1e-11;
  // At a fold time stands still, and where no force is left nothing is missed in a moment.
  const bool once = ending.guard == Guard::fold || (ending.guard == Guard::unbent && further_.empty());
  // Whether a tip comes to rest depends on v to rounding, the more so where friction hardly moves the tip.
  constexpr double kToRounding = 1e-3;  // of what v may be, and of the fraction
  const bool may_rest = contact_.leans && ending.guard == Guard::slip_reversal;
  const double closest = may_rest ? kToRounding * slip_rounding() : std::numeric_limits<double>::infinity();
  const double closest_fraction = may_rest ? kToRounding * kClosestFraction : kClosestFraction;
  for (int i = 0; i < (may_rest ? 2 * kTimes : kTimes); ++i) {
    if (!cut(whole, ending.fraction, shorter, closest)) return false;
    if (once) break;
    const double left = left_at_end(ending, shorter);
    rounding_at_end_ = 2.0 * std::abs(left);
    const double less = left / ending.slope;
    if (!(std::abs(less) > closest_fraction) || ending.fraction - less > 1.0) break;
    ending.fraction -= less;
    if (!(ending.fraction > 0.0)) return false;
  }
  return true;
}

/// Whether a fold is the lift-off of an unbent blade: time stands still there, too, so that rounding, or an
/// error between the nodes where there can be no fold, is taken for one.
bool ContactArc::is_next_to_unbent(const Interval& interval) const {
  constexpr double kNext = 1e-4;  // p: the force is some 1e-9 of EI/L²
  constexpr double kNear = 0.03;
  if (contact_.leans && !(interval.lean.at_end() > 0.0)) return false;  // it is bent against its load
  const double argument = interval.argument.at_end();
  return argument < kNext ||
         (argument < kNear && law_->starts_unloaded(blade_, contact_.slip, pose(blade_, end_of(interval))));
}

/// The blades of tips at rest are no straight struts between hub and ring.
bool ContactArc::are_bent_firmly(const Interval& interval) const {
  constexpr double kLeastModulus = 1e-3;  // κ
  const auto is_bent = [&](int blade, double slip, const TipInTime& tip) {
    if (slip != 0.0) return true;
    for (std::size_t i = 0; i < kNodes; ++i) {
      if (std::abs(tip.lean[i]) > kLeastModulus) continue;  // l is a part of κ
      if (!(std::abs(touch_of(blade, at_node(interval, i)).bend.modulus) > kLeastModulus)) return false;
    }
    return true;
  };
  bool all = is_bent(blade_, contact_.slip, interval);
  for (std::size_t k = 0; k < further_.size(); ++k)
    all = all && is_bent(further_[k].blade, further_[k].slip, interval.further[k]);
  return all;
}

ContactArc::Verdict ContactArc::judge(Ending& ending) {
  const Interval& next = trial();
  const bool reaches_zero = next.chord.time == 0.0;
  Bounds bounds = law_->bounds(contact_, next);
  const auto first = touch_down(next, guard_of_contacts(next));
  if (!first) return Verdict::too_long;
  ending = *first;
  const bool in_part = ending.guard != Guard::none;
  Interval& part = intervals_[made_];  // what has been made before is not asked for again
  if (in_part) {
    if (!cut_at(next, ending, part)) return Verdict::gives_up;
    // Beyond its ending the interval is no motion.
    const bool lifts = ending.guard == Guard::unbent || ending.guard == Guard::under_load;
    if (!lifts || !further_.empty() || !stays_valid(bounds, ending)) bounds = law_->bounds(contact_, part);
    // The tip that touches is at the ring at the end.
    const double at_ring = 2.0 * machine().ring_radius * tolerance_;
    gap_bound_of_others_ = -std::numeric_limits<double>::infinity();
    for (const Other& other : others_) {
      const double bound = solver_.largest_gap(contact_, part, numbers(other.blade), other.offset);
      gap_bound_of_others_ = std::max(gap_bound_of_others_, bound);
      if (!(bound < (other.blade == ending.blade ? at_ring : 0.0))) return Verdict::too_long;
    }
  }
  // Close to a fold bounds of shorter intervals tell.
  if (!stays_valid(bounds, ending))
    return contact_.leans || contact_.slip == 0.0 ? Verdict::too_long : Verdict::gives_up;
  displacement_bound_ = bounds.displacement;
  const bool held_beyond_ring = law_->releases_at_fold(blade_);
  const bool stays_bent = bounds.gap_measure > 0.0 && (begins_ || next.start_gap_measure > 0.0);
  if (ending.guard != Guard::under_load && !held_beyond_ring && !stays_bent) return Verdict::gives_up;
  const Interval& kept = in_part ? part : next;
  if (ending.guard == Guard::fold && is_next_to_unbent(kept)) ending.guard = Guard::unbent;
  if (contact_.slip == 0.0 && contact_.leans) {
    // At a fold the place of a tip at rest is lost. One whose blade unbends is for steps to follow.
    if (ending.guard == Guard::fold) ending.guard = Guard::loosening;
    if (ending.guard == Guard::unbent || ending.guard == Guard::chart_end) return Verdict::gives_up;
  }
  if (contact_.leans && !are_bent_firmly(kept)) return Verdict::gives_up;
  // At a fold a tip is free only outside the ring, or it snaps.
  if (ending.guard == Guard::fold && !law_->has_branches(blade_) && !(pose(blade_, end_of(kept)).gap < 0.0))
    return Verdict::gives_up;
  // Time goes on.
  for (std::size_t i = 0; i < kNodes; ++i) {
    const bool may_turn = i + 1 == kNodes && (reaches_zero || in_part);
    if (!(kept.time_slope[i] > 0.0) && !may_turn) return Verdict::gives_up;
  }
  for (std::size_t k = 0; k < further_.size(); ++k) {
    if (bounds.stays[k]) continue;
    if (lead_has_changed_) return Verdict::too_long;
    change_leader(k);
    return Verdict::another_leads;
  }
  return in_part ? Verdict::holds_in_part : Verdict::holds;
}

/// Takes from the shaft's velocity what is left of a rigid tip's v at the end, the shortest way: v does not
/// jump where s changes, and its sign would be taken for that of what follows; v of a tip at rest does not
/// drift.
void ContactArc::bring_to_rest(int blade) {
  const contact::BladeDirection er = blades_->direction(blade, blades_->first(end_.time));
  const contact::Pose there = pose(blade, end_);
  const contact::Geometry geometry = law_->geometry(blade);
  const double v = contact::undeformed_slip_velocity(geometry, there, blades_->angular_speed(end_.time));
  const std::complex<double> less =
      v * contact::tangent(geometry, there) * std::complex<double>(er.cosine, er.sine);
  end_.bodies[2] -= less.real();
  end_.bodies[3] -= less.imag();
}

/// The end of an interval: of the contact, or at a touch-down, to rounding, where one ends it.
void ContactArc::end_at(const Interval& interval, const Ending& ending) {
  start_ = end_;
  end_ = end_of(interval);
  er_ = {interval.blade_x.at_end(), interval.blade_y.at_end()};
  ending_ = ending;
  if (ending.guard == Guard::none && interval.chord.time == 0.0) ending_ = {Guard::unbent, 1.0, blade_, 0.0};
  const auto place_ring = [this] {
    if (machine().ring.is_massless()) law_->place_ring(end_.time, touching_at_end(), end_.bodies);
  };
  // To where the gap of a blade is zero: in time, and what is left, or all where the tip hardly moves against
  // the ring, the shortest way for the shaft.
  const auto goes_on_to_ring = [&](int blade) {
    constexpr int kTimes = 2;
    constexpr double kFarthest = 0.1;  // of the interval
    for (int i = 0; i < kTimes; ++i) {
      const contact::Pose there = pose(blade, end_);
      const double late =
          -there.gap / contact::gap_rate(law_->geometry(blade), there, blades_->angular_speed(end_.time));
      if (std::abs(late) < kFarthest * interval.elapsed.at_end()) move(end_, interval, late);
      place_ring();
    }
    const double radius = machine().ring_radius;
    const double left = pose(blade, end_).gap / (2.0 * radius);
    if (!(std::abs(left) < tolerance_)) return;
    const contact::BladeDirection er = blades_->direction(blade, blades_->first(end_.time));
    const rotor::State seen = rotor::from_ring(end_.bodies);
    const double reach = numbers(blade).reach;
    end_.bodies[0] -= left * (seen[0] + reach * er.cosine) / radius;
    end_.bodies[1] -= left * (seen[1] + rotor_->misalignment + reach * er.sine) / radius;
    place_ring();
  };
  switch (ending_.guard) {
    case Guard::unbent:
      move(end_, interval,
           -end_.bending.argument * interval.time_slope.at_end() / interval.argument_slope.at_end());
      end_.bending.argument = 0.0;
      goes_on_to_ring(blade_);
      break;
    case Guard::under_load:
      if (law_->ends_at_ring()) goes_on_to_ring(ending_.blade);
      break;
    case Guard::touch_down:
      goes_on_to_ring(ending_.blade);
      break;
    case Guard::slip_reversal:
      if (law_->is_rigid() && !machine().ring.is_massless()) bring_to_rest(ending_.blade);
      break;
    default:
      break;
  }
  if (rests_rigidly()) bring_to_rest(blade_);
}

}  // namespace rubatlas::collocation
