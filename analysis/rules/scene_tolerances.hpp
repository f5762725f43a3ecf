/// Lengths, computed from a scene, below which two states or two displacements count as equal.
#pragma once

#include "analysis/rules/class.hpp"
#include "settings/scene.hpp"

namespace rubatlas::analysis {

/// δc, or L/10 where δc is zero [m]. The tolerance of the integrator is relative to this length.
[[nodiscard]] double length_scale(const settings::Scene& scene);

/// The tolerance within which two sections of a motion of this scene are equal; it includes the error of the
/// integrator.
[[nodiscard]] ClosingTolerance closing_tolerance(const settings::Scene& scene);

/// Displacement [m] below which two motions count as equally small (find_triggers).
[[nodiscard]] double negligible_displacement(const settings::Scene& scene);

}  // namespace rubatlas::analysis
