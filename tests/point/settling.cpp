/// `protocol.stop_when_periodic`: transients end where the motion repeats, and nothing else changes.
#include "point/settling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

using test::run;  // also where another source of this folder has a `run` of its own

point::PointOutcome outcome_of(double speed_ratio, bool stop_when_periodic) {
  settings::Scene scene;
  scene.observables = {"poincare", "max_displacement"};
  scene.protocol.stop_when_periodic = stop_when_periodic;
  return run(scene, speed_ratio);
}

TEST(Settling, ACycleIsSettledOnceItHasRepeatedThreeTimes) {
  for (const int period : {1, 3, 16}) {
    point::Settling settling(1e-12);
    for (int i = 0; i < 4 * period; ++i) {
      EXPECT_EQ(settling.period(), 0) << "period " << period << " after " << i << " sections";
      settling.add(point::Settling::Section::Constant(std::sin(2.0 * (i % period))));
    }
    EXPECT_EQ(settling.period(), period);
  }
}

TEST(Settling, ASpiralIsNotSettledBeforeItsTurnsAreWithinTheDistance) {
  point::Settling settling(1e-12);
  for (int i = 0; i < 200; ++i) {
    const double radius = std::pow(0.8, i);
    point::Settling::Section section = point::Settling::Section::Zero();
    section.head<3>() << radius, -radius, radius;
    settling.add(section);
    if (0.2 * std::pow(0.8, i - 3) > 1e-12) {
      EXPECT_EQ(settling.period(), 0) << i;
    }
  }
  EXPECT_EQ(settling.period(), 1);
}

TEST(Settling, APeriodicPointCostsLessAndHasTheSameSections) {
  for (const double speed_ratio : {0.30, 0.40, 0.62}) {
    const auto whole = outcome_of(speed_ratio, false);
    const auto shortened = outcome_of(speed_ratio, true);
    ASSERT_EQ(shortened.status, ending::PointStatus::done);
    EXPECT_LT(shortened.work.right_hand_sides, 3 * whole.work.right_hand_sides / 4) << speed_ratio;
    for (std::size_t row = 0; row < whole.rows.size(); ++row) {
      ASSERT_EQ(shortened.rows[row].size(), whole.rows[row].size());
      for (std::size_t i = 0; i < whole.rows[row].size(); ++i) {
        EXPECT_NEAR(shortened.rows[row][i], whole.rows[row][i], 1e-11)
            << speed_ratio;  // tolerance x clearance
      }
    }
  }
}

TEST(Settling, AChaoticPointRunsItsWholeTransient) {
  const auto whole = outcome_of(0.50, false);
  const auto watched = outcome_of(0.50, true);
  EXPECT_EQ(watched.work.right_hand_sides, whole.work.right_hand_sides);
  EXPECT_EQ(watched.rows, whole.rows);
}

}  // namespace
}  // namespace rubatlas::test
