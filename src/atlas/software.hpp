/// Which build wrote a file; becomes root attributes of the same names.
#pragma once

#include <string>

#include "atlas/hdf5.hpp"

namespace rubatlas::atlas {

struct Software {
  std::string software = "rubatlas";
  std::string software_version;
  std::string git_commit;
  std::string compiler;
};

/// Version of the layout that this folder's README describes; a reader that meets another one says so.
constexpr const char* kSchemaVersion = "1";

/// Writes `Conventions`, `schema_version` and the build on the root of a new file. Any file of this project
/// (atlas, maps, orbit, accuracy) opens with them.
void write_provenance(Object root, const Software& software, const std::string& title);

}  // namespace rubatlas::atlas
