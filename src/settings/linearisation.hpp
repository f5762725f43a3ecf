/// Which scenes have a linearised flow, for Lyapunov exponents and for periodic orbits found by shooting.
#pragma once

#include <optional>
#include <string>

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// Why a scene has none, as a sentence that names the place and what is allowed; nothing where it has one.
/// Refused is what has no derivative or one that is not written yet, rather than approximated.
std::optional<std::string> refusal_of_linearisation(const Scene& scene);
/// The same for periodic orbits by shooting.
std::optional<std::string> refusal_of_shooting(const Scene& scene);
/// The transients of a line, of a scene with the line's values, end on the cycles that they approach
/// (`protocol.settle`).
bool settles(const Scene& line);
/// Those of some line of the scene may.
bool may_settle(const Scene& scene);

}  // namespace rubatlas::settings
