/// The polynomials of an interval between its nodes, on intervals whose polynomials are known.
#include "collocation/interval_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubatlas::test {
namespace {

using namespace collocation;

/// A motion along x in an interval in which time goes on unevenly, τ = 0.3 (θ + a θ²)/(1 + a).
struct Course {
  double unevenness;  ///< a
  [[nodiscard]] double elapsed(double fraction) const {
    return 0.3 * (fraction + unevenness * fraction * fraction) / (1.0 + unevenness);
  }
  [[nodiscard]] double time_slope(double fraction) const {
    return 0.3 * (1.0 + 2.0 * unevenness * fraction) / (1.0 + unevenness);
  }
};

/// x = 1 − c (τ − t)² and y = 0: farthest at the time t.
Interval swing_with_top(const Course& course, double top, double curvature) {
  Interval interval;
  const auto x = [&](double time) { return 1.0 - curvature * (time - top) * (time - top); };
  const auto vx = [&](double time) { return -2.0 * curvature * (time - top); };
  interval.shaft.start = {x(0.0), 0.0, vx(0.0), 0.0};
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double node = kNodeTables.node[i];
    interval.elapsed[i] = course.elapsed(node);
    interval.time_slope[i] = course.time_slope(node);
    interval.shaft.x[i] = x(interval.elapsed[i]);
    interval.shaft.vx[i] = vx(interval.elapsed[i]);
    interval.shaft.ax[i] = -2.0 * curvature;
  }
  return interval;
}

TEST(IntervalSamples, WhatSetsOutFromZeroPassesThroughItWhereItComesBack) {
  // A tip whose slip has just reversed, and reverses again before the first node: v starts as the least
  // number that has a sign, which is not where it comes back.
  constexpr double kBack = 0.005;  // θ
  for (const double start : {0.0, std::numeric_limits<double>::min()}) {
    AtPlaces values{start};
    for (std::size_t i = 1; i < kPlaces; ++i)
      values[i] = kNodeTables.place[i] * (kBack - kNodeTables.place[i]);
    ASSERT_LT(values[1], 0.0);
    EXPECT_NEAR(crossing(values, 1), kBack, 1e-12) << start;
  }
}

TEST(IntervalSamples, FindWhereAnIntervalHasReachedATime) {
  for (const double unevenness : {0.0, 1.0, -0.4, 1e6}) {  // the last one starts as a tip does that touches
    const Course course{unevenness};
    const Interval interval = swing_with_top(course, 0.1, 1.0);
    for (int i = 0; i <= 1000; ++i) {
      const double time = 0.3 * i / 1000;
      EXPECT_NEAR(course.elapsed(fraction_at(interval, time)), time, 1e-14) << unevenness;
    }
  }
}

TEST(IntervalSamples, TheLargestDisplacementIsFoundWhereverItLies) {
  for (const double unevenness : {0.0, 0.8, -0.4}) {
    const Course course{unevenness};
    for (int i = -20; i <= 120; ++i) {
      const double top = 0.3 * i / 100;
      const Interval interval = swing_with_top(course, top, 2.0);
      const auto expected = [&](double from, double to) {
        const double nearest = std::clamp(top, course.elapsed(from), course.elapsed(to)) - top;
        return 1.0 - 2.0 * nearest * nearest;
      };
      for (const double from : {0.0, 0.1, 0.51}) {
        for (const double to : {1.0, 0.95, 0.52}) {
          EXPECT_NEAR(farthest(interval, from, to).value, expected(from, to), 1e-14)
              << "top at " << top << " of " << from << " to " << to;
        }
      }
    }
  }
}

TEST(IntervalSamples, TheLargestValueIsFoundWhereverItLies) {
  for (int i = 1; i < 100; ++i) {
    const double top = i / 100.0;
    AtPlaces values;
    for (std::size_t place = 0; place < kPlaces; ++place) {
      const double away = kNodeTables.place[place] - top;
      values[place] = 0.7 - away * away * (1.0 + 0.5 * kNodeTables.place[place]);
    }
    for (const double from : {0.0, 0.1, 0.96}) {
      for (const double to : {1.0, 0.95, 0.15}) {
        if (!(from < top && top < to)) continue;
        const auto found = largest_of(values, from, to, 0.0);
        EXPECT_NEAR(found.argument, top, 1e-5) << "a maximum is flat: its value errs by 1e-10";
        EXPECT_NEAR(found.value, 0.7, 1e-9);
      }
    }
  }
}

TEST(IntervalSamples, AStretchStartsFromTheIntervalsPolynomials) {
  const collocation::Machine machine{};
  const Interval interval = swing_with_top({0.5}, 0.1, 2.0);
  const auto read_stretch = collocation::interval_solver().read_stretch;
  // Up to 1 the nodes of the stretch are those of the interval.
  for (const double fraction : {1e-3, 0.3, 0.77, 1.0, 1.0 + 1e-9}) {
    Interval stretch;
    read_stretch(machine, interval, fraction, stretch);
    Interval itself = interval;
    read_stretch(machine, itself, fraction, itself);
    EXPECT_EQ(itself.shaft.x.value, stretch.shaft.x.value);
    EXPECT_EQ(itself.shaft.vx.value, stretch.shaft.vx.value);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const AtPlaces basis = basis_at(fraction * kNodeTables.node[i]);
      EXPECT_NEAR(stretch.shaft.x[i],
                  sum_of_products(basis, at_places(interval.shaft.start[0], interval.shaft.x)), 1e-15);
      EXPECT_NEAR(stretch.shaft.vx[i],
                  sum_of_products(basis, at_places(interval.shaft.start[2], interval.shaft.vx)), 1e-15);
    }
  }
}

}  // namespace
}  // namespace rubatlas::test
