/// Curves of bifurcations in two quantities: the equations of an orbit and a test function, along the
/// arclength.
///
/// Source: Seydel, Practical Bifurcation and Stability Analysis, chapter 5.
#pragma once

#include "branch/branch.hpp"
#include "branch/shooting.hpp"

namespace rubatlas::branch {

/// A curve of bifurcations of one kind in two quantities, from one of them on, both ways as long as `go_on`
/// says of each. The shooting varies both. Orbits along the curve, without events; none where the first
/// cannot be found.
Branch follow_curve(Shooting& shooting, EventKind kind, const Orbit& from, const GoOn& go_on);

}  // namespace rubatlas::branch
