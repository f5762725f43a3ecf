/// Motions through the folds at which blades snap from branch to branch.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "compliant_motion.hpp"

namespace rubatlas::test::compliant {
namespace {

/// Events of one kind, with the blade and the time.
template <class Law>
std::vector<modes::Event> snaps_of(const Run<Law>& motion) {
  std::vector<modes::Event> snaps;
  for (const modes::Event& event : motion.witness.events) {
    if (event.kind == modes::Guard::snap) snaps.push_back(event);
  }
  return snaps;
}

TEST(Branches, AMotionGoesOnThroughTheFoldOfABladeInAYieldingRing) {
  const auto law = make(0.1, 0.0, Theory::elastica, Ring{1e5});
  const auto motion = run(law, 0.45, 3);
  EXPECT_EQ(motion.status, ending::PointStatus::done);
  const auto snaps = snaps_of(motion);
  ASSERT_FALSE(snaps.empty());
  for (const modes::Event& snap : snaps) {
    // There the branch from which it came ends: past it, along the way it moves, h has no root there.
    contact::Pose at = pose_at(0.45, 3, snap);
    EXPECT_GT(at.gap, 0.0);
    EXPECT_LT(snap.slip * at.tangential, 0.0) << "on the receding side";
  }
  EXPECT_LT(motion.witness.largest_jump, 1e-15) << "the state is continuous";
  // The time of the snap follows the tolerance.
  for (const double tolerance : {1e-11, 1e-10, 1e-9}) {
    const auto coarser = snaps_of(run(law, 0.45, 3, 3, tolerance));
    ASSERT_EQ(coarser.size(), snaps.size());
    for (std::size_t i = 0; i < snaps.size(); ++i)
      EXPECT_NEAR(coarser[i].time, snaps[i].time, 2e4 * tolerance) << tolerance;
  }
}

TEST(Branches, ABladeSnapsAtItsFoldBesideAnotherOneWhateverTheTolerance) {
  const auto law = make(0.1, 0.0, Theory::elastica, Ring{1e4});
  rotor::State start;
  start << 2e-3, -1e-3, 0.02, 0.03;
  const auto fine = snaps_of(run(law, 0.315, 1, 3, 1e-15, start));
  ASSERT_FALSE(fine.empty());
  EXPECT_EQ(fine[0].blade, 1);
  EXPECT_NEAR(fine[0].time, 0.32266046, 1e-8) << "the fold";
  for (const double tolerance : {1e-14, 1e-13, 1e-12, 1e-11, 1e-10}) {
    const auto snaps = snaps_of(run(law, 0.315, 1, 3, tolerance, start));
    ASSERT_EQ(snaps.size(), fine.size());
    EXPECT_NEAR(snaps[0].time, fine[0].time, 1e3 * tolerance + 1e-12) << tolerance;
  }
}

TEST(Branches, NoMotionIsLostAtAFold) {
  int snaps = 0;
  for (const double share : {100.0, 300.0, 1000.0}) {
    const auto law = make(0.1, share);
    for (int i = 0; i < 20; ++i) {
      const auto motion = run(law, 0.1 + 0.03 * i, 5, 3, 1e-11);
      EXPECT_EQ(motion.status, ending::PointStatus::done) << share << ", " << i;
      snaps += static_cast<int>(snaps_of(motion).size());
    }
  }
  EXPECT_GT(snaps, 2);
}

TEST(Branches, AColumnBucklesAndStraightensAtTheSameTimesWhateverTheTolerance) {
  const auto law = make(0.0, 0.0, Theory::elastica, Ring{1e5});
  rotor::State start;
  start << -0.0010026794376224251, -0.0039731201235519171, 0.020789851758929081, 0.02654179434526615;
  const auto fine = snaps_of(run(law, 0.208, 1, 10, 1e-15, start));
  ASSERT_FALSE(fine.empty());
  const contact::Pose at = pose_at(0.208, 10, fine[0]);
  EXPECT_LT(fine[0].slip * at.tangential, 0.0);
  for (const double tolerance : {1e-13, 1e-11}) {
    const auto snaps = snaps_of(run(law, 0.208, 1, 10, tolerance, start));
    ASSERT_FALSE(snaps.empty());
    EXPECT_NEAR(snaps[0].time, fine[0].time, 1e4 * tolerance) << tolerance;
  }
}

TEST(Branches, AContactThatIsOpenAtTheStartStandsOnTheRootThatLoadFromZeroMeetsFirst) {
  // Receding, lightly in, where the blade could be compressed or bent.
  const auto law = make(0.02, 1.0, Theory::elastica, Ring{1e5});
  const double tangential = -0.0142;
  const double penetration = 2e-5;
  const double radius = kGeometry.ring_radius + penetration;
  const double radial = std::sqrt(radius * radius - tangential * tangential) - kGeometry.reach;
  // Blade 0 points along x at the start; c = (x, y + y0).
  rotor::State start;
  start << radial, tangential - 0.01001, 0.0, 0.0;
  const auto motion = run(law, 0.3, 1, 1, 1e-13, start);
  ASSERT_FALSE(motion.witness.first_forces.empty());
  contact::Pose at{radial, tangential, 0.0, 0.0, penetration * (2 * kGeometry.ring_radius + penetration)};
  const double bending = law.solve(at, 1.0).value();
  EXPECT_LT(bending, 0.1) << "compressed";
  EXPECT_NEAR(motion.witness.first_forces[0], law.constraint(at, 1.0, bending, 0.3).force.normal, 1e-9);
}

}  // namespace
}  // namespace rubatlas::test::compliant
