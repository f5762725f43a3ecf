#include "collocation/blades_in_contact.hpp"

#include <algorithm>
#include <cmath>

#include "blade/bending_table.hpp"

namespace rubatlas::collocation {

Course course_at_end(const Interval& made, const AtNodes& nodes) {
  constexpr std::size_t kLast = kNodes - 1;
  const auto slope = [&](std::size_t node) {
    return (nodes[node + 1] - nodes[node]) / (made.elapsed[node + 1] - made.elapsed[node]);
  };
  const double before = slope(kLast - 2);
  const double after = slope(kLast - 1);
  const double half_curvature = (after - before) / (made.elapsed[kLast] - made.elapsed[kLast - 2]);
  return {nodes.at_end(), after + half_curvature * (made.elapsed[kLast] - made.elapsed[kLast - 1]),
          half_curvature};
}

void go_on(const Interval& made, const TipInTime& tip, bool further, BladeStart& start) {
  start.start_gap = tip.gap.at_end();
  start.start_gap_measure = tip.gap_measure.at_end();
  start.at_start.slip_velocity = tip.slip_velocity.at_end();
  start.at_start.normal = tip.normal_force.at_end();
  start.at_start.root_strain = tip.root_strain.at_end();
  start.start_lean = tip.lean.at_end();
  start.at_start.shortening = tip.shortening.at_end();
  start.start_chart_left = tip.chart_left.at_end();
  start.start_cone_left = tip.cone_left.at_end();
  start.start_yielding = tip.yielding.at_end();
  if (!further) return;
  start.square = course_at_end(made, tip.square);
  start.start_square = start.square.value;
  if (start.load != nullptr) start.lean = course_at_end(made, tip.lean);
}

namespace {

/// p² of a blade that bends from zero, where p² would have grown to this if the deflection went on to grow
/// as p² does next to the unbent blade. It grows more with little friction, as exp p.
double square_of_deflection(const blade::BendingTable& table, double square) {
  const std::vector<blade::BendingTable::Knot>& knots = table.knots();
  const auto square_at = [&](std::size_t k) { return knots[k].argument * knots[k].argument; };
  if (knots.size() == 1 || !(square > square_at(0))) return square;
  const double deflection = square / square_at(0) * knots[0].deflection;
  std::size_t next = 1;
  while (next + 1 < knots.size() && knots[next].deflection < deflection) ++next;
  const double share =
      (deflection - knots[next - 1].deflection) / (knots[next].deflection - knots[next - 1].deflection);
  return std::lerp(square_at(next - 1), square_at(next), std::clamp(share, 0.0, 1.0));
}

}  // namespace

AtNodes guessed_times(const Interval& next) {
  AtNodes elapsed;
  const AtNodes& node = kNodeTables.node;
  for (std::size_t i = 0; i < kNodes; ++i)
    elapsed[i] = node[i] * next.chord.time + next.deviation[i] * next.normal.time;
  return elapsed;
}

void guess(const BladeStart& start, const AtNodes& elapsed, TipInTime& tip) {
  constexpr double kLeast = 1e-24;      // p²
  constexpr double kLeastShare = 0.01;  // of that at the start
  for (std::size_t i = 0; i < kNodes; ++i)
    tip.square[i] = std::max({start.square.after(elapsed[i]), kLeastShare * start.start_square, kLeast});
  if (start.load != nullptr) {
    for (std::size_t i = 0; i < kNodes; ++i) tip.lean[i] = start.lean.after(elapsed[i]);
  } else if (!(start.start_square > 0.0) && start.blade->table != nullptr) {
    for (double& square : tip.square.value) square = square_of_deflection(*start.blade->table, square);
  }
}

}  // namespace rubatlas::collocation
