#include "mpi/commands/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "atlas/atlas_writer.hpp"
#include "mpi/commands/estimate.hpp"
#include "mpi/commands/notes.hpp"
#include "mpi/commands/preparation.hpp"
#include "mpi/commands/reach.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/failure.hpp"
#include "mpi/job/mailbox.hpp"
#include "mpi/job/master.hpp"
#include "mpi/job/point_runner.hpp"
#include "mpi/job/progress.hpp"
#include "mpi/job/run_record.hpp"
#include "mpi/job/schedule.hpp"
#include "mpi/job/session.hpp"
#include "mpi/job/signals.hpp"
#include "mpi/job/worker.hpp"
#include "mpi/say.hpp"
#include "mpi/version.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// A word of a command quoted for a shell.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

/// The command that goes on with this run when it has been stopped.
std::string command_to_go_on(const RunOptions& options, const Session& session) {
  std::string text =
      session.is_parallel() ? fmt::format("{} -n {} ", Session::launcher(), session.size()) : "";
  for (const auto& word : options.words) {
    if (word != "--overwrite" && word != "--resume") text += quoted(word) + ' ';
  }
  return text + "--resume";
}

/// Points spread over the grid, tried before the job where somebody wants to know how long it will take.
std::vector<TriedPoint> try_points(const RunOptions& options, const settings::Scene& scene,
                                   const Preparation& preparation, int ranks) {
  constexpr double kShareOfTime = 0.01;
  constexpr double kMostSeconds = 0.5;
  constexpr double kFirstLook = 0.02;  // [s]
  if (options.progress == ProgressStyle::off) return {};
  const CostEstimate first = estimate_cost(scene, kFirstLook);
  const auto pending = static_cast<double>(std::ranges::count(preparation.status, 0));
  const double share = kShareOfTime * first.seconds_per_point * pending / ranks;
  if (share <= kFirstLook) return first.points;
  return estimate_cost(scene, std::min(share, kMostSeconds)).points;
}

/// Rank 0's part of the job between opening and closing the atlas.
JobResult lead(const Session& session, const Preparation& preparation, const plan::Grid& grid,
               const plan::Pieces& pieces, const std::vector<TriedPoint>& tried,
               const atlas::FinalStates& ends, PointRunner& runner, Master::Reports reports) {
  const Schedule::Stored stored{.status = preparation.status,
                                .seam = preparation.seam,
                                .final_state = [&](std::size_t point) { return ends.of(point); }};
  Schedule schedule(grid, pieces, stored, session.size());
  for (const TriedPoint& point : tried) {
    const auto& speeds = grid.axes().back().values;
    const auto place = std::ranges::lower_bound(speeds, point.speed_ratio) - speeds.begin();
    if (point.seconds) schedule.expect(static_cast<std::size_t>(place), *point.seconds);
  }
  const Mailbox mailbox(session);
  const auto [first, end] = plan::points_of(preparation.part, grid);
  const auto own = std::span(preparation.status).subspan(first, end - first);
  Master master(session, mailbox, schedule, runner, std::move(reports), standing_of(own));
  return master.run();
}

/// The exit code of the job. Rank 0 checks that the path still leads to the atlas that it has filled.
int ending(const Preparation& preparation, const JobResult& result) {
  if (preparation.lock->is_in_place()) return exit_code_of(result.standing);
  say_sentence(fmt::format(
      "{} was removed, moved or replaced while it was being filled; what has been computed is in the "
      "file that stood there before",
      preparation.atlas.string()));
  return exit_code::kEnvironment;
}

/// How most of the points that are not done ended, and the quantity of the scene that is the cause.
void say_why_all_have_left(const settings::Scene& scene, const JobResult& result) {
  if (result.standing.outside < result.standing.total) return;
  std::string text = "every point left the model";
  const auto most =
      std::ranges::max_element(result.ended_by, {}, [](const auto& entry) { return entry.second; });
  if (most != result.ended_by.end()) {
    text += fmt::format(", {} of {} since {}", most->second, result.standing.computed,
                        ending::text_of(most->first));
  }
  const std::string reason = likely_reason_to_leave(scene);
  say_sentence(reason.empty() ? text : text + "; the likely reason: " + reason);
}

/// Applies to a run that has computed a complete atlas by itself, since a point that ended early might have
/// touched. Where the scene alone decides it, `prepare` has already said so.
void say_that_nothing_touched(const settings::Scene& scene, const JobResult& result) {
  const Standing& standing = result.standing;
  if (standing.computed < standing.total || standing.outside + standing.failed > 0) return;
  if (has_touched(scene, result.work)) return;
  if (reach_without_contact(scene)) return;
  say_sentence(fmt::format("no blade touched the ring at any of the {} points", standing.total));
}

int fill_atlas(const RunOptions& options, const Session& session, const Preparation& preparation) {
  const auto started = std::chrono::system_clock::now();
  const bool leading = session.rank() == 0;

  // 3. Every rank reads the scene from rank 0's text, and opens the atlas together with the others.
  const std::string scene_text = session.broadcast(preparation.scene_text);
  const settings::Scene scene = settings::parse_scene(scene_text, options.scene.string());
  const plan::Grid grid(scene);
  const std::filesystem::path atlas = session.broadcast(preparation.atlas.string());
  atlas::AtlasWriter writer(atlas, scene, std::chrono::milliseconds(options.batch_milliseconds));

  std::optional<RunRecord> record;
  const std::vector<std::string> hosts = session.gather(host_name());
  if (leading)
    record.emplace(record_output(atlas, {options.scene}),
                   RunBeginning{started, preparation.part, hosts, options.resume}, software());

  // 4. Rank 0 hands out points of lines, and computes like the others.
  Progress progress(leading ? options.progress : ProgressStyle::off);
  JobResult result;
  try {
    PointRunner runner(scene, grid, writer);
    if (leading) {
      const std::string stopping = fmt::format("stopping; a second signal ends it at once; to go on: {}",
                                               command_to_go_on(options, session));
      result = lead(session, preparation, grid, plan::Pieces(scene),
                    try_points(options, scene, preparation, session.size()), writer.ends(), runner,
                    {progress, [&](const JobResult& so_far) { record->update(so_far); }, stopping});
    } else {
      work(Mailbox(session), runner);
    }
  } catch (...) {
    // The job is aborted before the writer is destroyed, since closing the atlas would wait for ranks that
    // have failed.
    const int code = report_failure(std::current_exception());
    session.abort(code);
    return code;
  }

  // 5. Ranks that finish early sleep; then all close the atlas together.
  session.wait_for_all();
  writer.close();
  const int code = session.broadcast(leading ? ending(preparation, result) : exit_code::kDone);
  if (leading) {
    progress.finish(result.standing);
    say_why_all_have_left(scene, result);
    say_that_nothing_touched(scene, result);
    record->finish(result, code);
  }
  // A rank that ends with a code other than 0 makes mpirun kill the others, which may still be writing.
  session.wait_for_all();
  return code;
}

}  // namespace

int run(const RunOptions& options) {
  note_stop_signals();

  // 1. Initialise MPI, if a launcher started this process.
  const Session session;

  // 2. Rank 0 alone reads the scene and prepares the atlas. Its verdict goes to all ranks, so that all end
  // together: a rank that ends early would make mpirun kill rank 0 before its message is printed.
  Preparation preparation;
  int verdict = exit_code::kDone;
  if (session.rank() == 0) {
    try {
      session.require_one_job();
      if (options.dry_run) {
        print(rehearse(options));
      } else {
        preparation = prepare(options, software());
      }
    } catch (...) {
      verdict = report_failure(std::current_exception());
    }
  }
  session.wait_for_all();
  verdict = session.broadcast(verdict);
  if (verdict != exit_code::kDone || options.dry_run) return verdict;

  try {
    return fill_atlas(options, session, preparation);
  } catch (...) {
    const int code = report_failure(std::current_exception());
    session.abort(code);
    return code;
  }
}

}  // namespace rubatlas::mpi
