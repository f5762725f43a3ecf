/// A contact of an elastic blade has the same bits in registers of any width.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "blade/bending_table.hpp"
#include "blade/elastica_curve.hpp"
#include "collocation/interval.hpp"
#include "lone_contacts.hpp"

namespace rubatlas::test {
namespace {

/// The paper's machine with an unbalance, and one on which everything acts that a machine may have.
std::array<collocation::Machine, 2> plain_and_full_machine() {
  collocation::Machine plain = machine_at_ring();
  plain.forcing_count = 1;
  plain.frequency = {plain.speed_ratio};
  collocation::Machine full = plain;
  full.support = {false, {1.1, 0.2, -0.1, 0.8}, {0.2, 0.05, -0.05, 0.3}};
  full.forcing_count = 3;
  full.frequency = {0.37, 0.0, -1.2};
  full.ripple = {0.1, 1.1, 0.1 * 0.37 / 1.1};
  full.ring = {true, 9.0, 0.3, 0.02};
  return {plain, full};
}

void expect_same_bits_of_interval(const collocation::Machine& machine, const collocation::Interval& first) {
  using namespace collocation;
  Interval in_pairs = first;
  Interval here = first;
  const Closeness closeness{1e-12, false};
  ASSERT_TRUE(solver_in_pairs().solve(machine, closeness, in_pairs));
  ASSERT_TRUE(interval_solver().solve(machine, closeness, here));
  EXPECT_GT(here.argument.at_end(), 0.2);
  EXPECT_EQ(in_pairs.sweeps, here.sweeps);
  const auto same = [](const AtNodes& a, const AtNodes& b) {
    return std::memcmp(a.value.data(), b.value.data(), sizeof a.value) == 0;
  };
  const auto same_body = [&](const Body& a, const Body& b) {
    return same(a.x, b.x) && same(a.vy, b.vy) && same(a.ax, b.ax);
  };
  EXPECT_TRUE(same_body(in_pairs.shaft, here.shaft) && same_body(in_pairs.ring, here.ring));
  EXPECT_TRUE(same(in_pairs.argument, here.argument) && same(in_pairs.elapsed, here.elapsed));
  EXPECT_TRUE(same(in_pairs.angular_speed, here.angular_speed));
  EXPECT_TRUE(same(in_pairs.leader().gap_measure, here.leader().gap_measure) &&
              same(in_pairs.leader().slip_velocity, here.leader().slip_velocity));
  EXPECT_TRUE(same(in_pairs.coefficients, here.coefficients));
  for (std::size_t k = 1; k < here.tips.size(); ++k) {
    EXPECT_TRUE(same(in_pairs.tips[k].square, here.tips[k].square));
    for (std::size_t i = 0; i < kNodes; ++i)
      EXPECT_NEAR(here.tips[k].square[i], here.argument[i] * here.argument[i], 1e-9) << i;
  }
  Bounds of_pairs{};
  Bounds of_here{};
  solver_in_pairs().bounds(machine, in_pairs, of_pairs);
  interval_solver().bounds(machine, here, of_here);
  EXPECT_EQ(of_pairs, of_here);
  EXPECT_EQ(solver_in_pairs().largest_displacement(in_pairs), interval_solver().largest_displacement(here));
  const AtPlaces arguments = at_places(here.start_argument, here.argument);
  EXPECT_EQ(solver_in_pairs().upper_bound(arguments), interval_solver().upper_bound(arguments));
  const collocation::Blade& blade = *first.leader().blade;
  const std::array<double, 2> other{-0.5, 0.866};
  EXPECT_EQ(solver_in_pairs().largest_gap(machine, in_pairs, blade, other),
            interval_solver().largest_gap(machine, here, blade, other));
}

TEST(ContactArc, HasTheSameBitsOnEveryProcessor) {
  using namespace collocation;
  const blade::ElasticaCurve curve(0.1);
  const blade::BendingTable table(curve);
  const double thickness = 1e-3;
  const auto machines = plain_and_full_machine();
  for (const collocation::Machine& machine : machines) {
    const bool full = machine.ring.moves;
    const Blade blade{.table = &table,
                      .reach = 0.1,
                      .closing = -0.0021,
                      .length = 0.1,
                      .load_unit = 206e9 * 0.01 * thickness * thickness * thickness / 12.0 / 0.01,
                      .strain_unit = 0.5 * thickness / 0.1,
                      .friction = 0.1,
                      .yield_unit = full ? 1e-4 : 0.0,
                      .first_shortening = full ? 0.01 : 0.0,
                      .first_yielding = full ? 0.02 : 0.0};
    Interval first = interval_at_ring(machine.misalignment, blade);
    first.forcing[0] = {1e-5, -2e-5};
    first.forcing[1] = {-1e-5, 1e-5};
    first.forcing[2] = {2e-5, 1e-5};
    first.ripple = {0.6, 0.8};
    {
      SCOPED_TRACE("alone: the last sweeps keep their slopes");
      expect_same_bits_of_interval(machine, first);
    }
    SCOPED_TRACE("with a further blade in the same place, and just so bent");
    first.tips.push_back(first.leader());
    for (std::size_t i = 0; i < kNodes; ++i) first.tips[1].square[i] = 0.05 * kNodeTables.node[i];
    expect_same_bits_of_interval(machine, first);
  }
}

}  // namespace
}  // namespace rubatlas::test
