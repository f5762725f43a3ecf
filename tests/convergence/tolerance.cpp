/// Error follows tolerance: what `accuracy.tolerance` promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../solve/reference_case.hpp"

namespace rubatlas::test {
namespace {

class Tolerance : public ::testing::TestWithParam<const char*> {};

TEST_P(Tolerance, BoundsTheErrorOfPeriodicMotionsAndTakesItAlong) {
  const ReferenceCase& c = reference_case(GetParam());
  const double clearance = c.scene.clearance();
  const auto last = static_cast<std::size_t>(c.last_section);
  double smallest_so_far = 1e300;
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    const auto sections = sections_of(c, tolerance);
    double error = 0.0;
    for (std::size_t i = 0; i < c.last_sections.size(); ++i) {
      error = std::max(error, distance(sections[last - 11 + i], c.last_sections[i]));
    }
    EXPECT_LE(error, 100.0 * tolerance * clearance) << "tolerance " << tolerance;
    // Errors far below their tolerance are luck (a contact of few steps); beyond that they must not grow.
    EXPECT_LE(error, 10.0 * std::max(smallest_so_far, tolerance * clearance)) << "tolerance " << tolerance;
    smallest_so_far = std::min(smallest_so_far, error);
  }
}

INSTANTIATE_TEST_SUITE_P(Periodic, Tolerance,
                         ::testing::Values("default_Om0.40", "default_Om0.62", "mu0.5_Om0.62", "mu0_Om0.62",
                                           "rig_mu0.1_Om0.605", "zeta0.2_Om0.5", "zeta1_Om0.5", "n2_Om0.3"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           for (char& letter : name) {
                             if (letter == '.') letter = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace rubatlas::test
