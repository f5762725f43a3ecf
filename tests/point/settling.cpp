/// `protocol.settle`: a transient ends on the cycle where it would end anyway, and nothing else changes.
#include "point/settling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "../support/point.hpp"
#include "integrate/decompositions.hpp"

namespace rubatlas::test {
namespace {

using point::Return;
using point::Section;
using point::Settling;
using test::run;  // also where another source of this folder has a `run` of its own

constexpr double kError = 1e-9;

Section four(double x, double y, double vx, double vy) {
  Section section(4);
  section << x, y, vx, vy;
  return section;
}

/// Iterates a map of sections, whose derivative is taken from differences, as a motion that may settle.
class MapMotion {
 public:
  using Map = std::function<Section(const Section&)>;
  explicit MapMotion(Map map) : map_(std::move(map)) {}

  /// Touch-downs of a revolution that begins there.
  std::function<std::vector<std::int32_t>(const Section&)> events = [](const Section&) {
    return std::vector<std::int32_t>{1, -1};
  };
  /// Where a motion goes that starts anew from a section; by default where the map goes.
  std::optional<Map> started_anew;
  double nearest_grazing = 1.0;

  struct Settled {
    int revolutions = 0;  ///< 0: it has not
    std::vector<Section> cycle;
    Section last;  ///< section that was run to
    int revolutions_of_searches = 0;
    std::vector<Section> derivatives;  ///< from where they were taken
  };
  [[nodiscard]] Settled run(Section from, int revolutions) const {
    Settled result;
    Settling settling(kError, 1.0, [&](const Section& start, int count, bool derivative) {
      result.revolutions_of_searches += count;
      if (derivative) result.derivatives.push_back(start);
      return std::optional(turn(start, count, derivative));
    });
    result.last = from;
    for (int i = 0; i < revolutions; ++i) {
      std::vector<std::int32_t> touches = events(result.last);
      result.last = map_(result.last);
      settling.add(result.last, std::move(touches));
      auto cycle = settling.cycle(revolutions - i - 1);
      if (!cycle) continue;
      result.revolutions = i + 1;
      result.cycle = std::move(*cycle);
      return result;
    }
    return result;
  }

 private:
  [[nodiscard]] Return turn(Section at, int count, bool derivative) const {
    const Map& map = started_anew ? *started_anew : map_;
    Return result;
    result.nearest_grazing = nearest_grazing;
    result.jacobian = variation::Tangents::Identity(4, 4);
    for (int i = 0; i < count; ++i) {
      const auto touches = events(at);
      result.events.insert(result.events.end(), touches.begin(), touches.end());
      if (derivative) {
        Eigen::Matrix4d slopes;
        for (Eigen::Index k = 0; k < 4; ++k) {
          constexpr double kStep = 1e-5;
          const Section step = kStep * Section::Unit(4, k);
          slopes.col(k) = (map(at + step) - map(at - step)) / (2.0 * kStep);
        }
        result.jacobian = slopes * result.jacobian;
      }
      at = map(at);
      result.sections.push_back(at);
    }
    return result;
  }

  Map map_;
};

/// The first component by a map of its own, the others contract towards 0.
MapMotion along_one(std::function<double(double)> map) {
  return MapMotion([map = std::move(map)](const Section& at) {
    return four(map(at[0]), 0.5 * at[1], 0.3 * at[2], 0.2 * at[3]);
  });
}
Section at(double first) {
  return four(first, 1e-3, 1e-3, 1e-3);
}

TEST(Settling, ASpiralEndsInItsCentreLongBeforeItGetsThere) {
  const double turn = 0.9;
  const Section centre = four(0.2, -0.1, 0.3, 0.4);
  const MapMotion spiral([&](const Section& at) {
    const double x = at[0] - centre[0];
    const double y = at[1] - centre[1];
    return four(centre[0] + 0.8 * (x * std::cos(turn) - y * std::sin(turn)),
                centre[1] + 0.8 * (x * std::sin(turn) + y * std::cos(turn)),
                centre[2] + 0.1 * (at[2] - centre[2]), centre[3] - 0.2 * (at[3] - centre[3]));
  });
  const auto settled = spiral.run(four(0.0, 0.0, 0.0, 0.0), 200);
  ASSERT_EQ(settled.cycle.size(), 1U);
  EXPECT_LT(settled.revolutions, 40);
  EXPECT_GT(std::abs(settled.last[0] - centre[0]) + std::abs(settled.last[1] - centre[1]), 1e5 * kError);
  for (Eigen::Index i = 0; i < 4; ++i) EXPECT_NEAR(settled.cycle[0][i], centre[i], 0.1 * kError);
}

TEST(Settling, AMotionOnItsCycleEndsThereThoughNewtonsStepsAreAsLargeAsTheErrorsOfSections) {
  // Each section errs anew, and Newton's steps do not fall below what comes of that.
  const auto error = [](double x) { return 0.4 * kError * std::sin(1e13 * x); };
  const auto settled =
      along_one([&](double x) { return 0.25 + 0.2 * (x - 0.25) + error(x); }).run(at(0.3), 100);
  ASSERT_EQ(settled.cycle.size(), 1U);
  EXPECT_NEAR(settled.cycle[0][0], 0.25, kError);
}

TEST(Settling, ACycleOfTwoEndsInBothItsSectionsInTheirOrder) {
  const double r = 3.3;
  const auto settled = along_one([r](double x) { return r * x * (1.0 - x); }).run(at(0.3), 300);
  ASSERT_EQ(settled.cycle.size(), 2U);
  const double root = std::sqrt((r + 1.0) * (r - 3.0));
  const double high = (r + 1.0 + root) / (2.0 * r);
  const double low = (r + 1.0 - root) / (2.0 * r);
  EXPECT_NEAR(std::max(settled.cycle[0][0], settled.cycle[1][0]), high, 0.1 * kError);
  EXPECT_NEAR(std::min(settled.cycle[0][0], settled.cycle[1][0]), low, 0.1 * kError);
  EXPECT_EQ(settled.last[0] > 0.5 * (low + high), settled.cycle[0][0] > 0.5 * (low + high));
}

TEST(Settling, WhereAMultiplierIsInDoubtItsDerivativeIsTakenOnTheCycle) {
  // Of x -> −1.02 x + x³ from ±sqrt(0.02) on: 0.96².
  const MapMotion motion = along_one([](double x) { return x * x * x - 1.02 * x; });
  const auto settled = motion.run(at(0.15), 2000);
  ASSERT_EQ(settled.cycle.size(), 2);
  ASSERT_GE(settled.derivatives.size(), 2);
  EXPECT_NEAR(std::abs(settled.derivatives.back()[0]), std::sqrt(0.02), kError);
  EXPECT_TRUE(settled.derivatives.back().tail(3).isZero(kError));
}

TEST(Settling, AFoldThatHasJustVanishedLeavesNoCycleToEndOn) {
  for (const double distance : {1e-6, 1e-8, 1e-10}) {
    const auto ghost = along_one([distance](double x) { return x + distance + x * x; }).run(at(-1e-2), 1000);
    EXPECT_EQ(ghost.revolutions, 0) << distance;
  }
}

TEST(Settling, AMotionThatLingersBesideASaddleDoesNotEndOnIt) {
  for (const double multiplier : {1.0005, 1.01, 1.1, 2.0}) {
    for (const double start : {1e-4, 1e-7, 1e-10}) {
      const auto passing = along_one([multiplier](double x) { return multiplier * x; }).run(at(start), 150);
      EXPECT_EQ(passing.revolutions, 0) << multiplier << " from " << start;
    }
  }
}

TEST(Settling, ANearlyNeutralCycleIsLeftToTheProtocol) {
  for (const double multiplier : {0.9995, -0.9995, 1.0}) {
    const auto neutral = along_one([multiplier](double x) { return multiplier * x; }).run(at(1e-3), 1000);
    EXPECT_EQ(neutral.revolutions, 0) << multiplier;
  }
}

TEST(Settling, AnUnstableSpiralInsideATorusIsNoEnd) {
  const MapMotion torus([](const Section& at) {
    const double radius = std::hypot(at[0], at[1]);
    const double growth = 1.01 - 1e6 * radius * radius;
    return four(growth * (at[0] * std::cos(1.0) - at[1] * std::sin(1.0)),
                growth * (at[0] * std::sin(1.0) + at[1] * std::cos(1.0)), 0.3 * at[2], 0.2 * at[3]);
  });
  EXPECT_EQ(torus.run(four(1e-9, 0.0, 1e-3, 1e-3), 1000).revolutions, 0);
}

TEST(Settling, NearTheBorderOfABasinAMotionHasSettledOnlyWhenItIsHalfWayInside) {
  // A saddle at 1 - m, in units of `size`, bounds the basin of the cycle at 0.
  const double size = 1e-3;
  for (const double multiplier : {0.3, 0.8, 0.95}) {
    const double saddle = size * (1.0 - multiplier);
    for (const double start : {0.3, 0.9, 0.999, 0.999999}) {
      const auto inside = along_one([&](double x) {
                            return multiplier * x + x * x / size;
                          }).run(four(start * saddle, 0.0, 0.0, 0.0), 1000);
      ASSERT_EQ(inside.cycle.size(), 1U) << multiplier << " from " << start;
      EXPECT_LT(inside.last[0], 0.5 * saddle);
      EXPECT_NEAR(inside.cycle[0][0], 0.0, 0.1 * kError);
    }
    const auto outside = along_one([&](double x) {
                           return multiplier * x + x * x / size;
                         }).run(four(1.000001 * saddle, 0.0, 0.0, 0.0), 60);
    EXPECT_EQ(outside.revolutions, 0) << multiplier;
  }
}

TEST(Settling, ACycleAtItsPeriodDoublingIsLeftToTheProtocol) {
  for (const double beyond : {-1e-6, 0.0, 1e-6}) {
    const double r = 3.0 + beyond;
    const auto doubling =
        along_one([r](double x) { return r * x * (1.0 - x); }).run(at(2.0 / 3.0 + 1e-3), 1000);
    EXPECT_EQ(doubling.revolutions, 0) << beyond;
  }
}

TEST(Settling, WhereATouchDownComesOrGoesOnTheWayItHasNotSettled) {
  auto contraction = along_one([](double x) { return 0.9 * x; });
  // A second blade touches as long as the motion is farther out.
  const double border = 1e-5;
  contraction.events = [border](const Section& at) {
    return at[0] > border ? std::vector<std::int32_t>{1, -1, 2, -2} : std::vector<std::int32_t>{1, -1};
  };
  const auto settled = contraction.run(at(1e-3), 300);
  ASSERT_EQ(settled.cycle.size(), 1U);
  EXPECT_LT(settled.last[0], 0.9 * border);
}

TEST(Settling, WhatGrazesNearTheCycleMustBeFartherThanTheMotion) {
  auto contraction = along_one([](double x) { return 0.9 * x; });
  contraction.nearest_grazing = 1e-6;
  const auto settled = contraction.run(at(1e-3), 300);
  ASSERT_EQ(settled.cycle.size(), 1U);
  EXPECT_LT(settled.last[0], 1e-7);
}

TEST(Settling, AMotionThatGoesElsewhereWhenItStartsAnewDoesNotSettle) {
  auto hidden = along_one([](double x) { return 0.9 * x; });
  hidden.started_anew = [](const Section& at) { return four(0.9 * at[0] + 1e-6, 0.0, 0.0, 0.0); };
  EXPECT_EQ(hidden.run(at(1e-3), 300).revolutions, 0);
}

TEST(Settling, WhatNeverSettlesCostsLittleMore) {
  for (const double r : {3.57, 3.7, 3.9, 4.0}) {
    const auto chaos = along_one([r](double x) { return r * x * (1.0 - x); }).run(at(0.3), 10000);
    EXPECT_EQ(chaos.revolutions, 0) << r;
    EXPECT_LT(chaos.revolutions_of_searches, 500) << r;
  }
}

// --- of the rotor ---

settings::Scene scene_that(settings::Settle settle) {
  settings::Scene scene;
  scene.observables = {"poincare",       "poincare_blade_passing", "max_displacement", "spectrum",
                       "lightest_touch", "nearest_miss",           "friction_power",   "contact_fraction"};
  scene.protocol.settle = settle;
  return scene;
}
point::PointOutcome outcome_of(double speed_ratio, settings::Settle settle) {
  return run(scene_that(settle), speed_ratio);
}

TEST(Settling, APeriodicPointCostsAFractionAndHasTheSameRow) {
  for (const double speed_ratio : {0.30, 0.40, 0.62}) {
    const auto whole = outcome_of(speed_ratio, settings::Settle::never);
    const auto settled = outcome_of(speed_ratio, settings::Settle::newton);
    ASSERT_EQ(settled.status, ending::PointStatus::done);
    EXPECT_GT(settled.settled, 0);
    EXPECT_EQ(whole.settled, 0);
    EXPECT_LT(settled.work.revolutions, whole.work.revolutions / 5) << speed_ratio;
    ASSERT_EQ(settled.rows.size(), whole.rows.size());
    for (std::size_t row = 0; row < whole.rows.size(); ++row) {
      ASSERT_EQ(settled.rows[row].size(), whole.rows[row].size());
      // Relative to the clearance, or to what is larger than that in metres.
      const double size = std::max(1e-3, std::abs(whole.rows[row].front()));
      for (std::size_t i = 0; i < whole.rows[row].size(); ++i) {
        EXPECT_NEAR(settled.rows[row][i], whole.rows[row][i], 1e-8 * size)
            << speed_ratio << ": " << scene_that(settings::Settle::newton).observables[row];
      }
    }
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(settled.final_state[i], whole.final_state[i], 1e-11);
  }
}

TEST(Settling, ExponentsOnACycleAreTheLogarithmsOfItsMultipliers) {
  for (const double speed_ratio : {0.30, 0.40, 0.62}) {
    settings::Scene scene = scene_that(settings::Settle::newton);
    scene.observables = {"poincare", "lyapunov"};
    const auto settled = run(scene, speed_ratio);
    ASSERT_GT(settled.settled, 0);
    const auto& sections = settled.rows[0];
    std::size_t period = 1;
    while (std::abs(sections[4 * period] - sections[0]) > 0.0) ++period;
    motion::SectionState start;
    std::copy_n(sections.end() - 4, 4, start.begin());
    auto solver = solver_of(scene);
    const auto map = solver->section_map(speed_ratio, start, static_cast<int>(period));
    const auto multipliers = integrate::eigen_modes(map.jacobian).values;
    std::vector<double> logarithms;
    const double time = static_cast<double>(period) * 2.0 * std::numbers::pi / speed_ratio;
    for (const auto& multiplier : multipliers) logarithms.push_back(std::log(std::abs(multiplier)) / time);
    std::ranges::sort(logarithms, std::greater<>());
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(settled.rows[1][i], logarithms[i], 1e-6) << speed_ratio;
    for (const double error : settled.rows[2]) EXPECT_EQ(error, 0.0);
    EXPECT_NEAR(settled.rows[3][0], 0.0, 1e-9) << "what is left of their sum";
  }
}

TEST(Settling, WithExponentsNoCycleIsLongerThanWhatIsSampled) {
  settings::Scene scene = scene_that(settings::Settle::newton);
  scene.observables = {"poincare", "lyapunov"};
  scene.protocol.transient_revolutions = 3000;
  const double speed_ratio = 0.6855;  // period 2
  scene.protocol.sampled_revolutions = 2;
  const auto of_cycle = run(scene, speed_ratio);
  ASSERT_GT(of_cycle.settled, 0);
  EXPECT_LT(of_cycle.rows[1][0], 0.0);
  scene.protocol.sampled_revolutions = 1;
  const auto of_half = run(scene, speed_ratio);
  EXPECT_EQ(of_half.settled, 0);
  EXPECT_TRUE(std::isnan(of_half.rows[2][0])) << "one revolution tells no error";
}

TEST(Settling, TheOrbitOfAPeriodicPointIsItsCycle) {
  for (const double speed_ratio : {0.30, 0.40, 0.62}) {
    const auto solver = solver_of(scene_that(settings::Settle::newton));
    const auto outcome = solver->run(speed_ratio, {});
    const auto orbit = solver->orbit(speed_ratio, {});
    ASSERT_EQ(orbit.sections.size(), 100U);
    for (std::size_t i = 0; i < orbit.sections.size(); ++i)
      EXPECT_LE(largest_difference(orbit.sections[i], test::section(outcome.rows[0], i)), 1e-12)
          << speed_ratio;
    EXPECT_EQ(orbit.sections.front(), test::section(outcome.rows[0], 0)) << "the same motion";
  }
}

TEST(Settling, AChaoticPointRunsItsWholeProtocol) {
  const auto whole = outcome_of(0.50, settings::Settle::never);
  const auto watched = outcome_of(0.50, settings::Settle::newton);
  EXPECT_EQ(watched.settled, 0);
  EXPECT_EQ(watched.rows, whole.rows);
  EXPECT_EQ(watched.final_state, whole.final_state);
}

}  // namespace
}  // namespace rubatlas::test
