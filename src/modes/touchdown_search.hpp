/// The search for the touch-down that ends a flight, with proof that there is none before it, and for the
/// tips that pass the ring meanwhile.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "integrate/conservative_step.hpp"
#include "integrate/cubic_range.hpp"
#include "integrate/first_crossing.hpp"
#include "integrate/newton_between.hpp"
#include "modes/flight.hpp"
#include "modes/flight_row.hpp"
#include "modes/tip_of.hpp"
#include "modes/work_meter.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

/// Finds the first touch-down of a flight. For each blade the search keeps the time up to which the blade is
/// proven clear of the ring. The least of these times is advanced until it no longer moves, which is a
/// touch-down, or until all of them have passed the end of the search.
template <class Law, class Blades = rotor::BladeSet>
class TouchdownSearch {
 public:
  TouchdownSearch(const rotor::RotorConstants& rotor, const Law& law, const Blades& blades)
      : rotor_(&rotor),
        law_(&law),
        blades_(&blades),
        turning_weight_(turning_weight(rotor)),
        clear_until_(static_cast<std::size_t>(blades.count())) {}

  /// Flights whose states come in rows.
  template <class Flight>
  static constexpr bool kInRows = !Blades::kMayRipple && requires(const Flight& flight) {
    flight.row();
  };

  struct Touchdown {
    int blade;
    double time;  ///< τ of the revolution
  };

  /// Nothing also where the meter ends the revolution.
  template <class Flight>
  std::optional<Touchdown> find(const Flight& flight, double until, WorkMeter& meter) {
    const double from = flight.start_time();
    auto state = flight.state(from);
    // The shaft cannot leave the clearance circle: no blade can touch, and there is nothing to search.
    if (stays_clear(flight, from, state, until - from)) return std::nullopt;

    if constexpr (kInRows<Flight>) {
      return find_in_rows(flight, state, until, meter);
    } else {
      clear_until_.assign(clear_until_.size(), from);
      return find_by_steps(flight, from, state, until, meter);
    }
  }

  /// The time before `until` when the shaft's centre reaches the ring, |c| = R, with no blade in contact
  /// (MODEL 5): the zero of the gap of a blade without length. Nothing also where the meter ends the
  /// revolution.
  template <class Flight>
  std::optional<double> shaft_at_ring(const Flight& flight, double until, WorkMeter& meter) const {
    const contact::Geometry shaft{0.0, law_->of(0).geometry().ring_radius};
    double time = flight.start_time();
    auto state = flight.state(time);
    const double bound = bound_from_ring(flight, time, state, until - time);
    if (bound + std::abs(rotor_->misalignment) < shaft.ring_radius) return std::nullopt;
    const rotor::State seen = rotor::from_ring(state);
    if (std::hypot(seen[0], seen[1] + rotor_->misalignment) >= shaft.ring_radius) return time;
    while (meter.spend(Work::flight, WorkPrice::kGap + price_of_state(flight))) {
      const double step = clear_step(flight, shaft, 0, time, state, until);
      if (step <= kTimeResolution * std::max(1.0, time)) return time;
      time += step;
      if (time >= until) return std::nullopt;
      state = flight.state(time);
    }
    return std::nullopt;
  }

  /// The shaft stays within the clearance circle for ever, so that no blade can touch.
  template <class Flight, class Bodies>
  [[nodiscard]] bool never_touches(const Flight& flight, const Bodies& state) const {
    return stays_clear(flight, flight.start_time(), state, std::numeric_limits<double>::infinity());
  }

  /// A tip at a time of the flight.
  template <class Flight>
  [[nodiscard]] trajectory::Tip tip(const Flight& flight, int blade, double time) const {
    const contact::Geometry& geometry = law_->of(blade).geometry();
    return tip_of(geometry, pose(geometry, blade, time, flight.state(time)), blades_->angular_speed(time));
  }

  /// The tip that passes the ring nearest between two times of the flight, nearer than `known` [m], or none.
  /// Once this has been asked for, the search keeps the gaps that it finds.
  template <class Flight>
  [[nodiscard]] std::optional<trajectory::Pass> nearest_pass(const Flight& flight, double begin, double end,
                                                             double known) requires kInRows<Flight> {
    keeps_rows_ = true;
    const rotor::State state = flight.state(begin);
    if (!rows_reach(begin, state, end)) look_along(flight, begin, state, end);
    std::optional<trajectory::Pass> nearest;
    auto next = gaps_.begin();
    for (const KeptRow& row : rows_) {
      if (!(row.begin < end)) break;
      for (int k = 0; k < blades_->count(); ++k) {
        const FlightRow::Gaps& gaps = *next++;
        if (!may_have_top(gaps)) continue;  // mostly
        if (const auto pass = nearest_top(flight, row, k, gaps, end, known)) {
          nearest = pass;
          known = pass->miss;
        }
      }
    }
    return nearest;
  }

  /// Gaps evaluated, one for each blade and time, or row of times.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  /// Times closer than this, relative to the time since the revolution started, are one: two units in the
  /// last place.
  static constexpr double kTimeResolution = 2.0 * std::numeric_limits<double>::epsilon();
  static constexpr double kDoubt = 10.0;  ///< of the rounding of a gap: below it a row does not tell

  /// Bound of |(d/dτ + iΩ)³ z| against (|z|² + |z'|²)^½ in a flight without forcing: z''' and z'' are written
  /// with z and z', whose coefficients are bounded together.
  static double turning_weight(const rotor::RotorConstants& rotor) {
    const double damping = 2.0 * rotor.damping_ratio;
    const double speed = std::abs(rotor.speed_ratio);
    const double of_velocity =
        std::hypot(damping * damping - 1.0 - 3.0 * speed * speed, 3.0 * speed * damping);
    const double of_position = std::hypot(damping, speed * (3.0 + speed * speed));
    return std::hypot(of_velocity, of_position);
  }

  /// In rows of times, and in steps only where a row leaves a doubt.
  template <class Flight>
  std::optional<Touchdown> find_in_rows(const Flight& flight, rotor::State state, double until,
                                        WorkMeter& meter) {
    if (!row_) row_.emplace(flight.row());
    double time = flight.start_time();
    forget_rows(state);
    const double bound = fourth_bound(flight, flight.amplitude_bound(time, state, until - time));
    const std::int64_t price = price_of_state(flight) + blades_->count() * WorkPrice::kGap;
    while (time < until) {
      if (!meter.spend(Work::flight, price)) return std::nullopt;
      flight.start_row(*row_, time, state, bound);
      evaluations_ += static_cast<std::uint64_t>(blades_->count());
      const contact::BladeDirection first = blades_->first(time);
      int doubt = FlightRow::kTimes;
      for (int k = 0; k < blades_->count(); ++k) {
        const FlightRow::Gaps gaps = gaps_of(k, first);
        const int of_blade = row_->first_doubt(gaps, kDoubt * rotor_->gap_rounding(law_->of(k).geometry()));
        clear_until_[static_cast<std::size_t>(k)] = of_blade;
        doubt = std::min(doubt, of_blade);
        if (keeps_rows_) gaps_.push_back(gaps);
      }
      if (keeps_rows_) rows_.push_back({time, std::min(doubt + 1, FlightRow::kTimes)});
      time += doubt * row_->spacing();
      state = flight.state(time);
      if (doubt == FlightRow::kTimes) continue;
      if (time >= until) break;
      const double end = std::min(time + row_->spacing(), until);
      for (double& clear_until : clear_until_) clear_until = clear_until > doubt ? end : time;
      if (const auto touchdown = find_by_steps(flight, time, state, end, meter)) return touchdown;
      if (meter.ended()) return std::nullopt;
      time = end;
      state = flight.state(time);
    }
    return std::nullopt;
  }

  /// In steps that no tip can outrun; `clear_until_` says from when on each blade is to be looked at.
  template <class Flight, class Bodies>
  std::optional<Touchdown> find_by_steps(const Flight& flight, double time, Bodies state, double until,
                                         WorkMeter& meter) {
    while (true) {
      std::size_t blade = 0;
      for (std::size_t k = 1; k < clear_until_.size(); ++k) {
        if (clear_until_[k] < clear_until_[blade]) blade = k;
      }
      if (clear_until_[blade] >= until) return std::nullopt;
      if (clear_until_[blade] > time) {
        time = clear_until_[blade];
        state = flight.state(time);
      }
      if (!meter.spend(Work::flight, WorkPrice::kGap + price_of_state(flight))) return std::nullopt;
      ++evaluations_;
      const int number = static_cast<int>(blade);
      const double step = clear_step(flight, law_->of(number).geometry(), number, time, state, until);
      if (step <= kTimeResolution * std::max(1.0, time)) return Touchdown{static_cast<int>(blade), time};
      clear_until_[blade] = time + step;
    }
  }

  [[nodiscard]] contact::Pose pose(const contact::Geometry& geometry, int blade, double time,
                                   const auto& bodies) const {
    return rotor::pose_of(*rotor_, geometry, blades_->direction(blade, blades_->first(time)),
                          rotor::from_ring(bodies));
  }

  /// Begins to keep rows of a flight from a state on.
  void forget_rows(const rotor::State& state) {
    rows_.clear();
    gaps_.clear();
    rows_state_ = state;
  }
  /// Of a blade, at the times of the row; `first`: where blade 0 stands at its start.
  [[nodiscard]] FlightRow::Gaps gaps_of(int blade, const contact::BladeDirection& first) const {
    return row_->gaps(law_->of(blade).geometry(), blades_->direction(blade, first));
  }
  /// Rows are kept from this state on as far as `end`.
  [[nodiscard]] bool rows_reach(double begin, const rotor::State& state, double end) const {
    return !rows_.empty() && rows_.front().begin == begin && (rows_state_ == state).all() &&
           rows_.back().begin + rows_.back().intervals * row_->spacing() >= end;
  }
  /// Keeps rows between two times, without a search.
  template <class Flight>
  void look_along(const Flight& flight, double begin, rotor::State state, double end) {
    if (!row_) row_.emplace(flight.row());
    forget_rows(state);
    const double length = FlightRow::kTimes * row_->spacing();
    const auto count = static_cast<std::int64_t>(std::ceil((end - begin) / length));
    for (std::int64_t number = 0; number < count; ++number) {
      const double time = begin + static_cast<double>(number) * length;
      flight.start_row(*row_, time, state, 0.0);
      const contact::BladeDirection first = blades_->first(time);
      for (int k = 0; k < blades_->count(); ++k) gaps_.push_back(gaps_of(k, first));
      rows_.push_back({time, FlightRow::kTimes});
      state = row_->state(FlightRow::kTimes - 1);
    }
  }

  struct KeptRow {
    double begin;   ///< τ of the revolution
    int intervals;  ///< of the row that belong to the flight's way; the next row goes on after them
  };
  /// Whether a gap may rise and fall again within one of the row's intervals (`integrate::cubic_may_peak`).
  [[nodiscard]] bool may_have_top(const FlightRow::Gaps& gaps) const {
    using Values = FlightRow::Values;
    Values gap_before;
    Values rise;
    gap_before << gaps.before, gaps.gap.head(FlightRow::kTimes - 1);
    rise << gaps.rate_before, gaps.rate.head(FlightRow::kTimes - 1);
    const Values between = 3.0 / row_->spacing() * (gaps.gap - gap_before) - rise - gaps.rate;
    return ((rise > 0.0 && (between < 0.0 || gaps.rate <= 0.0)) || (between > 0.0 && gaps.rate < 0.0)).any();
  }
  /// Of the tops of a blade's gap in a row the one nearest to the ring, before `end` and nearer than `known`.
  template <class Flight>
  [[nodiscard]] std::optional<trajectory::Pass> nearest_top(const Flight& flight, const KeptRow& row,
                                                            int blade, const FlightRow::Gaps& gaps,
                                                            double end, double known) const {
    const double radius = law_->of(blade).geometry().ring_radius;
    const double h = row_->spacing();
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
                                           kDoubt * rotor_->gap_rounding(law_->of(blade).geometry())) &&
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

  /// Share of the time h between two values with their slopes, the first of which rises and the second falls,
  /// where the cubic through them is largest.
  static double top_of_cubic(const integrate::ValueAndSlope& first, const integrate::ValueAndSlope& second,
                             double h) {
    const double mean = (second.value - first.value) / h;
    const double square = 3.0 * (first.slope + second.slope - 2.0 * mean);
    const double linear = 6.0 * mean - 4.0 * first.slope - 2.0 * second.slope;
    return 2.0 * first.slope / (std::sqrt(linear * linear - 4.0 * square * first.slope) - linear);
  }

  /// Two times between which a tip's radius has its one maximum, and about when.
  struct TopBetween {
    double from;
    double to;
    double guess;
  };
  /// The pass of that tip there, if it comes before `end` and nearer than `known`.
  template <class Flight>
  [[nodiscard]] std::optional<trajectory::Pass> pass_between(const Flight& flight, int blade,
                                                             TopBetween between, double end,
                                                             double known) const {
    const contact::Geometry& geometry = law_->of(blade).geometry();
    const auto rate = [&](double time) {
      const rotor::State at = flight.state(time);
      const contact::BladeDirection er = blades_->direction(blade, blades_->first(time));
      const contact::Pose there = rotor::pose_of(*rotor_, geometry, er, at);
      const double turning = blades_->angular_speed(time);
      return integrate::ValueAndSlope{
          contact::gap_rate(geometry, there, turning),
          contact::gap_curvature(geometry, er, there, {at[0], at[1] + rotor_->misalignment}, {at[2], at[3]},
                                 flight.acceleration(time, at), turning)};
    };
    if (end < between.to) {
      if (!(rate(end).value < 0.0)) return std::nullopt;
      between.to = end;
      between.guess = std::min(between.guess, 0.5 * (between.from + end));
    }
    constexpr double kClosest = 1e-6;  // of the time between: the error left is of the second order of that
    const double time = integrate::newton_between(rate, between.from, between.to, between.guess, false,
                                                  kClosest * (between.to - between.from));
    return pass_at(flight, blade, time, known);
  }
  /// The pass of a tip whose radius is largest at that time, if it is nearer than `known`.
  template <class Flight>
  [[nodiscard]] std::optional<trajectory::Pass> pass_at(const Flight& flight, int blade, double time,
                                                        double known) const {
    const trajectory::Tip top = tip(flight, blade, time);
    if (!(top.overlap < 0.0 && -top.overlap < known)) return std::nullopt;
    return trajectory::Pass{-top.overlap, top.side, blade, time};
  }

  template <class Flight, class Bodies>
  [[nodiscard]] bool stays_clear(const Flight& flight, double time, const Bodies& state,
                                 double horizon) const {
    return bound_from_ring(flight, time, state, horizon) + std::abs(rotor_->misalignment) <=
           least_clearance();
  }

  /// Clearance of the blade that reaches farthest [m].
  [[nodiscard]] double least_clearance() const {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < blades_->count(); ++k) {
      const contact::Geometry& geometry = law_->of(k).geometry();
      least = std::min(least, geometry.ring_radius - geometry.reach);
    }
    return least;
  }

  /// A duration from `time` on within which a tip of that geometry, in the direction of a blade, cannot
  /// touch.
  template <class Flight, class Bodies>
  double clear_step(const Flight& flight, const contact::Geometry& geometry, int blade, double time,
                    const Bodies& state, double until) const {
    const rotor::State seen = rotor::from_ring(state);
    const double turning = blades_->angular_speed(time);
    const double reach = geometry.reach;
    const contact::BladeDirection er = blades_->direction(blade, blades_->first(time));
    const contact::Pose at = rotor::pose_of(*rotor_, geometry, er, seen);
    const double slope = contact::gap_rate(geometry, at, turning);
    // Rounding may leave the gap of a blade that has just lifted off a little above zero.
    if (at.gap >= 0.0 && slope > 0.0) return 0.0;
    const double value = std::min(at.gap, 0.0);

    const std::complex<double> acceleration = flight.acceleration(time, state);
    double curvature = contact::gap_curvature(geometry, er, at, {seen[0], seen[1] + rotor_->misalignment},
                                              {seen[2], seen[3]}, acceleration, turning);
    // Where free motion grows, a bound over all the remaining time would be as large as that of its end.
    const double remaining = until - time;
    const double renewed = time_of_bound(flight);
    const bool in_pieces = renewed < remaining;
    const auto bound = flight.amplitude_bound(time, state, in_pieces ? renewed : remaining);  // of |z|, |c'|
    if constexpr (std::is_same_v<decltype(bound), const double>) {
      if (flight.is_isotropic() && !blades_->ripples())
        return integrate::conservative_step(value, slope, curvature, close_third_bound(flight, bound, reach));
    }
    if constexpr (Blades::kMayRipple)
      curvature += 2.0 * reach * blades_->angular_acceleration(time) * at.tangential;
    const double step =
        integrate::conservative_step(value, slope, curvature, third_bound(flight, bound, reach));
    return in_pieces ? std::min(step, renewed) : step;
  }

  /// Bound of |g'''| at constant speed on an isotropic shaft.
  template <class Flight>
  double close_third_bound(const Flight& flight, double bound, double reach) const {
    const double speed = std::abs(rotor_->speed_ratio);
    // g''' = 6 c'·c'' + 2 c·c''' + 2(rh+L) er·(d/dτ + iΩ)³ c. In the last term z''' and z'' are written with
    // z, z' and the forcing; the coefficients of z and z' are bounded together: |z|² + |z'|² <= bound².
    const double forcing = flight.forcing_bound();
    const double damping = 2.0 * rotor_->damping_ratio;
    const double misalignment = std::abs(rotor_->misalignment);
    const double centre = bound + misalignment;  // of |c|
    const double second = std::sqrt(1.0 + damping * damping) * bound + forcing;
    const double third = damping * second + bound + forcing * speed;
    const double turned_third =
        turning_weight_ * bound + (damping + 4.0 * speed) * forcing + speed * speed * speed * misalignment;
    return 6.0 * bound * second + 2.0 * centre * third + 2.0 * reach * turned_third;
  }

  /// Bound of |g''''| at constant speed on an isotropic shaft, of the blade that reaches farthest: of
  /// (|c|²)'''' and of 2(rh+L) er·(d/dτ + iΩ)⁴ c, term by term.
  template <class Flight>
  double fourth_bound(const Flight& flight, double bound) const {
    const double speed = std::abs(rotor_->speed_ratio);
    const double forcing = flight.forcing_bound();
    const double damping = 2.0 * rotor_->damping_ratio;
    const double centre = bound + std::abs(rotor_->misalignment);
    const double second = flight.second_bound(bound);
    const double third = flight.third_bound(bound);
    const double fourth = damping * third + second + forcing * speed * speed;
    const double turned =
        fourth + speed * (4.0 * third + speed * (6.0 * second + speed * (4.0 * bound + speed * centre)));
    double reach = 0.0;
    for (int k = 0; k < blades_->count(); ++k) reach = std::max(reach, law_->of(k).geometry().reach);
    return 6.0 * second * second + 8.0 * bound * third + 2.0 * centre * fourth + 2.0 * reach * turned;
  }

  /// The same for any support and any turning, term by term: with D = d/dτ + iφ',
  /// D³c = c''' + 3iφ'c'' + 3(iφ'' − φ'²)c' + (iφ''' − 3φ'φ'' − iφ'³)c.
  template <class Flight, class Bound>
  double third_bound(const Flight& flight, const Bound& bound, double reach) const {
    double speed = std::abs(rotor_->speed_ratio);
    double of_velocity = speed * speed;
    double of_position = speed * speed * speed;
    if constexpr (Blades::kMayRipple) {
      speed = blades_->speed_bound();
      const double change = blades_->angular_acceleration_bound();
      of_velocity = speed * speed + change;
      of_position = blades_->angular_jerk_bound() + 3.0 * speed * change + speed * speed * speed;
    }
    const double centre = position_bound(bound) + std::abs(rotor_->misalignment);
    const double velocity = velocity_bound(bound);
    const double second = flight.second_bound(bound);
    const double third = flight.third_bound(bound);
    const double turned = third + 3.0 * speed * second + 3.0 * of_velocity * velocity + of_position * centre;
    return 6.0 * velocity * second + 2.0 * centre * third + 2.0 * reach * turned;
  }

  const rotor::RotorConstants* rotor_;
  const Law* law_;
  const Blades* blades_;
  double turning_weight_;
  std::vector<double> clear_until_;
  std::optional<FlightRow> row_;
  // What was found along the flight, where it is kept: gaps row by row, and in them blade by blade.
  bool keeps_rows_ = false;
  rotor::State rows_state_ = rotor::State::Zero();  ///< of the shaft at the first of the rows
  std::vector<KeptRow> rows_;
  std::vector<FlightRow::Gaps> gaps_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace rubatlas::modes
