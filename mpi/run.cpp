#include "mpi/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>

#include "atlas/atlas_writer.hpp"
#include "batch/line_batch.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/failure.hpp"
#include "mpi/mailbox.hpp"
#include "mpi/master.hpp"
#include "mpi/point_runner.hpp"
#include "mpi/preparation.hpp"
#include "mpi/progress.hpp"
#include "mpi/run_record.hpp"
#include "mpi/schedule.hpp"
#include "mpi/session.hpp"
#include "mpi/signals.hpp"
#include "mpi/version.hpp"
#include "mpi/worker.hpp"
#include "scene/reader.hpp"

namespace rubatlas::mpi {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

Standing standing_before(const std::vector<std::uint8_t>& status) {
  Standing standing;
  standing.total = status.size();
  for (const auto code : status) {
    const auto point = static_cast<solve::PointStatus>(code);
    if (point != solve::PointStatus::pending) ++standing.finished;
    if (point != solve::PointStatus::pending && point != solve::PointStatus::done) ++standing.failed;
  }
  return standing;
}

int exit_code_of(const JobResult& result) {
  if (result.stopped) return exit_code::kInterrupted;
  return result.standing.failed > 0 ? exit_code::kSomePointsFailed : exit_code::kDone;
}

/// Rank 0's part of the job between opening and closing the atlas.
JobResult lead(const Session& session, const Preparation& preparation, const plan::Grid& grid,
               PointRunner& runner, Progress& progress) {
  const auto stored = [&](std::size_t point) { return preparation.ends.of(point); };
  Schedule schedule(grid, preparation.status, stored, session.size());
  const Mailbox mailbox(session);
  Master master(session, mailbox, schedule, runner, progress, standing_before(preparation.status));
  return master.run();
}

/// The exit code of the job; rank 0 looks whether what it has filled is still where it was.
int ending(const Preparation& preparation, const JobResult& result) {
  if (preparation.lock->is_in_place()) return exit_code_of(result);
  fmt::print(stderr,
             "rubatlas: {} was removed, moved or replaced while it was being filled; what has been computed "
             "is in the "
             "file that stood there before\n",
             preparation.atlas.string());
  return exit_code::kEnvironment;
}

int fill_atlas(const RunOptions& options, const Session& session, const Preparation& preparation) {
  const auto started = std::chrono::system_clock::now();
  const bool leading = session.rank() == 0;

  // 3. Every rank reads the scene from rank 0's text, and opens the atlas together with the others.
  const std::string scene_text = session.broadcast(preparation.scene_text);
  const scene::Scene scene = scene::parse_scene(scene_text, options.scene.string());
  const plan::Grid grid(scene);
  const std::filesystem::path atlas = session.broadcast(preparation.atlas.string());
  atlas::AtlasWriter writer(atlas, scene, std::chrono::milliseconds(options.batch_milliseconds));

  const batch::Width width = batch::width_of(scene, options.most_lanes);

  // 4. Rank 0 hands out pieces of lines, and computes like the others.
  Progress progress(leading ? options.progress : ProgressStyle::off);
  JobResult result;
  batch::LaneCounts lane_counts;
  try {
    PointRunner runner(scene, grid, writer, width);
    if (leading) {
      result = lead(session, preparation, grid, runner, progress);
    } else {
      work(Mailbox(session), runner);
    }
    lane_counts = runner.lane_counts();
  } catch (...) {
    // Before the writer goes: closing the atlas would wait for ranks that will not come.
    const int code = report_failure(std::current_exception());
    session.abort(code);
    return code;
  }

  // 5. Whoever comes early sleeps; then all close the atlas together.
  session.wait_for_all();
  writer.close();
  const int code = session.broadcast(leading ? ending(preparation, result) : exit_code::kDone);
  const std::vector<std::string> hosts = session.gather(host_name());
  const std::vector<std::string> lanes = session.gather(fmt::to_string(width.seats));
  const std::vector<std::string> in_lanes = session.gather(fmt::to_string(lane_counts.in_lanes));
  if (leading) {
    progress.finish(result.standing);
    write_run_record(record_output(atlas, options.scene),
                     {started, hosts, lanes, in_lanes, options.resume, code, result}, software());
  }
  // A rank that ends with a code other than 0 makes mpirun kill the others, which may still have something to
  // write.
  session.wait_for_all();
  return code;
}

}  // namespace

int run(const RunOptions& options) {
  note_stop_signals();

  // 1. MPI, if a launcher started us.
  const Session session;

  // 2. Rank 0 alone reads the scene and prepares the atlas. Its verdict goes to all, so that all end in
  // order: a rank that left early would make mpirun kill rank 0 before its message is out.
  Preparation preparation;
  int verdict = exit_code::kDone;
  if (session.rank() == 0) {
    try {
      if (options.dry_run) {
        fmt::print("{}", rehearse(options));
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
