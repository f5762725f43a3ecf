/// Slip that reverses, and tips that nearly stick.
#include <gtest/gtest.h>

#include <cmath>

#include "hard_point.hpp"

namespace rubatlas::test {
namespace {

using solve::PointStatus;

TEST(Slip, KickedRotorsReverseTheirSlipABoundedNumberOfTimes) {
  // A shaft that whirls against the spin faster than the tips run reverses the slip of every contact; where
  // both nearly cancel, the tip sticks and the model flips to and fro. Kicks of all sizes against slow and
  // fast rotors, friction from none to twice the load.
  int reversals = 0;
  int done = 0;
  for (const auto law : {scene::ContactLaw::elastica, scene::ContactLaw::elastic_ring}) {
    for (const double friction : {0.0, 0.1, 0.5, 2.0}) {
      for (const double speed : {0.005, 0.05, 0.3}) {
        for (int kick = -10; kick <= 10; ++kick) {
          SCOPED_TRACE(::testing::Message() << "law " << static_cast<int>(law) << ", friction " << friction
                                            << ", speed " << speed << ", kick " << kick);
          scene::Scene scene = default_rotor(2);
          scene.contact = {law, friction};
          scene.rotor.misalignment = 0.0;
          const solve::SectionState start{0.005, 0.0, 0.0, 3e-4 * kick * std::abs(kick)};
          const auto outcome = run(scene, speed, start);
          ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, outcome));
          reversals += static_cast<int>(outcome.work.slip_reversals);
          if (outcome.status == PointStatus::done) ++done;
          const std::uint64_t events = 1 + outcome.work.touchdowns + outcome.work.slip_reversals;
          EXPECT_LE(outcome.work.slip_reversals, 100U * (1U + outcome.work.touchdowns));
          EXPECT_LE(outcome.work.right_hand_sides, 400U * events);
          EXPECT_NE(outcome.status, PointStatus::integrator_failed);
        }
      }
    }
  }
  EXPECT_GT(done, 400) << "kicks through the ring are few";
  EXPECT_GT(reversals, 1000);
}

TEST(Slip, TipsThatMayStickComeToRestABoundedNumberOfTimes) {
  // The same kicks. A tip comes loose at the very edge of the cone, and may be at rest again at once.
  int rests = 0;
  int done = 0;
  for (const double friction : {0.0, 0.1, 0.5, 2.0}) {
    for (const double static_ratio : {1.0, 1.0 + 1e-9, 2.0}) {
      for (const double speed : {0.005, 0.05, 0.3}) {
        for (int kick = -10; kick <= 10; ++kick) {
          SCOPED_TRACE(::testing::Message() << "friction " << friction << ", ratio " << static_ratio
                                            << ", speed " << speed << ", kick " << kick);
          scene::Scene scene = default_rotor(2);
          scene.contact = {scene::ContactLaw::elastic_ring, friction};
          scene.rotor.misalignment = 0.0;
          scene.stick.emplace().static_ratio = static_ratio;
          const solve::SectionState start{0.005, 0.0, 0.0, 3e-4 * kick * std::abs(kick)};
          const auto outcome = run(scene, speed, start);
          ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, outcome));
          rests += static_cast<int>(outcome.work.slip_reversals);
          if (outcome.status == PointStatus::done) ++done;
          const std::uint64_t events = 1 + outcome.work.touchdowns + outcome.work.slip_reversals;
          EXPECT_LE(outcome.work.slip_reversals, 100U * (1U + outcome.work.touchdowns));
          EXPECT_LE(outcome.work.right_hand_sides, 400U * events);
          EXPECT_NE(outcome.status, PointStatus::integrator_failed);
        }
      }
    }
  }
  EXPECT_GT(done, 300) << "kicks through the ring are few";
  EXPECT_GT(rests, 500);
}

}  // namespace
}  // namespace rubatlas::test
