/// Sections per revolution and per blade passing (MODEL 6).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "observables/poincare.hpp"
#include "observables/poincare_blade_passing.hpp"
#include "synthetic_motion.hpp"

namespace rubatlas::observables {
namespace {

trajectory::State spiral(double time) {
  return {time, 2 * time, std::cos(time), std::sin(time)};
}

TEST(Poincare, KeepsTheStateAfterEachRevolution) {
  const trajectory::PointConstants point = point_at(0.62, 3);
  Poincare poincare;
  feed(poincare, point, 5, spiral);
  std::vector<double> row(20);
  poincare.write(row);
  for (int r = 0; r < 5; ++r) {
    const trajectory::State expected = spiral((r + 1) * point.period);
    for (int k = 0; k < 4; ++k)
      EXPECT_EQ(row[static_cast<std::size_t>(4 * r + k)], expected[static_cast<std::size_t>(k)]);
  }
}

TEST(Poincare, ForgetsThePointBefore) {
  const trajectory::PointConstants point = point_at(0.62, 3);
  Poincare poincare;
  feed(poincare, point, 7, [](double) { return trajectory::State{9, 9, 9, 9}; });
  feed(poincare, point, 2, spiral);
  std::vector<double> row(8);
  poincare.write(row);
  EXPECT_EQ(row[0], point.period);
  EXPECT_EQ(row[4], 2 * point.period);
}

TEST(PoincareBladePassing, KeepsTheStateAtEveryBladePassing) {
  for (const int blades : {1, 2, 3, 7, 50}) {
    const trajectory::PointConstants point = point_at(0.62, blades);
    PoincareBladePassing passings;
    feed(passings, point, 4, spiral);
    const auto count = static_cast<std::size_t>(4 * blades);
    std::vector<double> row(4 * count, -1.0);
    passings.write(row);
    for (std::size_t i = 0; i < count; ++i) {
      const double time = point.period * static_cast<double>(i + 1) / blades;
      const trajectory::State expected = spiral(time);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(row[4 * i + k], expected[k], 2e-14 * (1 + time)) << blades << ", " << i;
    }
  }
}

TEST(PoincareBladePassing, LastPassingOfARevolutionIsItsSection) {
  const trajectory::PointConstants point = point_at(0.4, 3);
  Poincare poincare;
  PoincareBladePassing passings;
  feed(poincare, point, 6, spiral);
  feed(passings, point, 6, spiral);
  std::vector<double> sections(24);
  std::vector<double> all(72);
  poincare.write(sections);
  passings.write(all);
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(all[4 * (3 * r + 2) + k], sections[4 * r + k]);
  }
}

TEST(PoincareBladePassing, PassingWhereTwoPiecesMeetIsKeptOnce) {
  const trajectory::PointConstants point = point_at(1.0, 2);
  PoincareBladePassing passings;
  passings.begin(point);
  SyntheticPiece first(0.0, point.period / 2, spiral);
  SyntheticPiece second(point.period / 2, point.period, spiral);
  passings.piece(first);
  passings.piece(second);
  passings.revolution_ends(spiral(point.period));
  EXPECT_EQ(first.states() + second.states(), 1);
  std::vector<double> row(8);
  passings.write(row);
  EXPECT_EQ(row[0], point.period / 2);
  EXPECT_EQ(row[4], point.period);
}

}  // namespace
}  // namespace rubatlas::observables
