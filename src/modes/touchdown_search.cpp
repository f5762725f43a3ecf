#include "modes/touchdown_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "integrate/conservative_step.hpp"
#include "integrate/newton_between.hpp"
#include "modes/seen_tip.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::modes {
namespace {

/// Times closer than this, relative to the time since the revolution started, are one: two units in the last
/// place.
constexpr double kTimeResolution = 2.0 * std::numeric_limits<double>::epsilon();
constexpr double kDoubt = 10.0;  ///< of the rounding of a gap: below it a row does not tell
/// The first spacing of rows [τ]: one or two rows reach from contact to contact, and finer rows are seldom
/// asked for.
constexpr double kSpacing = 0.75;
/// The remainder of a row is to be smaller than this share of R times the length scale; a gap is 2R times a
/// distance.
constexpr double kLargestRemainder = 1.0 / 8.0;
/// The same of rows whose cubics have to show where tips pass: a ring that moves fast turns them round often.
constexpr double kLargestRemainderOfPasses = 1.0 / 256.0;

/// How long a function that falls certainly goes on to fall: up to the positive root of the parabola above
/// its slope.
double falling_step(double slope, double curvature, double third_bound) {
  const double root = std::sqrt(curvature * curvature - 2.0 * third_bound * slope);
  return curvature > 0.0 ? -2.0 * slope / (curvature + root) : (root - curvature) / third_bound;
}

}  // namespace

TouchdownSearch::TouchdownSearch(const Flight& flight, std::vector<contact::Geometry> blades,
                                 WorkMeter& meter, bool touches_inside)
    : flight_(&flight),
      meter_(&meter),
      machine_(&flight.machine()),
      touches_inside_(touches_inside),
      blades_(std::move(blades)),
      ring_radius_(blades_.front().ring_radius),
      rounding_(kDoubt * machine_->constants.gap_rounding(blades_.front())),
      farthest_(std::ranges::max(blades_, {}, &contact::Geometry::reach).reach),
      turning_(turning_bounds(machine_->blades)),
      first_spacing_(kSpacing / std::max(1.0, std::abs(machine_->constants.speed_ratio))),
      first_doubts_(blades_.size()),
      crossings_(blades_.size()) {}

bool TouchdownSearch::shaft_at_ring(double until) {
  const double misalignment = machine_->constants.misalignment;
  const double from = flight_->start_time();
  const rotor::ShaftAndRing& bodies = flight_->at_start();
  const double bound = flight_->bound(from, bodies, until - from, false).position();
  if (bound + std::abs(misalignment) < ring_radius_) return false;
  const rotor::State seen = rotor::from_ring(bodies);
  if (std::hypot(seen[0], seen[1] + misalignment) >= ring_radius_) return true;
  return by_steps({0.0, ring_radius_}, 0, from, bodies, until).has_value();
}

/// g = |c|² + 2(rh+L) Re(c e^{−iφ}) + a constant.
TouchdownSearch::GapBounds TouchdownSearch::gap_bounds(const FlightBound& bound) const {
  const double centre = bound.position() + std::abs(machine_->constants.misalignment);  // of |c|
  const double velocity = bound.velocity();
  const double turning = machine_->blades.speed_bound();
  const auto [second, third, fourth] = flight_->derivative_bounds(bound);
  const double third_turned =
      third + 3.0 * turning * second + 3.0 * turning_.second * velocity + turning_.third * centre;
  const double fourth_turned = fourth + 4.0 * turning * third + 6.0 * turning_.second * second +
                               4.0 * turning_.third * velocity + turning_.fourth * centre;
  return {6.0 * velocity * second + 2.0 * centre * third + 2.0 * farthest_ * third_turned,
          6.0 * second * second + 8.0 * velocity * third + 2.0 * centre * fourth +
              2.0 * farthest_ * fourth_turned};
}

TouchdownSearch::Outlook TouchdownSearch::outlook(double time, const rotor::ShaftAndRing& bodies,
                                                  double until, bool shows_passes) {
  // Where free motion grows, a bound over all the remaining time would be as large as that of its end.
  const double remaining = until - time;
  const double renewed = std::max(flight_->time_of_bound(), kTimesOfRow * kClosest * first_spacing_);
  const bool in_pieces = renewed < remaining;
  const double horizon = std::min(renewed, remaining);
  const double fourth = gap_bounds(flight_->bound(time, bodies, horizon)).fourth;
  const double share = shows_passes ? kLargestRemainderOfPasses : kLargestRemainder;
  const double allowed = share * ring_radius_ * machine_->constants.length_scale;
  const auto suits = [&](double h) {
    return !(in_pieces && kTimesOfRow * h > renewed) && FlightRow::remainder(fourth, h) <= allowed;
  };
  double spacing = first_spacing_;
  while (spacing > kClosest * first_spacing_ && !suits(spacing)) spacing *= 0.5;
  return {in_pieces ? time + renewed : until, fourth, &row_of(spacing)};
}

/// In rows of times; where one leaves open whether a tip touches in an interval, in a finer row of that
/// interval, and in steps only where this leaves it open, too.
std::optional<TouchdownSearch::Touchdown> TouchdownSearch::find(double until) {
  double time = flight_->start_time();
  rotor::ShaftAndRing bodies = flight_->at_start();
  rows_.clear();
  // The shaft cannot leave the clearance circle: no blade can touch, and there is nothing to search.
  const double bound = flight_->bound(time, bodies, until - time, false).position();
  if (bound + std::abs(machine_->constants.misalignment) <= ring_radius_ - farthest_) return std::nullopt;
  const std::int64_t price = price_of_row();
  Outlook ahead = outlook(time, bodies, until, false);
  double fine_until = time;     // the end of an interval that a finer row looks at
  int left_open = kTimesOfRow;  // the interval of the row before that this one looks at
  for (int rows = 1; time < until; ++rows) {
    if (!meter_->spend(Work::flight, price)) return std::nullopt;
    FlightRow& row = *ahead.row;
    const std::span<const FlightRow::Gaps> gaps = read(row, time, bodies, ahead.fourth, left_open);
    int doubt = kTimesOfRow;
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const bool stays_clear = first_doubts_[k] > left_open;
      first_doubts_[k] = stays_clear ? kTimesOfRow : row.first_doubt(gaps[k], rounding_);
      if (!stays_clear) ++evaluations_;
      doubt = std::min(doubt, first_doubts_[k]);
    }
    bool is_open = false;  // a tip may touch in that interval, or not
    for (std::size_t k = 0; k < gaps.size() && doubt < kTimesOfRow; ++k) {
      if (first_doubts_[k] > doubt) continue;
      crossings_[k] = row.only_crossing(gaps[k], doubt, rounding_);
      // Of a tip that starts at the ring no row tells.
      is_open = is_open || (!crossings_[k] && gaps[k].at(doubt).value < -rounding_);
    }
    const bool refines = is_open && !(time < fine_until);
    const int passed = doubt == kTimesOfRow || refines ? doubt : doubt + 1;
    if (keeps_rows_ && passed > 0 && rows_.size() < kMostRows) rows_.push_back({time, row.spacing(), passed});
    if (doubt > 0) {
      time += doubt * row.spacing();
      bodies = rows % kRowsFromClosedForm != 0 ? row.state(doubt - 1) : flight_->state(time);
    }
    if (time >= until) break;
    left_open = refines && !keeps_rows_ ? doubt : kTimesOfRow;
    if (refines) {
      fine_until = time + row.spacing();
      ahead.row = &row_of(row.spacing() / kTimesOfRow);
      continue;
    }
    if (doubt < kTimesOfRow) {
      const double end = std::min(time + row.spacing(), until);
      std::optional<Touchdown> touchdown;
      for (std::size_t k = 0; k < gaps.size(); ++k) {
        if (first_doubts_[k] > doubt) continue;
        const int blade = static_cast<int>(k);
        const double before = touchdown ? touchdown->time : end;
        const auto touch = crossings_[k]
                               ? by_newton(blade, time, time + row.spacing(), time + *crossings_[k], before)
                               : by_steps(geometry(blade), blade, time, bodies, before);
        if (touch) touchdown = touch;
      }
      if (meter_->ended()) return std::nullopt;
      if (touchdown) return touchdown;
      time = end;
      bodies = flight_->state(time);
    }
    const double next_end = time + kTimesOfRow * row.spacing();
    if (time < until && !(time < fine_until) &&
        (row.spacing() < first_spacing_ || (next_end > ahead.until && ahead.until < until)))
      ahead = outlook(time, bodies, until, false);
  }
  return std::nullopt;
}

/// Moves a row to a time of the flight and reads gaps, behind those of the rows that are kept: of the blades
/// of which the row before may have left open the interval that this one looks at.
std::span<const FlightRow::Gaps> TouchdownSearch::read(FlightRow& row, double time,
                                                       const rotor::ShaftAndRing& bodies, double fourth_bound,
                                                       int left_open) {
  row.start(time, bodies, fourth_bound);
  const std::size_t kept = rows_.size() * blades_.size();
  gaps_.resize(kept);
  const contact::BladeDirection first = machine_->blades.first(time);
  for (std::size_t k = 0; k < blades_.size(); ++k) {
    if (first_doubts_[k] <= left_open)
      gaps_.push_back(row.gaps(blades_[k], machine_->blades.direction(static_cast<int>(k), first)));
    else
      gaps_.emplace_back();
  }
  return std::span(gaps_).subspan(kept);
}

/// Where the gap of a blade rises all through an interval, from below zero to above: its touch-down before
/// `until`.
std::optional<TouchdownSearch::Touchdown> TouchdownSearch::by_newton(int blade, double from, double to,
                                                                     double guess, double until) {
  constexpr double kLastStep = 1e-8;  // [τ]: the last step errs by its square
  const auto gap = [&](double at) {
    meter_->spend(Work::flight, WorkPrice::kGap + flight_->price_of_state());
    ++evaluations_;
    const contact::Pose there = pose(blade, at, flight_->state(at));
    return integrate::ValueAndSlope{
        there.gap, contact::gap_rate(geometry(blade), there, machine_->blades.angular_speed(at))};
  };
  const double touches = integrate::newton_between(gap, from, to, guess, true, kLastStep);
  return touches < until ? std::optional(Touchdown{blade, touches}) : std::nullopt;
}

std::optional<TouchdownSearch::Touchdown> TouchdownSearch::by_steps(const contact::Geometry& tip, int blade,
                                                                    double time, rotor::ShaftAndRing bodies,
                                                                    double until) {
  while (time < until && meter_->spend(Work::flight, WorkPrice::kGap + flight_->price_of_state())) {
    ++evaluations_;
    const double step = clear_step(tip, blade, time, bodies, until);
    if (step <= kTimeResolution * std::max(1.0, time)) return Touchdown{blade, time};
    time += step;
    if (time < until) bodies = flight_->state(time);
  }
  return std::nullopt;
}

contact::Pose TouchdownSearch::pose(int blade, double time, const rotor::ShaftAndRing& bodies) const {
  const rotor::BladeSet& blades = machine_->blades;
  return rotor::pose_of(machine_->constants, geometry(blade), blades.direction(blade, blades.first(time)),
                        rotor::from_ring(bodies));
}

trajectory::Tip TouchdownSearch::tip(int blade, double time) {
  return tip_of(geometry(blade), pose(blade, time, flight_->state(time)),
                machine_->blades.angular_speed(time));
}

/// A duration from `time` on within which a tip of that geometry cannot touch.
double TouchdownSearch::clear_step(const contact::Geometry& geometry, int blade, double time,
                                   const rotor::ShaftAndRing& bodies, double until) const {
  const rotor::BladeSet& blades = machine_->blades;
  const contact::BladeDirection er = blades.direction(blade, blades.first(time));
  const rotor::State seen = rotor::from_ring(bodies);
  const double turning = blades.angular_speed(time);
  const contact::Pose at = rotor::pose_of(machine_->constants, geometry, er, seen);
  const double slope = contact::gap_rate(geometry, at, turning);
  // Rounding may leave the gap of a blade that has just lifted off a little above zero.
  if (at.gap >= 0.0 && slope > 0.0) return 0.0;
  const double value = std::min(at.gap, 0.0);

  const double curvature =
      rotor::free_gap_curvature(*machine_, geometry, er, at, rotor::full_state(bodies, time, 0.0), 0.0);
  // Where free motion grows, a bound over all the remaining time would be as large as that of its end.
  const double remaining = until - time;
  const double horizon = std::min(flight_->time_of_bound(), remaining);
  const FlightBound bound = flight_->bound(time, bodies, horizon);
  const double third = gap_bounds(bound).third;
  const double step = touches_inside_ && at.gap > rounding_
                          ? falling_step(slope, curvature, third)
                          : integrate::conservative_step(value, slope, curvature, third);
  return horizon < remaining ? std::min(step, horizon) : step;
}

/// With f = −iφ: (e^f)' = f' e^f, and so on.
rotor::DerivativeBounds TouchdownSearch::turning_bounds(const rotor::BladeSet& blades) {
  const double speed = blades.speed_bound();
  const double change = blades.angular_acceleration_bound();
  const double jerk = blades.angular_jerk_bound();
  const double square = speed * speed;
  return {square + change, jerk + 3.0 * speed * change + square * speed,
          blades.angular_snap_bound() + 4.0 * speed * jerk + 3.0 * change * change + 6.0 * square * change +
              square * square};
}

}  // namespace rubatlas::modes
