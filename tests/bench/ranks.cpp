// How busy ranks are kept by the lines of a scene: the CPU time of each point is measured in a serial sweep,
// and the schedule of a job then plays with these times.
//
//     ranks SCENE.json [EVERY]     EVERY: only each EVERY-th line, its times standing for those of its
//     neighbours
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "../mpi/played_job.hpp"
#include "assembly/make_line_solver.hpp"
#include "mpi/clock.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::mpi {
namespace {

/// Seconds of each point of a line, in the order of its sweep.
std::vector<double> times_of_line(const settings::Scene& scene, const plan::Grid& grid, std::size_t line,
                                  const std::shared_ptr<assembly::BladeTables>& tables) {
  const auto solver = assembly::make_line_solver(scene, grid.parameters(grid.point(line, 0)), tables);
  const auto& [x, y, vx, vy] = scene.initial;
  const motion::PointStart initial(motion::SectionState{x, y, vx, vy});
  std::optional<motion::PointStart> start;
  std::vector<double> seconds;
  for (std::size_t visit = 0; visit < grid.speed_count(); ++visit) {
    const double begin = processor_seconds();
    const auto outcome =
        solver->run(grid.parameters(grid.point(line, visit)).speed_ratio, start.value_or(initial));
    seconds.push_back(processor_seconds() - begin);
    start.reset();
    if (outcome.status == ending::PointStatus::done && grid.points_depend_on_each_other())
      start.emplace(outcome.final_state, outcome.final_memory);
  }
  return seconds;
}

void show(const std::string& path, std::size_t every) {
  const settings::Scene scene = settings::parse_scene(settings::read_text(path), path);
  const plan::Grid grid(scene);
  const auto tables = assembly::make_blade_tables();
  std::vector<std::vector<double>> times(grid.line_count());
  double serial = 0.0;
  for (std::size_t line = 0; line < times.size(); ++line) {
    times[line] = line % every == 0 ? times_of_line(scene, grid, line, tables) : times[line - line % every];
    for (const double seconds : times[line]) serial += seconds;
  }
  const auto cost = [&](std::size_t line, std::uint64_t visit) { return times[line][visit]; };
  const double alone = PlayedJob(scene, 1).play(cost);
  fmt::print("| {} | {} | {:.1f} | {:.1f} %", path.substr(path.rfind('/') + 1), grid.point_count(), serial,
             100.0 * (alone / serial - 1.0));
  for (const int ranks : {2, 4, 8, 16, 32, 64}) {
    fmt::print(" | {:.1f} %", 100.0 * alone / ranks / PlayedJob(scene, ranks).play(cost));
  }
  fmt::print(" |\n");
}

}  // namespace
}  // namespace rubatlas::mpi

int main(int argc, char** argv) {
  if (argc < 2) return EXIT_FAILURE;
  rubatlas::mpi::show(argv[1], argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
}
