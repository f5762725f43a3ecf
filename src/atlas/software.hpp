/// Which build wrote a file; becomes root attributes of the same names.
#pragma once

#include <string>

#include "atlas/hdf5.hpp"
#include "atlas/output.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

struct Software {
  std::string software = "rubatlas";
  std::string software_version;
  std::string git_commit;
  std::string compiler;

  friend bool operator==(const Software&, const Software&) = default;
};

/// Version of the file layout described in datasets.md.
constexpr const char* kSchemaVersion = "5";
/// The same layout, of programs that cut no line unasked.
constexpr const char* kVersionOfWholeLines = "4";
/// The layout without `/settled`, of programs whose motions settled never.
constexpr const char* kVersionWithoutSettled = "3";
/// The same layout, of programs whose default method was `hybrid`.
constexpr const char* kVersionOfHybrid = "2";
/// The layout without checksums: such atlases are read, but not resumed.
constexpr const char* kVersionWithoutChecksums = "1";
/// Version of the layout of maps and edges (analysis/maps.md). In version 3 margins and columns had the names
/// of axes.
constexpr const char* kMapsSchemaVersion = "6";

/// Writes `Conventions`, `schema_version`, the kind of the file, what names it (`title`, `creator`,
/// `license`) and the build as root attributes of a new file. Every file of this project (atlas, maps, orbit,
/// accuracy) has them.
void write_provenance(Object root, const Software& software, FileKind kind, const settings::Scene& scene);
/// The build that began a file. Throws EnvironmentError.
Software software_of(const File& file);

}  // namespace rubatlas::atlas
