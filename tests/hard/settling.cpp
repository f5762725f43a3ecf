/// Transients that tempt a motion to settle where it will not stay (`protocol.settle`). Each is held against
/// the same motion run for thousands of revolutions: where a motion has settled, its cycle is where that
/// ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include "../support/point.hpp"
#include "integrate/decompositions.hpp"
#include "point/settling.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using motion::SectionState;
using settings::Settle;

/// The smallest period in which the last sections repeat within a distance, 0: none.
int period_of(const std::vector<double>& sections, double distance) {
  const std::size_t count = sections.size() / 4;
  for (std::size_t period = 1; period <= point::Settling::kLongestPeriod && 2 * period <= count; ++period) {
    double largest = 0.0;
    for (std::size_t i = 4 * period; i < sections.size(); ++i)
      largest = std::max(largest, std::abs(sections[i] - sections[i - 4 * period]));
    if (largest <= distance) return static_cast<int>(period);
  }
  return 0;
}

enum class Outcome { settled, ran_all, ended };

/// Where a motion has settled, it is on its cycle after thousands of revolutions more, section by section.
Outcome ends_where_it_settles(settings::Scene scene, double speed, const SectionState& start = {}) {
  constexpr int kFurther = 4000;  // about
  scene.observables = {"poincare"};
  scene.protocol = {200, 48, 64, Settle::newton};
  const auto settled = run(scene, speed, start);
  if (settled.status != PointStatus::done) return Outcome::ended;
  if (settled.settled == 0) return Outcome::ran_all;
  const int period = period_of(settled.rows[0], 0.0);
  EXPECT_GT(period, 0) << "a cycle repeats to the last bit";
  if (period == 0) return Outcome::settled;
  scene.protocol.settle = Settle::never;
  scene.protocol.transient_revolutions += kFurther / period * period;
  const auto whole = run(scene, speed, start);
  EXPECT_EQ(whole.status, PointStatus::done) << speed;
  if (whole.status != PointStatus::done) return Outcome::settled;
  // The errors of a period's revolutions add up on the cycle to their sum over 1 less the largest multiplier.
  SectionState section_on_cycle;
  std::copy_n(settled.rows[0].begin(), 4, section_on_cycle.begin());
  const auto map = solver_of(scene)->section_map(speed, section_on_cycle, period);
  const double largest = integrate::eigen_modes(map.jacobian).values.cwiseAbs().maxCoeff();
  EXPECT_LT(largest, 1.0) << speed;
  const double error =
      10.0 * period * scene.accuracy.tolerance * std::max(scene.clearance(), 1e-4) / (1.0 - largest);
  double difference = 0.0;
  for (std::size_t i = 0; i < whole.rows[0].size(); ++i)
    difference = std::max(difference, std::abs(whole.rows[0][i] - settled.rows[0][i]));
  EXPECT_LE(difference, error) << "speed " << speed << ", period " << period << ", multiplier " << largest
                               << ", settled after " << settled.settled;
  return Outcome::settled;
}

TEST(HardSettling, WhereAStableOrbitHasJustVanishedTheTransientIsRunOn) {
  // Grazing ends region 2 of the default rotor at 0.595437, a period doubling begins region 4 at 0.684037.
  for (const double border : {0.5954366724, 0.6840370978}) {
    for (const double distance : {-1e-3, -1e-4, -1e-6, 1e-6, 1e-4, 1e-3})
      ends_where_it_settles(default_rotor(1), border + distance);
  }
}

TEST(HardSettling, NextToAnUnstableOrbitAMotionLingersAndDoesNotSettleThere) {
  // Period 1 beyond its period doubling: the motion starts on the unstable orbit, to the last digits or
  // beside it.
  settings::Scene scene = default_rotor(1);
  scene.observables = {"poincare"};
  scene.protocol = {200, 16, 64, Settle::newton};
  const auto solver = solver_of(scene);
  // From rest nearer to it last digits decide whether a motion ends on this orbit or in chaos beside it.
  SectionState orbit{};
  for (const double speed : {0.66, 0.675, 0.682})
    orbit = solver->section_map(speed, orbit, 400).sections.back();
  for (const double beyond : {1e-4, 1e-3, 3e-3}) {
    const double speed = 0.6840370978 + beyond;
    for (int i = 0; i < 20; ++i) {
      const auto map = solver->section_map(speed, orbit, 1);
      ASSERT_FALSE(map.sections.empty());
      ASSERT_TRUE(map.differentiable);
      Eigen::Vector4d residual;
      for (std::size_t k = 0; k < 4; ++k)
        residual[static_cast<Eigen::Index>(k)] = map.sections[0][k] - orbit[k];
      const Eigen::Vector4d step = integrate::solve(Eigen::Matrix4d::Identity() - map.jacobian, residual);
      for (std::size_t k = 0; k < 4; ++k) orbit[k] += step[static_cast<Eigen::Index>(k)];
    }
    const auto map = solver->section_map(speed, orbit, 1);
    ASSERT_LE(largest_difference(map.sections[0], orbit), 1e-11) << "it is an orbit";
    ASSERT_GT(integrate::eigen_modes(map.jacobian).values.cwiseAbs().maxCoeff(), 1.0) << "and unstable";
    for (const double beside : {0.0, 1e-12, 1e-9, 1e-6}) {
      SectionState start = orbit;
      start[0] += beside;
      const auto outcome = run(scene, speed, start);
      ASSERT_EQ(outcome.status, PointStatus::done);
      if (outcome.settled == 0) continue;
      EXPECT_NE(period_of(outcome.rows[0], 0.0), 1)
          << "settled on the unstable orbit, from " << beside << " m beside it";
      ends_where_it_settles(scene, speed, start);
    }
  }
}

TEST(HardSettling, WithLittleDampingAMotionSettlesWhereItEnds) {
  int settled = 0;
  for (const double damping : {0.0, 0.005, 0.02}) {
    settings::Scene scene = default_rotor(1);
    scene.rotor.damping_ratio = damping;
    scene.contact.law = settings::ContactLaw::elastic_ring;
    scene.contact.friction = 0.05;
    for (const double speed : {0.12, 0.15, 0.21, 0.26, 0.33, 0.41, 0.45, 0.53, 0.62, 0.70, 0.75, 0.82})
      if (ends_where_it_settles(scene, speed) == Outcome::settled) ++settled;
  }
  EXPECT_GE(settled, 3);
  settings::Scene undamped = default_rotor(1);
  undamped.rotor.damping_ratio = 0.0;
  undamped.contact.friction = 0.0;
  undamped.protocol = {100, 20, 64, Settle::newton};
  for (const double speed : {0.21, 0.62}) EXPECT_EQ(run(undamped, speed).settled, 0) << "nothing contracts";
}

void expect_to_settle_from_all_over_the_basins(int starts) {
  std::mt19937 random(20161027);
  std::uniform_real_distribution<double> place(-8e-3, 8e-3);
  int settled = 0;
  for (const double speed : {0.235, 0.30, 0.36, 0.40, 0.62}) {
    for (int i = 0; i < starts; ++i) {
      settings::Scene scene = default_rotor(1);
      if (i % 2 == 1) scene.unbalance = effects::Unbalance{.moment = 1e-4};
      const SectionState start{place(random), place(random), place(random), place(random)};
      if (ends_where_it_settles(scene, speed, start) == Outcome::settled) ++settled;
    }
  }
  EXPECT_GT(settled, 5 * starts / 2);
}
TEST(HardSettling, FromAllOverItsBasinsARotorWithSeveralCyclesSettlesWhereItEnds) {
  expect_to_settle_from_all_over_the_basins(6);
}
TEST(HardSettlingSlow, FromAllOverItsBasinsARotorWithSeveralCyclesSettlesWhereItEnds) {
  expect_to_settle_from_all_over_the_basins(12);
}

void expect_to_settle_in_an_aligned_ring(int starts) {
  std::mt19937 random(86);
  std::uniform_real_distribution<double> place(-1.2e-2, 1.2e-2);
  int settled = 0;
  for (const int blades : {2, 3, 5}) {
    settings::Scene scene = default_rotor(1);
    scene.blades.count = blades;
    scene.rotor.misalignment = 0.0;
    scene.unbalance = effects::Unbalance{.moment = 4e-3};
    for (const double speed : {0.8, 0.85, 0.9}) {
      for (int i = 0; i < starts; ++i) {
        const SectionState start{place(random), place(random), place(random), place(random)};
        if (ends_where_it_settles(scene, speed, start) == Outcome::settled) ++settled;
      }
    }
  }
  EXPECT_GT(settled, 5 * starts / 2);
}
TEST(HardSettling, InAnAlignedRingWhereEachCycleTurnedByABladeIsAnotherAMotionSettlesWhereItEnds) {
  expect_to_settle_in_an_aligned_ring(2);
}
TEST(HardSettlingSlow, InAnAlignedRingWhereEachCycleTurnedByABladeIsAnotherAMotionSettlesWhereItEnds) {
  expect_to_settle_in_an_aligned_ring(4);
}

/// A point of any rotor whose flow is linearised by four numbers.
struct RandomPoint {
  settings::Scene scene;
  double speed;
  SectionState start;
};

RandomPoint random_point(std::mt19937_64& generator) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  const auto one_in = [&](int many) { return std::uniform_int_distribution<int>(1, many)(generator) == 1; };
  settings::Scene scene = default_rotor(1);
  if (one_in(3)) scene.contact.law = settings::ContactLaw::elastic_ring;
  scene.contact.friction = between(0.0, 0.4);
  scene.rotor.damping_ratio = std::pow(10.0, between(-2.3, -0.5));
  if (one_in(3)) scene.blades.count = std::uniform_int_distribution<int>(1, 7)(generator);
  if (one_in(3)) scene.unbalance = effects::Unbalance{.moment = std::pow(10.0, between(-6.0, -3.3))};
  switch (std::uniform_int_distribution<int>(0, 9)(generator)) {
    case 0:
      scene.gravity = effects::Gravity{.acceleration = between(0.0, 0.2)};
      break;
    case 1:
      scene.side_load = effects::SideLoad{.force = between(0.0, 0.3)};
      break;
    case 2:
      scene.support = effects::Support{.stiffness_xx = between(5.0, 30.0), .damping_yy = between(0.2, 2.0)};
      break;
    case 3:
      scene.regularised_friction = effects::RegularisedFriction{.velocity = between(0.01, 0.1)};
      break;
    case 4:
      scene.stribeck = effects::Stribeck{.static_friction = scene.contact.friction + between(0.0, 0.2),
                                         .velocity = between(0.1, 0.5),
                                         .regularising_velocity = between(0.02, 0.1)};
      break;
    case 5:
      scene.unequal_blades.emplace().length_spread = between(0.0, 2e-4);
      break;
    default:
      break;
  }
  constexpr double kFarthest = 8e-4;
  const auto component = [&] { return between(-kFarthest, kFarthest); };
  return {scene, between(0.05, 0.95), {component(), component(), component(), component()}};
}

void expect_random_points_to_end_where_they_settle(int points, int fewest_settled) {
  std::mt19937_64 generator(28);
  int settled = 0;
  for (int i = 0; i < points; ++i) {
    SCOPED_TRACE(::testing::Message() << "point " << i);
    const RandomPoint point = random_point(generator);
    if (ends_where_it_settles(point.scene, point.speed, point.start) == Outcome::settled) ++settled;
  }
  EXPECT_GE(settled, fewest_settled);
}

TEST(HardSettling, OfRandomRotorsAMotionSettlesWhereItEnds) {
  expect_random_points_to_end_where_they_settle(40, 12);
}

TEST(HardSettlingSlow, OfTwentyThousandRandomRotorsAMotionSettlesWhereItEnds) {
  expect_random_points_to_end_where_they_settle(20'000, 6'000);
}

TEST(HardSettling, UnderEachEffectWithALinearisedFlowAMotionSettlesWhereItEnds) {
  std::vector<settings::Scene> scenes(7, default_rotor(1));
  scenes[0].gravity = effects::Gravity{.acceleration = 0.05};
  scenes[1].support = effects::Support{.stiffness_xx = 20.0, .damping_yy = 0.5};
  scenes[2].ring_body = effects::RingBody{.mass = 0.5, .compliance = 1e-4, .damping = 3.0};
  scenes[3].regularised_friction = effects::RegularisedFriction{.velocity = 0.05};
  scenes[4].stribeck =
      effects::Stribeck{.static_friction = 0.3, .velocity = 0.5, .regularising_velocity = 0.1};
  scenes[5].unequal_blades = effects::UnequalBlades{
      .length_errors = {1e-4, 0.0, -2e-4}, .thickness_errors = {}, .angle_errors = {0.0, 0.02, -0.05}};
  scenes[6].contact.law = settings::ContactLaw::elastic_ring;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    int settled = 0;
    for (const double speed : {0.21, 0.30, 0.36, 0.41, 0.62, 0.66}) {
      SCOPED_TRACE(::testing::Message() << "scene " << i);
      if (i == 2) {  // whose cycles are those of eight numbers, of which a section map has four
        settings::Scene scene = scenes[i];
        scene.observables = {"poincare"};
        scene.protocol = {200, 48, 64, Settle::newton};
        const auto found = run(scene, speed);
        scene.protocol.settle = Settle::never;
        if (found.settled == 0) continue;
        ++settled;
        const int period = period_of(found.rows[0], 0.0);
        ASSERT_GT(period, 0);
        scene.protocol.transient_revolutions = 200 + 3800 / period * period;
        const auto late = run(scene, speed);
        for (std::size_t k = 0; k < late.rows[0].size(); ++k)
          EXPECT_NEAR(late.rows[0][k], found.rows[0][k], 1e-8 * scene.clearance()) << speed;
        ASSERT_EQ(found.final_memory.view().size(), 4U);
        for (std::size_t k = 0; k < 4; ++k)
          EXPECT_NEAR(late.final_memory.view()[k], found.final_memory.view()[k], 1e-8 * scene.clearance());
      } else if (ends_where_it_settles(scenes[i], speed) == Outcome::settled) {
        ++settled;
      }
    }
    EXPECT_GE(settled, 2) << "scene " << i;
  }
}

}  // namespace
}  // namespace rubatlas::test
