/// A new atlas: all axes, texts and attributes, every dataset at its full size, and no point done.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "atlas/output.hpp"
#include "atlas/software.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

/// Creates the atlas of a scene with the serial driver under a temporary name and renames it when it is
/// complete and on the disk: one rank does this before the others open it. `scene_text` is the scene file as
/// it was read. `before_it_appears` is called with the temporary name when the file is complete, so that the
/// caller can lock it before it is renamed. Throws EnvironmentError, and OutputRefusal where a file exists
/// that must not be replaced.
void create_atlas(const Output& output, const settings::Scene& scene, const std::string& scene_text,
                  const Software& software,
                  const std::function<void(const std::filesystem::path&)>& before_it_appears = {});

}  // namespace rubatlas::atlas
