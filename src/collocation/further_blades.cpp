#include "collocation/further_blades.hpp"

#include <algorithm>
#include <cmath>

#include "blade/bending_table.hpp"

namespace rubatlas::collocation {

double deflection_per_square(const contact::ElasticaContact& law) {
  constexpr double kUnbent = 0.01;  // p at which Δ ~ p² holds
  const double bending = law.curve().over_asinh().bending(kUnbent);
  return law.length() * law.curve().at(bending).deflection / (kUnbent * kUnbent);
}

FurtherStart further_start(const contact::ElasticaContact& law, const contact::Pose& pose, const Touch& touch,
                           double angular_speed) {
  const blade::BendingTable& table = law.curve().over_asinh();
  const auto there = law.constraint(pose, touch.slip, touch.bending, angular_speed);
  const double gap_measure = law.gap_per_deflection(pose, touch.slip, touch.bending);
  const double argument = table.argument(touch.bending);
  double rate = 0.0;
  if (touch.bending > 0.0) {
    rate = -2.0 * argument * there.time_slope / (there.bending_slope * table.bending_slope_at(touch.bending));
  } else {
    // Where the blade begins to bend, g = 2 s ct Δ, with Δ ~ p².
    rate =
        contact::gap_rate(law.geometry(), pose, angular_speed) / (gap_measure * deflection_per_square(law));
  }
  return {.blade = touch.blade,
          .slip = touch.slip,
          .square = argument * argument,
          .rate = rate,
          .gap_measure = gap_measure,
          .slip_velocity = there.force.slip_velocity,
          .force = there.force};
}

void go_on(const Interval& made, const FurtherBlade& blade, FurtherStart& start) {
  constexpr std::size_t kLast = kNodes - 1;
  const auto slope = [&](std::size_t node) {
    return (blade.square[node + 1] - blade.square[node]) / (made.elapsed[node + 1] - made.elapsed[node]);
  };
  const double before = slope(kLast - 2);
  const double after = slope(kLast - 1);
  const double apart = made.elapsed[kLast] - made.elapsed[kLast - 2];
  start.half_curvature = (after - before) / apart;
  start.rate = after + start.half_curvature * (made.elapsed[kLast] - made.elapsed[kLast - 1]);
  start.square = blade.square.at_end();
  start.gap_measure = blade.gap_measure.at_end();
  start.slip_velocity = blade.slip_velocity.at_end();
}

void guess(const FurtherStart& start, const AtNodes& elapsed, FurtherBlade& blade) {
  blade.offset = start.offset;
  blade.slip = start.slip;
  blade.start_square = start.square;
  blade.start_gap_measure = start.gap_measure;
  blade.start_slip_velocity = start.slip_velocity;
  constexpr double kLeast = 1e-8;       // p²
  constexpr double kLeastShare = 0.01;  // of that at the start
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double later = start.square + elapsed[i] * (start.rate + elapsed[i] * start.half_curvature);
    blade.square[i] = std::max({later, kLeastShare * start.square, kLeast});
  }
}

}  // namespace rubatlas::collocation
