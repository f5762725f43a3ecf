/// Whole motions by the method `collocation`, against an independent 80-bit implementation (tests/reference)
/// and against `hybrid`.
#include <gtest/gtest.h>

#include "../support/point.hpp"
#include "reference_case.hpp"

namespace rubatlas::test {
namespace {

class ReferenceOrbitByCollocation : public ::testing::TestWithParam<ReferenceCase> {
 protected:
  static ReferenceCase by_collocation(ReferenceCase c) {
    c.scene.accuracy.method = settings::Method::collocation;
    return c;
  }
};

TEST_P(ReferenceOrbitByCollocation, SectionsOfPeriodicMotionsAgreeAfterAllRevolutions) {
  const ReferenceCase c = by_collocation(GetParam());
  if (!c.periodic) return;  // aperiodic ones are held to their first sections below
  const auto sections = settled_sections_of(c, 1e-12);
  const std::size_t last = sections.size();
  for (std::size_t i = 0; i < c.last_sections.size(); ++i) {
    EXPECT_LE(largest_difference(sections[last - 11 + i], c.last_sections[i]), 1e-9 * c.amplitude())
        << "section " << c.last_section - 10 + static_cast<int>(i);
  }
}

TEST_P(ReferenceOrbitByCollocation, FirstSectionsAgreeAsFarAsTheMotionLetsErrorsBe) {
  const ReferenceCase c = by_collocation(GetParam());
  // As the same test of `hybrid` has it (reference_orbits.cpp).
  constexpr double kTolerance = 1e-13;
  constexpr double kAmplification = 10.0 * kTolerance / 1e-16;
  const auto sections = sections_of(c, kTolerance, static_cast<int>(c.first_sections.size()));
  for (std::size_t i = 0; i < c.first_sections.size(); ++i) {
    const double floor = 10.0 * kTolerance * c.scene.clearance();
    EXPECT_LE(largest_difference(sections[i], c.first_sections[i]),
              floor + kAmplification * c.section_uncertainty[i])
        << "section " << i + 1;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, ReferenceOrbitByCollocation, ::testing::ValuesIn(reference_cases()),
                         [](const auto& instance) {
                           std::string name = instance.param.name;
                           for (char& c : name) c = c == '.' || c == '-' ? '_' : c;
                           return name;
                         });

TEST(Collocation, KeepsWhatHybridKeepsOfAPoint) {
  settings::Scene scene = default_rotor(40);
  scene.observables = {"poincare",
                       "poincare_blade_passing",
                       "max_displacement",
                       "spectrum",
                       "touchdowns_per_revolution",
                       "max_contact_force",
                       "contact_fraction",
                       "max_root_strain"};
  scene.protocol.transient_revolutions = 60;
  scene.accuracy.tolerance = 1e-10;
  for (const double speed_ratio : {0.25, 0.36, 0.62}) {
    scene.accuracy.method = settings::Method::hybrid;
    const auto steps = run(scene, speed_ratio);
    scene.accuracy.method = settings::Method::collocation;
    const auto nodes = run(scene, speed_ratio);
    ASSERT_EQ(nodes.status, point::PointStatus::done);
    for (std::size_t row = 0; row < steps.rows.size(); ++row) {
      double largest = 0.0;
      for (const double value : steps.rows[row]) largest = std::max(largest, std::abs(value));
      for (std::size_t i = 0; i < steps.rows[row].size(); ++i) {
        EXPECT_NEAR(nodes.rows[row][i], steps.rows[row][i], 1e-7 * largest)
            << scene.observables[row] << ' ' << i << " at " << speed_ratio;
      }
    }
  }
}

TEST(Collocation, TakesAFractionOfTheEvaluationsOfOneNodeAfterTheOther) {
  settings::Scene scene = default_rotor(100);
  scene.accuracy.method = settings::Method::collocation;
  const auto outcome = run(scene, 0.36);
  ASSERT_EQ(outcome.status, point::PointStatus::done);
  const auto per_touchdown = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(outcome.work.touchdowns);
  };
  // Eight nodes at once: 20 sweeps a touch-down, where steps take 130 right-hand sides one after the other.
  EXPECT_LT(per_touchdown(outcome.work.right_hand_sides) / 8.0, 24.0);
  EXPECT_LT(per_touchdown(outcome.work.steps), 5.0);
}

}  // namespace
}  // namespace rubatlas::test
