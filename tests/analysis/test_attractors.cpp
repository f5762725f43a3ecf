#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "analysis/rules/attractors.hpp"

namespace rubatlas::analysis {
namespace {

using Numbers = std::vector<std::int32_t>;
using Record = std::vector<double>;

constexpr ClosingTolerance kCloses{.relative = 1e-6, .floor = 1e-9};
constexpr double kDisplacement = 2.0;

/// Sections of a periodic orbit on an ellipse, the first of them `first` sections into its period.
Record orbit(std::size_t period, std::size_t first, double right = 0.0, double mirror = 1.0) {
  Record sections;
  for (std::size_t i = 0; i < 100; ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>((first + i) % period) / static_cast<double>(period);
    sections.insert(sections.end(), {right + std::cos(angle), mirror * (0.3 + 0.5 * std::sin(angle)),
                                     -std::sin(angle), mirror * 0.5 * std::cos(angle)});
  }
  return sections;
}

Numbers numbers_of(const std::vector<Record>& records) {
  Attractors attractors(kCloses);
  for (const auto& sections : records) attractors.add(trace_of(sections, kDisplacement, kCloses), sections);
  return attractors.numbers();
}

/// The trace of an aperiodic motion.
MotionTrace aperiodic(double displacement, double error) {
  return {.motion = motion_class::kAperiodic,
          .max_displacement = displacement,
          .displacement_error = error,
          .section = {}};
}

Numbers numbers_of(const std::vector<MotionTrace>& traces) {
  Attractors attractors(kCloses);
  for (const auto& trace : traces) attractors.add(trace, {});
  return attractors.numbers();
}

TEST(AttractorNumbers, OneOrbitStartedAtAnotherPhaseOfItsPeriodIsOneAttractor) {
  EXPECT_EQ(numbers_of({orbit(5, 0), orbit(5, 1), orbit(5, 3), orbit(5, 4)}), (Numbers{1, 1, 1, 1}));
}

TEST(AttractorNumbers, MirroredAndShiftedOrbitsAreOtherAttractors) {
  EXPECT_EQ(numbers_of({orbit(3, 0), orbit(3, 0, 0.0, -1.0), orbit(3, 0, 0.1), orbit(3, 1)}),
            (Numbers{1, 2, 3, 1}));
}

TEST(AttractorNumbers, OrbitsOfOtherPeriodsAreOtherAttractorsThoughTheyShareSections) {
  EXPECT_EQ(numbers_of({orbit(4, 0), orbit(2, 0), orbit(4, 2)}), (Numbers{1, 2, 1}));
}

TEST(AttractorNumbers, OrbitsWithinTheStatedToleranceAreOne) {
  const double size =
      std::sqrt(1.0 + 0.3 * 0.3 + 0.5 * 0.5);  // of the section at phase 0, the largest of period 1
  const double tolerance = kMatchingFactor * kCloses.relative * size;
  EXPECT_EQ(numbers_of({orbit(1, 0), orbit(1, 0, 0.99 * tolerance)}), (Numbers{1, 1}));
  EXPECT_EQ(numbers_of({orbit(1, 0), orbit(1, 0, 1.01 * tolerance)}), (Numbers{1, 2}));
}

TEST(AttractorNumbers, CountFromOneInTheOrderOfTheirFirstAppearance) {
  EXPECT_EQ(numbers_of({orbit(3, 0), orbit(7, 0), orbit(3, 2), orbit(1, 0), orbit(7, 5)}),
            (Numbers{1, 2, 1, 3, 2}));
}

TEST(AttractorNumbers, AMotionThatIsNotResolvedAndAPointThatIsNotDoneHaveNone) {
  Record settling = orbit(1, 0);
  settling[0] += 1e-5;  // within a hundred tolerances
  ASSERT_EQ(trace_of(settling, kDisplacement, kCloses).motion, motion_class::kUnresolved);
  EXPECT_EQ(numbers_of({settling, Record{}, orbit(1, 0), settling}), (Numbers{0, 0, 1, 0}));
}

TEST(AttractorNumbers, AperiodicMotionsAreOneWhereTwoStandardErrorsOfTheirDifferenceReach) {
  const double both = std::hypot(0.03, 0.04);
  EXPECT_EQ(numbers_of({aperiodic(1.0, 0.03), aperiodic(1.0 + 1.99 * both, 0.04)}), (Numbers{1, 1}));
  EXPECT_EQ(numbers_of({aperiodic(1.0, 0.03), aperiodic(1.0 + 2.01 * both, 0.04)}), (Numbers{1, 2}));
}

TEST(AttractorNumbers, AChainOfAperiodicMotionsIsOneAttractorWhateverItsOrder) {
  const auto a = aperiodic(1.0, 0.01);
  const auto b = aperiodic(1.025, 0.01);
  const auto c = aperiodic(1.05, 0.01);
  const auto far = aperiodic(2.0, 0.01);
  EXPECT_EQ(numbers_of({a, b, c, far}), (Numbers{1, 1, 1, 2}));
  EXPECT_EQ(numbers_of({a, c, far, b}), (Numbers{1, 1, 2, 1}));
  EXPECT_EQ(numbers_of({c, far, a}), (Numbers{1, 2, 3}));
}

TEST(AttractorNumbers, OrbitsThatDifferInNothingButTheBladesThatTouchAreNamed) {
  EXPECT_TRUE(may_be_shifted(7, 1.0, 7, 1.00009));
  EXPECT_FALSE(may_be_shifted(7, 1.0, 7, 1.00011));
  EXPECT_FALSE(may_be_shifted(7, 1.0, 5, 1.0));
  EXPECT_FALSE(may_be_shifted(motion_class::kAperiodic, 1.0, motion_class::kAperiodic, 1.0));
}

}  // namespace
}  // namespace rubatlas::analysis
