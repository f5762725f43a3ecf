#include "atlas/free_space.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "atlas/environment_error.hpp"
#include "atlas/output.hpp"

namespace rubatlas::atlas {

std::string readable_bytes(std::uint64_t bytes) {
  constexpr std::array kUnits{"B", "kB", "MB", "GB", "TB", "PB", "EB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < kUnits.size()) {
    value /= 1000.0;
    ++unit;
  }
  return fmt::format("{:.3g} {}", value, kUnits[unit]);
}

void require_space(const std::filesystem::path& path, std::uint64_t bytes, std::string_view made_of,
                   std::uint64_t length) {
  const std::filesystem::path directory = directory_of(path);
  struct statvfs file_system {};
  if (::statvfs(directory.c_str(), &file_system) != 0) {
    throw EnvironmentError(fmt::format("cannot write in {}: {}", directory.string(), std::strerror(errno)));
  }
  const std::string size =
      fmt::format("{}{}", readable_bytes(bytes), made_of.empty() ? "" : fmt::format(" ({})", made_of));
  std::uint64_t room = std::uint64_t{file_system.f_bavail} * file_system.f_frsize;
  struct stat existing {};
  constexpr std::uint64_t kBlock = 512;  // the unit of st_blocks, whatever the file system's own is
  if (::stat(path.c_str(), &existing) == 0) room += static_cast<std::uint64_t>(existing.st_blocks) * kBlock;
  if (bytes > room) {
    throw EnvironmentError(fmt::format("{} will take {}, and {} has room for {}", path.string(), size,
                                       directory.string(), readable_bytes(room)));
  }
  rlimit limit{};
  // Writing beyond this limit raises a signal instead of an error.
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      std::max(bytes, length) > limit.rlim_cur) {
    throw EnvironmentError(
        fmt::format("{} will {}, and this process may write files of up to {} (ulimit -f)", path.string(),
                    length > bytes ? fmt::format("be {} long", readable_bytes(length)) : "take " + size,
                    readable_bytes(limit.rlim_cur)));
  }
}

}  // namespace rubatlas::atlas
