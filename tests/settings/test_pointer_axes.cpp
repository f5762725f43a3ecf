// Axes that the grid names by a quantity's JSON pointer: what may be swept so, how it is read, checked and
// written.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene_error_text.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::settings {
namespace {

const std::string kRigid = R"("contact": {"law": "elastic_ring"}, )";

/// A scene with further keys of the grid.
std::string scene_with_axes(const std::string& axes, const std::string& more = "") {
  return "{" + more + R"("grid": {"speed_ratio": 0.5, )" + axes + "}}";
}

std::string refusal_of_axis(const std::string& axis) {
  return refusal(scene_with_axes(axis));
}

TEST(PointerAxes, StandBeforeTheNamedOnesSortedByTheNamesOfTheirDimensions) {
  const Scene scene = parse_scene(scene_with_axes(
      R"("/unbalance/phase": [0, 1], "/rotor/misalignment": {"from": 0.01, "to": 0.02, "count": 3},
         "/ring/stiffness": [1e3, 1e4], "friction": [0.1, 0.2])",
      kRigid));
  std::vector<std::string> names;
  for (const auto& axis : axes_of(scene)) names.push_back(axis.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"ring_stiffness", "rotor_misalignment", "unbalance_phase", "thickness",
                                      "unbalance", "friction", "damping_ratio", "speed_ratio"}));
  EXPECT_EQ(axes_of(scene)[0].values, (std::vector<double>{1e3, 1e4}));
  EXPECT_EQ(axes_of(scene)[0].quantity, &quantity("/ring/stiffness"));
  EXPECT_EQ(axes_of(scene)[1].values, (std::vector<double>{0.01, 0.015, 0.02}));
  EXPECT_EQ(axes_of(scene)[5].values, (std::vector<double>{0.1, 0.2}));
}

const std::string kFromTheStart = R"("sweep": "independent", )";

TEST(PointerAxes, EveryNumberOfTheMachineAndOfTheInitialStateCanBeSweptAndNothingElse) {
  const auto allowed = sweepable_quantities();
  const auto is_allowed = [&](std::string_view pointer) {
    return std::ranges::any_of(allowed, [&](const auto* entry) { return entry->pointer == pointer; });
  };
  for (const auto* pointer :
       {"/rotor/mass", "/rotor/natural_frequency", "/rotor/misalignment", "/blades/length", "/blades/width",
        "/blades/youngs_modulus", "/blades/hub_radius", "/ring/radius", "/ring/stiffness", "/unbalance/phase",
        "/initial/x", "/initial/y", "/initial/vx", "/initial/vy"}) {
    EXPECT_TRUE(is_allowed(pointer)) << pointer;
  }
  for (const auto* pointer : {"/blades/count", "/blades/thickness", "/contact/law", "/contact/friction",
                              "/unbalance/moment", "/rotor/damping_ratio", "/grid/speed_ratio",
                              "/validity/max_shortening", "/accuracy/tolerance", "/title"}) {
    EXPECT_FALSE(is_allowed(pointer)) << pointer;
  }
  for (const auto* entry : allowed) {
    const std::string chosen = entry->pointer == "/ring/stiffness" || entry->section() == "/contact_damping"
                                   ? kRigid
                               : entry->section() == "/initial" ? kFromTheStart
                                                                : "";
    // Blades must fit into the ring, and something must be left of each.
    const double value = entry->section() == "/blades"           ? 0.01
                         : entry->section() == "/unequal_blades" ? 1e-5
                         : entry->section() == "/stick"          ? 2.0
                                                                 : 0.5;
    const Scene read =
        parse_scene(scene_with_axes(fmt::format(R"("{}": [{}])", entry->pointer, value), chosen));
    EXPECT_EQ(std::get<double>(entry->read(read).value()), value) << entry->pointer;
  }
}

TEST(PointerAxes, TheInitialStateIsAnAxisWhereEveryPointStartsFromIt) {
  const Scene scene = parse_scene(
      scene_with_axes(R"("/initial/vx": [0, 0.002], "/initial/x": {"from": -0.001, "to": 0.001, "count": 3})",
                      kFromTheStart));
  EXPECT_EQ(axes_of(scene)[0].name, "initial_vx");
  EXPECT_EQ(axes_of(scene)[1].name, "initial_x");
  EXPECT_EQ(axes_of(scene)[1].values, (std::vector<double>{-0.001, 0.0, 0.001}));
  EXPECT_EQ(scene.initial.x, -0.001);
  const std::string resolved = resolved_json(scene);
  EXPECT_EQ(resolved_json(parse_scene(resolved)), resolved);
  EXPECT_EQ(quantity_of_axis("initial_vx"), &quantity("/initial/vx"));
}

TEST(PointerAxes, TheInitialStateIsNoAxisOfASweepWhosePointsGoOnFromEachOther) {
  for (const std::string sweep : {"up", "down", "both"}) {
    EXPECT_EQ(
        refusal(scene_with_axes(R"("/rotor/mass": [1, 2], "/initial/vy": [0, 0.001])",
                                fmt::format(R"("sweep": "{}", )", sweep))),
        fmt::format("/grid/~1initial~1vy: under the sweep \"{}\" only the first speed of a line would start "
                    "from /initial/vy; an axis of the initial state needs the sweep \"independent\"",
                    sweep));
  }
  EXPECT_NE(refusal_of_axis(R"("/initial/x": 0)"), "accepted") << "a sweep goes up unless the scene says so";
  EXPECT_EQ(refusal(scene_with_axes(R"("/initial/x": [0, 2000])", kFromTheStart)),
            "/grid/~1initial~1x/1: 2000 is outside [-1000, 1000] m; horizontal displacement at the start");
}

TEST(PointerAxes, ASweptQuantityIsPresentWithTheFirstOfItsValues) {
  const Scene scene = parse_scene(
      scene_with_axes(R"("/unbalance/phase": [0.5, 1], "/rotor/mass": [2, 3])", R"("rotor": {"mass": 7}, )"));
  ASSERT_TRUE(scene.unbalance.has_value());
  EXPECT_EQ(scene.unbalance->phase, 0.5);
  EXPECT_EQ(scene.rotor.mass, 2.0);
}

TEST(PointerAxes, CanonicalTextNamesThemByTheirPointersAndIsReadBack) {
  const std::string text = scene_with_axes(
      R"("/rotor/misalignment": [0.01, 0.02], "/ring/stiffness": [1e3, 1e4], "/unbalance/phase": 0.25)",
      kRigid + R"("ring": {"stiffness": 5e4}, )");
  const Scene scene = parse_scene(text);
  const std::string resolved = resolved_json(scene);
  EXPECT_EQ(resolved_json(parse_scene(resolved)), resolved);
  const auto grid = nlohmann::json::parse(resolved)["grid"];
  EXPECT_EQ(grid["/rotor/misalignment"], (std::vector<double>{0.01, 0.02}));
  EXPECT_EQ(grid["/ring/stiffness"], (std::vector<double>{1e3, 1e4}));
  EXPECT_EQ(grid["/unbalance/phase"], std::vector<double>{0.25});
  EXPECT_LT(resolved.find("\"/ring/stiffness\": [1000, 10000]"), resolved.find("\"/rotor/misalignment\": ["));
  // No point reads the scene's own value of a swept quantity, so it makes no other scene.
  const std::string without_own = resolved_json(parse_scene(scene_with_axes(
      R"("/unbalance/phase": [0.25], "/ring/stiffness": [1e3, 1e4], "/rotor/misalignment": [0.01, 0.02])",
      kRigid)));
  EXPECT_EQ(resolved, without_own);
}

TEST(PointerAxes, DifferencesBetweenScenesNameThem) {
  const auto resolved = [](const std::string& axes) {
    return resolved_json(parse_scene(scene_with_axes(axes, kRigid)));
  };
  EXPECT_EQ(difference(resolved(R"("/ring/stiffness": [1e3, 1e4])"), resolved(R"("/ring/stiffness": [1e3])")),
            "/grid/~1ring~1stiffness has 2 values in the first and 1 in the second");
}

TEST(PointerAxes, AnUnknownPointerNamesTheNearestThatCanBeSwept) {
  const std::string allowed =
      "/rotor/mass, /rotor/natural_frequency, /rotor/misalignment, /blades/length, /blades/width, "
      "/blades/youngs_modulus, /blades/hub_radius, /ring/radius, /ring/stiffness, ";
  const auto text = refusal_of_axis(R"("/ring/stifness": [1e3, 1e4])");
  EXPECT_TRUE(
      text.starts_with("/grid/~1ring~1stifness: no quantity that can be swept, with the value "
                       "[1000.0,10000.0]; by their pointers can be: " +
                       allowed))
      << text;
  EXPECT_TRUE(text.ends_with("; nearest: /ring/stiffness")) << text;
  EXPECT_TRUE(refusal_of_axis(R"("/contact/fricton": 0.1)").ends_with("; nearest: friction"));
  for (const std::string pointer :
       {"/protocol/sampled_revolutions", "/blades/count", "/accuracy/tolerance", "/title", "/", "//"}) {
    EXPECT_NE(refusal_of_axis(fmt::format(R"("{}": 1)", pointer))
                  .find(": no quantity that can be swept, with the value 1"),
              std::string::npos)
        << pointer;
  }
}

TEST(PointerAxes, AQuantityWhoseAxisHasANameIsSentToIt) {
  EXPECT_EQ(refusal_of_axis(R"("/blades/thickness": [0.001, 0.002])"),
            "/grid/~1blades~1thickness: the axis of this quantity has a name of its own: thickness");
  EXPECT_TRUE(refusal_of_axis(R"("/unbalance/moment": 0)").ends_with("a name of its own: unbalance"));
  EXPECT_TRUE(refusal_of_axis(R"("/grid/speed_ratio": 1)").ends_with("a name of its own: speed_ratio"));
}

TEST(PointerAxes, ValuesAreCheckedAsThoseOfTheNamedAxes) {
  EXPECT_EQ(refusal_of_axis(R"("/rotor/mass": [1, 0])"),
            "/grid/~1rotor~1mass/1: 0 is outside (0, 1000000000] kg; modal mass of the rotor");
  EXPECT_EQ(refusal_of_axis(R"("/rotor/mass": [2, 1])"),
            "/grid/~1rotor~1mass/1: 1 comes after 2; values are ascending without duplicates");
  EXPECT_EQ(refusal_of_axis(R"("/rotor/mass": {"from": 1, "to": 2})"),
            "/grid/~1rotor~1mass/count: missing; a range of values is from, to and count");
  EXPECT_EQ(refusal_of_axis(R"("/rotor/mass": [])"),
            "/grid/~1rotor~1mass: the list is empty; at least one value is needed; modal mass of the rotor");
  const std::string thousand = R"({"from": 0.1, "to": 0.5, "count": 2000})";
  EXPECT_EQ(
      refusal_of_axis(fmt::format(R"("/rotor/mass": {0}, "friction": {0}, "damping_ratio": {0})", thousand)),
      "/grid: 8000000000 points; at most 1000000000 are allowed");
}

TEST(PointerAxes, AQuantityThatTheChosenLawDoesNotReadIsRefused) {
  EXPECT_EQ(refusal_of_axis(R"("/ring/stiffness": 10000)"),
            "/grid/~1ring~1stiffness: 10000 has no effect under the contact law \"elastica\"; only "
            "\"elastic_ring\" reads it");
}

TEST(PointerAxes, TheBladesFitIntoTheRingAtEveryPoint) {
  // Each axis alone is fine with the default rotor; the tightest combination is not.
  EXPECT_EQ(refusal_of_axis(R"("/ring/radius": [0.105, 0.12])"), "accepted");
  EXPECT_EQ(refusal_of_axis(R"("/blades/length": [0.09, 0.108])"), "accepted");
  EXPECT_EQ(refusal_of_axis(R"("/ring/radius": [0.105, 0.12], "/blades/length": [0.09, 0.108])"),
            "/grid/~1ring~1radius: a ring of radius 0.105 is smaller than hub_radius + length = 0.108 m; the "
            "blades must fit into the ring at every point of the grid");
  EXPECT_EQ(
      refusal_of_axis(R"("/blades/hub_radius": [0, 0.025])"),
      "/grid/~1blades~1hub_radius: a ring of radius 0.11 is smaller than hub_radius + length = 0.125 m; "
      "the blades must fit into the ring at every point of the grid");
  // The scene's own radius, which no point reads, is no reason to refuse.
  EXPECT_EQ(refusal(scene_with_axes(R"("/ring/radius": [0.11, 0.12])", R"("ring": {"radius": 0.05}, )")),
            "accepted");
}

}  // namespace
}  // namespace rubatlas::settings
