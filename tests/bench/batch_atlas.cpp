/// Trial: whole atlases with their attempts of contact steps batched over lines, against the same atlases as
/// the program makes them (README).
///
///   batch_atlas [REPEATS [LINES_ALIVE...]]     sixteen damping ratios, so many lines alive at a time
///   batch_atlas REPEATS SCENE.json...          a scene's own lines as one, two or four ranks would share
///   them
///
/// Speeds are thinned out to 24 and revolutions to 30 + 10; all observables are kept. Both ways in turn in
/// one process, process CPU time; everything that an atlas would keep is compared.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "line_fibers.hpp"
#include "plan/grid.hpp"
#include "scene/reader.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/methods.hpp"
#include "solve/typed_line_solver.hpp"

namespace {
using namespace rubatlas;

constexpr std::size_t kSpeeds = 24;
constexpr std::size_t kFewest = 2;  ///< attempts that are worth a batch

using Outcomes = std::vector<solve::PointOutcome>;
using MakeSolver = std::unique_ptr<solve::LineSolver> (*)(const solve::LineRequest&);

void shorten(scene::Scene& scene) {
  scene.protocol.transient_revolutions = 30;
  scene.protocol.sampled_revolutions = 10;
}

/// Sixteen damping ratios of the default rotor.
scene::Scene damping_scene() {
  scene::Scene scene = scene::parse_scene(R"({
    "grid": {"damping_ratio": {"from": 0.05, "to": 0.2, "count": 16},
             "speed_ratio": {"from": 0.1, "to": 0.8, "count": 24}},
    "observables": ["poincare", "poincare_blade_passing", "max_displacement", "spectrum",
                    "touchdowns_per_revolution", "max_contact_force", "contact_fraction", "max_root_strain"]
  })");
  shorten(scene);
  return scene;
}

/// A scene that ships, with every n-th of its speeds.
scene::Scene thinned_scene(const std::string& file) {
  scene::Scene scene = scene::parse_scene(scene::read_text(file), file);
  std::vector<double> speeds;
  const std::vector<double>& all = scene.grid.speed_ratio;
  for (std::size_t i = 0; i < kSpeeds; ++i) speeds.push_back(all[i * (all.size() - 1) / (kSpeeds - 1)]);
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  scene.grid.speed_ratio = speeds;
  shorten(scene);
  return scene;
}

/// One line, swept as the program does it: each point from the end of the one before.
void run_line(const scene::Scene& scene, const plan::Grid& grid, std::size_t line,
              const std::shared_ptr<solve::BladeTables>& tables, MakeSolver make, Outcomes& outcomes) {
  const plan::PointParameters parameters = grid.parameters(grid.point(line, 0));
  const auto solver = make({scene, parameters, *tables});
  const solve::SectionState rest{};
  solve::SectionState start = rest;
  for (std::size_t visit = 0; visit < grid.speed_count(); ++visit) {
    outcomes.push_back(solver->run(grid.parameters(grid.point(line, visit)).speed_ratio, start, [] {}));
    const bool goes_on =
        grid.points_depend_on_each_other() && outcomes.back().status == solve::PointStatus::done;
    start = goes_on ? outcomes.back().final_state : rest;
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

/// One scene both ways.
class Trial {
 public:
  explicit Trial(scene::Scene scene) : scene_(std::move(scene)), grid_(scene_) { run_scalar(); }

  [[nodiscard]] std::size_t lines() const { return grid_.line_count(); }

  /// Prints a row of the table; `ranks` share the lines as they come, each with at most `alive` at a time.
  /// Returns how many points differ.
  std::size_t measure(const std::string& name, int repeats, std::size_t ranks, std::size_t alive) {
    std::vector<double> alone, together, ratio;
    bench::LaneCounts counts;
    std::size_t different = 0;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      alone.push_back(run_scalar());
      counts = {};
      together.push_back(run_batched(ranks, alive, counts));
      ratio.push_back(alone.back() / together.back());
      different += different_points(scalar_, batched_);
    }
    const double attempts = static_cast<double>(counts.in_lanes + counts.alone);
    const double share = attempts > 0.0 ? static_cast<double>(counts.in_lanes) / attempts : 0.0;
    const double filled =
        counts.batches > 0 ? static_cast<double>(counts.in_lanes) / static_cast<double>(counts.batches) : 0.0;
    fmt::print("| {} | {:.0f} | {:.0f} | {:.2f} | {:.1f} | {:.0f} % | {} of {} |\n", name, median(alone),
               median(together), median(ratio), filled, 100.0 * share, different,
               static_cast<std::size_t>(repeats) * grid_.point_count());
    std::fflush(stdout);
    return different;
  }

  static void print_head(const std::string& first) {
    fmt::print(
        "| {} | scalar (ms) | batched (ms) | × | motions a batch | attempts in batches | points with "
        "other bits |\n|---|--:|--:|--:|--:|--:|--:|\n",
        first);
  }

 private:
  double run_scalar() {
    scalar_.assign(lines(), {});
    const double begin = milliseconds();
    for (std::size_t line = 0; line < lines(); ++line) {
      run_line(scene_, grid_, line, tables_, solve::make_hybrid, scalar_[line]);
    }
    return milliseconds() - begin;
  }
  double run_batched(std::size_t ranks, std::size_t alive, bench::LaneCounts& counts) {
    using Batched = solve::HybridMethod<bench::BatchedDormandPrince853>;
    batched_.assign(lines(), {});
    const double begin = milliseconds();
    for (std::size_t rank = 0; rank < ranks; ++rank) {
      std::vector<std::function<void()>> work;
      for (std::size_t line = rank; line < lines(); line += ranks) {
        work.emplace_back([this, line] {
          run_line(scene_, grid_, line, tables_, solve::make_typed_line_solver<Batched>, batched_[line]);
        });
      }
      counts += bench::LineFibers(alive, kFewest).run(work);
    }
    return milliseconds() - begin;
  }

  scene::Scene scene_;
  plan::Grid grid_;
  std::shared_ptr<solve::BladeTables> tables_ = solve::make_blade_tables();
  std::vector<Outcomes> scalar_;
  std::vector<Outcomes> batched_;
};

int run(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  std::vector<std::string> rest(argv + std::min(argc, 2), argv + argc);
  if (rest.empty()) rest = {"16", "8", "4", "3", "2", "1"};
  std::size_t different = 0;
  if (rest.front().ends_with(".json")) {
    Trial::print_head("scene, lines, ranks");
    for (const std::string& file : rest) {
      Trial trial(thinned_scene(file));
      for (const std::size_t ranks : {1U, 2U, 4U}) {
        if (ranks > trial.lines()) continue;
        const std::string name =
            fmt::format("{}, {}, {}", std::filesystem::path(file).stem().string(), trial.lines(), ranks);
        different += trial.measure(name, repeats, ranks, trial.lines());
      }
    }
  } else {
    Trial trial(damping_scene());
    Trial::print_head("lines alive");
    for (const std::string& alive : rest) {
      different += trial.measure(alive, repeats, 1, static_cast<std::size_t>(std::stoul(alive)));
    }
  }
  return different == 0 ? 0 : 1;
}
}  // namespace

int main(int argc, char** argv) {
  if (!__builtin_cpu_supports("avx512dq")) {
    fmt::print("batch_atlas: this processor has no AVX-512\n");
    return 0;
  }
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "batch_atlas: {}\n", error.what());
    return 2;
  }
}
