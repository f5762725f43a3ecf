#include "atlas/lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "atlas/environment_error.hpp"

namespace rubatlas::atlas {
namespace {

int open_or_throw(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    throw EnvironmentError(fmt::format("cannot open {}: {}", path.string(), std::strerror(errno)));
  }
  return descriptor;
}

/// False only when somebody else holds the lock.
bool lock(int descriptor, int kind) {
  return ::flock(descriptor, kind | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

/// The holder before us removes the file when it is through: what was locked may be a file without a name.
bool is_still(int descriptor, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

FileLock::FileLock(int descriptor, std::filesystem::path remove_at_end)
    : descriptor_(descriptor), remove_at_end_(std::move(remove_at_end)) {}

FileLock::FileLock(FileLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), remove_at_end_(std::move(other.remove_at_end_)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(remove_at_end_, other.remove_at_end_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  if (!remove_at_end_.empty()) ::unlink(remove_at_end_.c_str());
  ::close(descriptor_);
}

FileLock FileLock::beside(const std::filesystem::path& atlas) {
  const std::filesystem::path path = atlas.string() + ".lock";
  while (true) {
    const int descriptor = open_or_throw(path, O_RDWR | O_CREAT);
    if (!lock(descriptor, LOCK_EX)) {
      ::close(descriptor);
      throw EnvironmentError(fmt::format("another run is filling {}", atlas.string()));
    }
    if (is_still(descriptor, path)) return {descriptor, path};
    ::close(descriptor);
  }
}

FileLock FileLock::shared_on(const std::filesystem::path& atlas) {
  const int descriptor = open_or_throw(atlas, O_RDONLY);
  if (!lock(descriptor, LOCK_SH)) {
    ::close(descriptor);
    throw EnvironmentError(fmt::format("{} is open for writing in another program", atlas.string()));
  }
  return {descriptor, {}};
}

}  // namespace rubatlas::atlas
