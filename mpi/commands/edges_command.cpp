#include "mpi/commands/edges_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/analyse.hpp"
#include "analysis/edges_file.hpp"
#include "analysis/edges_report.hpp"
#include "analysis/rules/borders.hpp"
#include "analysis/rules/edge_search.hpp"
#include "atlas/atlas_reader.hpp"
#include "atlas/final_states.hpp"
#include "atlas/output.hpp"
#include "atlas/schema.hpp"
#include "atlas/verify.hpp"
#include "mpi/clock.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/failure.hpp"
#include "mpi/job/progress.hpp"
#include "mpi/job/rounds.hpp"
#include "mpi/job/session.hpp"
#include "mpi/job/signals.hpp"
#include "mpi/say.hpp"
#include "mpi/version.hpp"
#include "plan/grid.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {
namespace {

/// Borders that are searched at the same time: enough to keep many ranks busy, and few enough that the states
/// of their points fit into memory and into a message.
constexpr std::size_t kBordersAtOnce = 4096;

/// Speeds are not told apart more closely than this.
constexpr double kFinestResolution = 1e-12;

/// A border whose edges are being looked for, with the ends of the points that have been tried for it.
struct SearchedBorder {
  std::size_t line = 0;
  analysis::Border border;
  analysis::EdgeSearch search;
  std::vector<std::optional<motion::PointStart>> ends;  ///< by their numbers; none: the point is not done
};

/// What rank 0 has when the first round begins.
struct EdgesTask {
  atlas::Output output{std::filesystem::path()};
  std::optional<atlas::AtlasReader> atlas;
  analysis::Findings found;
  std::vector<SearchedBorder> borders;
};

std::filesystem::path edges_output(const EdgesCommand& command) {
  if (command.output) return *command.output;
  auto path = command.atlas;
  path.replace_filename(command.atlas.stem().string() + "_edges.h5");
  return path;
}

/// The points of a border in the order of the sweep, and where they ended.
SearchedBorder begin_search(std::size_t line, const analysis::Border& border, std::span<const double> speeds,
                            std::span<const std::uint8_t> motion, const plan::Grid& grid,
                            const atlas::FinalStates& stored, double resolution) {
  std::vector<std::size_t> places;
  for (std::size_t i = border.below; i <= border.above; ++i) places.push_back(i);
  if (grid.direction(line) == plan::Direction::down) std::ranges::reverse(places);
  std::vector<double> tried_speeds;
  std::vector<std::uint8_t> tried_motions;
  std::vector<std::optional<motion::PointStart>> ends;
  for (const std::size_t i : places) {
    tried_speeds.push_back(speeds[i]);
    tried_motions.push_back(motion[i]);
    ends.emplace_back();
    if (motion[i] != analysis::motion_class::kLeftValidity) {
      ends.back() = stored.of(line * speeds.size() + i);
    }
  }
  return {line, border,
          analysis::EdgeSearch(tried_speeds, tried_motions, resolution, grid.points_depend_on_each_other()),
          std::move(ends)};
}

EdgesTask prepare_edges(const EdgesCommand& command) {
  if (!(command.resolution >= kFinestResolution && command.resolution <= 1.0)) {
    throw UsageError(
        fmt::format("--to {}: outside [{}, 1]; longest interval of the speed ratio within which "
                    "an edge is known",
                    command.resolution, kFinestResolution));
  }
  EdgesTask task;
  task.output = atlas::permitted(
      {edges_output(command), atlas::FileKind::edges, atlas::existing(command.overwrite)}, {command.atlas});
  const auto& atlas = task.atlas.emplace(command.atlas);
  if (!atlas.has("poincare")) {
    throw UsageError(fmt::format("{} has no edges: it keeps no sections; add \"poincare\" to /observables",
                                 command.atlas.string()));
  }
  atlas::require_sound_rows(atlas);
  auto& found = task.found = analysis::examine(atlas);
  found.edges = analysis::EdgeTable{.resolution = command.resolution, .only_regions = command.only_regions};

  const plan::Grid grid(found.scene);
  const atlas::FinalStates stored(atlas.file(), atlas::schema_of(found.scene));
  const auto status = atlas.status();
  const std::size_t speeds = grid.speed_count();
  for (std::size_t line = 0; line < found.lines.size(); ++line) {
    const auto& summary = found.lines[line];
    const auto motion =
        analysis::border_motions(summary.line.motion, std::span(status).subspan(line * speeds, speeds));
    for (auto& border : analysis::find_borders(motion)) {
      analysis::note_regions(border, summary.line, summary.regions);
      if (command.only_regions && border.region_begins == 0 && border.region_ends == 0) continue;
      task.borders.push_back(
          begin_search(line, border, summary.line.speed_ratio, motion, grid, stored, command.resolution));
    }
  }
  return task;
}

/// The class of a computed point, as searches take it. A point that could not be integrated is evidence for
/// no motion.
std::uint8_t motion_of(const RoundResult& result) {
  switch (result.status) {
    case ending::PointStatus::done:
      return result.motion;
    case ending::PointStatus::left_validity:
      return analysis::motion_class::kLeftValidity;
    default:
      return analysis::motion_class::kUnresolved;
  }
}

/// Carries out the searches of all edges on rank 0, round by round. The searches do not know of each other; a
/// round has the points of all of them.
class Leader {
 public:
  Leader(Rounds& rounds, std::vector<SearchedBorder>& borders, bool swept, ProgressStyle style)
      : rounds_(rounds), borders_(borders), swept_(swept), progress_(style) {}

  /// Returns false where a point was given up.
  bool run(int ranks) {
    for (std::size_t first = 0; first < borders_.size(); first += kBordersAtOnce) {
      const std::span all(borders_);
      const auto some = all.subspan(first, std::min(kBordersAtOnce, all.size() - first));
      if (!narrow_down(some, ranks)) return false;
      for (auto& searched : some) searched.ends.clear();
    }
    return true;
  }

  /// To be called once, on success or not: the other ranks leave.
  void dismiss() { rounds_.compute({}, {}, {}); }

  Standing finish() {
    standing_.seconds = seconds_since(began_);
    if (!borders_.empty()) progress_.finish(standing_);
    return standing_;
  }

 private:
  bool narrow_down(std::span<SearchedBorder> some, int ranks) {
    while (true) {
      const auto points = next_round(some);
      standing_.total = standing_.finished + expected_points();
      if (points.empty()) break;
      const auto before = standing_;
      const auto results = rounds_.compute(
          points,
          [&] {
            if (progress_.is_due()) show();
            return !stop_requested();
          },
          // Until the round is over, the other ranks are taken to be as far as this one.
          [&](const RoundResult&) {
            standing_.finished = std::min(standing_.finished + static_cast<std::size_t>(ranks),
                                          before.finished + points.size());
            standing_.computed = standing_.finished;
          });
      standing_ = before;
      if (!take(some, results)) return false;
    }
    return true;
  }

  void show() {
    standing_.seconds = seconds_since(began_);
    progress_.show(standing_);
  }

  [[nodiscard]] std::size_t expected_points() const {
    std::size_t points = 0;
    for (const auto& searched : borders_)
      points += std::max(searched.search.expected_points(), searched.search.next().size());
    return points;
  }

  [[nodiscard]] std::vector<RoundPoint> next_round(std::span<const SearchedBorder> some) const {
    std::vector<RoundPoint> points;
    for (const auto& searched : some) {
      for (const auto& request : searched.search.next()) {
        const auto& from = searched.ends[request.from];
        const bool goes_on = swept_ && from.has_value();
        points.push_back({.line = searched.line,
                          .speed_ratio = request.speed_ratio,
                          .from_initial = static_cast<std::uint8_t>(goes_on ? 0 : 1),
                          .start = goes_on ? *from : motion::PointStart{}});
      }
    }
    return points;
  }

  bool take(std::span<SearchedBorder> some, std::span<const RoundResult> results) {
    auto next = results.begin();
    for (auto& searched : some) {
      std::vector<std::uint8_t> motions;
      for (std::size_t left = searched.search.next().size(); left > 0; --left, ++next) {
        if (next->status == ending::PointStatus::pending) return false;
        standing_.count(next->status);
        ++standing_.computed;
        motions.push_back(motion_of(*next));
        const bool done = next->status == ending::PointStatus::done;
        searched.ends.push_back(done ? std::optional(next->end) : std::nullopt);
      }
      searched.search.take(motions);
    }
    return true;
  }

  Rounds& rounds_;
  std::vector<SearchedBorder>& borders_;
  bool swept_;
  Progress progress_;
  Standing standing_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

void note_results(EdgesTask& task) {
  auto edges = *task.found.edges;
  for (std::size_t i = 0; i < task.borders.size(); ++i) {
    const auto& searched = task.borders[i];
    for (const auto& edge : analysis::edges_of(searched.line, i, searched.border, searched.search))
      edges.edges.push_back(edge);
  }
  analysis::enter_edges(task.found, std::move(edges));
}

int lead_edges(const EdgesCommand& command, EdgesTask& task, const Session& session, Rounds& rounds) {
  const bool swept = plan::Grid(task.found.scene).points_depend_on_each_other();
  Leader leader(rounds, task.borders, swept, command.progress);
  const bool complete = leader.run(session.size());
  leader.dismiss();
  if (!complete) {
    say_sentence(fmt::format("stopped; {} has not been written", task.output.path.string()));
    return exit_code::kInterrupted;
  }
  note_results(task);
  analysis::write_edges(task.output, task.found, *task.atlas, command.atlas.filename().string(), software());
  const auto standing = leader.finish();
  print(analysis::edges_report(task.found));
  return exit_code_of(standing);
}

}  // namespace

int find_edges(const EdgesCommand& command) {
  note_stop_signals();
  const Session session;
  const bool leading = session.rank() == 0;

  // Rank 0 alone reads the atlas. All ranks end together where it refuses.
  EdgesTask task;
  int code = exit_code::kDone;
  if (leading) {
    try {
      session.require_one_job();
      task = prepare_edges(command);
    } catch (...) {
      code = report_failure(std::current_exception());
    }
  }
  session.wait_for_all();
  code = session.broadcast(code);
  if (code != exit_code::kDone) return code;

  try {
    const auto text = session.broadcast(leading ? task.atlas->scene_resolved() : std::string());
    Rounds rounds(session, settings::parse_scene(text, "/scene_resolved"));
    if (leading) {
      code = lead_edges(command, task, session, rounds);
    } else {
      rounds.take_part([] { return !stop_requested(); });
    }
  } catch (...) {
    code = report_failure(std::current_exception());
    session.abort(code);
    return code;
  }
  session.wait_for_all();
  code = session.broadcast(code);
  session.wait_for_all();
  return code;
}

}  // namespace rubatlas::mpi
