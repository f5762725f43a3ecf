#include "atlas/publish.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "atlas/environment_error.hpp"

namespace rubatlas::atlas {
namespace {

void synchronise(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synchronised = file >= 0 && ::fsync(file) == 0;
  const int reason = errno;
  if (file >= 0) ::close(file);
  if (!synchronised) {
    throw EnvironmentError(
        fmt::format("{} does not reach the disk: {}", path.string(), std::strerror(reason)));
  }
}

}  // namespace

std::filesystem::path unpublished_name(const std::filesystem::path& path) {
  return path.string() + ".part";
}

void publish(const std::filesystem::path& path) {
  const auto part = unpublished_name(path);
  synchronise(part);
  if (std::rename(part.c_str(), path.c_str()) != 0) {
    throw EnvironmentError(
        fmt::format("cannot rename {} to {}: {}", part.string(), path.string(), std::strerror(errno)));
  }
  // The name itself is on the disk only when the directory is.
  synchronise(path.has_parent_path() ? path.parent_path() : ".");
}

}  // namespace rubatlas::atlas
