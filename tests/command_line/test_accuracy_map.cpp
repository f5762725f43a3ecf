// What counts as a change of a map, on maps made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/rules/class.hpp"
#include "mpi/accuracy/accuracy_map.hpp"
#include "plan/grid.hpp"

namespace rubatlas::mpi {
namespace {

/// A line of a hundred speeds: periodic, chaotic between 0.40 and 0.60, periodic again.
class AccuracyMap : public testing::Test {
 protected:
  AccuracyMap() {
    for (int i = 0; i <= 90; ++i) scene.grid.speed_ratio.push_back(0.05 + 0.01 * i);
    scene.grid.thickness = scene.grid.unbalance = scene.grid.friction = scene.grid.damping_ratio = {0.1};
    scene.protocol = {200, 100, 64};
    study.settings.resize(2);
    study.points.resize(scene.grid.speed_ratio.size());
    for (auto& point : study.points) point.horizon = 300;
    study.runs.resize(2 * study.points.size());
    for (std::size_t setting = 0; setting < 2; ++setting) {
      for (std::size_t i = 0; i < study.points.size(); ++i) {
        const double speed = scene.grid.speed_ratio[i];
        auto& run = of(setting, i);
        run.status = ending::PointStatus::done;
        run.motion = speed > 0.395 && speed < 0.605 ? analysis::motion_class::kAperiodic : 1;
        run.max_displacement = speed < 0.395 ? 1e-4 : 1e-2;
      }
    }
  }

  atlas::AccuracyRun& of(std::size_t setting, std::size_t point) {
    return study.runs[setting * study.points.size() + point];
  }
  const atlas::MapChanges& changes() {
    judge_maps(scene, study);
    EXPECT_EQ(study.changes.size(), 2U);
    EXPECT_EQ(study.changes[0].any, 0.0) << "the reference differs from itself";
    return study.changes[1];
  }
  [[nodiscard]] double points(double count) const { return count / static_cast<double>(study.points.size()); }

  settings::Scene scene;
  atlas::AccuracyStudy study;
};

TEST_F(AccuracyMap, EqualMapsHaveNoError) {
  EXPECT_EQ(changes().any, 0.0);
  EXPECT_EQ(of(0, 45).region, 2) << "chaos after the first trigger";
}

TEST_F(AccuracyMap, ADisplacementChangesBeyondOnePerCent) {
  of(1, 3).max_displacement *= 1.009;
  EXPECT_EQ(changes().max_displacement, 0.0);
  of(1, 3).max_displacement = 1e-4 * 1.011;
  of(1, 4).max_displacement = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(changes().max_displacement, points(2));
  EXPECT_DOUBLE_EQ(changes().any, points(2));
}

TEST_F(AccuracyMap, NegligibleDisplacementsAreEqual) {
  of(0, 3).max_displacement = 0.0;
  of(1, 3).max_displacement = 1e-12;
  EXPECT_EQ(changes().max_displacement, 0.0);
}

TEST_F(AccuracyMap, AMotionOfAnotherClassOrStatusHasChanged) {
  of(1, 3).motion = 2;
  of(1, 4).status = ending::PointStatus::left_validity;
  EXPECT_DOUBLE_EQ(changes().motion, points(2));
  EXPECT_EQ(changes().max_displacement, 0.0);
}

TEST_F(AccuracyMap, AnEdgeThatMovesChangesTheRegionOfThePointsThatItPasses) {
  for (std::size_t i = 0; i < study.points.size(); ++i) {
    if (scene.grid.speed_ratio[i] > 0.575 && scene.grid.speed_ratio[i] < 0.605) of(1, i).motion = 1;
  }
  // 0.58, 0.59 and 0.60 go from region 2 to region 3; their classes have changed too.
  EXPECT_DOUBLE_EQ(changes().region, points(3));
  EXPECT_DOUBLE_EQ(changes().any, points(3));
}

TEST_F(AccuracyMap, WhatChaosDoesToAMaximumIsToldApart) {
  of(1, 3).max_displacement *= 1.5;
  of(1, 45).max_displacement *= 1.5;
  study.points[45].horizon = 12;
  EXPECT_DOUBLE_EQ(changes().any, points(2));
  EXPECT_DOUBLE_EQ(changes().beyond_chaos, points(1));
  of(1, 45).motion = 3;
  EXPECT_DOUBLE_EQ(changes().beyond_chaos, points(2));
}

}  // namespace
}  // namespace rubatlas::mpi
