/// 10 000 random legal scenes: whatever the reader accepts ends with a status, after a bounded amount of
/// work.
///
/// Nobody wrote these cases, so nobody tuned the solver to them. A failure prints the scene, so that it can
/// be run again. The few motions that take a second each are followed to their end in the slow tests alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "../support/honest_end.hpp"
#include "../support/point.hpp"
#include "assembly/make_line_solver.hpp"
#include "random_scene.hpp"

namespace rubatlas::test {
namespace {

/// Scenes are searched in shards that may run side by side.
struct Shard {
  std::uint64_t first;
  std::uint64_t scenes;
  int most_questions;
};

/// gtest: the name of a shard in the list of tests.
void PrintTo(const Shard& shard, std::ostream* out) {
  *out << shard.first << "_to_" << shard.first + shard.scenes - 1;
}

/// A motion asks whether to go on after each of its few revolutions, and after each 2 ms of work.
constexpr int kAsOftenAsItLikes = std::numeric_limits<int>::max();

std::vector<Shard> shards(std::uint64_t count, std::uint64_t scenes, int most_questions) {
  std::vector<Shard> all;
  for (std::uint64_t i = 0; i < count; ++i) all.push_back({i * scenes, scenes, most_questions});
  return all;
}

/// The solver's own bound: two seconds of a processor core for a point of up to twenty revolutions; the last
/// attempt of a step may pass it.
void expect_bounded_work(const point::PointOutcome& outcome) {
  constexpr std::int64_t kBeyond = 50'000'000;
  ASSERT_LE(outcome.work.price, modes::kWorkBound.point + kBeyond);
}

/// Runs a random scene; none where its end is not an honest one, or its work not bounded. Pending where it
/// asks too often whether to go on.
std::optional<point::PointOutcome> search(std::uint64_t index, int most_questions = kAsOftenAsItLikes) {
  SCOPED_TRACE("random scene " + std::to_string(index) + ": " + random_scene_text(index));
  std::optional<point::PointOutcome> outcome;
  const auto run_scene = [&] {
    const settings::Scene scene = random_scene(index);
    const motion::SectionState start{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};
    int questions = 0;
    outcome =
        solver_of(scene, assembly::make_blade_tables())->run(scene.grid.speed_ratio.front(), start, [&] {
          return ++questions <= most_questions;
        });
    if (outcome->status == ending::PointStatus::pending) {
      ASSERT_GT(questions, most_questions);
      return;
    }
    expect_an_honest_end(scene, *outcome);
    expect_bounded_work(*outcome);
  };
  EXPECT_NO_THROW(run_scene());
  return ::testing::Test::HasFailure() ? std::nullopt : outcome;
}

// Scenes that have once failed.

TEST(RandomScenes, OfThirtyBladesUnderAnInclinedLoadKeepTheBoundOfTheWork) {
  // One attempt of a step of all blades passed the bound by far.
  EXPECT_TRUE(search(425));
}

TEST(RandomScenes, WhoseWorkIsSpentWhereABladeTouchesDownAtOnceEndWithAStatus) {
  // The contacts were asked for in an interval that had not been made.
  EXPECT_TRUE(search(775));
}

TEST(RandomScenes, WhereTwoKnotsOfABladesTableFindTheSameFoldEndWithAStatus) {
  EXPECT_TRUE(search(7079));
}

void expect_followed(std::initializer_list<std::uint64_t> scenes) {
  for (const std::uint64_t index : scenes) {
    const auto outcome = search(index);
    ASSERT_TRUE(outcome);
    EXPECT_NE(outcome->detail, ending::StatusDetail::step_too_short) << index;
  }
}

TEST(RandomScenes, WhoseTipsTouchDownOffTheRingByRoundingAreFollowed) {
  // Fast tips, and blades with next to no friction: the overlap, or what they were short of the ring, was
  // taken for a bent blade, or for one that nothing bends where the force has to set in at once.
  expect_followed({447, 1533, 1816, 6684, 8032});
}

TEST(RandomScenes, WhoseTipsAreOffTheRingByTheToleranceAreFollowed) {
  // A bent blade outside of the ring, or a free one in it, where an arc begins.
  expect_followed({232, 2045, 2066, 3361, 3419, 3995, 4685, 9221});
}

TEST(RandomScenes, ThatMoveInVeryShortTimesAreFollowed) {
  // Intervals shorter than 1e-8 of the first guess.
  expect_followed({159, 1900, 4977, 9222, 9504});
}

TEST(RandomScenes, InWhichANodeFindsTheRootOfABladeBentTheOtherWayTouchOncePerPassing) {
  // The jump of p to −p was taken for a fold, and this for a lift-off: the contact began again, each time a
  // moment earlier, and carried the shaft away.
  const auto outcome = search(4796);
  ASSERT_TRUE(outcome);
  constexpr std::uint64_t kPassings = 5 * 3;  // of five blades in three revolutions
  EXPECT_LE(outcome->work.touchdowns, kPassings);
}

class RandomSearch : public ::testing::TestWithParam<Shard> {};

TEST_P(RandomSearch, EveryLegalSceneEndsWithAStatus) {
  const auto [first, scenes, most_questions] = GetParam();
  std::map<ending::StatusDetail, int> ended_by;
  std::int64_t dearest = 0;
  std::uint64_t dearest_scene = first;
  int touched = 0;
  std::uint64_t dear = 0;
  for (std::uint64_t index = first; index < first + scenes; ++index) {
    const auto found = search(index, most_questions);
    ASSERT_TRUE(found);
    const point::PointOutcome& outcome = *found;
    if (outcome.work.touchdowns > 0) ++touched;
    if (outcome.status == ending::PointStatus::pending) {
      ++dear;
      continue;
    }
    ++ended_by[outcome.detail];
    if (outcome.work.price > dearest) dearest_scene = index;
    dearest = std::max(dearest, outcome.work.price);
  }
  const int done = ended_by[ending::StatusDetail::none];
  std::cout << "scenes " << first << " to " << first + scenes - 1 << ": " << done << " done";
  for (const auto& entry : ending::kStatusDetails) {
    if (entry.detail != ending::StatusDetail::none && ended_by[entry.detail] > 0)
      std::cout << ", " << ended_by[entry.detail] << ' ' << entry.name;
  }
  if (dear > 0) std::cout << ", " << dear << " too dear";
  std::cout << "; most work " << 1e-9 * static_cast<double>(dearest) << " s, scene " << dearest_scene << '\n';
  EXPECT_LE(dear, scenes / 4);
  // A generator whose scenes never touch, or never end as done, would search nothing.
  EXPECT_GT(done, static_cast<int>(scenes) / 4);
  EXPECT_GT(touched, static_cast<int>(scenes) / 4);
}

INSTANTIATE_TEST_SUITE_P(First, RandomSearch, ::testing::ValuesIn(shards(4, 25, 100)));
INSTANTIATE_TEST_SUITE_P(Slow, RandomSearch, ::testing::ValuesIn(shards(20, 500, kAsOftenAsItLikes)));

}  // namespace
}  // namespace rubatlas::test
