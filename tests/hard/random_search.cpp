/// 10 000 random legal scenes: whatever the reader accepts ends with a status, after a bounded amount of
/// work.
///
/// Nobody wrote these cases, so nobody tuned the solver to them. A failure prints the scene's index;
/// `random_scene_text(index)` is the scene.
#include <gtest/gtest.h>

#include "hard_point.hpp"
#include "random_scene.hpp"

namespace rubatlas::test {
namespace {

constexpr std::uint64_t kShards = 20;
constexpr std::uint64_t kScenesInShard = 500;

/// The solver's own bounds, for each revolution that was started. A step of order eight takes twelve
/// right-hand sides, its dense output three, the start of a phase one; the last step may still be repeated
/// until it is too short to go on, and the last search may look at each blade once more.
void expect_bounded_work(const scene::Scene& scene, const solve::PointOutcome& outcome) {
  constexpr std::uint64_t kRightHandSidesInStep = 16;
  constexpr std::uint64_t kLastRepeats = 200;
  const int started = outcome.status == solve::PointStatus::done
                          ? scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions
                          : outcome.failed_revolution + 1;
  const auto revolutions = static_cast<std::uint64_t>(started);
  const solve::WorkCounts& work = outcome.work;
  const std::uint64_t steps = solve::WorkBounds::kSteps + kLastRepeats;
  ASSERT_LE(work.steps + work.rejected_steps, revolutions * steps);
  ASSERT_LE(work.right_hand_sides,
            revolutions * (steps + solve::WorkBounds::kEvents) * kRightHandSidesInStep);
  ASSERT_LE(work.gap_evaluations, revolutions * (solve::WorkBounds::kGapEvaluations +
                                                 static_cast<std::uint64_t>(scene.blades.count)));
  ASSERT_LE(work.touchdowns + work.liftoffs + work.slip_reversals,
            revolutions * static_cast<std::uint64_t>(solve::WorkBounds::kEvents));
}

void search(std::uint64_t first, std::uint64_t scenes) {
  int done = 0;
  int touched = 0;
  for (std::uint64_t index = first; index < first + scenes; ++index) {
    SCOPED_TRACE("random scene " + std::to_string(index));
    const scene::Scene scene = random_scene(index);
    const double speed = scene.grid.speed_ratio.front();
    const solve::SectionState start{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};
    const auto outcome = run(scene, speed, start, solve::make_blade_tables());
    ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, outcome));
    ASSERT_NO_FATAL_FAILURE(expect_bounded_work(scene, outcome));
    if (outcome.status == solve::PointStatus::done) ++done;
    if (outcome.work.touchdowns > 0) ++touched;
  }
  // A generator whose scenes never touch, or never end as done, would search nothing.
  EXPECT_GT(done, static_cast<int>(scenes) / 4);
  EXPECT_GT(touched, static_cast<int>(scenes) / 4);
}

class RandomSearch : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomSearch, EveryLegalSceneEndsWithAStatus) {
  search(GetParam() * kScenesInShard, kScenesInShard);
}

INSTANTIATE_TEST_SUITE_P(Slow, RandomSearch, ::testing::Range<std::uint64_t>(0, kShards));

TEST(RandomSearch, TheFirstScenesEndWithAStatus) {
  search(0, 60);
}

}  // namespace
}  // namespace rubatlas::test
