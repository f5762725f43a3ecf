/// One grid point of the default rotor, alone in a process: what a profiler looks at (profile.sh).
///
///   default_point SPEED_RATIO REVOLUTIONS TOLERANCE [OBSERVABLE...]
///
/// From rest, two thirds of the revolutions transient; observables default to `poincare`. Prints what the
/// point cost as counts, and a hash of the sections' bytes, which tells whether a change has changed results.
#include <fmt/core.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "assembly/make_line_solver.hpp"
#include "problem.hpp"

/// What profile.sh counts: a name of its own, so that the making of tables stays outside.
__attribute__((noinline)) rubatlas::point::PointOutcome run_point(rubatlas::point::LineSolver& solver,
                                                                  double speed_ratio) {
  return solver.run(speed_ratio, rubatlas::motion::SectionState{});
}

namespace {

/// FNV-1a over the bytes of the numbers.
std::uint64_t hash_of(const std::vector<double>& values) {
  std::uint64_t hash = 14695981039346656037U;
  for (const double value : values) {
    unsigned char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211U;
  }
  return hash;
}

int run(int argc, char** argv) {
  using namespace rubatlas;
  const double speed_ratio = std::atof(argv[1]);
  settings::Scene scene = bench::default_scene(std::atoi(argv[2]), std::atof(argv[3]));
  if (argc > 4) scene.observables.assign(argv + 4, argv + argc);
  const auto solver =
      assembly::make_line_solver(scene, bench::line_of(scene, speed_ratio), assembly::make_blade_tables());
  const point::PointOutcome outcome = run_point(*solver, speed_ratio);
  const motion::WorkCounts& work = outcome.work;
  fmt::print("status {}\nright_hand_sides {}\nsteps {}\nrejected_steps {}\ntouchdowns {}\nliftoffs {}\n",
             static_cast<int>(outcome.status), work.right_hand_sides, work.steps, work.rejected_steps,
             work.touchdowns, work.liftoffs);
  fmt::print("slip_reversals {}\ngap_evaluations {}\nfirst_observable_hash {:016x}\n", work.slip_reversals,
             work.gap_evaluations, hash_of(outcome.rows.front()));
  return outcome.status == ending::PointStatus::done ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: default_point SPEED_RATIO REVOLUTIONS TOLERANCE [OBSERVABLE...]\n");
    return 2;
  }
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "default_point: {}\n", error.what());
    return 2;
  }
}
