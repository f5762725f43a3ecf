#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mpi/job/schedule.hpp"
#include "plan/grid.hpp"
#include "plan/pieces.hpp"
#include "played_job.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {
namespace {

settings::Scene lines_of_points(std::size_t lines, std::size_t points, settings::Sweep sweep) {
  settings::Scene scene;
  scene.grid = {
      .thickness = {0.001}, .unbalance = {0.0}, .friction = {0.1}, .damping_ratio = {}, .speed_ratio = {}};
  for (std::size_t i = 0; i < lines; ++i)
    scene.grid.damping_ratio.push_back(0.01 * static_cast<double>(i + 1));
  for (std::size_t i = 0; i < points; ++i)
    scene.grid.speed_ratio.push_back(0.001 * static_cast<double>(i + 1));
  scene.sweep = sweep;
  return scene;
}

motion::PointStart never(std::size_t point) {
  ADD_FAILURE() << "point " << point << " was looked up";
  return {};
}

/// A schedule of points that no earlier run has computed.
struct NewJob {
  plan::Grid grid;
  Schedule schedule;
  NewJob(const settings::Scene& scene, int ranks)
      : grid(scene),
        schedule(grid, plan::Pieces(scene),
                 {std::vector<std::uint8_t>(grid.point_count(), 0),
                  std::vector<std::uint8_t>(grid.point_count(), 0), never},
                 ranks) {}
};

double equal_cost(std::size_t, std::uint64_t) {
  return 1.0;
}

TEST(Schedule, SevenEqualLinesKeepTwoRanksBusyToTheEnd) {
  PlayedJob job(lines_of_points(7, 200, settings::Sweep::up), 2);
  EXPECT_LE(job.play(equal_cost), 700.0 + 2.0);
}

TEST(Schedule, ThreeLinesKeepTwoRanksBusyToTheEnd) {
  PlayedJob job(lines_of_points(3, 1000, settings::Sweep::down), 2);
  EXPECT_LE(job.play(equal_cost), 1500.0 + 2.0);
}

TEST(Schedule, LinesOfUnequalCostKeepRanksBusyToTheEnd) {
  // Low damping costs more, and so does the chaotic region, as in real jobs.
  const auto cost = [](std::size_t line, std::uint64_t visit) {
    return (visit > 80 && visit < 140 ? 10.0 : 1.0) * 3.0 / static_cast<double>(line + 1);
  };
  double total = 0.0;
  double longest_line = 0.0;
  for (std::size_t line = 0; line < 7; ++line) {
    double sum = 0.0;
    for (std::uint64_t visit = 0; visit < 200; ++visit) sum += cost(line, visit);
    total += sum;
    longest_line = std::max(longest_line, sum);
  }
  for (const int ranks : {2, 3}) {
    PlayedJob job(lines_of_points(7, 200, settings::Sweep::up), ranks);
    // No schedule can be shorter than this.
    EXPECT_LE(job.play(cost), 1.02 * std::max(total / ranks, longest_line));
  }
}

TEST(Schedule, ALineThatTurnsOutToBeLongIsNotLeftToTheEnd) {
  const auto cost = [](std::size_t line, std::uint64_t) { return line == 5 ? 5.0 : 1.0; };
  PlayedJob job(lines_of_points(6, 200, settings::Sweep::up), 2);
  // Five lines of 200 beside one of 1000, whose cost nobody knows beforehand: whole lines in their order
  // would take 1400, and with all costs known two ranks could be through at 1000.
  EXPECT_LE(job.play(cost), 1100.0);
}

TEST(Schedule, IndependentPointsOfOneLineAreSharedByAllRanks) {
  PlayedJob job(lines_of_points(1, 1000, settings::Sweep::independent), 4);
  EXPECT_LE(job.play(equal_cost), 250.0 + 2.0);
}

TEST(Schedule, BothDirectionsAreLinesOfTheirOwn) {
  PlayedJob job(lines_of_points(2, 100, settings::Sweep::both), 3);
  EXPECT_LE(job.play(equal_cost), 400.0 / 3.0 + 3.0);
}

TEST(Schedule, ALineRunsOnOneRankAtATime) {
  NewJob job(lines_of_points(1, 50, settings::Sweep::up), 2);
  Schedule& schedule = job.schedule;
  EXPECT_TRUE(schedule.next(0).has_value());
  EXPECT_FALSE(schedule.next(1).has_value()) << "its next point needs the state that rank 0 is computing";
  EXPECT_TRUE(schedule.has_more()) << "but there will be work";
}

TEST(Schedule, APieceBehindAFailedPointStartsFromInitial) {
  NewJob job(lines_of_points(1, 50, settings::Sweep::up), 1);
  Schedule& schedule = job.schedule;
  const auto first = schedule.next(0);
  ASSERT_TRUE(first);
  for (std::uint64_t visit = 0; visit < first->count; ++visit) {
    auto ended = report(0, visit);
    if (visit + 1 == first->count) ended.status = ending::PointStatus::left_validity;
    schedule.record(ended);
  }
  const auto second = schedule.next(0);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->first_visit, first->count);
  EXPECT_EQ(second->from_initial, 1);
}

TEST(Schedule, AResumedLineGoesOnFromTheStoredStateOfADonePoint) {
  const settings::Scene scene = lines_of_points(1, 6, settings::Sweep::down);
  const plan::Grid grid(scene);
  // Points in order of speed; the sweep comes from above: done, failed, pending, pending, done, pending.
  const std::vector<std::uint8_t> status{0, 1, 0, 0, 2, 1};
  Schedule schedule(grid, plan::Pieces(scene),
                    {status, {}, [](std::size_t point) { return end_of(100, point); }}, 1);

  std::vector<Assignment> assignments;
  while (schedule.has_more()) {
    assignments.push_back(*schedule.next(0));
    for (std::uint64_t i = 0; i < assignments.back().count; ++i) {
      schedule.record(report(0, assignments.back().first_visit + i));
    }
  }
  EXPECT_EQ(
      std::accumulate(assignments.begin(), assignments.end(), std::size_t{0},
                      [](std::size_t sum, const Assignment& assignment) { return sum + assignment.count; }),
      3U);
  // Visit 2 (point 3) is behind a failed one.
  EXPECT_EQ(assignments.front().first_visit, 2U);
  EXPECT_EQ(assignments.front().from_initial, 1);
  // Visit 5 (point 0) is behind visit 4 (point 1), done in an earlier run.
  EXPECT_EQ(assignments.back().first_visit, 5U);
  EXPECT_EQ(assignments.back().from_initial, 0);
  EXPECT_EQ(assignments.back().start, end_of(100, 1));
}

TEST(Schedule, NothingIsHandedOutWhereNothingIsPending) {
  const settings::Scene scene = lines_of_points(2, 3, settings::Sweep::up);
  const plan::Grid grid(scene);
  Schedule schedule(grid, plan::Pieces(scene), {std::vector<std::uint8_t>{1, 1, 2, 3, 1, 1}, {}, never}, 2);
  EXPECT_FALSE(schedule.has_more());
  EXPECT_FALSE(schedule.next(0).has_value());
}

TEST(Schedule, WithManyLinesARankStaysWithItsOwn) {
  NewJob job(lines_of_points(50, 100, settings::Sweep::up), 2);
  Schedule& schedule = job.schedule;
  const auto first = schedule.next(0);
  for (std::uint64_t visit = 0; visit < first->count; ++visit) {
    PointReport one = report(first->line, visit);
    one.run = first->run;
    schedule.record(one);
  }
  EXPECT_EQ(schedule.next(0)->line, first->line);
}

TEST(Schedule, TheTimeLeftIsExpectedFromWhatOtherLinesTook) {
  NewJob job(lines_of_points(2, 4, settings::Sweep::up), 2);
  Schedule& schedule = job.schedule;
  ASSERT_EQ(schedule.next(1)->line, 0U);  // this rank reports nothing
  // The second line took 1, 1, 1, 9 seconds; the first is expected to take the same.
  std::size_t computed = 0;
  while (computed < 4) {
    const Assignment assignment = *schedule.next(0);
    ASSERT_EQ(assignment.line, 1U);
    for (std::uint64_t i = 0; i < assignment.count; ++i) {
      PointReport one = report(1, assignment.first_visit + i, ++computed == 4 ? 9.0 : 1.0);
      one.run = assignment.run;
      schedule.record(one);
    }
  }
  EXPECT_DOUBLE_EQ(schedule.remaining_over_recorded(), 1.0);
}

// --- lines swept in pieces ---

settings::Scene lines_in_pieces(std::size_t lines, std::size_t points, settings::Sweep sweep) {
  settings::Scene scene = lines_of_points(lines, points, sweep);
  scene.pieces = settings::Pieces{.points = 20, .lead_in = 4};
  return scene;
}

/// Two branches: what starts from `initial` is on branch 1 below visit 50 and on branch 2 above. A sweep on
/// branch 1 stays on it up to visit 113, where the branch ends.
double hysteresis(std::size_t line, std::uint64_t visit, double before) {
  const std::uint64_t end_of_branch = 113 + line;
  if (before == 0.0) return visit < 50 ? 1.0 : 2.0;
  return visit < end_of_branch ? before : 2.0;
}

std::vector<double> branches(const StoredAtlas& atlas) {
  std::vector<double> found;
  for (const auto& [point, end] : atlas.ends) found.push_back(end[2]);
  return found;
}

TEST(SweepInPieces, FollowsTheBranchOfTheSerialSweep) {
  for (const auto sweep : {settings::Sweep::up, settings::Sweep::down, settings::Sweep::both}) {
    PlayedJob serial(lines_of_points(3, 200, sweep), 1, hysteresis);
    serial.play(equal_cost);
    PlayedJob pieces(lines_in_pieces(3, 200, sweep), 4, hysteresis);
    pieces.play(equal_cost);
    EXPECT_EQ(branches(serial.atlas()), branches(pieces.atlas()));
  }
}

TEST(SweepInPieces, RepairsTheStretchFromASeamToTheEndOfTheBranch) {
  const settings::Scene scene = lines_in_pieces(1, 200, settings::Sweep::up);
  PlayedJob job(scene, 1, hysteresis);
  job.play(equal_cost);
  std::vector<std::uint8_t> expected(200, 0);
  // The runs of the first three pieces begin below visit 50. Repair goes on through two pieces.
  for (const std::size_t seam : {20U, 40U, 113U, 120U, 140U, 160U, 180U}) expected[seam] = 1;
  for (std::size_t visit = 60; visit < 113; ++visit) expected[visit] = 2;
  EXPECT_EQ(job.atlas().seam, expected);
  // Besides the points of the line: nine lead-ins, one point at each seam that agrees, and what is replaced.
  EXPECT_EQ(job.computed(), 200U + 9 * 4 + 7 + (113 - 60));
}

TEST(SweepInPieces, MakesTheSameAtlasWithAnyNumberOfRanksAndAfterAnyKill) {
  const settings::Scene scene = lines_in_pieces(2, 200, settings::Sweep::down);
  PlayedJob whole(scene, 1, hysteresis);
  whole.play(equal_cost);
  const auto uneven = [](std::size_t line, std::uint64_t visit) {
    return 1.0 + static_cast<double>((7 * visit + 3 * line) % 11);
  };
  for (const int ranks : {1, 2, 5}) {
    for (std::size_t kill = 10; kill < 600; kill += 23) {
      PlayedJob job(scene, ranks, hysteresis);
      job.play(uneven, kill);
      job.play(uneven);
      ASSERT_EQ(job.atlas().seam, whole.atlas().seam) << ranks << " ranks, killed after " << kill;
      ASSERT_EQ(job.atlas().ends, whole.atlas().ends) << ranks << " ranks, killed after " << kill;
    }
  }
}

TEST(SweepInPieces, LosesNothingWhereSingleRowsAreMissing) {
  const settings::Scene scene = lines_in_pieces(1, 200, settings::Sweep::up);
  PlayedJob whole(scene, 1, hysteresis);
  whole.play(equal_cost);
  for (std::size_t hole = 0; hole < 200; ++hole) {
    PlayedJob job(scene, 2, hysteresis);
    job.play(equal_cost);
    job.lose({hole, (hole + 71) % 200, (hole + 72) % 200});
    job.play(equal_cost);
    ASSERT_EQ(job.atlas().seam, whole.atlas().seam) << "without " << hole;
    ASSERT_EQ(job.atlas().ends, whole.atlas().ends) << "without " << hole;
  }
}

TEST(SweepInPieces, KeepsManyRanksBusyOnOneLine) {
  settings::Scene scene = lines_of_points(1, 1000, settings::Sweep::up);
  scene.pieces = settings::Pieces{};
  PlayedJob alone(scene, 1);
  const double work = alone.play(equal_cost);
  EXPECT_EQ(work, 1000.0 + 20);
  for (const int ranks : {2, 4}) {
    PlayedJob job(scene, ranks);
    EXPECT_LE(job.play(equal_cost), 1.03 * work / ranks) << ranks << " ranks";
  }
}

TEST(SweepInPieces, KeepsSixtyFourRanksBusyOnOneLongLine) {
  settings::Scene scene = lines_of_points(1, 10'000, settings::Sweep::up);
  scene.pieces = settings::Pieces{};
  const auto cost = [](std::size_t /*line*/, std::uint64_t visit) { return visit > 4000 ? 3.0 : 1.0; };
  constexpr double kOneByOne = 4001.0 + 3.0 * 5999.0;
  PlayedJob job(scene, 64);
  EXPECT_LE(0.9 * job.play(cost), kOneByOne / 64.0);
}

TEST(SweepInPieces, KeepsSixtyFourRanksBusyOnSevenLines) {
  settings::Scene scene = lines_of_points(7, 1000, settings::Sweep::up);
  scene.pieces = settings::Pieces{};
  // Low damping costs more, and so does the chaotic region, as in real jobs.
  const auto cost = [](std::size_t line, std::uint64_t visit) {
    return (visit > 400 ? 3.0 : 1.0) * (1.0 + 1.0 / static_cast<double>(line + 1));
  };
  PlayedJob alone(scene, 1);
  const double work = alone.play(cost);
  double longest_run = 0.0;
  for (std::uint64_t visit = 508; visit < 640; ++visit) longest_run += cost(0, visit);
  PlayedJob job(scene, 64);
  // No schedule can be shorter than this.
  EXPECT_LE(job.play(cost), 1.05 * std::max(work / 64.0, longest_run));
}

/// Seconds of the processor that handing out and recording a point takes on average.
double seconds_of_a_point(std::size_t lines, bool in_pieces) {
  settings::Scene scene = lines_of_points(lines, 8, settings::Sweep::up);
  if (in_pieces) scene.pieces = settings::Pieces{.points = 4, .lead_in = 1};
  constexpr int kRanks = 4;
  NewJob job(scene, kRanks);
  int choices = 0;
  const std::clock_t begin = std::clock();
  while (job.schedule.has_more()) {
    const Assignment assignment = *job.schedule.next(choices++ % kRanks);
    for (std::uint64_t i = 0; i < assignment.count; ++i) {
      PointReport one = report(assignment.line, assignment.first_visit + i);
      one.run = assignment.run;
      one.keep = assignment.keep;
      one.same_motion = 1;
      job.schedule.record(one);
    }
  }
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / static_cast<double>(8 * lines);
}

TEST(Schedule, TheChoiceOfARunTakesNoLongerAmongManyLines) {
  // A choice that looked at all lines would take fifty times as long.
  for (const bool in_pieces : {false, true}) {
    const double among_few = seconds_of_a_point(2'000, in_pieces);
    EXPECT_LT(seconds_of_a_point(100'000, in_pieces), 10.0 * among_few) << in_pieces;
  }
}

}  // namespace
}  // namespace rubatlas::mpi
