/// Checks of numbers of single effects against the rest of a scene; `combinations.hpp` decides which effects
/// combine.
#pragma once

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// Throws SceneError where an effect does not fit the machine or the method.
void check_effects(const Scene& scene);

}  // namespace rubatlas::settings
