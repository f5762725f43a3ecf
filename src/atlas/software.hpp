/// Which build wrote a file; becomes root attributes of the same names.
#pragma once

#include <string>

#include "atlas/hdf5.hpp"
#include "atlas/output.hpp"

namespace rubatlas::atlas {

struct Software {
  std::string software = "rubatlas";
  std::string software_version;
  std::string git_commit;
  std::string compiler;
};

/// Version of the layout that this folder's README describes.
constexpr const char* kSchemaVersion = "2";
/// Atlases of the version without checksums: they are read, but no run goes on with them.
constexpr const char* kVersionWithoutChecksums = "1";

/// Writes `Conventions`, `schema_version`, what the file is and the build on the root of a new file. Any file
/// of this project (atlas, maps, orbit, accuracy) opens with them.
void write_provenance(Object root, const Software& software, FileKind kind, const std::string& title);

}  // namespace rubatlas::atlas
