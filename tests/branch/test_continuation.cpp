/// Periodic orbits followed along a quantity, and the bifurcations on the way.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <vector>

#include "../support/point.hpp"
#include "branch/bifurcations.hpp"
#include "branch/continuation.hpp"
#include "integrate/decompositions.hpp"
#include "plan/grid.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::test {
namespace {

using branch::EventKind;

settings::Scene followed_rotor() {
  settings::Scene scene = settings::parse_scene(R"({"grid": {"speed_ratio": 0.5}})", "the default rotor");
  scene.accuracy.tolerance = 1e-12;
  scene.observables.clear();
  return scene;
}

branch::GoOn up_to(std::size_t orbits) {
  return [orbits](std::size_t count, const branch::Orbit& /*last*/) { return count < orbits; };
}

/// Along the speed ratio from one value to the other.
struct AlongSpeed {
  AlongSpeed(const settings::Scene& scene, double from, double to)
      : shooting(scene, parameters(scene, from),
                 {{settings::axes_of(scene).size() - 1, 0.1 * from, std::min(from, to), std::max(from, to)}}),
        continuation(shooting),
        start(continuation.settle({}, {from}, 300)),
        branch(start ? continuation.follow(*start, to > from ? 1.0 : -1.0, up_to(500)) : branch::Branch{}) {}

  static std::vector<double> parameters(const settings::Scene& scene, double speed) {
    std::vector<double> values;
    for (const auto& axis : settings::axes_of(scene)) values.push_back(axis.values.front());
    values.back() = speed;
    return values;
  }

  branch::Shooting shooting;
  branch::Continuation continuation;
  std::optional<branch::Orbit> start;
  branch::Branch branch;
};

TEST(Branch, HoldsOrbitsThatCloseAndContractByDampingAlone) {
  const settings::Scene scene = followed_rotor();
  const AlongSpeed along(scene, 0.42, 0.36);
  ASSERT_TRUE(along.start);
  EXPECT_EQ(along.start->period, 1);
  ASSERT_GT(along.branch.orbits.size(), 3U);
  EXPECT_NEAR(along.branch.orbits.front().quantities[0], 0.42, 1e-15);
  EXPECT_NEAR(along.branch.orbits.back().quantities[0], 0.36, 1e-12);
  for (const branch::Orbit& orbit : along.branch.orbits) {
    const auto& end = orbit.map.sections.back();
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(end[i], orbit.section[i], 2e-12 * 0.01);
    const double duration = 2.0 * std::numbers::pi / orbit.quantities[0];
    const double determinant = std::exp(-4.0 * scene.rotor.damping_ratio * duration);
    EXPECT_NEAR(std::abs(orbit.multipliers.prod()) / determinant, 1.0, 1e-6);
    EXPECT_TRUE(orbit.is_stable());
  }
}

TEST(Branch, OfThePeriodOneMotionBelowRegionTwoEndsByGrazingOnTheRecedingSide) {
  const AlongSpeed along(followed_rotor(), 0.42, 0.46);
  ASSERT_TRUE(along.start);
  const auto grazing = std::ranges::find(along.branch.events, EventKind::grazing, &branch::Event::kind);
  ASSERT_NE(grazing, along.branch.events.end());
  EXPECT_GT(grazing->orbit.quantities[0], 0.439) << "simulations are periodic there";
  EXPECT_LT(grazing->orbit.quantities[0], 0.440) << "and no longer there";
  EXPECT_EQ(grazing->side, observables::GrazingSide::receding);
  EXPECT_LT(grazing->uncertainty, 1e-8);
}

/// A stretch of orbits of which every one closes.
void expect_closed_orbits(const branch::Branch& branch) {
  for (const branch::Orbit& orbit : branch.orbits) {
    const auto& end = orbit.map.sections.back();
    // The rounding of the section grows along an unstable orbit.
    const double growth = std::max(1.0, 1e-2 * orbit.map.jacobian.norm());
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(end[i], orbit.section[i], 2e-12 * 0.01 * growth);
  }
}

TEST(Branch, GoesOnThroughAGrazingOnTheApproachingSideAndAroundTheFoldBehindIt) {
  // Near 1/3 the motion doubles its period, unstable orbits go on through a grazing and turn back right
  // behind.
  const AlongSpeed below(followed_rotor(), 0.29, 0.34);
  ASSERT_TRUE(below.start);
  expect_closed_orbits(below.branch);
  std::vector<EventKind> kinds;
  kinds.reserve(below.branch.events.size());
  for (const auto& event : below.branch.events) kinds.push_back(event.kind);
  ASSERT_GE(kinds.size(), 4U);
  EXPECT_EQ((std::vector<EventKind>(kinds.begin(), kinds.begin() + 4)),
            (std::vector<EventKind>{EventKind::period_doubling, EventKind::period_doubling,
                                    EventKind::grazing, EventKind::fold}));
  const auto& events = below.branch.events;
  EXPECT_EQ(events[2].side, observables::GrazingSide::approaching);
  const double grazing = events[2].orbit.quantities[0];
  const double fold = events[3].orbit.quantities[0];
  EXPECT_GT(fold, grazing);
  EXPECT_LT(fold - grazing, 1e-5);
  EXPECT_NEAR(events[3].orbit.multipliers[0].real(), 1.0, 1e-3) << "at a fold a multiplier is one";
  const auto farthest = std::ranges::max_element(
      below.branch.orbits, {}, [](const branch::Orbit& orbit) { return orbit.quantities[0]; });
  EXPECT_LE(farthest->quantities[0], fold + 1e-12) << "no orbit beyond the fold";
  EXPECT_LT(below.branch.orbits.back().quantities[0], fold) << "the branch has turned back";
}

TEST(Branch, GoesOnBehindAGrazingOnTheRecedingSideWithTheContactThatBeginsThere) {
  const AlongSpeed along(followed_rotor(), 0.42, 0.46);
  ASSERT_TRUE(along.start);
  const auto grazing = std::ranges::find(along.branch.events, EventKind::grazing, &branch::Event::kind);
  ASSERT_NE(grazing, along.branch.events.end());
  const double speed = grazing->orbit.quantities[0];
  const auto touches = [](const branch::Orbit& orbit) {
    return orbit.cuts * std::ranges::count_if(orbit.map.events, [](int event) { return event > 0; });
  };
  const auto before = touches(along.branch.orbits.front());
  const auto first = std::ranges::find_if(
      along.branch.orbits, [&](const branch::Orbit& orbit) { return touches(orbit) > before; });
  ASSERT_NE(first, along.branch.orbits.end());
  EXPECT_EQ(touches(*first), before + 3) << "all blades graze at once, since they are alike";
  EXPECT_NEAR(first->quantities[0], speed, 1e-4);
  EXPECT_GT(std::abs(first->multipliers[0]), 100.0) << "the square root of a light touch";
  EXPECT_GT(along.branch.orbits.end() - first, 10) << "and on from there";
  // Each of them is a motion of the rotor: from its section all touch-downs follow, and it closes, as far as
  // the rounding of the section allows.
  const auto solver = solver_of(followed_rotor());
  int compared = 0;
  for (auto orbit = first; orbit != along.branch.orbits.end(); ++orbit) {
    const auto map = solver->section_map(orbit->quantities[0], orbit->section, orbit->period);
    const double growth = map.jacobian.norm();
    if (!orbit->admissible || growth > 1e6) continue;
    ++compared;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(map.sections.back()[i], orbit->section[i], 1e-11 * 0.01 * growth) << orbit->quantities[0];
    EXPECT_EQ(std::ranges::count_if(map.events, [](int event) { return event > 0; }), touches(*orbit));
  }
  EXPECT_GT(compared, 8);
}

TEST(Branch, OfPeriodTwoEndsWhereThePeriodOneMotionDoublesItsPeriod) {
  settings::Scene scene = followed_rotor();
  scene.grid.damping_ratio = {0.2};
  const AlongSpeed two(scene, 0.24, 0.225);
  ASSERT_TRUE(two.start);
  EXPECT_EQ(two.start->period, 2);
  ASSERT_FALSE(two.branch.events.empty());
  const branch::Event& end = two.branch.events.back();
  EXPECT_EQ(end.kind, EventKind::period_doubling);
  EXPECT_EQ(end.orbit.period, 1);
  EXPECT_LT(two.branch.orbits.back().quantities[0], end.orbit.quantities[0]) << "it has not turned back";
  const AlongSpeed one(scene, 0.225, 0.235);
  ASSERT_TRUE(one.start);
  const auto doubling =
      std::ranges::find(one.branch.events, EventKind::period_doubling, &branch::Event::kind);
  ASSERT_NE(doubling, one.branch.events.end());
  EXPECT_NEAR(end.orbit.quantities[0], doubling->orbit.quantities[0], 1e-10);
}

TEST(Branch, OfTwoBladesDoublesWhereTheMotionNoLongerRepeatsItselfAtEachPassing) {
  settings::Scene scene = followed_rotor();
  scene.blades.count = 2;
  AlongSpeed one(scene, 1.005, 1.03);
  ASSERT_TRUE(one.start);
  EXPECT_EQ(one.start->passings, 1);
  ASSERT_EQ(one.branch.events.size(), 1U);
  const branch::Event& doubling = one.branch.events.front();
  EXPECT_EQ(doubling.kind, EventKind::period_doubling);
  EXPECT_NEAR(doubling.orbit.quantities[0], 1.014434463, 1e-8);
  EXPECT_NEAR(std::abs(doubling.orbit.multipliers[0] - 1.0), 0.0, 1e-7) << "(-1)² over the revolution";
  for (const branch::Orbit& orbit : one.branch.orbits)
    EXPECT_EQ(orbit.is_stable(), orbit.quantities[0] < doubling.orbit.quantities[0]);

  const auto doubled = one.continuation.follow_doubled(doubling, up_to(5));
  ASSERT_TRUE(doubled && !doubled->orbits.empty());
  const branch::Orbit& first = doubled->orbits.front();
  EXPECT_EQ(first.passings, 2);
  EXPECT_EQ(first.period, 1);
  EXPECT_NEAR(first.quantities[0], doubling.orbit.quantities[0], 1e-4);

  const AlongSpeed two(scene, 1.0155, 1.01);
  ASSERT_TRUE(two.start);
  EXPECT_EQ(two.start->passings, 2) << "simulations have class 2 per passing there";
  ASSERT_FALSE(two.branch.events.empty());
  const branch::Event& end = two.branch.events.back();
  EXPECT_EQ(end.kind, EventKind::period_doubling);
  EXPECT_EQ(end.orbit.passings, 1);
  EXPECT_NEAR(end.orbit.quantities[0], doubling.orbit.quantities[0], 1e-10);
}

TEST(Branch, OfAnEvenNumberOfBladesIsTheSameMotionOverWholeRevolutions) {
  for (const auto& [count, from, to] : {std::tuple{2, 0.5, 0.72}, std::tuple{4, 0.512, 0.519}}) {
    settings::Scene scene = followed_rotor();
    scene.blades.count = count;
    const AlongSpeed along(scene, from, to);
    ASSERT_TRUE(along.start);
    EXPECT_LT(along.start->passings, count);
    EXPECT_FALSE(along.branch.events.empty()) << "a grazing, a doubling";
    const auto solver = solver_of(scene);
    int compared = 0;
    for (const branch::Orbit& orbit : along.branch.orbits) {
      const auto map = solver->section_map(orbit.quantities[0], orbit.section, orbit.period);
      const double growth = std::max(1.0, map.jacobian.norm());
      if (!orbit.admissible || growth > 1e6) continue;
      ++compared;
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(map.sections.back()[i], orbit.section[i], 1e-11 * 0.01 * growth) << orbit.quantities[0];
      const auto values = integrate::eigen_modes(map.jacobian).values;
      const double largest = values.cwiseAbs().maxCoeff();
      // Beside a grazing the square root of what rounding moves.
      EXPECT_NEAR(largest / std::abs(orbit.multipliers[0]), 1.0, 1e-3) << orbit.quantities[0];
      EXPECT_EQ(std::ranges::count_if(map.events, [](int event) { return event > 0; }),
                orbit.cuts * std::ranges::count_if(orbit.map.events, [](int event) { return event > 0; }));
    }
    EXPECT_GT(compared, 5);
  }
}

TEST(Branch, AnOrbitIsTheSameWhereverItIsCut) {
  const settings::Scene scene = followed_rotor();
  branch::Shooting shooting(scene, AlongSpeed::parameters(scene, 0.62),
                            {{settings::axes_of(scene).size() - 1, 0.062, 0.6, 0.64}});
  branch::Continuation continuation(shooting);
  const auto orbit = continuation.settle({}, {0.62}, 300);
  ASSERT_TRUE(orbit && orbit->map.lightest_place);
  for (const int passings : shooting.passings_of_periods()) {
    shooting.cut_at({orbit->map.lightest_place->blade, orbit->map.lightest_place->revolution, passings});
    const auto at = shooting.scaled(*orbit->map.lightest_place, orbit->quantities);
    const auto other = shooting.orbit(at);
    ASSERT_TRUE(other) << passings;
    if (other->mismatch.norm() > 1e-3) continue;  // the motion has not this period
    EXPECT_LT(other->mismatch.norm(), 1e-10);
    EXPECT_TRUE(other->admissible);
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(other->section[static_cast<std::size_t>(i)], orbit->section[static_cast<std::size_t>(i)],
                  1e-12);
      EXPECT_NEAR(std::abs(other->multipliers[i] - orbit->multipliers[i]), 0.0, 1e-7) << passings;
    }
  }
}

TEST(Branch, OfManyBladesAndWithLittleDampingHoldsOrbitsThatClose) {
  settings::Scene many = followed_rotor();
  many.blades.count = 50;
  many.contact.law = settings::ContactLaw::elastic_ring;
  settings::Scene light = followed_rotor();
  light.rotor.damping_ratio = 0.03;
  light.contact.law = settings::ContactLaw::elastic_ring;
  for (const auto& [scene, from, to] : {std::tuple{many, 0.6, 0.62}, std::tuple{light, 0.25, 0.24}}) {
    const AlongSpeed along(scene, from, to);
    ASSERT_TRUE(along.start) << scene.blades.count << " blades";
    ASSERT_GT(along.branch.orbits.size(), 2U);
    expect_closed_orbits(along.branch);
  }
}

TEST(Branch, ATestFunctionChangesItsSignWhereAMultiplierPassesTheCircle) {
  const auto of = [](const Eigen::Matrix4d& jacobian) {
    branch::Orbit orbit;
    orbit.forward = jacobian;
    orbit.multipliers = integrate::eigen_modes(jacobian).values;
    return orbit;
  };
  const auto with = [&](double a, double b, double c, double d) {
    return of(Eigen::Vector4d(a, b, c, d).asDiagonal().toDenseMatrix());
  };
  EXPECT_GT(branch::test_function(EventKind::period_doubling, with(-0.9, 0.1, 0.2, 0.3)), 0.0);
  EXPECT_LT(branch::test_function(EventKind::period_doubling, with(-1.1, 0.1, 0.2, 0.3)), 0.0);
  EXPECT_LT(branch::test_function(EventKind::fold, with(0.9, 0.1, 0.2, 0.3)) *
                branch::test_function(EventKind::fold, with(1.1, 0.1, 0.2, 0.3)),
            0.0);
  Eigen::Matrix4d turning = with(0.0, 0.0, 0.1, 0.2).forward;
  const auto turned = [&](double size) {
    turning.topLeftCorner<2, 2>() << size * 0.6, -size * 0.8, size * 0.8, size * 0.6;
    return branch::test_function(EventKind::neimark_sacker, of(turning));
  };
  EXPECT_LT(turned(0.99) * turned(1.01), 0.0);
}

TEST(Branch, IsRefusedWhereTheMotionDoesNotSettleOnAPeriodicOrbit) {
  const AlongSpeed along(followed_rotor(), 0.5, 0.6);
  EXPECT_FALSE(along.start) << "region 2 is chaotic";
}

}  // namespace
}  // namespace rubatlas::test
