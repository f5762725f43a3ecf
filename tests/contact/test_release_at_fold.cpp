/// Contacts that hold a tip beyond the ring, up to the fold of its branch.
#include <gtest/gtest.h>

#include <cmath>

#include "compliant_blades.hpp"

namespace rubatlas::contact {
namespace {

TEST(ReleaseAtFold, HoldsTheTipBeyondTheRingAsLongAsThereIsAForce) {
  for (const double friction : {0.0, 0.01, 0.1, 0.5}) {
    const ElasticaContact law = make({friction}, kReleasedAtFold);
    for (const double lateral : {-1e-4, -1e-3, -5e-3}) {
      // From the ring outwards to the fold, which the root approaches like a square root.
      double gap = 0.0;
      auto root = law.solve(pressed_tip(0.0, lateral), 1.0);
      ASSERT_TRUE(root.has_value());
      const double at_ring = *root;
      double step = 1e-4;
      double last = *root;
      while (step > 1e-18) {
        Pose at = pressed_tip(0.0, lateral);
        at.gap = gap - step;
        root = law.solve(at, 1.0);
        if (!root) {
          step *= 0.5;
          continue;
        }
        gap -= step;
        EXPECT_LT(*root, last);
        last = *root;
        const auto there = law.constraint(at, 1.0, last, 0.3);
        EXPECT_NEAR(law.residual(at, 1.0, law.curve_at(last)), 0.0, 1e-16);
        // The search from a neighbouring root finds the same root.
        EXPECT_NEAR(law.solve_near(at, 1.0, at_ring).value_or(-1.0), last,
                    1e-12 * at_ring + 1e-16 / std::abs(there.bending_slope));
      }
      EXPECT_LT(gap, 0.0);
      Pose fold = pressed_tip(0.0, lateral);
      fold.gap = gap;
      EXPECT_GT(last, 0.1 * at_ring) << "a finite force at release";
      const double slope = law.constraint(fold, 1.0, last, 0.3).bending_slope;
      Pose ring = pressed_tip(0.0, lateral);
      EXPECT_LT(std::abs(slope), 1e-4 * std::abs(law.constraint(ring, 1.0, at_ring, 0.3).bending_slope));
    }
  }
}

TEST(ReleaseAtFold, IsTheSameLawWhileTheTipIsInTheRing) {
  for (const double friction : {0.0, 0.1}) {
    const ElasticaContact fold = make({friction}, kReleasedAtFold);
    const ElasticaContact ring = make({friction});
    RandomContacts contacts(kDefaultRotor, 0.35, 26);
    for (int i = 0; i < 1000; ++i) {
      const Pose at = contacts.next();
      EXPECT_EQ(fold.solve(at, 1.0), ring.solve(at, 1.0));
      EXPECT_EQ(fold.solve_near(at, -1.0, 0.3), ring.solve_near(at, -1.0, 0.3));
    }
  }
}

TEST(ReleaseAtFold, NeverHoldsATipOnTheApproachingSide) {
  const ElasticaContact law = make({0.1}, kReleasedAtFold);
  const auto yielding = make({0.1, 1.0}, Ring{1e4, true});
  for (const double lateral : {1e-6, 1e-3, 5e-3}) {
    for (const double gap : {-1e-15, -1e-9, -1e-6}) {
      Pose at = pressed_tip(0.0, lateral);
      at.gap = gap;
      EXPECT_FALSE(law.solve(at, 1.0).has_value());
      EXPECT_FALSE(yielding.solve(at, 1.0).has_value());
    }
  }
}

}  // namespace
}  // namespace rubatlas::contact
