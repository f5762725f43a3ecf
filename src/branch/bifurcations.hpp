/// Bifurcations between two orbits of a branch: folds, period doublings, Neimark–Sacker bifurcations.
///
/// Source: Seydel, Practical Bifurcation and Stability Analysis, chapters 5 (test functions) and 7 (periodic
/// orbits).
#pragma once

#include <vector>

#include "branch/branch.hpp"
#include "branch/corrector.hpp"

namespace rubatlas::branch {

/// Test functions: each changes its sign where the bifurcation is.
double test_function(EventKind kind, const Orbit& orbit);

/// Adds the bifurcations of a step of this arclength.
void add_bifurcations(Corrector& corrector, const OnBranch& from, const OnBranch& to, double length,
                      std::vector<Event>& events);

}  // namespace rubatlas::branch
