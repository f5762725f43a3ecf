/// A new atlas: every axis, text and attribute, every dataset at its full size, and no point done.
#pragma once

#include <filesystem>
#include <string>

#include "atlas/software.hpp"
#include "scene/scene.hpp"

namespace rubatlas::atlas {

/// Creates the atlas of a scene with the serial driver under a temporary name and renames it when it is
/// complete and on the disk: one rank does this before the others open it. What stood at `path` is replaced.
/// `scene_text` is the scene file as it was read. Throws EnvironmentError.
void create_atlas(const std::filesystem::path& path, const scene::Scene& scene, const std::string& scene_text,
                  const Software& software);

}  // namespace rubatlas::atlas
