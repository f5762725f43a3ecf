#include "atlas/hdf5_check.hpp"

#include <algorithm>
#include <string_view>

namespace rubatlas::atlas {
namespace {

/// How HDF5 reports a failing system call: "..., errno = 28, error message = 'No space left on device', ...".
constexpr std::string_view kSystemReason = "error message = '";
constexpr std::string_view kTruncated = "truncated file";

herr_t find_reason(unsigned /*depth*/, const H5E_error2_t* error, void* reason) {
  auto& text = *static_cast<std::string*>(reason);
  const std::string_view frame = error->desc == nullptr ? "" : error->desc;
  if (!text.empty()) return 0;
  if (const auto at = frame.find(kSystemReason); at != std::string_view::npos) {
    const auto rest = frame.substr(at + kSystemReason.size());
    text = rest.substr(0, rest.find('\''));
  } else if (frame.find(kTruncated) != std::string_view::npos) {
    text = "the file is cut short";
  }
  return 0;
}

/// A name from HDF5, whose functions return first the length and then the text.
template <typename Name>
std::string name_of(hid_t identifier, const Name& ask) {
  std::string name(1024, '\0');
  const auto length = ask(identifier, name.data(), name.size());
  name.resize(length > 0 ? std::min(name.size() - 1, static_cast<std::size_t>(length)) : 0);
  return name;
}

}  // namespace

void throw_hdf5_failure() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_reason, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw Hdf5Failure(reason.empty() ? "it is damaged, or not as this program writes it" : reason);
}

std::string described(hid_t identifier) {
  const std::string file = name_of(identifier, H5Fget_name);
  const std::string object = name_of(identifier, H5Iget_name);
  H5Eclear2(H5E_DEFAULT);
  return file + ": " + (object.empty() || object == "/" ? "its root" : object);
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
