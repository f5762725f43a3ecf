/// The supremum of the displacement over continuous time, on motions whose supremum is known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "observables/max_displacement.hpp"
#include "synthetic_motion.hpp"
#include "trajectory/largest_distance.hpp"

namespace rubatlas::observables {
namespace {

constexpr double kAccuracy = 1e-14;  ///< relative: a maximum is flat

/// x = a cos(ωτ + φ), y = b sin(ωτ + φ).
std::function<trajectory::State(double)> ellipse(double a, double b, double frequency, double phase) {
  return [=](double time) {
    const double angle = frequency * time + phase;
    return trajectory::State{a * std::cos(angle), b * std::sin(angle), -a * frequency * std::sin(angle),
                             b * frequency * std::cos(angle)};
  };
}

double largest(const trajectory::PointConstants& point, int revolutions,
               const std::function<trajectory::State(double)>& motion) {
  MaxDisplacement observable;
  feed(observable, point, revolutions, motion);
  std::vector<double> row(1);
  observable.write(row);
  return row[0];
}

TEST(MaxDisplacement, IsTheMajorSemiAxisOfAnEllipse) {
  for (const double speed : {0.05, 0.3, 0.62, 1.0, 2.5}) {
    for (const double phase : {0.0, 0.1, 1.0, 2.0, 3.0}) {
      const trajectory::PointConstants point = point_at(speed, 3);
      EXPECT_NEAR(largest(point, 3, ellipse(0.013, 0.004, 1.0, phase)), 0.013, kAccuracy * 0.013)
          << speed << ", " << phase;
      EXPECT_NEAR(largest(point, 3, ellipse(0.004, 0.013, speed, phase)), 0.013, kAccuracy * 0.013) << speed;
      EXPECT_NEAR(largest(point, 3, ellipse(0.013, 0.01299, 1.0, phase)), 0.013, kAccuracy * 0.013)
          << "nearly a circle";
    }
  }
}

TEST(MaxDisplacement, IsTheSumOfTwoWhirlsWhereTheyMeet) {
  // z = a e^{iτ} + b e^{-iΩτ}: |z| is largest, a + b, where (1 + Ω) τ is a whole turn.
  const double speed = 0.7;
  const trajectory::PointConstants point = point_at(speed, 3);
  const auto motion = [speed](double time) {
    const double a = 0.008;
    const double b = 0.003;
    const double forward = time - 1.0;
    const double backward = -speed * (time - 1.0);
    return trajectory::State{a * std::cos(forward) + b * std::cos(backward),
                             a * std::sin(forward) + b * std::sin(backward),
                             -a * std::sin(forward) + speed * b * std::sin(backward),
                             a * std::cos(forward) - speed * b * std::cos(backward)};
  };
  EXPECT_NEAR(largest(point, 2, motion), 0.011, kAccuracy * 0.011);
}

TEST(MaxDisplacement, IsTheFirstMaximumOfADecayingSwing) {
  // x = e^{-ζτ} sin τ is largest at τ = atan(1/ζ).
  const double damping = 0.1;
  const auto motion = [damping](double time) {
    const double decay = std::exp(-damping * time);
    return trajectory::State{decay * std::sin(time), 0.0, decay * (std::cos(time) - damping * std::sin(time)),
                             0.0};
  };
  const double top = std::atan(1 / damping);
  const double expected = std::exp(-damping * top) * std::sin(top);
  EXPECT_NEAR(largest(point_at(0.3, 3), 4, motion), expected, kAccuracy * expected);
}

TEST(MaxDisplacement, MayStandAtTheEndOfAPiece) {
  // A cusp between two pieces, as an impact would leave: only the pieces' ends see it.
  const trajectory::PointConstants point = point_at(1.0, 3);
  const auto motion = [](double time) {
    const double peak = 2.0;
    return trajectory::State{1.0 - std::abs(time - peak), 0.0, time < peak ? 1.0 : -1.0, 0.0};
  };
  MaxDisplacement observable;
  observable.begin(point);
  SyntheticPiece rising(1.5, 2.0, motion);
  SyntheticPiece falling(2.0, 2.5, motion);
  observable.piece(rising);
  observable.piece(falling);
  std::vector<double> row(1);
  observable.write(row);
  EXPECT_EQ(row[0], 1.0);
}

TEST(MaxDisplacement, DoesNotSearchPiecesThatCannotBeatTheLargest) {
  const trajectory::PointConstants point = point_at(0.3, 3);
  MaxDisplacement observable;
  observable.begin(point);
  SyntheticPiece large(0.0, 10.0, ellipse(0.01, 0.002, 1.0, 0.4));
  SyntheticPiece small(10.0, 20.0, ellipse(0.005, 0.002, 1.0, 0.4), {}, 0.006);
  SyntheticPiece larger(20.0, 20.9, ellipse(0.02, 0.002, 1.0, 0.4), {}, 0.03);
  observable.piece(large);
  observable.piece(small);
  EXPECT_GT(large.states(), 0);
  EXPECT_EQ(small.states(), 0);
  std::vector<double> row(1);
  observable.write(row);
  EXPECT_NEAR(row[0], 0.01, kAccuracy * 0.01);
  observable.piece(larger);
  observable.write(row);
  EXPECT_GT(larger.states(), 0);
  EXPECT_GT(row[0], 0.01);
  observable.begin(point);
  observable.write(row);
  EXPECT_EQ(row[0], 0.0) << "a new point starts from nothing";
}

TEST(LargestDistance, MayBeTakenFromAnotherCentre) {
  // A circle of radius r around (0, b) is farthest from (0, −d) at its top.
  const auto motion = [](double time) {
    return trajectory::State{0.004 * std::cos(time), 0.001 + 0.004 * std::sin(time), -0.004 * std::sin(time),
                             0.004 * std::cos(time)};
  };
  SyntheticPiece piece(0.2, 6.0, motion);
  EXPECT_NEAR(trajectory::largest_distance(piece, -0.01, 0.5), 0.015, kAccuracy * 0.015);
}

TEST(LargestDistance, HoldsForPiecesMuchShorterThanAnOscillation) {
  const auto motion = ellipse(0.013, 0.004, 1.0, 0.0);
  for (const double length : {1e-12, 1e-6, 1e-2}) {
    SyntheticPiece around(2 * std::numbers::pi - length / 3, 2 * std::numbers::pi + length, motion);
    EXPECT_NEAR(trajectory::largest_distance(around, 0.0, 0.5), 0.013, kAccuracy * 0.013) << length;
  }
}

}  // namespace
}  // namespace rubatlas::observables
