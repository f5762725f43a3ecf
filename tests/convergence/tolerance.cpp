/// Error follows tolerance: what `accuracy.tolerance` promises of the default method.
///
/// Trajectory error on periodic points: the largest difference of the last sections (revolutions 290 … 300)
/// to independent data. The bound is 100 × tolerance × δc at every tolerance from 1e-4 to 1e-12; and the
/// error does not grow as the tolerance shrinks, but for noise at the bottom: an error below its tolerance is
/// luck.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../point/reference_case.hpp"
#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

/// Settles on an orbit of period 8 after a long transient that multiplies errors: in which of its eight
/// revolutions it does depends on the last digits, the orbit does not. Its sections agree up to a shift.
constexpr const char* kShifted = "me1e-4_Om0.3";

std::vector<ReferenceCase> periodic_cases() {
  std::vector<ReferenceCase> cases;
  for (const ReferenceCase& c : reference_cases()) {
    if (c.periodic) cases.push_back(c);
  }
  return cases;
}

/// The largest difference of the last sections, these taken `shift` revolutions earlier.
double difference(const ReferenceCase& c, const std::vector<motion::SectionState>& sections,
                  std::size_t shift) {
  const std::size_t first = sections.size() - c.last_sections.size() - shift;
  double largest = 0.0;
  for (std::size_t i = 0; i < c.last_sections.size(); ++i) {
    largest = std::max(largest, largest_difference(sections[first + i], c.last_sections[i]));
  }
  return largest;
}

class Tolerance : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(Tolerance, BoundsTheErrorOfPeriodicMotionsAndTakesItAlong) {
  const ReferenceCase& c = GetParam();
  const std::size_t shifts = c.name == kShifted ? 8 : 1;
  const double clearance = c.scene.clearance();
  double smallest_so_far = 1e300;
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    const auto sections = settled_sections_of(c, tolerance);
    double error = difference(c, sections, 0);
    for (std::size_t shift = 1; shift < shifts; ++shift) {
      error = std::min(error, difference(c, sections, shift));
    }
    EXPECT_LE(error, 100.0 * tolerance * clearance) << "tolerance " << tolerance;
    EXPECT_LE(error, 10.0 * std::max(smallest_so_far, tolerance * clearance)) << "tolerance " << tolerance;
    smallest_so_far = std::min(smallest_so_far, error);
  }
}

INSTANTIATE_TEST_SUITE_P(Periodic, Tolerance, ::testing::ValuesIn(periodic_cases()),
                         [](const auto& instance) {
                           std::string name = instance.param.name;
                           for (char& letter : name) {
                             if (letter == '.' || letter == '-') letter = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace rubatlas::test
