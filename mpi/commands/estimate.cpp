#include "mpi/commands/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "batch/line_batch.hpp"
#include "mpi/clock.hpp"
#include "mpi/commands/reach.hpp"
#include "plan/grid.hpp"
#include "plan/pieces.hpp"

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

motion::SectionState start_of(const settings::Scene& scene) {
  return {scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};
}

/// Number of revolutions of a trial; the first point has a few only.
int trial_revolutions(const settings::Scene& scene, double budget,
                      const std::shared_ptr<assembly::BladeTables>& tables, const modes::GoOn& go_on) {
  const settings::Scene probe = shortened(scene, kFewestRevolutions);
  const auto parameters = plan::Grid(probe).parameters(0);
  const auto solver = assembly::make_line_solver(probe, parameters, tables);
  const double before = processor_seconds();
  solver->run(parameters.speed_ratio, start_of(probe), go_on);
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
  const motion::SectionState start = start_of(scene);
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

  batch::Width width = batch::width_of(scene);
  const std::size_t most_side_by_side = grid.points_depend_on_each_other()
                                            ? grid.line_count() * plan::Pieces(scene).per_line()
                                            : grid.point_count();
  width.seats = static_cast<int>(std::min(static_cast<std::size_t>(width.seats), most_side_by_side));
  // Declared before the batch, so that it outlives the points in the batch.
  std::vector<std::unique_ptr<point::LineSolver>> solvers(static_cast<std::size_t>(width.seats));
  const auto points = batch::make_line_batch(width);

  CostEstimate result;
  result.side_by_side = width.seats;
  result.most_revolutions = total_revolutions(trial);
  std::vector<double> speed_of_seat(solvers.size(), 0.0);
  std::size_t begun = 0;
  const auto begin_on = [&](std::size_t seat) {
    const auto parameters = grid.parameters(point_of(begun));
    solvers[seat] = batch::make_line_solver(width, trial, parameters, tables);
    speed_of_seat[seat] = parameters.speed_ratio;
    points->begin(static_cast<int>(seat), *solvers[seat], parameters.speed_ratio, start);
    ++begun;
  };
  double sum_of_shares = 0.0;
  double processor_time = 0.0;
  for (std::size_t seat = 0; seat < solvers.size() && begun < most_trials; ++seat) begin_on(seat);
  while (result.trials + result.given_up < begun) {
    const double before = processor_seconds();
    const auto finished = points->advance(go_on);
    processor_time += processor_seconds() - before;
    const auto& outcome = finished.outcome;
    sum_of_shares += finished.seconds;
    result.work += outcome.work;
    result.revolutions += static_cast<double>(outcome.work.revolutions);
    TriedPoint& point = result.points.emplace_back();
    point.speed_ratio = speed_of_seat[static_cast<std::size_t>(finished.seat)];
    point.touched = has_touched(scene, outcome.work);
    if (outcome.status == point::PointStatus::pending) {
      ++result.given_up;
      continue;
    }
    point.seconds = (outcome.status == point::PointStatus::done ? scale : 1.0) * finished.seconds;
    if (outcome.status == point::PointStatus::left_validity) ++result.left_validity;
    if (outcome.status == point::PointStatus::integrator_failed) ++result.integrator_failed;
    ++result.trials;
    if (begun < most_trials && clock() - begin < budget) begin_on(static_cast<std::size_t>(finished.seat));
  }
  if (result.trials == 0) {
    // No point was finished: the estimate uses the time of the revolutions computed so far.
    if (result.revolutions > 0.0) {
      result.seconds_per_point = processor_time / result.revolutions * total_revolutions(scene);
      result.standard_error = result.fastest = result.slowest = result.seconds_per_point;
    }
    return result;
  }

  // Shares are measured in wall time, in which other processes may have run too.
  const double own = sum_of_shares > 0.0 ? processor_time / sum_of_shares : 1.0;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  result.fastest = std::numeric_limits<double>::infinity();
  for (TriedPoint& point : result.points) {
    if (!point.seconds) continue;
    *point.seconds *= own;
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
