/// Flights that are read at equally spaced times, against their closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "../support/machine_of.hpp"
#include "contact/pose.hpp"
#include "modes/flight.hpp"
#include "modes/touchdown_search.hpp"
#include "random_machine.hpp"
#include "rotor/machine.hpp"
#include "trajectory/largest_distance.hpp"

namespace rubatlas::test {
namespace {

constexpr double kSize = 0.01;  ///< [m] of the motions
const std::vector<contact::Geometry> kBlades(3, {0.1, 0.11});

/// Calls `use` with flights of undamped to overdamped shafts, with and without unbalance, over a revolution.
template <class Use>
void for_each_flight(Use use) {
  std::mt19937_64 generator(1);
  for (const double damping : {0.0, 0.001, 0.1, 1.0, 1.7}) {
    for (const double speed : {0.2, 0.62, 1.0, 2.5}) {
      const rotor::RotorConstants constants{speed, damping, 0.01, 0.01, kSize};
      rotor::State state;
      for (double& component : state) component = between(generator, -kSize, kSize);
      const auto fly = [&](const auto& forcing) {
        const rotor::Machine machine = machine_of(constants, rotor::BladeSet(3, speed), forcing);
        modes::Flight flight(machine);
        flight.start(between(generator, 0.0, 0.1), rotor::shaft_and_ring(state));
        modes::WorkMeter meter;
        modes::TouchdownSearch search(flight, kBlades, meter);
        use(flight, search, constants);
      };
      fly(kNoForcing);
      fly(rotor::RotatingUnbalance(0.1 * kSize, 0.4, speed, damping));
    }
  }
}

TEST(FlightBounds, HoldWhereForcingsOfDifferentFrequencyComeIntoStepLater) {
  for (const double damping : {0.0, 0.1, 1.0}) {
    const rotor::RotorConstants constants{2.5, damping, 0.01, 0.01, kSize};
    // A static load, and an unbalance that opposes it at τ = 0.
    const rotor::Harmonic load(0.1 * kSize, 0.0, 0.0, damping);
    const rotor::Harmonics both({load, rotor::RotatingUnbalance(0.08 * kSize, 0.0, 2.5, damping)});
    const auto steady = *both.steady(0.0);
    const rotor::Machine machine{constants, rotor::BladeSet(3, 2.5), {both}, {}};
    modes::Flight flight(machine);
    const rotor::State start{steady.position.real(), steady.position.imag(), steady.velocity.real(),
                             steady.velocity.imag()};
    flight.start(0.0, rotor::shaft_and_ring(start));
    double largest = 0.0;
    double amplitude = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const rotor::State there = flight.shaft(0.01 * i);
      largest = std::max(largest, std::hypot(there[0], there[1]));
      amplitude = std::max(amplitude, std::sqrt(there.square().sum()));
    }
    EXPECT_GT(largest, 2.0 * std::abs(steady.position)) << "else the start would bound the motion";
    EXPECT_LE(largest, flight.shaft_bound(0.0, start, 10.0, false) * (1.0 + 1e-12));
    EXPECT_LE(amplitude, flight.bound(0.0, flight.state(0.0), 10.0).shaft * (1.0 + 1e-12));
  }
}

TEST(FlightSamples, AreThoseOfTheClosedFormToRounding) {
  for_each_flight([](const auto& flight, auto& search, const rotor::RotorConstants& rotor) {
    for (const int count : {7, 64, 256, 8192}) {
      trajectory::MotionPiece& piece = search.piece(rotor.period());
      const trajectory::SampleTimes times{rotor.period(), count};
      const int first = static_cast<int>(flight.start_time() / times.spacing()) + 1;
      for (const int last : {first, first + 1, count - 1}) {
        if (last >= count) continue;
        std::vector<double> x(static_cast<std::size_t>(last - first + 1));
        std::vector<double> y(x.size());
        std::vector<double> x_alone(x.size());
        piece.places(times, first, x, y);
        piece.places(times, first, x_alone, {});
        EXPECT_EQ(x, x_alone);
        double largest = 0.0;
        for (int i = first; i <= last; ++i) {
          const auto sample = static_cast<std::size_t>(i - first);
          const rotor::State exact = flight.shaft(times[i]);
          largest = std::max({largest, std::abs(x[sample] - exact[0]), std::abs(y[sample] - exact[1])});
        }
        EXPECT_LE(largest, 1e-14 * kSize) << "speed ratio " << rotor.speed_ratio << ", damping ratio "
                                          << rotor.damping_ratio << ", " << count << " samples to " << last;
      }
    }
  });
}

/// The same piece, of which only states are known.
class StatesOnly final : public trajectory::PieceWithoutContact {
 public:
  explicit StatesOnly(trajectory::MotionPiece& piece) : piece_(&piece) {}
  [[nodiscard]] double begin() const override { return piece_->begin(); }
  [[nodiscard]] double end() const override { return piece_->end(); }
  [[nodiscard]] trajectory::State state(double time) override { return piece_->state(time); }
  [[nodiscard]] double displacement_bound() const override { return piece_->displacement_bound(); }
  [[nodiscard]] trajectory::Tip tip(int blade, double time) override { return piece_->tip(blade, time); }

 private:
  trajectory::MotionPiece* piece_;
};

TEST(FlightSamples, TheLargestDisplacementOfAFlightIsFoundWhereverItLies) {
  std::mt19937_64 generator(2);
  int inside = 0;
  for_each_flight([&](const auto& flight, auto& search, const rotor::RotorConstants& rotor) {
    for (int i = 0; i < 200; ++i) {
      trajectory::MotionPiece& piece =
          search.piece(flight.start_time() + std::pow(10.0, between(generator, -3.0, 1.5)));
      StatesOnly states(piece);
      const double expected = states.largest_displacement(0.0, rotor.speed_ratio);
      EXPECT_NEAR(piece.largest_displacement(0.0, rotor.speed_ratio), expected, 1e-14 * expected)
          << "speed ratio " << rotor.speed_ratio << ", damping ratio " << rotor.damping_ratio << " up to "
          << piece.end();
      const auto distance = [&](double time) {
        return std::hypot(piece.state(time)[0], piece.state(time)[1]);
      };
      if (expected > (1.0 + 1e-6) * std::max(distance(piece.begin()), distance(piece.end()))) ++inside;
      EXPECT_EQ(piece.largest_displacement(2.0 * expected, rotor.speed_ratio), 2.0 * expected);
    }
  });
  EXPECT_GT(inside, 1000) << "of 8000 flights that many are largest in between";
}

TEST(FlightSamples, TheTipThatPassesTheRingNearestIsTheSameInRowsOfTimesAndByStates) {
  std::mt19937_64 generator(3);
  int passes = 0;
  for_each_flight([&](const auto& flight, auto& search, const rotor::RotorConstants& rotor) {
    const trajectory::PointConstants point{rotor.period(), rotor.speed_ratio, 3};
    for (int i = 0; i < 50; ++i) {
      trajectory::MotionPiece& piece =
          search.piece(flight.start_time() + std::pow(10.0, between(generator, -3.0, 1.5)));
      StatesOnly states(piece);
      const auto expected = states.nearest_pass(INFINITY, point);
      const auto found = piece.nearest_pass(INFINITY, point);
      ASSERT_EQ(found.has_value(), expected.has_value()) << "up to " << piece.end();
      if (!found) continue;
      ++passes;
      EXPECT_NEAR(found->miss, expected->miss, 1e-14 * kSize);
      // Where a maximum lies is known to the root of the rounding of its value, and to the cube root where
      // its curvature vanishes, as it nearly does in one of these flights.
      EXPECT_NEAR(found->side, expected->side, 1e-6 * kSize);
      EXPECT_FALSE(piece.nearest_pass(0.999 * found->miss, point)) << "nothing passes nearer";
    }
  });
  EXPECT_GT(passes, 500);
}

TEST(FlightSamples, ALongFlightIsLookedAtInPartsAndAnEndlessOneAsFarAsWorkIsAllowed) {
  for_each_flight([](const auto& flight, auto& /*search*/, const rotor::RotorConstants& rotor) {
    if (rotor.damping_ratio > 0.0 || rotor.speed_ratio != 0.62) return;
    const auto nearest_until = [&](double time, modes::WorkMeter& meter) {
      modes::TouchdownSearch search(flight, kBlades, meter);
      return search.piece(time).nearest_pass(INFINITY, {rotor.period(), rotor.speed_ratio, 3});
    };
    constexpr double kLong = 1e5;  // twelve times as many rows as are kept at once
    modes::WorkMeter meter;
    const auto in_parts = nearest_until(kLong, meter);
    const auto of_first_part = nearest_until(kLong / 16.0, meter);
    EXPECT_FALSE(meter.ended());
    ASSERT_TRUE(in_parts && of_first_part);
    EXPECT_LT(in_parts->miss, of_first_part->miss) << "an undamped shaft comes ever nearer";
    EXPECT_GT(in_parts->time, kLong / 16.0);
    modes::WorkMeter endless;
    EXPECT_TRUE(nearest_until(1e12, endless));
    EXPECT_EQ(endless.why(), ending::StatusDetail::flight_work);
  });
}

}  // namespace
}  // namespace rubatlas::test
