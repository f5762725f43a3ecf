/// Checks of what more than one quantity of a scene decides.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// Also fills in `spectrum.max_order`, whose default follows from the rest. Throws SceneError.
void check_together(const nlohmann::json& document, Scene& scene);

}  // namespace rubatlas::settings
