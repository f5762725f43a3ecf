/// Curves of bifurcations in two quantities: the equations of an orbit and a test function, along the
/// arclength.
///
/// Source: Seydel, Practical Bifurcation and Stability Analysis, chapter 5.
#pragma once

#include <cstddef>

#include "branch/branch.hpp"
#include "branch/shooting.hpp"

namespace rubatlas::branch {

/// A curve of bifurcations of one kind in two quantities, from one of them on, both ways. The shooting varies
/// both. Orbits along the curve, without events; none where the first cannot be found.
Branch follow_curve(Shooting& shooting, EventKind kind, const Orbit& from, std::size_t most);

}  // namespace rubatlas::branch
