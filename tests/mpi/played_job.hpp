/// A job without ranks and motions: the schedule with points of given costs and branches.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mpi/job/schedule.hpp"
#include "plan/grid.hpp"
#include "plan/pieces.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// The end of a point, made so that it tells which point it is.
inline motion::SectionState end_of(std::size_t line, std::uint64_t visit) {
  return {static_cast<double>(line), static_cast<double>(visit), 0.0, 0.0};
}

inline PointReport report(std::size_t line, std::uint64_t visit, double seconds = 1.0) {
  PointReport result;
  result.line = line;
  result.visit = visit;
  result.status = ending::PointStatus::done;
  result.final_state = end_of(line, visit);
  result.seconds = seconds;
  return result;
}

/// The atlas of a job that begins, or goes on.
struct StoredAtlas {
  std::vector<std::uint8_t> status;
  std::vector<std::uint8_t> seam = {};
  std::map<std::size_t, motion::SectionState> ends = {};

  explicit StoredAtlas(const plan::Grid& grid) : status(grid.point_count(), 0), seam(grid.point_count(), 0) {}
  [[nodiscard]] Schedule::Stored view() const {
    return {status, seam, [this](std::size_t point) { return motion::PointStart(ends.at(point)); }};
  }
};

/// What a point makes of its start: the branch that it is on. `initial` is branch 0.
using Branch = std::function<double(std::size_t line, std::uint64_t visit, double before)>;

/// Every point stays where it starts.
inline double same_branch(std::size_t, std::uint64_t, double before) {
  return before;
}

/// A job played with given costs: at each moment every rank that is free asks, computes what it gets, and
/// reports its points together, or one by one where their rows are not written at once.
/// Motions are told apart by their branch, which is their maximum displacement. Checks on the way that each
/// point is written once, and that a run's states go from point to point.
class PlayedJob {
 public:
  using Cost = std::function<double(std::size_t line, std::uint64_t visit)>;

  PlayedJob(settings::Scene scene, int ranks, Branch branch = same_branch)
      : scene_(std::move(scene)),
        grid_(scene_),
        ranks_(static_cast<std::size_t>(ranks)),
        branch_(std::move(branch)),
        atlas_(grid_) {}

  /// Time when the last point is done; `cost` gives a point's seconds. The job is killed after `most` points,
  /// and then loses what its ranks hold.
  double play(const Cost& cost, std::size_t most = std::numeric_limits<std::size_t>::max()) {
    const StoredAtlas before = atlas_;
    Schedule schedule(grid_, plan::Pieces(scene_), before.view(), static_cast<int>(ranks_));
    std::vector<std::optional<Assignment>> assignments(ranks_);
    std::vector<double> busy_until(ranks_, 0.0);
    held_.assign(ranks_, {});
    reports_.assign(ranks_, {});
    finished_ =
        static_cast<std::size_t>(std::ranges::count_if(before.status, [](auto code) { return code != 0; }));
    double now = 0.0;
    while (schedule.has_more() ||
           std::ranges::any_of(assignments, [](const auto& one) { return one.has_value(); })) {
      for (std::size_t rank = 0; rank < ranks_; ++rank) {
        if (assignments[rank]) continue;
        assignments[rank] = schedule.next(static_cast<int>(rank));
        if (assignments[rank])
          busy_until[rank] = now + cost(assignments[rank]->line, assignments[rank]->first_visit);
      }
      // The next point that is through.
      std::size_t rank = ranks_;
      for (std::size_t i = 0; i < ranks_; ++i) {
        if (assignments[i] && (rank == ranks_ || busy_until[i] < busy_until[rank])) rank = i;
      }
      if (rank == ranks_) throw std::logic_error("points are left and nobody gets any");
      if (computed_++ == most) return now;
      now = busy_until[rank];
      Assignment& current = *assignments[rank];
      finish(rank, current, cost(current.line, current.first_visit), schedule, assignments);
      ++current.first_visit;
      if (--current.count == 0) {
        assignments[rank].reset();
      } else {
        busy_until[rank] = now + cost(current.line, current.first_visit);
      }
    }
    EXPECT_EQ(std::ranges::count(atlas_.status, 0), 0) << "points are left";
    EXPECT_EQ(finished_, atlas_.status.size()) << "points that the schedule has counted";
    return now;
  }

  /// Takes points out of the atlas, as a kill before their statuses are written does.
  void lose(const std::vector<std::size_t>& points) {
    for (const std::size_t point : points) {
      atlas_.status[point] = 0;
      atlas_.seam[point] = 0;
      atlas_.ends.erase(point);
    }
  }
  [[nodiscard]] std::size_t computed() const { return computed_; }
  [[nodiscard]] const StoredAtlas& atlas() const { return atlas_; }

 private:
  void write(std::size_t line, std::uint64_t visit, double branch, plan::Seam seam) {
    const std::size_t point = grid_.point(line, visit);
    EXPECT_EQ(atlas_.status[point], 0) << "visit " << visit << " of line " << line << " is written twice";
    atlas_.status[point] = 1;
    atlas_.seam[point] = static_cast<std::uint8_t>(seam);
    atlas_.ends[point] = {static_cast<double>(line), static_cast<double>(visit), branch, 0.0};
  }

  void finish(std::size_t rank, Assignment& assignment, double seconds, Schedule& schedule,
              std::vector<std::optional<Assignment>>& assignments) {
    const bool chained = grid_.points_depend_on_each_other();
    if (!chained) {
      EXPECT_EQ(assignment.from_initial, 1);
    }
    if (assignment.from_initial == 0) {
      EXPECT_EQ(assignment.start[0], static_cast<double>(assignment.line));
      EXPECT_EQ(assignment.start[1], static_cast<double>(assignment.first_visit - 1))
          << "the state of the point before";
    }
    PointReport result = report(assignment.line, assignment.first_visit, seconds);
    const double branch = branch_(assignment.line, assignment.first_visit,
                                  assignment.from_initial != 0 ? 0.0 : assignment.start[2]);
    result.final_state[2] = branch;
    result.run = assignment.run;
    result.keep = assignment.keep;
    result.trace.max_displacement = branch;
    if (assignment.keep == Keep::at_once)
      write(assignment.line, assignment.first_visit, branch, plan::Seam::none);
    if (assignment.keep == Keep::after_verdict)
      held_[rank][{assignment.line, assignment.first_visit}] = branch;
    if (assignment.keep == Keep::where_it_differs || assignment.keep == Keep::compared) {
      result.same_motion = assignment.found.max_displacement == branch ? 1 : 0;
      if (result.same_motion == 0 && assignment.keep == Keep::where_it_differs)
        write(assignment.line, assignment.first_visit, branch, plan::Seam::repaired);
    }
    assignment.from_initial = chained ? 0 : 1;
    assignment.start = result.final_state;
    Report& computed = reports_[rank];
    computed.add(result);
    if (assignment.count > 1 && assignment.keep == Keep::at_once) return;
    for (std::size_t number = 0; number < computed.count; ++number) {
      const auto outcome = schedule.record(computed.point(number));
      finished_ += outcome.finished.size();
      for (const auto& [verdict, holders] : outcome.decisions) {
        for (const int holder : holders) take(verdict, static_cast<std::size_t>(holder), assignments);
      }
    }
    computed = {};
  }

  void take(const Verdict& verdict, std::size_t rank, std::vector<std::optional<Assignment>>& assignments) {
    std::erase_if(held_[rank], [&](const auto& entry) {
      const auto& [line, visit] = entry.first;
      if (line != verdict.line || visit < verdict.begin || visit >= verdict.end) return false;
      if (visit >= verdict.kept_from) {
        write(line, visit, entry.second, visit == verdict.kept_from ? plan::Seam::agrees : plan::Seam::none);
      }
      return true;
    });
    auto& assignment = assignments[rank];
    if (assignment && assignment->keep == Keep::after_verdict && assignment->line == verdict.line &&
        assignment->first_visit >= verdict.begin && assignment->first_visit < verdict.end) {
      assignment->keep = Keep::at_once;
    }
  }

  settings::Scene scene_;
  plan::Grid grid_;
  std::size_t ranks_;
  Branch branch_;
  StoredAtlas atlas_;
  std::vector<std::map<std::pair<std::size_t, std::uint64_t>, double>> held_;  ///< by rank
  std::vector<Report> reports_;  ///< of points that are computed and not reported, by rank
  std::size_t computed_ = 0;
  std::size_t finished_ = 0;  ///< points that the schedule has counted, and those of earlier runs
};

}  // namespace rubatlas::mpi
