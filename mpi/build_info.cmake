# Writes build_info.hpp. Run at every build, not at configuration: the commit changes in between. The file is touched
# only when its text changes, so that nothing is compiled twice for the same commit.
execute_process(COMMAND git -C ${SOURCE} rev-parse HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
else()
  execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no
                  OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(changes)
    string(APPEND commit "-modified")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#pragma once
namespace rubatlas::mpi::build_info {
constexpr const char* kVersion = "@VERSION@";
constexpr const char* kGitCommit = "@commit@";
constexpr const char* kCompiler = "@COMPILER@";
constexpr const char* kLibraries = "@LIBRARIES@";
}  // namespace rubatlas::mpi::build_info
]])
