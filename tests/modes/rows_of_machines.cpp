/// Rows of eight times of every kind of machine, against single states; the bounds of flight; touch-downs
/// that are found in rows against those found in steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "contact/pose.hpp"
#include "modes/flight.hpp"
#include "modes/flight_row.hpp"
#include "modes/touchdown_search.hpp"
#include "modes/work_meter.hpp"
#include "random_machine.hpp"

namespace rubatlas::test {
namespace {

/// The largest component of a motion on the way to a time, velocities divided by the fastest frequency [m].
double largest_on_the_way(const RandomMachine& random, const modes::Flight& flight, double until) {
  double largest = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double time = flight.start_time() + (until - flight.start_time()) * i / 100;
    const rotor::ShaftAndRing there = flight.state(time);
    for (int j = 0; j < 8; ++j)
      largest = std::max(largest, std::abs(there[j]) / (j % 4 < 2 ? 1.0 : random.fastest));
  }
  return largest;
}

TEST(FlightRows, AreTheStatesAndGapsOfTheFlightToRounding) {
  std::mt19937_64 generator(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const RandomMachine random(generator);
    const rotor::Machine& machine = random.machine;
    modes::Flight flight(machine);
    start_anywhere(generator, random, flight);
    modes::FlightRow row(machine, std::pow(10.0, between(generator, -3.0, -0.3)));
    const double begin = flight.start_time() + between(generator, 0.0, 5.0);
    row.start(begin, flight.state(begin), 0.0);
    const double end = begin + modes::kTimesOfRow * row.spacing();
    const double size = std::max(largest_on_the_way(random, flight, end), 1e-6);
    const contact::BladeDirection first = machine.blades.first(begin);
    for (int i = 0; i < modes::kTimesOfRow; ++i) {
      const double time = begin + (i + 1) * row.spacing();
      const rotor::ShaftAndRing exact = flight.state(time);
      const rotor::ShaftAndRing found = row.state(i);
      // A flight in two parts has the phases of what is fast, and of what grows, rounded once more.
      const double rounding = 1e-13 * size * random.fastest;
      for (int j = 0; j < 8; ++j) {
        ASSERT_NEAR(found[j], exact[j], rounding * (j % 4 < 2 ? 1.0 : random.fastest))
            << random.kind << ", number " << i << ", component " << j;
      }
      const rotor::State seen = rotor::from_ring(exact);
      const double turning = machine.blades.angular_speed(time);
      for (std::size_t k = 0; k < random.blades.size(); ++k) {
        const int blade = static_cast<int>(k);
        const auto gaps = row.gaps(random.blades[k], machine.blades.direction(blade, first));
        const auto er = machine.blades.direction(blade, machine.blades.first(time));
        const contact::Pose there = pose_of(machine.constants, random.blades[k], er, seen);
        const double lever = 0.2 + 2.0 * size;
        ASSERT_NEAR(gaps.gap[i], there.gap, lever * (rounding + 1e-15 * machine.constants.length_scale))
            << random.kind;
        ASSERT_NEAR(gaps.rate[i], contact::gap_rate(random.blades[k], there, turning),
                    4.0 * lever * random.fastest * (rounding + 1e-15 * machine.constants.length_scale))
            << random.kind;
      }
    }
  }
}

TEST(FlightRows, ShowWhatListenersAskForOfAnyMachine) {
  std::mt19937_64 generator(4);
  int passes = 0;
  int inside = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const RandomMachine random(generator);
    modes::Flight flight(random.machine);
    start_anywhere(generator, random, flight);
    modes::WorkMeter meter;
    modes::TouchdownSearch search(flight, random.blades, meter);
    const double begin = flight.start_time();
    const double end = begin + between(generator, 0.5, 10.0);
    trajectory::MotionPiece& piece = search.piece(end);

    const trajectory::SampleTimes times{end, 3000};
    const int first = static_cast<int>(begin / times.spacing()) + 1;
    std::vector<double> x(static_cast<std::size_t>(3000 - first));
    std::vector<double> y(x.size());
    piece.places(times, first, x, y);
    const rotor::State at_end = flight.shaft(end);
    const rotor::State at_begin = flight.shaft(begin);
    double largest = std::max(std::hypot(at_begin[0], at_begin[1]), std::hypot(at_end[0], at_end[1]));
    double nearest = -INFINITY;
    std::vector<double> before(random.blades.size(), INFINITY);
    std::vector<double> before_that(random.blades.size(), INFINITY);
    std::vector<rotor::ShaftAndRing> states;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double time = times[first + static_cast<int>(i)];
      const rotor::ShaftAndRing exact = states.emplace_back(flight.state(time));
      largest = std::max(largest, std::hypot(exact[0], exact[1]));
      for (std::size_t k = 0; k < before.size(); ++k) {
        const double overlap = search.tip(static_cast<int>(k), time).overlap;
        if (before[k] > before_that[k] && before[k] > overlap && before[k] < 0.0)
          nearest = std::max(nearest, before[k]);
        before_that[k] = std::exchange(before[k], overlap);
      }
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_NEAR(x[i], states[i][0], 1e-12 * largest) << random.kind;
      ASSERT_NEAR(y[i], states[i][1], 1e-12 * largest) << random.kind;
    }
    if (random.fastest > 3.0) continue;  // else samples, and rows, may be too far apart
    const double found = piece.largest_displacement(0.0, random.machine.constants.speed_ratio);
    ASSERT_GE(found, largest * (1.0 - 1e-14)) << random.kind;
    ASSERT_LE(found, largest * (1.0 + 1e-4)) << random.kind;
    if (found > 1.001 * std::max(std::hypot(at_begin[0], at_begin[1]), std::hypot(at_end[0], at_end[1])))
      ++inside;
    const auto pass = piece.nearest_pass(INFINITY, {end, random.machine.constants.speed_ratio, 1});
    if (nearest == -INFINITY) continue;
    ++passes;
    ASSERT_TRUE(pass.has_value()) << random.kind;
    ASSERT_NEAR(pass->miss, -nearest, 1e-3 * kClearanceOfMachines) << random.kind;
    ASSERT_LE(pass->miss, -nearest + 1e-15) << random.kind;
  }
  EXPECT_GT(inside, 30);
  EXPECT_GT(passes, 30);
}

/// The fourth derivative of a function from five of its values.
template <class Function>
double fourth_derivative(Function function, double at, double apart) {
  return (function(at - 2.0 * apart) - 4.0 * function(at - apart) + 6.0 * function(at) -
          4.0 * function(at + apart) + function(at + 2.0 * apart)) /
         std::pow(apart, 4);
}

TEST(FlightRows, NoGapBendsMoreThanItsBoundAllows) {
  std::mt19937_64 generator(2);
  double closest = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    const RandomMachine random(generator);
    const rotor::Machine& machine = random.machine;
    modes::Flight flight(machine);
    start_anywhere(generator, random, flight);
    modes::WorkMeter meter;
    const modes::TouchdownSearch search(flight, random.blades, meter);
    const double begin = flight.start_time();
    const double end = begin + std::min(5.0, flight.time_of_bound());
    const double bound = search.gap_bounds(flight.bound(begin, flight.state(begin), end - begin)).fourth;
    const double apart = 0.02 / random.fastest;
    for (std::size_t k = 0; k < random.blades.size(); ++k) {
      const auto gap = [&](double time) {
        const auto er = machine.blades.direction(static_cast<int>(k), machine.blades.first(time));
        return pose_of(machine.constants, random.blades[k], er, rotor::from_ring(flight.state(time))).gap;
      };
      for (int i = 0; i <= 100; ++i) {
        const double time = begin + 2.0 * apart + (end - begin - 4.0 * apart) * i / 100;
        const double fourth = std::abs(fourth_derivative(gap, time, apart));
        const double rounding = 1e-16 / std::pow(apart, 4);
        ASSERT_LE(fourth, bound * (1.0 + 1e-3) + 16.0 * rounding) << random.kind << " at " << time;
        if (rounding < 1e-6 * bound) closest = std::max(closest, fourth / bound);
      }
    }
  }
  EXPECT_GT(closest, 0.5) << "some gap is bent about as much as the bound allows";
}

TEST(FlightRows, TheirTouchDownsAreThoseOfStepsThatNoTipCanOutrun) {
  std::mt19937_64 generator(3);
  modes::GoOn nobody;
  int found = 0;
  std::uint64_t in_rows = 0;
  std::uint64_t in_steps = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const RandomMachine random(generator);
    const rotor::Machine& machine = random.machine;
    modes::Flight flight(machine);
    modes::WorkMeter meter;
    modes::TouchdownSearch rows(flight, random.blades, meter);
    modes::TouchdownSearch steps(flight, random.blades, meter);
    for (int start = 0; start < 4; ++start) {
      start_anywhere(generator, random, flight);
      if (largest_gap(random, flight, flight.start_time()) >= 0.0) continue;
      const double until = flight.start_time() + between(generator, 0.0, 20.0);
      meter.begin_revolution(nobody);
      const auto touchdown = rows.find(until);
      std::optional<modes::TouchdownSearch::Touchdown> expected;
      for (std::size_t k = 0; k < random.blades.size(); ++k) {
        const auto touch = steps.by_steps(random.blades[k], static_cast<int>(k), flight.start_time(),
                                          flight.at_start(), expected ? expected->time : until);
        if (touch) expected = touch;
      }
      ASSERT_EQ(touchdown.has_value(), expected.has_value()) << random.kind << ", trial " << trial;
      if (!touchdown) continue;
      ++found;
      ASSERT_EQ(touchdown->blade, expected->blade) << random.kind << ", trial " << trial;
      ASSERT_NEAR(largest_gap(random, flight, touchdown->time), 0.0, 1e-15) << random.kind;
      const double away = std::abs(touchdown->time - expected->time);
      const auto tip = rows.tip(touchdown->blade, touchdown->time);
      ASSERT_LE(away * std::abs(tip.rate), 4e-15) << random.kind << ", " << away << " apart";
    }
    in_rows += rows.evaluations();
    in_steps += steps.evaluations();
  }
  EXPECT_GT(found, 1000);
  EXPECT_LT(3 * in_rows, in_steps);
}

}  // namespace
}  // namespace rubatlas::test
