/// What the rules take from a scene: lengths below which two states, or two displacements, count as equal.
#pragma once

#include "analysis/rules/class.hpp"
#include "settings/scene.hpp"

namespace rubatlas::analysis {

/// δc, or L/10 where δc is zero [m]: what the integrator's tolerance is relative to.
[[nodiscard]] double length_scale(const settings::Scene& scene);

/// When two sections of a motion of this scene count as equal: the integrator's tolerance leaves that open.
[[nodiscard]] ClosingTolerance closing_tolerance(const settings::Scene& scene);

/// Displacement [m] below which two motions count as equally small (find_triggers).
[[nodiscard]] double negligible_displacement(const settings::Scene& scene);

}  // namespace rubatlas::analysis
