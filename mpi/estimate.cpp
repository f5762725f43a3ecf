#include "mpi/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "mpi/clock.hpp"
#include "plan/grid.hpp"

namespace rubatlas::mpi {
namespace {

// Enough revolutions for a point to show what it costs; fewer where they are slow, so that there is time for
// several points.
constexpr int kFewestRevolutions = 5;
constexpr int kMostRevolutions = 300;
constexpr double kShareOfOneTrial = 0.1;
constexpr std::size_t kMostTrials = 400;

int total_revolutions(const scene::Scene& scene) {
  return scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions;
}

/// The scene with at most so many revolutions, transient and sampled ones in the same proportion.
scene::Scene shortened(scene::Scene scene, int revolutions) {
  auto& protocol = scene.protocol;
  const int total = total_revolutions(scene);
  if (total <= revolutions) return scene;
  const double share = static_cast<double>(protocol.sampled_revolutions) / total;
  protocol.sampled_revolutions = std::max(1, static_cast<int>(std::lround(share * revolutions)));
  protocol.transient_revolutions = revolutions - protocol.sampled_revolutions;
  return scene;
}

solve::SectionState start_of(const scene::Scene& scene) {
  return {scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};
}

/// How many revolutions a trial may have, from a few at the first point.
int trial_revolutions(const scene::Scene& scene, double budget,
                      const std::shared_ptr<solve::BladeTables>& tables) {
  const scene::Scene probe = shortened(scene, kFewestRevolutions);
  const auto parameters = plan::Grid(probe).parameters(0);
  const auto solver = solve::make_line_solver(probe, parameters, tables);
  const double before = processor_seconds();
  solver->run(parameters.speed_ratio, start_of(probe), [] {});
  const double per_revolution = std::max((processor_seconds() - before) / kFewestRevolutions, 1e-9);
  return static_cast<int>(
      std::clamp<double>(kShareOfOneTrial * budget / per_revolution, kFewestRevolutions, kMostRevolutions));
}

}  // namespace

CostEstimate estimate_cost(const scene::Scene& scene, std::chrono::duration<double> budget) {
  const auto begin = std::chrono::steady_clock::now();
  const auto tables = solve::make_blade_tables();
  const scene::Scene trial = shortened(scene, trial_revolutions(scene, budget.count(), tables));
  const double scale = static_cast<double>(total_revolutions(scene)) / total_revolutions(trial);
  const plan::Grid grid(trial);
  const solve::SectionState start = start_of(scene);

  CostEstimate result;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  const std::size_t most_trials = std::min(grid.point_count(), kMostTrials);
  while (result.trials < most_trials && (result.trials == 0 || seconds_since(begin) < budget.count())) {
    // Multiples of the golden section fall evenly over the grid however many of them there is time for. A
    // grid that is tried as a whole is tried point by point.
    constexpr double kGoldenSection = 0.6180339887498949;
    const double position = std::fmod(kGoldenSection * static_cast<double>(result.trials), 1.0);
    const std::size_t point =
        grid.point_count() == most_trials
            ? result.trials
            : static_cast<std::size_t>(position * static_cast<double>(grid.point_count()));
    const auto parameters = grid.parameters(point);

    const auto solver = solve::make_line_solver(trial, parameters, tables);

    int revolutions = 0;
    const double before = processor_seconds();
    const auto outcome = solver->run(parameters.speed_ratio, start, [&] { ++revolutions; });
    const bool done = outcome.status == solve::PointStatus::done;
    const double seconds = (done ? scale : 1.0) * (processor_seconds() - before);

    result.fastest = result.trials == 0 ? seconds : std::min(result.fastest, seconds);
    result.slowest = std::max(result.slowest, seconds);
    if (outcome.status == solve::PointStatus::left_validity) ++result.left_validity;
    if (outcome.status == solve::PointStatus::integrator_failed) ++result.integrator_failed;
    result.revolutions += revolutions;
    result.work += outcome.work;
    sum += seconds;
    sum_of_squares += seconds * seconds;
    ++result.trials;
  }
  const auto count = static_cast<double>(result.trials);
  result.seconds_per_point = std::max(sum / count, 1e-9);  // a clock that stood still is no rate
  const double variance =
      std::max(0.0, sum_of_squares / count - result.seconds_per_point * result.seconds_per_point);
  result.standard_error = result.trials > 1 ? std::sqrt(variance / (count - 1.0)) : result.seconds_per_point;
  return result;
}

}  // namespace rubatlas::mpi
