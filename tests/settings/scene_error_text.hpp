/// Scenes with one mistake, and what the reader says to them.
#pragma once

#include <string>
#include <string_view>

#include "settings/reader.hpp"

namespace rubatlas::settings {

/// The text with which the reader refuses a scene, or "accepted".
inline std::string refusal(std::string_view text) {
  try {
    parse_scene(text, "scene.json");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

/// The same for a scene that is complete but for what is added to it: `"contact": {...}`.
inline std::string refusal_with(const std::string& addition) {
  return refusal(R"({"grid": {"speed_ratio": 0.5}, )" + addition + "}");
}

/// The same for a grid with one more key, or with another `speed_ratio`.
inline std::string refusal_of_grid(const std::string& content) {
  return refusal(R"({"grid": {)" + content + "}}");
}

}  // namespace rubatlas::settings
