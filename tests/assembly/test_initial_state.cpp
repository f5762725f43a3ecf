// Where a point starts that goes on from no other.
#include <gtest/gtest.h>

#include "assembly/make_line_solver.hpp"
#include "plan/grid.hpp"
#include "settings/reader.hpp"

namespace rubatlas::test {
namespace {

TEST(InitialState, IsThatOfTheSceneWhereNothingOfItIsSwept) {
  const auto scene = settings::parse_scene(
      R"({"grid": {"speed_ratio": [0.4, 0.5]}, "initial": {"x": 1e-3, "y": 2e-3, "vx": 3e-3, "vy": 4e-3}})");
  const plan::Grid grid(scene);
  for (std::size_t point = 0; point < grid.point_count(); ++point) {
    EXPECT_EQ(assembly::initial_state(scene, grid.parameters(point)),
              (motion::SectionState{1e-3, 2e-3, 3e-3, 4e-3}));
  }
}

TEST(InitialState, HasThePointsOwnValuesOnTheAxesOfTheGrid) {
  const auto scene = settings::parse_scene(
      R"({"grid": {"speed_ratio": [0.4, 0.5], "/initial/vy": [-1e-3, 1e-3], "/initial/x": [0, 5e-3]},
          "initial": {"x": 7e-3, "y": 2e-3}, "sweep": "independent"})");
  const plan::Grid grid(scene);  // the axes: initial_vy, initial_x, …, speed_ratio
  ASSERT_EQ(grid.point_count(), 8U);
  for (std::size_t point = 0; point < grid.point_count(); ++point) {
    const double x = point / 2 % 2 == 0 ? 0.0 : 5e-3;
    const double vy = point / 4 == 0 ? -1e-3 : 1e-3;
    EXPECT_EQ(assembly::initial_state(scene, grid.parameters(point)),
              (motion::SectionState{x, 2e-3, 0.0, vy}));
  }
}

}  // namespace
}  // namespace rubatlas::test
