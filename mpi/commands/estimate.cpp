#include "mpi/commands/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "assembly/make_line_solver.hpp"
#include "mpi/clock.hpp"
#include "mpi/commands/reach.hpp"
#include "plan/grid.hpp"

namespace rubatlas::mpi {
namespace {

// Enough revolutions to measure the cost of a point; fewer where they are slow, so that there is time for
// several points.
constexpr int kFewestRevolutions = 5;
constexpr int kMostRevolutions = 300;
constexpr double kShareOfOneTrial = 0.1;
constexpr std::size_t kMostTrials = 400;
/// A point that is not finished after this many budgets is given up.
constexpr double kLastMoment = 1.25;

int total_revolutions(const settings::Scene& scene) {
  return scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions;
}

/// The scene with at most so many revolutions, transient and sampled ones in the same proportion.
settings::Scene shortened(settings::Scene scene, int revolutions) {
  auto& protocol = scene.protocol;
  const int total = total_revolutions(scene);
  if (total <= revolutions) return scene;
  const double share = static_cast<double>(protocol.sampled_revolutions) / total;
  protocol.sampled_revolutions = std::max(1, static_cast<int>(std::lround(share * revolutions)));
  protocol.transient_revolutions = revolutions - protocol.sampled_revolutions;
  return scene;
}

/// Number of revolutions of a trial; the first point has a few only.
int trial_revolutions(const settings::Scene& scene, double budget,
                      const std::shared_ptr<assembly::BladeTables>& tables, const modes::GoOn& go_on) {
  const settings::Scene probe = shortened(scene, kFewestRevolutions);
  const auto parameters = plan::Grid(probe).parameters(0);
  const auto solver = assembly::make_line_solver(probe, parameters, tables);
  const double before = processor_seconds();
  solver->run(parameters.speed_ratio, assembly::initial_state(probe, parameters), go_on);
  const double per_revolution = std::max((processor_seconds() - before) / kFewestRevolutions, 1e-9);
  return static_cast<int>(
      std::clamp<double>(kShareOfOneTrial * budget / per_revolution, kFewestRevolutions, kMostRevolutions));
}

}  // namespace

double seconds_on_the_wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

CostEstimate estimate_cost(const settings::Scene& scene, double budget, const Clock& clock) {
  const double begin = clock();
  const modes::GoOn go_on = [&] { return clock() - begin < kLastMoment * budget; };
  const auto tables = assembly::make_blade_tables();
  const settings::Scene trial = shortened(scene, trial_revolutions(scene, budget, tables, go_on));
  const double scale = static_cast<double>(total_revolutions(scene)) / total_revolutions(trial);
  const plan::Grid grid(trial);
  const std::size_t most_trials = std::min(grid.point_count(), kMostTrials);
  // Multiples of the golden section are spread evenly over the grid for any number of points. A small grid is
  // computed completely, point by point.
  const auto point_of = [&](std::size_t number) {
    constexpr double kGoldenSection = 0.6180339887498949;
    const double position = std::fmod(kGoldenSection * static_cast<double>(number), 1.0);
    return grid.point_count() == most_trials
               ? number
               : static_cast<std::size_t>(position * static_cast<double>(grid.point_count()));
  };

  CostEstimate result;
  result.most_revolutions = total_revolutions(trial);
  double processor_time = 0.0;
  for (std::size_t number = 0; number < most_trials && (number == 0 || clock() - begin < budget); ++number) {
    const auto parameters = grid.parameters(point_of(number));
    const auto solver = assembly::make_line_solver(trial, parameters, tables);
    const auto start = assembly::initial_state(trial, parameters);
    const double before = processor_seconds();
    const auto outcome = solver->run(parameters.speed_ratio, start, go_on);
    const double seconds = processor_seconds() - before;
    processor_time += seconds;
    result.work += outcome.work;
    result.revolutions += static_cast<double>(outcome.work.revolutions);
    TriedPoint& point = result.points.emplace_back();
    point.speed_ratio = parameters.speed_ratio;
    point.touched = has_touched(scene, outcome.work);
    if (outcome.status == ending::PointStatus::pending) {
      ++result.given_up;
      break;
    }
    const bool runs_all = outcome.status == ending::PointStatus::done && outcome.settled == 0;
    point.seconds = (runs_all ? scale : 1.0) * seconds;
    if (outcome.status == ending::PointStatus::left_validity) ++result.left_validity;
    if (outcome.status == ending::PointStatus::integrator_failed) ++result.integrator_failed;
    ++result.trials;
  }
  if (result.trials == 0) {
    // No point was finished: the estimate uses the time of the revolutions computed so far.
    if (result.revolutions > 0.0) {
      result.seconds_per_point = processor_time / result.revolutions * total_revolutions(scene);
      result.standard_error = result.fastest = result.slowest = result.seconds_per_point;
    }
    return result;
  }

  double sum = 0.0;
  double sum_of_squares = 0.0;
  result.fastest = std::numeric_limits<double>::infinity();
  for (const TriedPoint& point : result.points) {
    if (!point.seconds) continue;
    sum += *point.seconds;
    sum_of_squares += *point.seconds * *point.seconds;
    result.fastest = std::min(result.fastest, *point.seconds);
    result.slowest = std::max(result.slowest, *point.seconds);
  }
  const auto count = static_cast<double>(result.trials);
  result.seconds_per_point =
      std::max(sum / count, 1e-9);  // avoids a division by zero where the clock did not advance
  const double variance =
      std::max(0.0, sum_of_squares / count - result.seconds_per_point * result.seconds_per_point);
  result.standard_error = result.trials > 1 ? std::sqrt(variance / (count - 1.0)) : result.seconds_per_point;
  return result;
}

}  // namespace rubatlas::mpi
