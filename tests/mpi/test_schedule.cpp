#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mpi/job/schedule.hpp"
#include "plan/grid.hpp"
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

/// The end of a point, made so that it tells which point it is.
motion::SectionState end_of(std::size_t line, std::uint64_t visit) {
  return {static_cast<double>(line), static_cast<double>(visit), 0.0, 0.0};
}

motion::SectionState never(std::size_t point) {
  ADD_FAILURE() << "point " << point << " was looked up";
  return {};
}

PointReport report(std::size_t line, std::uint64_t visit, double seconds = 1.0) {
  PointReport result;
  result.line = line;
  result.visit = visit;
  result.status = point::PointStatus::done;
  result.final_state = end_of(line, visit);
  result.seconds = seconds;
  return result;
}

/// A job played with given costs: at each moment every rank that is free asks, and computes what it gets.
/// Checks on the way that each point is computed once and that a sweep's states go from point to point.
class PlayedJob {
 public:
  PlayedJob(const settings::Scene& scene, int ranks)
      : grid_(scene), ranks_(static_cast<std::size_t>(ranks)) {}

  /// Time when the last point is done; `cost` gives a point's seconds.
  double play(const std::function<double(std::size_t line, std::uint64_t visit)>& cost) {
    const std::vector<std::uint8_t> status(grid_.point_count(), 0);
    Schedule schedule(grid_, status, never, static_cast<int>(ranks_));
    std::vector<std::optional<Piece>> piece(ranks_);
    std::vector<double> busy_until(ranks_, 0.0);
    std::map<std::size_t, std::uint64_t> next_visit;
    std::set<std::pair<std::size_t, std::uint64_t>> computed;
    double now = 0.0;
    while (computed.size() < grid_.point_count()) {
      for (std::size_t rank = 0; rank < ranks_; ++rank) {
        if (piece[rank]) continue;
        piece[rank] = schedule.next(static_cast<int>(rank));
        if (!piece[rank]) continue;
        check_start(*piece[rank], next_visit);
        busy_until[rank] = now + cost(piece[rank]->line, piece[rank]->first_visit);
      }
      // The next point that is through.
      std::size_t rank = ranks_;
      for (std::size_t i = 0; i < ranks_; ++i) {
        if (piece[i] && (rank == ranks_ || busy_until[i] < busy_until[rank])) rank = i;
      }
      if (rank == ranks_) throw std::logic_error("points are left and nobody gets any");
      now = busy_until[rank];
      Piece& current = *piece[rank];
      EXPECT_TRUE(computed.emplace(current.line, current.first_visit).second) << "computed twice";
      schedule.record(report(current.line, current.first_visit, cost(current.line, current.first_visit)));
      ++current.first_visit;
      next_visit[current.line] = current.first_visit;
      if (--current.count == 0) {
        piece[rank].reset();
      } else {
        busy_until[rank] = now + cost(current.line, current.first_visit);
      }
    }
    EXPECT_EQ(schedule.unassigned(), 0U);
    return now;
  }

 private:
  void check_start(const Piece& piece, std::map<std::size_t, std::uint64_t>& next_visit) const {
    if (!grid_.points_depend_on_each_other()) {
      EXPECT_TRUE(piece.from_initial);
      return;
    }
    EXPECT_EQ(piece.first_visit, next_visit[piece.line])
        << "a line is handed out in order, to one rank at a time";
    EXPECT_EQ(piece.from_initial, piece.first_visit == 0 ? 1 : 0);
    if (piece.first_visit > 0) {
      EXPECT_EQ(piece.start, end_of(piece.line, piece.first_visit - 1));
    }
  }

  plan::Grid grid_;
  std::size_t ranks_;
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
  const plan::Grid grid(lines_of_points(1, 50, settings::Sweep::up));
  const std::vector<std::uint8_t> status(50, 0);
  Schedule schedule(grid, status, never, 2);
  EXPECT_TRUE(schedule.next(0).has_value());
  EXPECT_FALSE(schedule.next(1).has_value()) << "its next point needs the state that rank 0 is computing";
  EXPECT_GT(schedule.unassigned(), 0U) << "but there will be work";
}

TEST(Schedule, APieceBehindAFailedPointStartsFromInitial) {
  const plan::Grid grid(lines_of_points(1, 50, settings::Sweep::up));
  const std::vector<std::uint8_t> status(50, 0);
  Schedule schedule(grid, status, never, 1);
  const auto first = schedule.next(0);
  ASSERT_TRUE(first);
  for (std::uint64_t visit = 0; visit < first->count; ++visit) {
    auto ended = report(0, visit);
    if (visit + 1 == first->count) ended.status = point::PointStatus::left_validity;
    schedule.record(ended);
  }
  const auto second = schedule.next(0);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->first_visit, first->count);
  EXPECT_EQ(second->from_initial, 1);
}

TEST(Schedule, AResumedLineGoesOnFromTheStoredStateOfADonePoint) {
  const plan::Grid grid(lines_of_points(1, 6, settings::Sweep::down));
  // Points in order of speed; the sweep comes from above: done, failed, pending, pending, done, pending.
  const std::vector<std::uint8_t> status{0, 1, 0, 0, 2, 1};
  Schedule schedule(
      grid, status, [](std::size_t point) { return end_of(100, point); }, 1);
  EXPECT_EQ(schedule.unassigned(), 3U);

  std::vector<Piece> pieces;
  while (schedule.unassigned() > 0) {
    pieces.push_back(*schedule.next(0));
    for (std::uint64_t i = 0; i < pieces.back().count; ++i) {
      schedule.record(report(0, pieces.back().first_visit + i));
    }
  }
  // Visit 2 (point 3) is behind a failed one.
  EXPECT_EQ(pieces.front().first_visit, 2U);
  EXPECT_EQ(pieces.front().from_initial, 1);
  // Visit 5 (point 0) is behind visit 4 (point 1), done in an earlier run.
  EXPECT_EQ(pieces.back().first_visit, 5U);
  EXPECT_EQ(pieces.back().from_initial, 0);
  EXPECT_EQ(pieces.back().start, end_of(100, 1));
}

TEST(Schedule, NothingIsHandedOutWhereNothingIsPending) {
  const plan::Grid grid(lines_of_points(2, 3, settings::Sweep::up));
  const std::vector<std::uint8_t> status{1, 1, 2, 3, 1, 1};
  Schedule schedule(grid, status, never, 2);
  EXPECT_EQ(schedule.unassigned(), 0U);
  EXPECT_FALSE(schedule.next(0).has_value());
}

TEST(Schedule, WithManyLinesARankStaysWithItsOwn) {
  const plan::Grid grid(lines_of_points(50, 100, settings::Sweep::up));
  const std::vector<std::uint8_t> status(5000, 0);
  Schedule schedule(grid, status, never, 2);
  const auto first = schedule.next(0);
  for (std::uint64_t visit = 0; visit < first->count; ++visit) schedule.record(report(first->line, visit));
  EXPECT_EQ(schedule.next(0)->line, first->line);
}

TEST(Schedule, TheTimeLeftIsExpectedFromWhatOtherLinesTook) {
  const plan::Grid grid(lines_of_points(2, 4, settings::Sweep::up));
  const std::vector<std::uint8_t> status(8, 0);
  Schedule schedule(grid, status, never, 1);
  // The first line took 1, 1, 1, 9 seconds; the second is expected to take the same.
  for (std::uint64_t visit = 0; visit < 4; ++visit) schedule.record(report(0, visit, visit == 3 ? 9.0 : 1.0));
  EXPECT_DOUBLE_EQ(schedule.remaining_over_recorded(), 1.0);
}

}  // namespace
}  // namespace rubatlas::mpi
