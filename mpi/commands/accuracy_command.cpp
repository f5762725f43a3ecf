#include "mpi/commands/accuracy_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>

#include "atlas/accuracy_file.hpp"
#include "atlas/output.hpp"
#include "mpi/accuracy/accuracy_settings.hpp"
#include "mpi/accuracy/accuracy_study.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/job/progress.hpp"
#include "mpi/say.hpp"
#include "mpi/version.hpp"
#include "plan/grid.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::mpi {
namespace {

/// Methods that are named are compared, or refused.
void say_what_is_left_out(const AccuracyLadders& ladders, const settings::Scene& scene) {
  const auto left_out = methods_left_out(scene);
  if (!ladders.methods.empty() || left_out.empty()) return;
  say_sentence(
      fmt::format("left out, since they do not take the scene's effects: {}", fmt::join(left_out, ", ")));
}

}  // namespace

int compute_accuracy(const AccuracyCommand& command) {
  const std::string text = settings::read_text(command.scene);
  const settings::Scene scene = settings::parse_scene(text, command.scene.string());
  const auto settings = accuracy_settings(command.ladders, scene);
  const atlas::Output output = atlas::permitted(
      {command.output, atlas::FileKind::accuracy, atlas::existing(command.overwrite)}, {command.scene});
  say_what_is_left_out(command.ladders, scene);

  Progress progress(command.progress);
  Standing standing;
  standing.total = settings.size() * plan::Grid(scene).point_count();
  const auto began = std::chrono::steady_clock::now();
  const auto after_run = [&](const atlas::AccuracyRun& run) {
    standing.count(run.status);
    ++standing.computed;
    standing.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (progress.is_due()) progress.show(standing);
  };
  const auto study = study_accuracy(scene, settings, command.repeats, after_run);
  atlas::write_accuracy(output, scene, text, study, software());
  progress.finish(standing);
  return standing.failed == 0 ? exit_code::kDone : exit_code::kSomePointsFailed;
}

}  // namespace rubatlas::mpi
