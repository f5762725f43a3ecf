#include "mpi/commands/effect_cost.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "assembly/make_line_solver.hpp"
#include "mpi/clock.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::mpi {
namespace {

/// CPU time [s] of one repetition, and number of repetitions. The fastest counts, since other processes
/// disturbed it least.
constexpr double kOneRepetition = 2e-3;
constexpr int kRepetitions = 5;
constexpr int kRevolutions = 10;
constexpr std::array kPlacesOnTheLine{0.3, 0.5, 0.7};

}  // namespace

std::optional<double> seconds_per_right_hand_side(const settings::Scene& scene, const modes::GoOn& go_on) {
  if (!go_on()) return std::nullopt;
  settings::Scene trial = scene;
  trial.protocol.transient_revolutions = 0;
  trial.protocol.sampled_revolutions =
      std::min(kRevolutions, scene.protocol.sampled_revolutions + scene.protocol.transient_revolutions);
  const plan::Grid grid(trial);
  const std::size_t first = grid.point_count() - grid.speed_count();
  const auto line = grid.parameters(first);
  const auto solver = assembly::make_line_solver(trial, line, assembly::make_blade_tables());
  const motion::SectionState start = assembly::initial_state(trial, line);

  double fastest = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    motion::WorkCounts work;
    const double began = processor_seconds();
    double seconds = 0.0;
    do {
      for (const double place : kPlacesOnTheLine) {
        const auto speed = static_cast<std::size_t>(place * static_cast<double>(grid.speed_count()));
        work += solver->run(grid.parameters(first + speed).speed_ratio, start, go_on).work;
        if (!go_on()) return std::nullopt;
      }
      seconds = processor_seconds() - began;
    } while (seconds < kOneRepetition);
    if (work.right_hand_sides == 0) return std::nullopt;
    fastest = std::min(fastest, seconds / static_cast<double>(work.right_hand_sides));
  }
  return fastest;
}

}  // namespace rubatlas::mpi
