/// Motions that leave the model, by arcs and in steps: what ends them, and in which revolution, is of the
/// motion, not of the method.
#include <gtest/gtest.h>

#include <string>

#include "../support/point.hpp"
#include "settings/reader.hpp"

namespace rubatlas::test {
namespace {

using ending::StatusDetail;
using settings::Method;

/// From rest, at a speed ratio, of a scene with these sections.
point::PointOutcome point_of(const std::string& sections, double speed_ratio, Method method) {
  settings::Scene scene =
      settings::parse_scene("{" + sections + R"(, "grid": {"speed_ratio": 0.5}, "observables": ["poincare"],
        "protocol": {"transient_revolutions": 30, "sampled_revolutions": 10}})");
  scene.accuracy.method = method;
  return test::run(scene, speed_ratio);
}

void expect_the_same_end(const std::string& sections, double speed_ratio, StatusDetail detail) {
  const auto on_arcs = point_of(sections, speed_ratio, Method::collocation);
  const auto in_steps = point_of(sections, speed_ratio, Method::hybrid);
  EXPECT_EQ(on_arcs.detail, detail) << speed_ratio;
  EXPECT_EQ(in_steps.detail, detail) << speed_ratio;
  EXPECT_EQ(on_arcs.failed_revolution, in_steps.failed_revolution) << speed_ratio;
}

TEST(EndOfValidity, OfBeamColumnsIsWhereTheirContactEquationLosesItsRoot) {
  const std::string columns = R"("contact": {"law": "beam_column", "friction": 0.5})";
  for (int i = 0; i < 15; ++i)
    expect_the_same_end(columns, 0.44 + 0.11 * i / 14.0, StatusDetail::no_equilibrium);
}

TEST(EndOfValidity, IsThatOfTheSceneWhereABladesTableEndsBefore) {
  // With a friction of 2 the table ends at 0.37 of the length, the model at half of it.
  expect_the_same_end(R"("contact": {"friction": 2.0})", 0.47 + 0.13 * 16.0 / 39.0,
                      StatusDetail::shortening_limit);
}

TEST(EndOfValidity, IsNotWhereABladeBesideAnotherIsHeldBeyondTheRing) {
  expect_the_same_end(R"("contact": {"friction": 0.5}, "release": {})", 0.05 + 0.9 * 33.0 / 59.0,
                      StatusDetail::none);
}

}  // namespace
}  // namespace rubatlas::test
