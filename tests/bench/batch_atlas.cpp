/// Trial: a whole atlas with its attempts of contact steps batched over lines, against the same atlas as the
/// program makes it (README).
///
///   batch_atlas [REPEATS [LINES_ALIVE...]]
///
/// Sixteen damping ratios, 24 speeds swept up, 30 + 10 revolutions, all observables of jobs/damping.json.
/// Both ways in turn in one process, process CPU time; every number that an atlas would keep is compared.
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <vector>

#include "line_fibers.hpp"
#include "problem.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/methods.hpp"
#include "solve/typed_line_solver.hpp"

namespace {
using namespace rubatlas;

constexpr int kLines = 16;
constexpr int kSpeeds = 24;
constexpr int kFewest = 3;  ///< attempts that are worth a batch; two cost less one after the other

scene::Scene atlas_scene() {
  scene::Scene scene = bench::default_scene(30, 1e-9);
  scene.protocol.transient_revolutions = 30;
  scene.protocol.sampled_revolutions = 10;
  scene.observables = {"poincare",
                       "poincare_blade_passing",
                       "max_displacement",
                       "spectrum",
                       "touchdowns_per_revolution",
                       "max_contact_force",
                       "contact_fraction",
                       "max_root_strain"};
  return scene;
}

using Outcomes = std::vector<solve::PointOutcome>;
using MakeSolver = std::unique_ptr<solve::LineSolver> (*)(const solve::LineRequest&);

/// One line, swept as the program does it: each point from the end of the one before.
void run_line(const scene::Scene& scene, int index, const std::shared_ptr<solve::BladeTables>& tables,
              MakeSolver make, Outcomes& outcomes) {
  plan::PointParameters line = bench::line_of(scene, 0.0);
  line.damping_ratio = 0.05 + 0.15 * index / (kLines - 1);
  const auto solver = make({scene, line, *tables});
  solve::SectionState start{};
  for (int i = 0; i < kSpeeds; ++i) {
    const double speed = 0.1 + 0.7 * i / (kSpeeds - 1);
    outcomes.push_back(solver->run(speed, start, [] {}));
    start = outcomes.back().status == solve::PointStatus::done ? outcomes.back().final_state
                                                               : solve::SectionState{};
  }
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Of everything that an atlas keeps, and of the counts of work.
std::size_t different_points(const std::vector<Outcomes>& all, const std::vector<Outcomes>& others) {
  std::size_t different = 0;
  for (std::size_t line = 0; line < all.size(); ++line) {
    for (std::size_t i = 0; i < all[line].size(); ++i) {
      const solve::PointOutcome& a = all[line][i];
      const solve::PointOutcome& b = others[line].at(i);
      bool same = a.status == b.status && a.failed_revolution == b.failed_revolution &&
                  a.rows.size() == b.rows.size() &&
                  std::memcmp(a.final_state.data(), b.final_state.data(), sizeof a.final_state) == 0 &&
                  std::memcmp(&a.work, &b.work, sizeof a.work) == 0;
      for (std::size_t row = 0; same && row < a.rows.size(); ++row)
        same = same_bits(a.rows[row], b.rows[row]);
      if (!same) ++different;
    }
  }
  return different;
}

double milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

int run(int repeats, const std::vector<std::size_t>& lines_alive) {
  const scene::Scene scene = atlas_scene();
  const auto tables = solve::make_blade_tables();
  std::vector<Outcomes> scalar;
  std::vector<Outcomes> batched;
  const auto work = [&](MakeSolver make, std::vector<Outcomes>& outcomes) {
    outcomes.assign(kLines, {});
    std::vector<std::function<void()>> lines;
    for (int i = 0; i < kLines; ++i) {
      lines.emplace_back(
          [&, i, make] { run_line(scene, i, tables, make, outcomes[static_cast<std::size_t>(i)]); });
    }
    return lines;
  };
  const auto run_scalar = [&] {
    const auto lines = work(solve::make_hybrid, scalar);
    const double begin = milliseconds();
    for (const auto& line : lines) line();
    return milliseconds() - begin;
  };
  run_scalar();  // tables and caches
  std::size_t points = 0, done = 0;
  for (const Outcomes& line : scalar) {
    points += line.size();
    for (const auto& point : line) done += point.status == solve::PointStatus::done ? 1 : 0;
  }
  fmt::print("points {} done {}\n", points, done);
  fmt::print(
      "| lines alive | ms scalar | ms batched | ratio | attempts | in a batch | lanes filled | points that "
      "differ |\n|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  std::size_t all_different = 0;
  for (const std::size_t alive : lines_alive) {
    std::vector<double> alone, together, ratio;
    bench::LaneCounts counts;
    std::size_t different = 0;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      alone.push_back(run_scalar());
      const auto lines =
          work(solve::make_typed_line_solver<solve::HybridMethod<bench::BatchedDormandPrince853>>, batched);
      bench::LineFibers fibers(alive, kFewest);
      const double begin = milliseconds();
      counts = fibers.run(lines);
      together.push_back(milliseconds() - begin);
      ratio.push_back(alone.back() / together.back());
      different += different_points(scalar, batched);
    }
    const double attempts = static_cast<double>(counts.in_lanes + counts.alone);
    fmt::print(
        "| {} | {:.0f} | {:.0f} | {:.2f} | {:.0f} | {:.1f} % | {:.2f} | {} |\n", alive, median(alone),
        median(together), median(ratio), attempts, 100.0 * static_cast<double>(counts.in_lanes) / attempts,
        counts.batches > 0 ? static_cast<double>(counts.in_lanes) / static_cast<double>(counts.batches) : 0.0,
        different);
    std::fflush(stdout);
    all_different += different;
  }
  return all_different == 0 ? 0 : 1;
}
}  // namespace

int main(int argc, char** argv) {
  if (!__builtin_cpu_supports("avx512dq")) {
    fmt::print("batch_atlas: this processor has no AVX-512\n");
    return 0;
  }
  std::vector<std::size_t> alive;
  for (int i = 2; i < argc; ++i) alive.push_back(static_cast<std::size_t>(std::atoi(argv[i])));
  if (alive.empty()) alive = {16, 8, 4, 2, 1};
  return run(argc > 1 ? std::atoi(argv[1]) : 5, alive);
}
