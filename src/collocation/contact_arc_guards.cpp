// What ends an interval: the guards of the blades in contact and touch-downs of others, where they are, and
// the state there.

#include <algorithm>
#include <cmath>
#include <limits>

#include "collocation/contact_arc.hpp"
#include "collocation/interval_samples.hpp"

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

/// The first guard of the blades in contact. One that the bounds exclude is not looked for.
ContactArc::Ending ContactArc::guard_of_contacts(const Interval& interval) const {
  const TipInTime& leads = interval.leader();
  Ending first;
  std::size_t place_of_first = kPlaces;
  // A quantity that is positive while the contact lasts, at the first `count` nodes.
  const auto look = [&](Guard guard, int blade, const AtPlaces& values, std::size_t count = kNodes) {
    std::size_t place = 1;
    while (place <= count && !(values[place] < 0.0)) ++place;
    if (place > count || place > place_of_first) return;
    const double fraction = crossing(values, place);
    if (place < place_of_first || fraction < first.fraction) {
      first = {guard, fraction, blade, slope_before(values, fraction)};
      place_of_first = place;
    }
  };
  const bool held_beyond_ring = is_held_beyond_ring();
  if (!held_beyond_ring && !(bounds_.gap_measure > 0.0))
    look(Guard::under_load, leads.number, at_places(leads.start_gap_measure, leads.gap_measure));
  // Over p itself the last node is the unbent blade.
  const std::size_t count = interval.chord.time == 0.0 ? kNodes - 1 : kNodes;
  look(Guard::unbent, leads.number, at_places(interval.start_argument, interval.argument), count);
  // Without other branches time stands still at the unbent blade, too, to rounding. On a ring with dampers it
  // all but does where a blade has just bent.
  const bool ends_only_branch =
      seeks_fold_ && law_->ends_at_ring() && !law_->is_rigid() && !is_next_to_unbent(interval);
  const bool may_fold = held_beyond_ring || (!is_straight(leads.number) &&
                                             (law_->has_branches(leads.number) || ends_only_branch));
  if (may_fold) {
    const double at_start = sum_of_products(kNodeTables.value_at_start, interval.time_slope);
    look(Guard::fold, leads.number, at_places(at_start, interval.time_slope), count);
  }
  if (law_->leans())
    look(Guard::chart_end, leads.number, at_places(leads.start_chart_left, leads.chart_left));
  const auto look_at_validity = [&](Guard guard, int blade) {
    look(guard, blade, validity_left(interval, guard, blade));
  };
  for (std::size_t k = 0; k < tips_.size(); ++k) {
    const TipInTime& tip = interval.tips[k];
    const Bounds::OfTip& bounds = bounds_.tips[k];
    if (tip.straight || tip.skims)
      look(Guard::pressed_in, tip.number, at_places(tip.start_cone_left, tip.cone_left));
    if (tip.slip == 0.0) look(Guard::loosening, tip.number, at_places(tip.start_cone_left, tip.cone_left));
    if (!(bounds.shortening < tip.blade->valid_shortening))
      look_at_validity(Guard::shortening_limit, tip.number);
    if (!reverses(tip.slip) || bounds.slip_velocity > 0.0) continue;
    // |v|, or what has reversed of it.
    const double sign = std::copysign(1.0, tip.at_start.slip_velocity);
    const double rounding = slips_from_zero(tip.at_start.slip_velocity) ? slip_rounding() : -1.0;
    AtPlaces velocity = at_places(tip.at_start.slip_velocity, tip.slip_velocity);
    for (double& v : velocity) v = sign * (std::abs(v) > rounding ? v : tip.at_start.slip_velocity);
    look(Guard::slip_reversal, tip.number, velocity);
  }
  if (!(bounds_.distance < machine().ring_radius)) look_at_validity(Guard::shaft_at_ring, kNoBlade);
  return first;
}

/// Whether a tip that does not touch is inside the undeformed ring where the next interval starts: it has
/// lifted off there, and moves inwards.
bool ContactArc::starts_inside(int blade) const {
  if (law_->ends_at_ring()) return false;
  const contact::Pose there = pose(blade, end_);
  return there.gap > contact::gap_rounding(law_->geometry(blade), there);
}

/// What is left of validity: of δ/L up to its limit, of |c|² up to the ring.
AtPlaces ContactArc::validity_left(const Interval& interval, Guard guard, int blade) const {
  if (guard == Guard::shaft_at_ring) {
    const double radius = machine().ring_radius;
    const auto left = [&](double x, double y) {
      const double centre = y + machine().misalignment;
      return radius * radius - (x * x + centre * centre);
    };
    const Body& shaft = interval.shaft;
    const Body& ring = interval.ring;
    AtPlaces result{left(shaft.start[0] - ring.start[0], shaft.start[1] - ring.start[1])};
    for (std::size_t i = 0; i < kNodes; ++i)
      result[i + 1] = left(shaft.x[i] - ring.x[i], shaft.y[i] - ring.y[i]);
    return result;
  }
  const TipInTime& tip = tip_of(interval, blade);
  AtPlaces result = at_places(tip.at_start.shortening, tip.shortening);
  for (double& value : result) value = tip.blade->valid_shortening - value;
  return result;
}

/// The first touch-down of another blade, if it comes before this ending. None where it cannot be told.
std::optional<ContactArc::Ending> ContactArc::touch_down(const Interval& interval, Ending before) const {
  // From the gap at the start alone and how far the shaft and the blades come it is mostly seen that a tip
  // stays off: g = |c|² + 2 (rh + L) c·er + a constant.
  const double x = interval.shaft.start[0] - interval.ring.start[0];
  const double y = interval.shaft.start[1] - interval.ring.start[1] + machine().misalignment;
  const double radial = x * interval.blade[0] + y * interval.blade[1];
  const double tangential = y * interval.blade[0] - x * interval.blade[1];
  const double distance = std::sqrt(x * x + y * y);
  const double farthest = distance + bounds_.moved;
  const double outwards = bounds_.moved + distance * (whole_->blades.speed_bound() * bounds_.latest);
  const auto stays_far_off = [&](int blade) {
    const auto [cosine, sine] = offset_of(blade);
    const Blade& tip = numbers(blade);
    const double radial_there = radial * cosine + tangential * sine + outwards;
    return farthest * farthest + 2.0 * tip.reach * radial_there + tip.closing < 0.0;
  };
  for (const int blade : others_) {
    if (stays_far_off(blade) || stays_off(blade, interval, false)) continue;
    const bool inside = starts_inside(blade);
    const TipCourse tip = course_of_tip(interval, blade);
    AtPlaces values = inside ? tip.rate : tip.gap;
    for (double& value : values) value = -value;
    std::size_t place = 1;
    while (place < kPlaces && !(values[place] < 0.0)) ++place;
    // It may come near the ring without touching it, or it touches at the start: shorter intervals tell.
    if (place == kPlaces || (place == 1 && !(values[0] > 0.0))) return std::nullopt;
    const double fraction = crossing(values, place);
    // Where it has left the ring before it turns outwards, it touches at the ring.
    if (inside && !(sum_of_products(basis_at(fraction), tip.gap) > 0.0)) return std::nullopt;
    if (fraction < before.fraction)
      before = {Guard::touch_down, fraction, blade, slope_before(values, fraction), inside};
  }
  return before;
}

/// What is left of the guard's quantity at the end of an interval that it ends.
double ContactArc::left_at_end(const Ending& ending, const Interval& interval) const {
  const auto tip = [&]() -> const TipInTime& { return tip_of(interval, ending.blade); };
  switch (ending.guard) {
    case Guard::shortening_limit:
    case Guard::shaft_at_ring:
      return validity_left(interval, ending.guard, ending.blade).back();
    case Guard::touch_down: {
      const contact::Pose there = pose(ending.blade, end_of(interval));
      if (!ending.inside) return -there.gap;
      return -0.5 * contact::gap_rate(law_->geometry(ending.blade), there, interval.angular_speed.at_end());
    }
    case Guard::under_load:
      return interval.leader().gap_measure.at_end();
    case Guard::unbent:
      return interval.argument.at_end();
    case Guard::fold:
      return interval.time_slope.at_end();
    case Guard::chart_end:
      return interval.leader().chart_left.at_end();
    case Guard::loosening:
    case Guard::pressed_in:
      return tip().cone_left.at_end();
    default:
      return std::copysign(1.0, tip().at_start.slip_velocity) * tip().slip_velocity.at_end();
  }
}

/// The same up to a guard, which the polynomials have only as accurately as velocities between the nodes.
bool ContactArc::cut_at(const Interval& whole, Ending& ending, Interval& shorter) {
  constexpr int kTimes = 4;
  constexpr double kClosestFraction = 1e-11;
  // At a fold time stands still, and where no force is left nothing is missed in a moment.
  const bool once = ending.guard == Guard::fold || (ending.guard == Guard::unbent && tips_.size() == 1);
  // Whether a tip comes to rest, and which way one slips that comes loose, depends on v to rounding, the more
  // so where friction hardly moves the tip.
  constexpr double kToRounding = 0.05;  // of what v may be
  constexpr double kCloser = 1e-3;      // than other guards, in θ
  constexpr double kCloseAtJump = 0.1;  // likewise, where the force jumps
  const Guard guard = guard_of_tip(ending.guard);
  const bool loosens = law_->leans() && guard == Guard::loosening;
  const bool may_rest = loosens || (law_->leans() && guard == Guard::slip_reversal);
  const double rounding = kToRounding * slip_rounding();
  const double closest = may_rest ? rounding : std::numeric_limits<double>::infinity();
  const double closest_fraction = kClosestFraction * (may_rest                        ? kCloser
                                                      : guard == Guard::slip_reversal ? kCloseAtJump
                                                                                      : 1.0);
  double left_before = std::numeric_limits<double>::infinity();
  double fraction_before = 1.0;
  bool is_located = true;
  for (int i = 0; i < (may_rest ? 2 * kTimes : kTimes); ++i) {
    // Again from where it was cut, which mostly takes one sweep.
    if (!cut(i == 0 ? whole : shorter, ending.fraction / fraction_before, shorter, closest)) {
      // As closely as that it may not be known.
      if (!may_rest || !cut(whole, ending.fraction, shorter)) return false;
    }
    if (once) break;
    fraction_before = ending.fraction;
    const double left = left_at_end(ending, shorter);
    rounding_at_end_ = 2.0 * std::abs(left);
    // What holds a tip may change so fast that the polynomial tells little of the slope: two places do,
    // unless what is left is rounding and hardly falls.
    constexpr double kFalls = 0.1;
    constexpr double kHardly = 0.5;
    constexpr double kMayBeRounding = 1e-8;  // of |c|²
    const double ratio = left / left_before;
    const bool may_be_rounding = std::abs(left) < kMayBeRounding;
    is_located = !loosens || may_be_rounding;
    if (loosens && std::abs(ratio) > kFalls && (ratio < kHardly || !may_be_rounding))
      ending.slope *= 1.0 - ratio;
    left_before = left;
    const double less = left / ending.slope;
    if (!(std::abs(less) > closest_fraction) || ending.fraction - less > 1.0) break;
    ending.fraction -= less;
    if (!(ending.fraction > 0.0)) return false;
  }
  return is_located;
}

/// What a guard of the leading blade is. At a fold the place of a tip at rest is lost, and where its blade
/// unbends nothing holds it.
ContactArc::Guard ContactArc::guard_of_tip(Guard guard) const {
  const bool is_end_of_branch = guard == Guard::fold || guard == Guard::unbent || guard == Guard::chart_end;
  return leading().slip == 0.0 && law_->leans() && is_end_of_branch ? Guard::loosening : guard;
}

/// To where the gap of a blade is zero: in time, and what is left, or all where the tip hardly moves against
/// the ring, the shortest way for the shaft.
void ContactArc::go_on_to_ring(const Interval& interval, int blade) {
  const auto place_ring = [this] {
    if (!machine().ring.is_massless()) return;
    rotor::ContactState state = state_at(end_);
    if (law_->place_ring(*whole_, touching_at(end_), state)) end_.bodies = rotor::bodies(state);
  };
  constexpr int kTimes = 2;
  constexpr double kFarthest = 0.1;  // of the interval
  contact::Pose there = pose(blade, end_);
  const double rounding = contact::gap_rounding(law_->geometry(blade), there);
  for (int i = 0; i < kTimes && (i == 0 || std::abs(there.gap) > rounding); ++i) {
    const double late = -there.gap / gap_rate_at_end(blade, there);
    if (std::abs(late) < kFarthest * interval.elapsed.at_end()) move(end_, interval, late);
    place_ring();
    there = pose(blade, end_);
  }
  const double radius = machine().ring_radius;
  const double left = there.gap / (2.0 * radius);
  if (!(std::abs(left) < tolerance_)) return;
  const contact::BladeDirection er = direction(blade, end_.time);
  const rotor::State seen = rotor::from_ring(end_.bodies);
  const double reach = numbers(blade).reach;
  end_.bodies[0] -= left * (seen[0] + reach * er.cosine) / radius;
  end_.bodies[1] -= left * (seen[1] + whole_->constants.misalignment + reach * er.sine) / radius;
  place_ring();
}

/// The end of an interval: of the contact, or at a touch-down, to rounding, where one ends it.
void ContactArc::end_at(const Interval& interval, const Ending& ending) {
  start_ = end_;
  end_ = end_of(interval);
  er_ = {interval.blade_x.at_end(), interval.blade_y.at_end()};
  ending_ = ending;
  if (ending.guard == Guard::none && interval.chord.time == 0.0)
    ending_ = {Guard::unbent, 1.0, leader(), 0.0};
  if (const auto skims = std::ranges::find(tips_, true, &TipStart::skims); skims != tips_.end()) {
    put_on_ring(skims->number, end_);
    if (ending_.guard == Guard::under_load && ending_.blade == skims->number) return;
  }
  if (ending_.guard == Guard::unbent) {
    move(end_, interval,
         -end_.bending.argument * interval.time_slope.at_end() / interval.argument_slope.at_end());
    end_.bending.argument = 0.0;
  }
  const bool lifts_off = ending_.guard == Guard::under_load ||
                         (ending_.guard == Guard::unbent && !law_->may_stand_straight(leader()));
  const bool touches_down = ending_.guard == Guard::touch_down && !ending_.inside;
  if (touches_down || (lifts_off && law_->ends_at_ring())) go_on_to_ring(interval, ending_.blade);
  if (!machine().ring.is_massless()) {
    const bool reverses_straight = ending_.guard == Guard::slip_reversal && is_straight(ending_.blade);
    bring_to_rest(reverses_straight ? ending_.blade : kNoBlade);
  }
}

}  // namespace rubatlas::collocation
