// Axes named by pointers on the grid, and the scene that a line of it is computed from.
#include "plan/scene_of_line.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::plan {
namespace {

const std::string kAxes =
    R"("speed_ratio": [0.1, 0.2], "damping_ratio": [0.05, 0.1], "thickness": [0.001, 0.002],
  "/rotor/mass": [1, 2, 3], "/ring/stiffness": [1e3, 1e4])";

settings::Scene scene_with(const std::string& more_axes, const std::string& sweep = "up") {
  return settings::parse_scene(R"({"contact": {"law": "elastic_ring"}, "grid": {)" + kAxes + more_axes +
                               R"(}, "sweep": ")" + sweep + "\"}");
}

TEST(PointerAxesOnTheGrid, StandBetweenDirectionAndThickness) {
  const Grid grid(scene_with("", "both"));
  std::vector<std::string> names;
  for (const auto& axis : grid.axes()) names.push_back(axis.name);
  EXPECT_EQ(names, (std::vector<std::string>{"direction", "ring_stiffness", "rotor_mass", "thickness",
                                             "unbalance", "friction", "damping_ratio", "speed_ratio"}));
  EXPECT_EQ(grid.shape(), (std::vector<std::size_t>{2, 2, 3, 2, 1, 1, 2, 2}));
  EXPECT_EQ(grid.axes()[1].units, "N/m");
  EXPECT_EQ(grid.axes()[1].long_name, settings::quantity("/ring/stiffness").meaning);
  EXPECT_EQ(grid.line_count(), 48U);
}

TEST(PointerAxesOnTheGrid, PointsAreNumberedInCOrder) {
  const Grid grid(scene_with("", "both"));
  std::size_t point = 0;
  for (std::size_t directions = 2; directions > 0; --directions) {
    for (const double stiffness : {1e3, 1e4}) {
      for (const double mass : {1.0, 2.0, 3.0}) {
        for (const double thickness : {0.001, 0.002}) {
          for (const double damping : {0.05, 0.1}) {
            for (const double speed : {0.1, 0.2}) {
              const auto parameters = grid.parameters(point++);
              EXPECT_EQ(parameters.swept, (std::vector<double>{stiffness, mass}));
              EXPECT_EQ(parameters.thickness, thickness);
              EXPECT_EQ(parameters.damping_ratio, damping);
              EXPECT_EQ(parameters.speed_ratio, speed);
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(point, grid.point_count());
}

TEST(PointerAxesOnTheGrid, ParametersAndTheirValuesAreTheSame) {
  const PointParameters parameters{0.3, 0.1, 0.2, 1e-5, 0.001, {1e4, 2.0}};
  const auto values = values_of(parameters);
  EXPECT_EQ(values, (std::vector<double>{1e4, 2.0, 0.001, 1e-5, 0.2, 0.1, 0.3}));
  EXPECT_EQ(values_of(parameters_at(values)), values);
}

TEST(SceneOfLine, HasEveryValueOfTheLine) {
  const settings::Scene scene =
      scene_with(R"(, "friction": [0, 0.3], "unbalance": [0, 1e-5], "/unbalance/phase": [1, 2])");
  const Grid grid(scene);
  for (std::size_t line = 0; line < grid.line_count(); ++line) {
    const auto parameters = grid.parameters(grid.point(line, 0));
    const settings::Scene own = scene_of_line(scene, parameters);
    EXPECT_EQ(own.ring.stiffness, parameters.swept[0]);
    EXPECT_EQ(own.rotor.mass, parameters.swept[1]);
    EXPECT_EQ(own.blades.thickness, parameters.thickness);
    EXPECT_EQ(own.rotor.damping_ratio, parameters.damping_ratio);
    EXPECT_EQ(own.contact.friction, parameters.friction);
    EXPECT_EQ(own.unbalance.has_value(), parameters.unbalance > 0.0) << "none is absent";
    if (own.unbalance) {
      EXPECT_EQ(own.unbalance->moment, parameters.unbalance);
      EXPECT_EQ(own.unbalance->phase, parameters.swept[2]);
    }
  }
}

TEST(SceneOfLine, LeavesASceneWithoutSweptQuantitiesAsItIs) {
  const auto scene =
      settings::parse_scene(R"({"grid": {"speed_ratio": [0.1, 0.2]}, "unbalance": {"moment": 1e-5}})");
  const auto own = scene_of_line(scene, Grid(scene).parameters(1));
  EXPECT_EQ(settings::resolved_json(own), settings::resolved_json(scene));
}

TEST(SceneOfLine, OfShortAxesIsThatOfTheWholeGridButForTheGrid) {
  const settings::Scene scene =
      scene_with(R"(, "friction": [0, 0.3], "unbalance": [0, 1e-5], "/unbalance/phase": [1, 2])");
  const Grid grid(scene);
  const settings::Scene lean = with_short_axes(scene);
  EXPECT_EQ(Grid(lean).point_count(), 1U);
  for (std::size_t line = 0; line < grid.line_count(); ++line) {
    const auto parameters = grid.parameters(grid.point(line, 0));
    settings::Scene own = scene_of_line(lean, parameters);
    own.grid = scene.grid;
    EXPECT_EQ(settings::resolved_json(own), settings::resolved_json(scene_of_line(scene, parameters)));
  }
}

TEST(SceneOfLine, RefusesALineOfAnotherGrid) {
  const PointParameters line{.speed_ratio = 0.1, .damping_ratio = 0.1, .thickness = 0.001};
  EXPECT_THROW(static_cast<void>(scene_of_line(scene_with(""), line)), std::invalid_argument);
}

}  // namespace
}  // namespace rubatlas::plan
