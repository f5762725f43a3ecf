/// A line at swept values is the line of a scene that has these values itself, to the last bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "assembly/make_line_solver.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::test {
namespace {

constexpr double kSpeed = 0.5;
constexpr motion::SectionState kAtRest{0.0, 0.0, 0.0, 0.0};

struct SweptQuantity {
  std::string pointer;
  std::string low;   ///< the first value of the axis
  std::string high;  ///< the last, at which the line is looked at
};

class PointerAxis : public testing::TestWithParam<SweptQuantity> {};

settings::Scene scene_with(const std::string& axis, const std::string& law) {
  return settings::parse_scene(R"({"grid": {"speed_ratio": 0.5, "unbalance": 1e-4, )" + axis +
                               R"(}, "contact": {"law": ")" + law + R"("},
    "protocol": {"transient_revolutions": 3, "sampled_revolutions": 6, "samples_per_revolution": 32},
    "observables": ["poincare", "max_displacement", "spectrum", "max_contact_force", "max_root_strain"]})");
}

/// The last line of a scene's grid.
point::PointOutcome last_line(const settings::Scene& scene) {
  const plan::Grid grid(scene);
  const auto line = grid.parameters(grid.point(grid.line_count() - 1, 0));
  return assembly::make_line_solver(scene, line, assembly::make_blade_tables())->run(kSpeed, kAtRest);
}

TEST_P(PointerAxis, GivesTheMotionOfASceneWithThatValue) {
  const auto& [pointer, low, high] = GetParam();
  const std::string key = fmt::format(R"("{}": )", pointer);
  const std::string law = pointer == "/ring/stiffness" ? "elastic_ring" : "elastica";
  const auto swept = last_line(scene_with(fmt::format("{}[{}, {}]", key, low, high), law));
  const auto own = last_line(scene_with(key + high, law));
  const auto other = last_line(scene_with(key + low, law));
  ASSERT_EQ(own.status, ending::PointStatus::done);
  EXPECT_EQ(swept.status, own.status);
  EXPECT_EQ(swept.rows, own.rows);
  EXPECT_EQ(swept.final_state, own.final_state);
  EXPECT_EQ(swept.work.right_hand_sides, own.work.right_hand_sides);
  if (pointer != "/rotor/natural_frequency") {
    EXPECT_NE(own.final_state, other.final_state) << "the quantity moves the rotor";
  }
}

INSTANTIATE_TEST_SUITE_P(Quantities, PointerAxis,
                         testing::Values(SweptQuantity{"/rotor/mass", "1", "2"},
                                         SweptQuantity{"/rotor/natural_frequency", "10", "12"},
                                         SweptQuantity{"/rotor/misalignment", "0.01001", "0.0101"},
                                         SweptQuantity{"/blades/length", "0.1", "0.1001"},
                                         SweptQuantity{"/blades/width", "0.01", "0.02"},
                                         SweptQuantity{"/blades/youngs_modulus", "1e11", "2e11"},
                                         SweptQuantity{"/blades/hub_radius", "0", "1e-4"},
                                         SweptQuantity{"/ring/radius", "0.109", "0.1095"},
                                         SweptQuantity{"/ring/stiffness", "1e3", "1e4"},
                                         SweptQuantity{"/unbalance/phase", "0", "0.7"}),
                         [](const auto& parameter) { return settings::axis_name(parameter.param.pointer); });

}  // namespace
}  // namespace rubatlas::test
