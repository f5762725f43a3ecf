/// Bounds of what changes within an interval (`interval.hpp`), by Bernstein's coefficients of the polynomials
/// through the start and the nodes. As the sweeps, compiled once for each kind of processor.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"

namespace rubatlas::collocation {
namespace {

template <std::size_t kWidth>
class IntervalBounds {
 public:
  static void bounds(const Machine& machine, const Interval& in, Bounds& result) {
    const TipInTime& leader = in.leader();
    const Number gap_measure(leader.gap_measure);
    result.gap_measure = leader.start_gap_measure - change(leader.start_gap_measure, gap_measure);
    if (!(result.gap_measure > 0.0))
      result.gap_measure = later(leader.start_gap_measure, gap_measure).least();
    const Place<double> start = start_from_ring(machine, in);
    const Place<Number> nodes = from_ring(machine, in);
    result.moved = root_of_squares(change(start.x, nodes.x), change(start.y, nodes.y));
    result.latest = Number(in.elapsed).largest();
    result.distance = root_of_squares(start.x, start.y) + result.moved;
    if (!(result.distance < machine.ring_radius))
      result.distance =
          root_of_squares(largest_magnitude(start.x, nodes.x), largest_magnitude(start.y, nodes.y));
    result.cone_left = std::numeric_limits<double>::infinity();
    result.tips.resize(in.tips.size());
    for (std::size_t k = 0; k < in.tips.size(); ++k) {
      const TipInTime& tip = in.tips[k];
      if (tip.slip == 0.0 || tip.straight || tip.skims)
        result.cone_left = std::min(result.cone_left, least_left(tip.start_cone_left, tip.cone_left));
      Bounds::OfTip& of_tip = result.tips[k];
      const Number slip_velocity(tip.slip_velocity);
      of_tip.slip_velocity =
          std::abs(tip.at_start.slip_velocity) - change(tip.at_start.slip_velocity, slip_velocity);
      if (!(of_tip.slip_velocity > 0.0))
        of_tip.slip_velocity = least_magnitude(tip.at_start.slip_velocity, slip_velocity);
      const Number shortening(tip.shortening);
      of_tip.shortening = tip.at_start.shortening + change(tip.at_start.shortening, shortening);
      if (!(of_tip.shortening < tip.blade->valid_shortening))
        of_tip.shortening = largest(tip.at_start.shortening, shortening);
      of_tip.stays = k == 0 || stays(tip);
    }
    if (in.leans()) inclined_bounds(in, result);
  }

  /// Those of blades under an inclined load besides.
  static void inclined_bounds(const Interval& in, Bounds& result) {
    result.chart_left = least_left(in.leader().start_chart_left, in.leader().chart_left);
    for (std::size_t k = 1; k < in.tips.size(); ++k) {
      const TipInTime& tip = in.tips[k];
      // The chart of a slipping tip ends only where the lean is negative. What is left of it begins like a
      // root of the time.
      const bool in_chart = (tip.slip != 0.0 && least(tip.start_lean, Number(tip.lean)) > 0.0) ||
                            least(tip.start_chart_left, Number(tip.chart_left)) > 0.0;
      result.tips[k].stays = result.tips[k].stays && in_chart && least_firmness(tip) > 0.0;
    }
    const double slope = sum_of_products(kNodeTables.value_at_start, in.time_slope);
    result.time_slope = least_before_end(later(slope, Number(in.time_slope)));
    if (in.start_argument > 0.0) result.time_slope = std::min(result.time_slope, slope);
  }

  static double gap(const Machine& machine, const Interval& in, const Blade& blade,
                    const std::array<double, 2>& offset) {
    // Of the tip of a straight blade (MODEL 2); `x, y`: er of the leading one.
    const auto gap_of = [&](const auto& shaft, const auto& x, const auto& y) {
      const auto er_x = x * offset[0] - y * offset[1];
      const auto er_y = y * offset[0] + x * offset[1];
      return (shaft.x * shaft.x + shaft.y * shaft.y) +
             ((shaft.x * er_x + shaft.y * er_y) * (2.0 * blade.reach) + blade.closing);
    };
    const double start = gap_of(start_from_ring(machine, in), in.blade[0], in.blade[1]);
    return later(start, gap_of(from_ring(machine, in), Number(in.blade_x), Number(in.blade_y))).largest();
  }

  [[nodiscard]] static double largest_displacement(const Interval& in) {
    return root_of_squares(largest_magnitude(in.shaft.start[0], Number(in.shaft.x)),
                           largest_magnitude(in.shaft.start[1], Number(in.shaft.y)));
  }

  static double upper_bound(const AtPlaces& values) {
    AtNodes nodes;
    std::copy(values.begin() + 1, values.end(), nodes.value.begin());
    return largest(values[0], Number(nodes));
  }

 private:
  using Number = Lanes<kWidth>;

  static double root_of_squares(double x, double y) { return std::sqrt(x * x + y * y); }

  /// Shaft from the ring's centre, at the start and at the nodes.
  template <class Value>
  struct Place {
    Value x, y;
  };
  static Place<double> start_from_ring(const Machine& machine, const Interval& in) {
    return {in.shaft.start[0] - in.ring.start[0],
            in.shaft.start[1] - in.ring.start[1] + machine.misalignment};
  }
  static Place<Number> from_ring(const Machine& machine, const Interval& in) {
    if (!machine.ring.moves) return {Number(in.shaft.x), Number(in.shaft.y) + machine.misalignment};
    return {Number(in.shaft.x) - Number(in.ring.x),
            Number(in.shaft.y) - Number(in.ring.y) + machine.misalignment};
  }
  /// Coefficients 1 to 8; coefficient 0 is the value at the start.
  static Number later(double start, const Number& at_nodes) {
    return Number::combined(kNodeTables.bernstein, at_nodes) + Number(kNodeTables.bernstein_of_start) * start;
  }
  /// How far it goes from the start.
  static double change(double start, const Number& at_nodes) {
    return kFarther * magnitude(at_nodes - start).largest();
  }
  /// Of coefficients 1 to 7.
  static double least_before_end(const Number& coefficients) {
    AtNodes each;
    coefficients.store(each);
    return *std::min_element(each.value.begin(), each.value.end() - 1);
  }
  /// The least of what is left of a guard's quantity; where it ends the interval it is zero at the end.
  static double least_left(double start, const AtNodes& left) {
    return std::min(start, least_before_end(later(start, Number(left))));
  }
  static double least(double start, const Number& at_nodes) {
    return std::min(start, later(start, at_nodes).least());
  }
  /// Whether a further blade stays bent, and on its branch.
  static bool stays(const TipInTime& tip) {
    const double left = tip.blade->held_beyond_ring && !tip.straight
                            ? least_firmness(tip)
                            : later(tip.start_gap_measure, Number(tip.gap_measure)).least();
    return !tip.lifts_off && later(tip.start_square, Number(tip.square)).least() > 0.0 && left > 0.0;
  }
  static double least_firmness(const TipInTime& tip) {
    return least(sum_of_products(kNodeTables.value_at_start, tip.firmness), Number(tip.firmness));
  }
  /// Positive where it keeps the sign that it has at the start.
  static double least_magnitude(double start, const Number& at_nodes) {
    return least(std::abs(start), at_nodes * std::copysign(1.0, start));
  }
  static double largest(double start, const Number& at_nodes) {
    return std::max(start, later(start, at_nodes).largest());
  }
  static double largest_magnitude(double start, const Number& at_nodes) {
    return std::max(std::abs(start), magnitude(later(start, at_nodes)).largest());
  }
};

}  // namespace
}  // namespace rubatlas::collocation
