/// Bifurcations between two orbits of a branch: folds, period doublings, Neimark–Sacker bifurcations.
///
/// Source: Seydel, Practical Bifurcation and Stability Analysis, chapters 5 (test functions) and 7 (periodic
/// orbits).
#pragma once

#include <optional>
#include <vector>

#include "branch/branch.hpp"
#include "branch/corrector.hpp"

namespace rubatlas::branch {

/// Test functions: each changes its sign where the bifurcation is.
double test_function(EventKind kind, const Orbit& orbit);

/// Where in a step an orbit of an even period becomes one of half of it that is run through twice: at the
/// period doubling of that orbit, where the branch ends.
[[nodiscard]] std::optional<Event> halving(Corrector& corrector, const OnBranch& from, const OnBranch& to);

/// Adds the bifurcations of a step of this arclength.
void add_bifurcations(Corrector& corrector, const OnBranch& from, const OnBranch& to, double length,
                      std::vector<Event>& events);

}  // namespace rubatlas::branch
