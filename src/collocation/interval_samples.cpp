#include "collocation/interval_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "integrate/newton_between.hpp"
#include "integrate/root_between.hpp"

namespace rubatlas::collocation {

double fraction_at(const Interval& interval, double elapsed) {
  if (elapsed <= 0.0) return 0.0;
  if (elapsed >= interval.elapsed.at_end()) return 1.0;
  const AtPlaces reached = at_places(0.0, interval.elapsed);
  std::size_t place = 1;
  while (reached[place] < elapsed) ++place;
  const AtPlaces& at = kNodeTables.place;
  constexpr double kClosest = 1e-7;  // [θ]: Newton's method ends with a step below it, and errs by its square
  // Of the places around it the polynomial is close to a line.
  const double share = (elapsed - reached[place - 1]) / (reached[place] - reached[place - 1]);
  const auto late = [&](double fraction) {
    return integrate::ValueAndSlope{sum_of_products(basis_at(fraction), reached) - elapsed,
                                    sum_of_products(slope_basis_at(fraction), interval.time_slope)};
  };
  return integrate::newton_between(late, at[place - 1], at[place],
                                   at[place - 1] + share * (at[place] - at[place - 1]), true, kClosest);
}

integrate::Sample largest_of(const AtPlaces& values, double from, double to, double known) {
  const auto value = [&](double fraction) { return sum_of_products(basis_at(fraction), values); };
  const AtPlaces& at = kNodeTables.place;
  std::array<integrate::Sample, kPlaces> samples{};
  std::size_t count = 0;
  const auto take = [&](double fraction, double there) { samples[count++] = {fraction, there}; };
  take(from, from > 0.0 ? value(from) : values.front());
  for (std::size_t i = 1; i < kNodes; ++i) {
    if (from < at[i] && at[i] < to) take(at[i], values[i]);
  }
  const double middle = 0.5 * (from + to);
  if (count == 1) take(middle, value(middle));
  take(to, to < 1.0 ? value(to) : values.back());
  return integrate::largest_value(value, std::span(samples).first(count), known);
}

double crossing(const AtPlaces& values, std::size_t place) {
  const AtPlaces& at = kNodeTables.place;
  const auto value = [&](double fraction) { return sum_of_products(basis_at(fraction), values); };
  if (place == 1 && values[0] <= std::numeric_limits<double>::min()) {
    // It starts at zero, or at the least positive number (`ContactArc::set_out`), and rises from there.
    const auto mean = [&](double fraction) { return (value(fraction) - values[0]) / fraction; };
    return integrate::root_between(mean, 0.0, at[1], std::abs(mean(at[1])), mean(at[1]));
  }
  return integrate::root_between(value, at[place - 1], at[place], values[place - 1], values[place]);
}

integrate::Sample farthest(const Interval& interval, double from, double to) {
  const Body& body = interval.shaft;
  const AtPlaces x = at_places(body.start[0], body.x);
  const AtPlaces y = at_places(body.start[1], body.y);
  const AtPlaces vx = at_places(body.start[2], body.vx);
  const AtPlaces vy = at_places(body.start[3], body.vy);
  AtPlaces squares, rates;  // |z|², and half of its rate by τ
  for (std::size_t i = 0; i < kPlaces; ++i) {
    squares[i] = x[i] * x[i] + y[i] * y[i];
    rates[i] = x[i] * vx[i] + y[i] * vy[i];
  }
  integrate::Sample most{from, sum_of_products(basis_at(from), squares)};
  const auto take = [&](double fraction) {
    if (!(from < fraction && fraction <= to)) return;
    const double square = sum_of_products(basis_at(fraction), squares);
    if (square > most.value) most = {fraction, square};
  };
  take(to);
  for (std::size_t i = 1; i < kPlaces; ++i) {
    take(kNodeTables.place[i]);
    if (rates[i - 1] > 0.0 && rates[i] < 0.0) take(crossing(rates, i));
  }
  return {most.argument, std::sqrt(most.value)};
}

TipCourse course_of_tip(const Machine& machine, const Interval& interval, const Blade& blade,
                        const std::array<double, 2>& offset) {
  TipCourse course;
  const auto set = [&](std::size_t place, double x, double y, double vx, double vy, double leader_x,
                       double leader_y, double angular_speed) {
    y += machine.misalignment;
    const double er_x = leader_x * offset[0] - leader_y * offset[1];
    const double er_y = leader_y * offset[0] + leader_x * offset[1];
    course.gap[place] = x * x + y * y + 2.0 * blade.reach * (x * er_x + y * er_y) + blade.closing;
    // c·c' + (rh + L)(c'·er + φ' c·et)
    course.rate[place] =
        x * vx + y * vy + blade.reach * (vx * er_x + vy * er_y + angular_speed * (y * er_x - x * er_y));
  };
  const Body& shaft = interval.shaft;
  const Body& ring = interval.ring;
  const auto seen = [&](std::size_t i) { return shaft.start[i] - ring.start[i]; };
  set(0, seen(0), seen(1), seen(2), seen(3), interval.blade[0], interval.blade[1],
      interval.start_angular_speed);
  for (std::size_t i = 0; i < kNodes; ++i)
    set(i + 1, shaft.x[i] - ring.x[i], shaft.y[i] - ring.y[i], shaft.vx[i] - ring.vx[i],
        shaft.vy[i] - ring.vy[i], interval.blade_x[i], interval.blade_y[i], interval.angular_speed[i]);
  return course;
}

std::optional<integrate::Sample> top_of(const TipCourse& tip) {
  for (std::size_t i = 1; i < kPlaces; ++i) {
    if (!(tip.rate[i - 1] > 0.0 && tip.rate[i] <= 0.0)) continue;
    const double fraction = crossing(tip.rate, i);
    return integrate::Sample{fraction, sum_of_products(basis_at(fraction), tip.gap)};
  }
  return std::nullopt;
}

}  // namespace rubatlas::collocation
