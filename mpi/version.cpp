#include "mpi/version.hpp"

#include <fmt/format.h>

#include "mpi/build_info.hpp"

namespace rubatlas::mpi {

const atlas::Software& software() {
  static const atlas::Software build{.software_version = build_info::kVersion,
                                     .git_commit = build_info::kGitCommit,
                                     .compiler = build_info::kCompiler};
  return build;
}

std::string version_text() {
  return fmt::format("rubatlas {}\ncommit    {}\ncompiler  {}\nlibraries {}\n", build_info::kVersion,
                     build_info::kGitCommit, build_info::kCompiler, build_info::kLibraries);
}

}  // namespace rubatlas::mpi
