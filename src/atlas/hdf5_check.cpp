#include "atlas/hdf5_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "atlas/environment_error.hpp"

namespace rubatlas::atlas {
namespace {

/// Walking upward ends at the outermost frame; the first frame with a text is the reason.
herr_t keep_innermost(unsigned /*depth*/, const H5E_error2_t* error, void* reason) {
  auto& text = *static_cast<std::string*>(reason);
  if (text.empty() && error->desc != nullptr) text = error->desc;
  return 0;
}

/// The path below the source tree: a message does not depend on where the program was built.
std::string_view below_source_tree(std::string_view file) {
  const auto at = file.rfind("src/");
  return at == std::string_view::npos ? file : file.substr(at);
}

}  // namespace

void throw_hdf5_error(const char* expression, const char* file, int line) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  if (reason.empty()) reason = "no reason given";
  std::replace(reason.begin(), reason.end(), '\n', ' ');  // some of its texts hold a date with a line's end
  throw EnvironmentError(
      fmt::format("HDF5: {} ({} at {}:{})", reason, expression, below_source_tree(file), line));
}

void prepare_hdf5() {
  static const bool prepared = [] {
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  static_cast<void>(prepared);
}

}  // namespace rubatlas::atlas
