#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/rules/same_motion.hpp"

namespace rubatlas::analysis {
namespace {

constexpr ClosingTolerance kClosing{.relative = 1e-6, .floor = 1e-9};

/// Sections of an orbit that repeats after `period` sections, the first of them `first` sections into it.
std::vector<double> cycle(std::size_t period, std::size_t first, double size = 1.0, double off = 0.0) {
  std::vector<double> sections;
  for (std::size_t i = 0; i < 100; ++i) {
    const auto place = static_cast<double>((first + i) % period);
    sections.insert(sections.end(), {size * (1.0 + 0.1 * place) + off, 0.5 * size, 0.1 * place, 0.0});
  }
  return sections;
}

/// Sections whose displacement wanders without a period.
std::vector<double> wandering(double from) {
  std::vector<double> sections;
  double x = from;
  for (std::size_t i = 0; i < 100; ++i) {
    x = 3.9 * x * (1.0 - x);  // the logistic map, which is chaotic here
    sections.insert(sections.end(), {x, 0.0, 0.0, 0.0});
  }
  return sections;
}

bool same(const std::vector<double>& one, double displacement_of_one, const std::vector<double>& other,
          double displacement_of_other) {
  return is_same_motion(trace_of(one, displacement_of_one, kClosing), one,
                        trace_of(other, displacement_of_other, kClosing), kClosing);
}

TEST(SameMotion, APeriodicOrbitIsTheSameWhereverItsRecordBegins) {
  EXPECT_TRUE(same(cycle(3, 0), 2.0, cycle(3, 2), 2.0));
}

TEST(SameMotion, PeriodicOrbitsThatAreFurtherApartThanTheToleranceDiffer) {
  EXPECT_TRUE(same(cycle(2, 0), 2.0, cycle(2, 0, 1.0, 0.5e-6), 2.0));
  EXPECT_FALSE(same(cycle(2, 0), 2.0, cycle(2, 0, 1.0, 5e-6), 2.0));
}

TEST(SameMotion, OrbitsOfDifferentPeriodsDifferThoughTheyShareASection) {
  EXPECT_FALSE(same(cycle(1, 0), 2.0, cycle(2, 1), 2.0));
}

TEST(SameMotion, AperiodicMotionsAreTheSameWhereTheirDisplacementsAre) {
  const auto one = wandering(0.31);
  const auto other = wandering(0.47);
  const double error = std::hypot(trace_of(one, 1.0, kClosing).displacement_error,
                                  trace_of(other, 1.0, kClosing).displacement_error);
  ASSERT_EQ(trace_of(one, 1.0, kClosing).motion, motion_class::kAperiodic);
  ASSERT_GT(error, 0.0);
  EXPECT_TRUE(same(one, 1.0, other, 1.0 + 1.9 * error));
  EXPECT_FALSE(same(one, 1.0, other, 1.0 + 2.1 * error));
}

TEST(SameMotion, AnAperiodicMotionIsNoPeriodicOne) {
  EXPECT_FALSE(same(wandering(0.31), 1.0, cycle(4, 0), 1.0));
}

TEST(SameMotion, PointsThatDidNotEndAsDoneAreTheSame) {
  EXPECT_TRUE(same({}, 0.0, {}, 0.0));
  EXPECT_FALSE(same({}, 0.0, cycle(1, 0), 1.0));
}

TEST(SameMotion, TheErrorOfAMaximumIsTheScatterOfTheMaximaOfTenths) {
  // Each tenth has one section further out than its others, alternately by 0.1 and by 0.2.
  std::vector<double> sections;
  for (std::size_t i = 0; i < 100; ++i) {
    const double x = i % 10 == 5 ? (i % 20 == 5 ? 1.1 : 1.2) : 1.0;
    sections.insert(sections.end(), {x, 0.0, 0.0, 0.0});
  }
  EXPECT_NEAR(trace_of(sections, 1.2, kClosing).displacement_error, 0.05 * std::sqrt(10.0 / 9.0), 1e-12);
}

}  // namespace
}  // namespace rubatlas::analysis
