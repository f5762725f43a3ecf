#include "mpi/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "plan/grid.hpp"

namespace rubatlas::mpi {
namespace {

using Clock = std::chrono::steady_clock;

// Enough revolutions for a point to show what it costs, few enough that a trial ends.
constexpr int kMostRevolutions = 300;
constexpr std::size_t kMostTrials = 400;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// CPU time, so that what else runs on the machine does not count.
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

int total_revolutions(const scene::Scene& scene) {
  return scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions;
}

/// The scene with at most kMostRevolutions, transient and sampled ones in the same proportion.
scene::Scene shortened(scene::Scene scene) {
  auto& protocol = scene.protocol;
  const int total = total_revolutions(scene);
  if (total <= kMostRevolutions) return scene;
  const double share = static_cast<double>(protocol.sampled_revolutions) / total;
  protocol.sampled_revolutions = std::max(1, static_cast<int>(std::lround(share * kMostRevolutions)));
  protocol.transient_revolutions = kMostRevolutions - protocol.sampled_revolutions;
  return scene;
}

void add(solve::WorkCounts& sum, const solve::WorkCounts& work) {
  sum.right_hand_sides += work.right_hand_sides;
  sum.steps += work.steps;
  sum.rejected_steps += work.rejected_steps;
  sum.touchdowns += work.touchdowns;
  sum.liftoffs += work.liftoffs;
  sum.slip_reversals += work.slip_reversals;
  sum.gap_evaluations += work.gap_evaluations;
}

}  // namespace

CostEstimate estimate_cost(const scene::Scene& scene, std::chrono::duration<double> budget) {
  const scene::Scene trial = shortened(scene);
  const double scale = static_cast<double>(total_revolutions(scene)) / total_revolutions(trial);
  const plan::Grid grid(trial);
  const auto tables = solve::make_blade_tables();
  const solve::SectionState start{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};

  CostEstimate result;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  const std::size_t most_trials = std::min(grid.point_count(), kMostTrials);
  const auto begin = Clock::now();
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

    const double before_table = processor_seconds();
    const auto solver = solve::make_line_solver(trial, parameters, tables);
    result.table_seconds += processor_seconds() - before_table;

    int revolutions = 0;
    const double before = processor_seconds();
    const auto outcome = solver->run(parameters.speed_ratio, start, [&] { ++revolutions; });
    const double seconds = scale * (processor_seconds() - before);

    result.fastest = result.trials == 0 ? seconds : std::min(result.fastest, seconds);
    result.slowest = std::max(result.slowest, seconds);
    if (outcome.status == solve::PointStatus::left_validity) ++result.left_validity;
    if (outcome.status == solve::PointStatus::integrator_failed) ++result.integrator_failed;
    result.revolutions += revolutions;
    add(result.work, outcome.work);
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
