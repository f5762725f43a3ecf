/// Bifurcations between two orbits of a branch: folds, period doublings, Neimark–Sacker bifurcations.
///
/// Where blades are alike and nothing else turns with the rotor, periods double in blade passings. Where a
/// multiplier from passing to passing goes through −1, that over the revolution of an even number of blades
/// goes through +1 while the branch does not turn: the class per passing goes from 1 to 2 within the same
/// period. So the passings of an orbit's period are halved as long as it repeats itself after half of them,
/// and the map over these is judged. For an odd number of blades they make whole revolutions.
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

/// By how much the motion differs, half of its passings of blades later, from where it starts [scaled]; zero
/// where it cannot repeat itself after them.
[[nodiscard]] Eigen::Vector4d half_a_period_on(Shooting& shooting, const Orbit& orbit);

/// Where in a step an orbit becomes one of half its passings that is run through twice: at the period
/// doubling of that orbit, where the branch ends.
[[nodiscard]] std::optional<Event> halving(Corrector& corrector, const OnBranch& from, const OnBranch& to);

/// Adds the bifurcations of a step of this arclength.
void add_bifurcations(Corrector& corrector, const OnBranch& from, const OnBranch& to, double length,
                      std::vector<Event>& events);

}  // namespace rubatlas::branch
