// Points, lines and visits: every point once, lines along the speed ratio, sweeps in their direction.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "plan/grid.hpp"
#include "settings/reader.hpp"

namespace rubatlas::plan {
namespace {

Grid grid_of(const std::string& sweep) {
  return Grid(
      settings::parse_scene(R"({"grid": {"speed_ratio": [0.1, 0.2, 0.3, 0.4], "damping_ratio": [0.05, 0.1],
                                     "friction": [0, 0.1, 0.2], "thickness": [0.001, 0.002]}, "sweep": ")" +
                            sweep + "\"}"));
}

const std::vector<std::string> kSweeps{"up", "down", "both", "independent"};

bool same_line(const PointParameters& a, const PointParameters& b) {
  return a.damping_ratio == b.damping_ratio && a.friction == b.friction && a.unbalance == b.unbalance &&
         a.thickness == b.thickness;
}

TEST(Grid, AxesStandInTheOrderOfTheAtlasWithUnitAndMeaning) {
  const Grid grid = grid_of("up");
  std::vector<std::string> names;
  for (const auto& axis : grid.axes()) {
    names.push_back(axis.name);
    EXPECT_FALSE(axis.units.empty()) << axis.name;
    EXPECT_FALSE(axis.long_name.empty()) << axis.name;
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"thickness", "unbalance", "friction", "damping_ratio", "speed_ratio"}));
  EXPECT_EQ(grid.axes()[0].units, "m");
  EXPECT_EQ(grid.axes()[1].units, "kg m");
  EXPECT_EQ(grid.axes()[4].units, "1");
  EXPECT_EQ(grid.shape(), (std::vector<std::size_t>{2, 1, 3, 2, 4}));
}

TEST(Grid, ASweepInBothDirectionsAddsTheSlowestAxis) {
  const Grid grid = grid_of("both");
  EXPECT_EQ(grid.axes().front().name, "direction");
  EXPECT_EQ(grid.axes().front().values, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(grid.shape(), (std::vector<std::size_t>{2, 2, 1, 3, 2, 4}));
  EXPECT_EQ(grid.point_count(), 2 * grid_of("up").point_count());
}

TEST(Grid, PointsAreNumberedInCOrder) {
  for (const auto& sweep : kSweeps) {
    const Grid grid = grid_of(sweep);
    std::size_t point = 0;
    for (std::size_t directions = sweep == "both" ? 2 : 1; directions > 0; --directions) {
      for (const double thickness : {0.001, 0.002}) {
        for (const double friction : {0.0, 0.1, 0.2}) {
          for (const double damping : {0.05, 0.1}) {
            for (const double speed : {0.1, 0.2, 0.3, 0.4}) {
              const auto parameters = grid.parameters(point++);
              EXPECT_EQ(parameters.thickness, thickness);
              EXPECT_EQ(parameters.friction, friction);
              EXPECT_EQ(parameters.damping_ratio, damping);
              EXPECT_EQ(parameters.speed_ratio, speed);
              EXPECT_EQ(parameters.unbalance, 0.0);
            }
          }
        }
      }
    }
    EXPECT_EQ(point, grid.point_count());
  }
}

TEST(Grid, EveryPointIsVisitedExactlyOnce) {
  for (const auto& sweep : kSweeps) {
    const Grid grid = grid_of(sweep);
    std::set<std::size_t> visited;
    for (std::size_t line = 0; line < grid.line_count(); ++line) {
      for (std::size_t visit = 0; visit < grid.speed_count(); ++visit)
        visited.insert(grid.point(line, visit));
    }
    EXPECT_EQ(visited.size(), grid.point_count());
    EXPECT_EQ(*visited.rbegin(), grid.point_count() - 1);
  }
}

TEST(Grid, LinesRunAlongSpeedRatioOnly) {
  for (const auto& sweep : kSweeps) {
    const Grid grid = grid_of(sweep);
    for (std::size_t line = 0; line < grid.line_count(); ++line) {
      const auto first = grid.parameters(grid.point(line, 0));
      for (std::size_t visit = 1; visit < grid.speed_count(); ++visit) {
        const auto before = grid.parameters(grid.point(line, visit - 1));
        const auto here = grid.parameters(grid.point(line, visit));
        EXPECT_TRUE(same_line(first, here));
        EXPECT_EQ(grid.point(line, visit) / grid.speed_count(), line);
        if (grid.direction(line) == Direction::up) {
          EXPECT_LT(before.speed_ratio, here.speed_ratio);
        } else {
          EXPECT_GT(before.speed_ratio, here.speed_ratio);
        }
      }
    }
  }
}

TEST(Grid, DirectionsFollowTheSweep) {
  EXPECT_EQ(grid_of("up").direction(0), Direction::up);
  EXPECT_EQ(grid_of("down").direction(0), Direction::down);
  EXPECT_EQ(grid_of("independent").direction(0), Direction::up);
  const Grid both = grid_of("both");
  for (std::size_t line = 0; line < both.line_count(); ++line) {
    EXPECT_EQ(both.direction(line), line < both.line_count() / 2 ? Direction::up : Direction::down);
  }
}

TEST(Grid, OnlyIndependentPointsDoNotDependOnEachOther) {
  for (const auto& sweep : kSweeps) {
    EXPECT_EQ(grid_of(sweep).points_depend_on_each_other(), sweep != "independent") << sweep;
  }
}

}  // namespace
}  // namespace rubatlas::plan
