/// The orbit from which a branch is followed: that on which a motion settles, or one of doubled period.
#pragma once

#include <optional>
#include <vector>

#include "branch/branch.hpp"
#include "branch/corrector.hpp"

namespace rubatlas::branch {

/// The periodic orbit on which the motion from a state settles, if its period is 16 revolutions at most. Sets
/// the period.
[[nodiscard]] std::optional<Orbit> settled_orbit(Corrector& corrector, const motion::SectionState& initial,
                                                 const std::vector<double>& quantities,
                                                 int transient_revolutions);

/// An orbit of the branch of doubled period that begins at a period doubling, turned away from it. Sets the
/// period.
[[nodiscard]] std::optional<OnBranch> doubled_orbit(Corrector& corrector, const Event& doubling);

}  // namespace rubatlas::branch
