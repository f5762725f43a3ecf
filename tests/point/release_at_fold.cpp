/// Contacts that end at the fold of the force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "compliant_motion.hpp"

namespace rubatlas::test::compliant {
namespace {

/// Receding lift-offs of a motion that are at the fold; also how many while other blades touched.
struct Releases {
  int at_fold = 0;
  int beside_others = 0;
};
template <class Law>
Releases expect_releases_at_the_fold(const Law& law, double speed_ratio, int blades, int revolutions) {
  constexpr double kLocated = 1e-12;  // g [m²]: 2R times a few tolerances
  const auto motion = run(law, speed_ratio, revolutions, blades);
  EXPECT_LT(motion.witness.largest_jump, 1e-15) << "the state is continuous";
  Releases found;
  int open = 0;
  for (std::size_t i = 0; i < motion.witness.events.size(); ++i) {
    const modes::Event& event = motion.witness.events[i];
    contact::Pose at = pose_at(speed_ratio, blades, event);
    if (event.kind == modes::Guard::touch_down) {
      ++open;
      EXPECT_NEAR(at.gap, 0.0, 1e-16) << "touch-downs stay where they are";
    }
    if (event.kind != modes::Guard::lift_off) continue;
    --open;
    if (law.starts_unloaded(at, event.slip)) {
      EXPECT_NEAR(at.gap, 0.0, kLocated);
      if (law.curve().friction() > 0.0) {
        EXPECT_NEAR(motion.witness.last_forces[i], 0.0, 1e-5);
      }
      continue;
    }
    EXPECT_LT(at.gap, 0.0) << "held beyond the ring";
    const double gap = at.gap;
    at.gap = gap + kLocated;
    const auto before = law.solve(at, event.slip);
    EXPECT_TRUE(before.has_value()) << "there is a force up to the fold, event " << i;
    if (before) {
      // It vanishes from a finite value, at the end of a square root.
      const double force = law.constraint(at, event.slip, *before, speed_ratio).force.normal;
      EXPECT_GT(motion.witness.last_forces[i], 0.5 * force);
      EXPECT_LT(motion.witness.last_forces[i], force * (1 + 1e-9));
    }
    at.gap = gap - kLocated;
    EXPECT_FALSE(law.solve(at, event.slip).has_value()) << "and none beyond, event " << i;
    ++found.at_fold;
    if (open > 0) ++found.beside_others;
  }
  return found;
}

TEST(ReleaseAtFold, EndsContactsWhereTheForceDoes) {
  Releases all;
  int in_yielding_ring = 0;
  const auto yielding = make(0.1, 1.0, Theory::elastica, Ring{1e7, true});
  for (const auto& [speed, blades] : {std::pair{0.36, 10}, std::pair{0.5, 3}, std::pair{0.75, 10},
                                      std::pair{0.3, 10}, std::pair{0.36, 20}, std::pair{0.9, 10}}) {
    for (const double friction : {0.0, 0.1, 0.3}) {
      const auto found = expect_releases_at_the_fold(make(friction, 0.0, Theory::elastica, kReleasedAtFold),
                                                     speed, blades, 10);
      all.at_fold += found.at_fold;
      all.beside_others += found.beside_others;
    }
    in_yielding_ring += expect_releases_at_the_fold(yielding, speed, blades, 10).at_fold;
  }
  EXPECT_GT(all.at_fold, 200);
  EXPECT_GT(all.beside_others, 5);
  EXPECT_GT(in_yielding_ring, 20);
}

TEST(ReleaseAtFold, LetsContactsLastLongerOnTheRecedingSide) {
  for (const auto& [speed, blades] : {std::pair{0.36, 10}, std::pair{0.5, 3}, std::pair{0.75, 3}}) {
    const auto ring = run(make(0.1, 0.0), speed, 10, blades);
    const auto fold = run(make(0.1, 0.0, Theory::elastica, kReleasedAtFold), speed, 10, blades);
    const auto& events = ring.witness.events;
    const auto recedes = [speed = speed, blades = blades](const modes::Event& event) {
      return event.kind == modes::Guard::lift_off &&
             event.slip * pose_at(speed, blades, event).tangential < 0.0;
    };
    const auto receding = std::find_if(events.begin(), events.end(), recedes);
    ASSERT_NE(receding, events.end());
    const auto same = static_cast<std::size_t>(receding - events.begin());
    for (std::size_t i = 0; i < same; ++i)
      EXPECT_NEAR(fold.witness.events[i].time, events[i].time, 1e-9) << "one motion up to there";
    EXPECT_EQ(fold.witness.events[same].kind, modes::Guard::lift_off);
    EXPECT_EQ(fold.witness.events[same].blade, receding->blade);
    EXPECT_GT(fold.witness.events[same].time, receding->time + 1e-6);
  }
}

}  // namespace
}  // namespace rubatlas::test::compliant
