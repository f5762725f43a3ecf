/// What the numbers of single effects ask of the rest of a scene; what combines with what is in
/// `combinations.hpp`.
#pragma once

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// Throws SceneError where an effect does not fit the machine or the method.
void check_effects(const Scene& scene);

}  // namespace rubatlas::settings
