// Tips that pass the ring within a flight without touching it.

#include <algorithm>
#include <cmath>

#include "integrate/cubic_range.hpp"
#include "integrate/first_crossing.hpp"
#include "integrate/newton_between.hpp"
#include "modes/touchdown_search.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::modes {
namespace {

/// Share of the time h between two values with their slopes, the first of which rises and the second falls,
/// where the cubic through them is largest.
double top_of_cubic(const integrate::ValueAndSlope& first, const integrate::ValueAndSlope& second, double h) {
  const double mean = (second.value - first.value) / h;
  const double square = 3.0 * (first.slope + second.slope - 2.0 * mean);
  const double linear = 6.0 * mean - 4.0 * first.slope - 2.0 * second.slope;
  return 2.0 * first.slope / (std::sqrt(linear * linear - 4.0 * square * first.slope) - linear);
}

}  // namespace

std::optional<trajectory::Pass> TouchdownSearch::nearest_pass(const Flight& flight, double begin, double end,
                                                              double known, WorkMeter& meter) {
  keeps_rows_ = true;
  const rotor::ShaftAndRing bodies = flight.state(begin);
  std::optional<trajectory::Pass> nearest;
  const auto look_at_rows = [&] {
    auto next = gaps_.begin();
    for (const KeptRow& row : rows_) {
      if (!(row.begin < end)) break;
      for (int k = 0; k < static_cast<int>(blades_.size()); ++k) {
        const FlightRow::Gaps& gaps = *next++;
        if (!may_have_top(gaps, row.spacing)) continue;  // mostly
        if (const auto pass = nearest_top(flight, row, k, gaps, end, known)) {
          nearest = pass;
          known = pass->miss;
        }
      }
    }
  };
  if (!rows_.empty() &&
      rows_reach(begin, bodies, end, outlook(flight, begin, bodies, end, true).row->spacing())) {
    look_at_rows();
    return nearest;
  }
  while (begin < end && !meter.ended()) {
    begin = look_along(flight, begin, end, meter);
    look_at_rows();
  }
  return nearest;
}

/// Begins to keep rows of a flight from a state on.
void TouchdownSearch::forget_rows(const rotor::ShaftAndRing& bodies) {
  rows_.clear();
  gaps_.clear();
  rows_state_ = bodies;
}

/// Rows of no larger spacing are kept from this state on as far as `end`.
bool TouchdownSearch::rows_reach(double begin, const rotor::ShaftAndRing& bodies, double end,
                                 double spacing) const {
  return rows_.front().begin == begin && (rows_state_ == bodies).all() &&
         rows_.back().begin + rows_.back().intervals * rows_.back().spacing >= end &&
         std::ranges::all_of(rows_, [spacing](const KeptRow& row) { return row.spacing <= spacing; });
}

/// Keeps rows between two times, without a search, as far as memory and the meter allow: up to the time that
/// is returned.
double TouchdownSearch::look_along(const Flight& flight, double begin, double end, WorkMeter& meter) {
  rotor::ShaftAndRing bodies = flight.state(begin);
  FlightRow& row = *outlook(flight, begin, bodies, end, true).row;
  forget_rows(bodies);
  const double length = FlightRow::kTimes * row.spacing();
  const auto count = static_cast<int>(std::min(std::ceil((end - begin) / length), double{kMostRows}));
  for (int number = 0; number < count && meter.spend(Work::flight, price_of_row(flight)); ++number) {
    const double time = begin + number * length;
    row.start(time, bodies, 0.0);
    const contact::BladeDirection first = machine_->blades.first(time);
    for (int k = 0; k < static_cast<int>(blades_.size()); ++k) gaps_.push_back(gaps_of(row, k, first));
    rows_.push_back({time, row.spacing(), FlightRow::kTimes});
    bodies = row.state(FlightRow::kTimes - 1);
  }
  return begin + count * length;
}

/// Whether a gap may rise and fall again within one of the row's intervals (`integrate::cubic_may_peak`).
bool TouchdownSearch::may_have_top(const FlightRow::Gaps& gaps, double spacing) {
  RowValues gap_before, rise;
  gap_before << gaps.before, gaps.gap.head(FlightRow::kTimes - 1);
  rise << gaps.rate_before, gaps.rate.head(FlightRow::kTimes - 1);
  const RowValues between = 3.0 / spacing * (gaps.gap - gap_before) - rise - gaps.rate;
  return ((rise > 0.0 && (between < 0.0 || gaps.rate <= 0.0)) || (between > 0.0 && gaps.rate < 0.0)).any();
}

/// Of the tops of a blade's gap in a row the one nearest to the ring, before `end` and nearer than `known`.
std::optional<trajectory::Pass> TouchdownSearch::nearest_top(const Flight& flight, const KeptRow& row,
                                                             int blade, const FlightRow::Gaps& gaps,
                                                             double end, double known) const {
  const double radius = geometry(blade).ring_radius;
  const double h = row.spacing;
  std::optional<trajectory::Pass> nearest;
  double gap_before = gaps.before;
  double rate_before = gaps.rate_before;
  for (int i = 0; i < row.intervals && row.begin + i * h < end; ++i) {
    const double gap = gaps.gap[i];
    const double rate = gaps.rate[i];
    const double from = row.begin + i * h;
    const double miss = std::min(known, radius);
    const double nearer = miss * (miss - 2.0 * radius);  // g of a tip that passes nearer than that
    std::optional<trajectory::Pass> pass;
    if (rate_before > 0.0 && rate <= 0.0) {
      // Tangents bound a maximum that lies between two times.
      if (std::max(gap_before + h * rate_before, gap - h * rate) > nearer) {
        const double guess = from + h * top_of_cubic({gap_before, rate_before}, {gap, rate}, h);
        pass = pass_between(flight, blade, {from, from + h, guess}, end, known);
      }
    } else if (integrate::cubic_may_peak(h * rate_before, gap - gap_before, h * rate,
                                         roundings_[static_cast<std::size_t>(blade)]) &&
               integrate::cubic_range(gap_before, h * rate_before, gap, h * rate).greatest > nearer) {
      // Fast decay after a contact may turn a tip round twice between two times.
      const auto rate_at = [&](double time) { return tip(flight, blade, time).rate; };
      const double to = std::min(from + h, end);
      if (const auto top = integrate::first_top(rate_at, from, to, rate_at(from), rate_at(to)))
        pass = pass_at(flight, blade, *top, known);
    }
    if (pass) {
      nearest = pass;
      known = pass->miss;
    }
    gap_before = gap;
    rate_before = rate;
  }
  return nearest;
}

/// The pass of a tip there, if it comes before `end` and nearer than `known`.
std::optional<trajectory::Pass> TouchdownSearch::pass_between(const Flight& flight, int blade,
                                                              TopBetween between, double end,
                                                              double known) const {
  const rotor::BladeSet& blades = machine_->blades;
  const auto rate = [&](double time) {
    const rotor::ShaftAndRing bodies = flight.state(time);
    const contact::BladeDirection er = blades.direction(blade, blades.first(time));
    const contact::Pose there = pose(blade, time, bodies);
    return integrate::ValueAndSlope{contact::gap_rate(geometry(blade), there, blades.angular_speed(time)),
                                    rotor::free_gap_curvature(*machine_, geometry(blade), er, there,
                                                              rotor::full_state(bodies, time, 0.0), 0.0)};
  };
  if (end < between.to) {
    if (!(rate(end).value < 0.0)) return std::nullopt;
    between.to = end;
    between.guess = std::min(between.guess, 0.5 * (between.from + end));
  }
  constexpr double kClosestTop = 1e-6;  // of the time between: the error left is of the second order of that
  const double time = integrate::newton_between(rate, between.from, between.to, between.guess, false,
                                                kClosestTop * (between.to - between.from));
  return pass_at(flight, blade, time, known);
}

/// The pass of a tip whose radius is largest at that time, if it is nearer than `known`.
std::optional<trajectory::Pass> TouchdownSearch::pass_at(const Flight& flight, int blade, double time,
                                                         double known) const {
  const trajectory::Tip top = tip(flight, blade, time);
  if (!(top.overlap < 0.0 && -top.overlap < known)) return std::nullopt;
  return trajectory::Pass{-top.overlap, top.side, blade, time};
}

}  // namespace rubatlas::modes
