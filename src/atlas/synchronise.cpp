#include "atlas/synchronise.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "atlas/environment_error.hpp"

namespace rubatlas::atlas {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int reason) {
  throw EnvironmentError(fmt::format("{} does not reach the disk: {}", path.string(), std::strerror(reason)));
}

/// Errors by which a file system says that it has no such call.
bool knows_no_such_call(int reason) {
  return reason == EINVAL || reason == ENOSYS || reason == EOPNOTSUPP || reason == EROFS;
}

}  // namespace

Synchroniser::Synchroniser(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDWR | O_CLOEXEC)) {
  if (descriptor_ < 0) refuse(path_, errno);
}

Synchroniser::~Synchroniser() {
  ::close(descriptor_);
}

void Synchroniser::synchronise() const {
  while (::fdatasync(descriptor_) != 0) {
    const int reason = errno;
    if (reason == EINTR) continue;
    if (knows_no_such_call(reason)) return;
    refuse(path_, reason);
  }
}

void synchronise_directory(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) refuse(path, errno);
  const int reason = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (reason != 0 && !knows_no_such_call(reason)) refuse(path, reason);
}

}  // namespace rubatlas::atlas
