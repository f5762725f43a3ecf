/// From a scene's text to a `Scene`. No other part of the program reads a scene's JSON.
///
/// Every mistake (unknown key, wrong type, value out of range, empty grid) is one `SceneError` whose text has
/// the JSON pointer, the value found, what is allowed and, for a key, the nearest known one:
///   /contact/friction: -0.1 is outside [0, 2]; Coulomb coefficient between blade tip and ring
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// A mistake in a scene: the program reports it in one sentence and ends with exit code 2.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses and checks a scene. `name` stands for the file in messages. Throws SceneError.
Scene parse_scene(std::string_view text, std::string_view name = "scene");

/// The scene with every default filled in and every axis written out, as JSON text in one canonical form
/// (sorted keys, shortest round-trip numbers): equal scenes give equal bytes. `parse_scene` reads it back.
std::string resolved_json(const Scene& scene);

/// The same without what names the atlas and says nothing of its motions: title, reference, creator, license.
std::string motion_json(const Scene& scene);

/// The resolved text of a program that cut no line unasked, as this one would write it. Before it knew
/// `/protocol/settle` its motions never settled.
std::string of_older_program(std::string_view resolved, bool knew_settle);

/// Empty when two resolved texts describe the same motions, whatever names their atlases, else one sentence
/// that names the first differing pointer and both values.
std::string difference(std::string_view resolved_a, std::string_view resolved_b);

}  // namespace rubatlas::settings
