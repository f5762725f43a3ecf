/// What flight on a general linear support costs: nanoseconds per state, bound and construction, for 0 … 32
/// harmonic terms, on one core. Asks nothing; prints the table of linear_support.md.
#include <fmt/format.h>

#include <chrono>
#include <vector>

#include "rotor/linear_support.hpp"
#include "rotor/support_bounds.hpp"
#include "rotor/support_matrices.hpp"

namespace {

using namespace rubatlas::rotor;

/// Seconds per call; each call waits for the one before, as in a search.
template <class Call>
double cost(int calls, const Call& call) {
  double chain = 0.0;
  double best = 1.0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) chain = call(i, 1e-30 * chain);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    best = std::min(best, taken.count() / calls);
  }
  return best;
}

}  // namespace

int main() {
  fmt::print(
      "| terms J | state [ns] | amplitude bound [ns] | support [µs] | bounds [µs] "
      "|\n|---|---|---|---|---|\n");
  const SupportMatrices parts = with_rotating_damping(isotropic_shaft(0.1), 0.02, 0.62);
  const LinearSupport::State start(0.003, -0.001, 0.002, 0.004);
  for (const int terms : {0, 1, 3, 32}) {
    std::vector<HarmonicForcing> forcing;
    for (int j = 0; j < terms; ++j) forcing.push_back({{1e-4, 2e-5}, 0.62 + 0.05 * j});
    const LinearSupport support(parts.stiffness, parts.damping, forcing);
    const SupportBounds bounds(support);
    const double state = cost(200000, [&](int i, double chain) {
      return support.state(0.3, start, 5e-5 * i + chain)[0];  // up to one revolution
    });
    const double bound = cost(
        200000, [&](int i, double chain) { return bounds.amplitude_bound(0.3, start, 5e-5 * i + chain); });
    const double support_built = cost(50, [&](int, double chain) {
      return LinearSupport(parts.stiffness, parts.damping, forcing).damping().trace() + chain;
    });
    const double bounds_built =
        cost(50, [&](int, double chain) { return SupportBounds(support).forcing_bound() + chain; });
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n", terms, 1e9 * state, 1e9 * bound,
               1e6 * support_built, 1e6 * bounds_built);
  }
}
