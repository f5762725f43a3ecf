/// The keys of a scene: which are known where, and what may have been meant by one that is not.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace rubatlas::settings {

/// Throws SceneError where a scene is no object, a section is none, or a key is not known; values are not
/// looked at.
void check_structure(const nlohmann::json& document);

}  // namespace rubatlas::settings
