/// A new atlas with the rows of others: parts that become one atlas, or a packed copy.
#pragma once

#include <functional>
#include <span>

#include "atlas/atlas_reader.hpp"
#include "atlas/create.hpp"
#include "atlas/output.hpp"
#include "plan/part.hpp"

namespace rubatlas::atlas {

/// Rows that are copied.
struct RowSource {
  const AtlasReader& atlas;
  plan::PointRange points;
};

/// Throws EnvironmentError, with one sentence, where an atlas has no checksums or where something besides its
/// rows has changed since it was begun.
void require_sound_header(const AtlasReader& atlas);

/// Creates an atlas and copies all finished rows of the sources, which have to be atlases of the same scene.
/// Rows are compared with their checksums as they are copied, and the whole copy is read again and compared
/// before it appears. Needs the memory of a block of rows and of the statuses. A source may be written by a
/// run at the same time: rows that it finishes later are pending in the copy. `go_on` is asked between
/// blocks; where it says no, the result is false and no file has been made. Throws EnvironmentError.
bool copy_atlas(const Output& output, const AtlasHeader& header, RowStorage storage,
                std::span<const RowSource> sources, const std::function<bool()>& go_on);

}  // namespace rubatlas::atlas
