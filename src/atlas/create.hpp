/// A new atlas: all axes, texts and attributes, every dataset at its full size, and no point done.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "atlas/hdf5.hpp"
#include "atlas/output.hpp"
#include "atlas/software.hpp"
#include "plan/part.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

/// What an atlas has besides its rows.
struct AtlasHeader {
  settings::Scene scene;
  std::string scene_text;  ///< the scene file as it was read
  Software software;
  plan::Part part = {};  ///< of the scene's grid; the datasets of a part have the extents of the whole grid
};

/// Creates the atlas of a scene with the serial driver under a temporary name and renames it when it is
/// complete and on the disk: one rank does this before the others open it. `before_it_appears` is called with
/// the temporary name when the file is complete, so that the caller can lock it before it is renamed. Throws
/// EnvironmentError, and OutputRefusal where a file exists that must not be replaced.
void create_atlas(const Output& output, const AtlasHeader& header,
                  const std::function<void(const std::filesystem::path&)>& before_it_appears = {});

enum class RowStorage : std::uint8_t {
  fixed,   ///< each row has its place in the file from the beginning, so that any rank can write it
  packed,  ///< compressed, in chunks: for one process that writes all rows once
};

/// Creates the file of an atlas under this name, replacing what is there: everything but rows and checksum
/// (`seal_header`), both of which the caller has to add.
File create_unsealed(const std::filesystem::path& name, const AtlasHeader& header, RowStorage storage);

}  // namespace rubatlas::atlas
