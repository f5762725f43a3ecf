// Blades whose two unknowns are solved for at each place, against the same blades carried along as a state.
#include <gtest/gtest.h>

#include <algorithm>

#include "directed_law.hpp"

namespace rubatlas::test {
namespace {

RecordedMotion from_rest(const HardRotor& rotor, const auto& law) {
  return follow(rotor, law, effects::NoForcing{}, solve::State::Zero(), 200,
                [](observables::MotionPiece&) {});
}

/// Of the last sections, from one to the next [m].
double closing_distance(const RecordedMotion& motion) {
  double largest = 0.0;
  for (std::size_t i = motion.sections.size() - 40; i < motion.sections.size(); ++i) {
    largest = std::max(largest, (motion.sections[i] - motion.sections[i - 1]).abs().maxCoeff());
  }
  return largest;
}

TEST(DirectedMotion, RepeatsItselfToRoundingWhereItIsPeriodicOnTheOrbitOfTheCarriedLaw) {
  for (const double speed : {0.2, 0.37, 0.42, 0.65}) {
    SCOPED_TRACE(speed);
    HardRotor rotor;
    rotor.speed_ratio = speed;
    rotor.tolerance = 1e-9;
    const auto carried = from_rest(rotor, rotor.elastica());
    const auto solved = from_rest(rotor, directed_law(rotor, contact::CoulombFriction{rotor.friction}));
    ASSERT_EQ(carried.status, solve::PointStatus::done);
    ASSERT_EQ(solved.status, solve::PointStatus::done);
    EXPECT_LE(closing_distance(carried), 1e-14);
    EXPECT_LE(closing_distance(solved), 1e-14);
    // A step may err by 1e-11 m, and these orbits forget an error only in some ten to a hundred revolutions.
    EXPECT_LE((carried.sections.back() - solved.sections.back()).abs().maxCoeff(), 1e-8);
  }
}

}  // namespace
}  // namespace rubatlas::test
