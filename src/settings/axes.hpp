/// The grid of a scene: a number, a list or a range of values for each axis.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// Fills in `scene.grid`, and the quantities that its axes set. Throws SceneError.
void read_grid(const nlohmann::json& document, Scene& scene);

}  // namespace rubatlas::settings
