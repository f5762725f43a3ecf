// Tips that pass the ring within a flight without touching it.

#include <algorithm>
#include <cmath>

#include "integrate/cubic_range.hpp"
#include "integrate/first_crossing.hpp"
#include "integrate/root_between.hpp"
#include "modes/touchdown_search.hpp"

namespace rubatlas::modes {
std::optional<trajectory::Pass> TouchdownSearch::nearest_pass(double known,
                                                              const trajectory::PointConstants& /*point*/) {
  keeps_rows_ = true;
  double from = begin();
  constexpr int kNone = -1;
  trajectory::Pass nearest{known, 0.0, kNone, 0.0};
  const auto look_at_rows = [&] {
    auto next = gaps_.begin();
    for (const KeptRow& row : rows_) {
      if (!(row.begin < end_)) break;
      for (int k = 0; k < static_cast<int>(blades_.size()); ++k) {
        const FlightRow::Gaps& gaps = *next++;
        if (row.begin == begin()) take_start(k, gaps.rate_before, nearest);
        if (may_have_top(gaps, row.spacing)) take_tops(row, k, gaps, nearest);  // seldom
      }
    }
  };
  if (!rows_.empty() && rows_reach_end(outlook(from, flight_->at_start(), end_, true).row->spacing())) {
    look_at_rows();
    from = end_;
  }
  while (from < end_ && !meter_->ended()) {
    from = look_along(from);
    look_at_rows();
  }
  return nearest.blade != kNone ? std::optional(nearest) : std::nullopt;
}

double TouchdownSearch::gap_rate(int blade, double time) const {
  return contact::gap_rate(geometry(blade), pose(blade, time, flight_->state(time)),
                           machine_->blades.angular_speed(time));
}

void TouchdownSearch::take_top(int blade, double time, trajectory::Pass& nearest) {
  const trajectory::Tip there = tip(blade, time);
  if (there.overlap < 0.0 && -there.overlap < nearest.miss)
    nearest = {-there.overlap, there.side, blade, time};
}

/// Symmetry may put a top on the section, where the flight before has not seen its rise end, to rounding.
void TouchdownSearch::take_start(int blade, double rate, trajectory::Pass& nearest) {
  constexpr double kJustAfter = 1e-6;  // [τ]
  if (std::abs(rate) <= rounding_ && gap_rate(blade, begin() + kJustAfter) < 0.0)
    take_top(blade, begin(), nearest);
}

/// Rows of no larger spacing are kept from the start of the flight as far as the end of the piece.
bool TouchdownSearch::rows_reach_end(double spacing) const {
  return rows_.front().begin == begin() &&
         rows_.back().begin + rows_.back().intervals * rows_.back().spacing >= end_ &&
         std::ranges::all_of(rows_, [spacing](const KeptRow& row) { return row.spacing <= spacing; });
}

/// Keeps rows from a time on, without a search, as far as memory and the meter allow: up to the time that is
/// returned.
double TouchdownSearch::look_along(double from) {
  rotor::ShaftAndRing bodies = flight_->state(from);
  FlightRow& row = *outlook(from, bodies, end_, true).row;
  rows_.clear();
  const double length = kTimesOfRow * row.spacing();
  const auto count = static_cast<int>(std::min(std::ceil((end_ - from) / length), double{kMostRows}));
  for (int number = 0; number < count && meter_->spend(Work::flight, price_of_row()); ++number) {
    const double time = from + number * length;
    read(row, time, bodies, 0.0, kTimesOfRow);
    rows_.push_back({time, row.spacing(), kTimesOfRow});
    bodies = row.state(kTimesOfRow - 1);
  }
  return from + count * length;
}

/// Whether a gap may rise and fall again within one of the row's intervals (`integrate::cubic_may_peak`).
bool TouchdownSearch::may_have_top(const FlightRow::Gaps& gaps, double spacing) {
  RowValues gap_before, rise;
  gap_before << gaps.before, gaps.gap.head(kTimesOfRow - 1);
  rise << gaps.rate_before, gaps.rate.head(kTimesOfRow - 1);
  const RowValues between = 3.0 / spacing * (gaps.gap - gap_before) - rise - gaps.rate;
  return ((rise > 0.0 && (between < 0.0 || gaps.rate <= 0.0)) || (between > 0.0 && gaps.rate < 0.0)).any();
}

/// Looks at the tops of a blade's gap in a row, before the end of the piece, for a pass that is nearer.
void TouchdownSearch::take_tops(const KeptRow& row, int blade, const FlightRow::Gaps& gaps,
                                trajectory::Pass& nearest) {
  constexpr unsigned kBits = 28;  // a maximum is flat, so its value has twice as many
  const double h = row.spacing;
  for (int i = 0; i < row.intervals && row.begin + i * h < end_; ++i) {
    const auto [gap_before, rate_before] = gaps.at(i);
    const auto [gap, rate] = gaps.at(i + 1);
    const double from = row.begin + i * h;
    const double miss = std::min(nearest.miss, ring_radius_);
    const double nearer = miss * (miss - 2.0 * ring_radius_);  // g of a tip that passes nearer than that
    const auto rate_at = [&](double time) { return gap_rate(blade, time); };
    std::optional<double> top;
    if (rate_before > 0.0 && rate <= 0.0) {
      // Tangents bound a maximum that lies between two times.
      if (std::max(gap_before + h * rate_before, gap - h * rate) > nearer)
        top = integrate::root_between(rate_at, from, from + h, rate_before, rate, kBits);
    } else if (integrate::cubic_may_peak(h * rate_before, gap - gap_before, h * rate, rounding_) &&
               integrate::cubic_range(gap_before, h * rate_before, gap, h * rate).greatest > nearer) {
      // Fast decay after a contact may turn a tip round twice between two times.
      top = integrate::first_top(rate_at, from, from + h, rate_before, rate);
    }
    if (top && *top < end_) take_top(blade, *top, nearest);
  }
}

}  // namespace rubatlas::modes
