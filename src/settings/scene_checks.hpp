/// Checks of what more than one quantity of a scene decides.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// Also fills in `pieces` and `spectrum.max_order`, whose defaults follow from the rest. Throws SceneError.
void check_together(const nlohmann::json& document, Scene& scene);

/// Whether lines are swept in pieces where the scene does not say whether they are.
[[nodiscard]] bool is_cut_unasked(const Scene& scene);

}  // namespace rubatlas::settings
