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

#include "../solve/reference_case.hpp"

namespace rubatlas::test {
namespace {

/// What a motion is known to do that keeps its last sections from following the tolerance everywhere.
struct Exception {
  const char* name;
  double loosest;        ///< tolerance from which on the promise holds
  bool shifted_in_time;  ///< sections agree up to a shift of whole revolutions
};

Exception exception_of(const std::string& name) {
  // Period 8 after a long transient that multiplies errors: in which of its eight revolutions it settles
  // depends on the last digits, the orbit does not.
  if (name == "me1e-4_Om0.3") return {"", 1e-4, true};
  // Starts with a kick that brings one blade close to the model's border: at 1e-4 its error is enough to
  // leave it, which the run says (status), in the first revolution.
  if (name == "slip_inconsistent_n5_Om0.08") return {"", 1e-5, false};
  return {"", 1e-4, false};
}

std::vector<ReferenceCase> periodic_cases() {
  std::vector<ReferenceCase> cases;
  for (const ReferenceCase& c : reference_cases()) {
    if (c.periodic) cases.push_back(c);
  }
  return cases;
}

/// The largest difference of the last sections, these taken `shift` revolutions earlier.
double difference(const ReferenceCase& c, const std::vector<solve::SectionState>& sections,
                  std::size_t shift) {
  const std::size_t first = sections.size() - c.last_sections.size() - shift;
  double largest = 0.0;
  for (std::size_t i = 0; i < c.last_sections.size(); ++i) {
    largest = std::max(largest, distance(sections[first + i], c.last_sections[i]));
  }
  return largest;
}

class Tolerance : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(Tolerance, BoundsTheErrorOfPeriodicMotionsAndTakesItAlong) {
  constexpr std::size_t kLongestPeriod = 8;  // of the cases that may be shifted, in revolutions
  const ReferenceCase& c = GetParam();
  const Exception exception = exception_of(c.name);
  const double clearance = c.scene.clearance();
  double smallest_so_far = 1e300;
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    if (tolerance > exception.loosest) continue;
    const auto sections = sections_of(c, tolerance);
    double error = difference(c, sections, 0);
    for (std::size_t shift = 1; exception.shifted_in_time && shift < kLongestPeriod; ++shift) {
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
