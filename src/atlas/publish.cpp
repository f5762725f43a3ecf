#include "atlas/publish.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>
#include <utility>

#include "atlas/environment_error.hpp"
#include "atlas/synchronise.hpp"

namespace rubatlas::atlas {
namespace {

/// Short, so that the name stays within the limit of the file system for any output.
std::filesystem::path random_name(const std::filesystem::path& directory) {
  std::random_device chance;
  return directory / fmt::format(".rubatlas-{:08x}{:08x}.part", chance(), chance());
}

bool is_same_file(int descriptor, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

Publication::Publication(Output output) : output_(std::move(output)) {
  const auto directory = directory_of(output_.path);
  do {
    name_ = random_name(directory);
    descriptor_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) {
    throw EnvironmentError(fmt::format("cannot write {}: {}", output_.path.string(), std::strerror(errno)));
  }
}

Publication::~Publication() {
  if (!name_.empty()) ::unlink(name_.c_str());
  ::close(descriptor_);
}

void Publication::rename_over() const {
  if (std::rename(name_.c_str(), output_.path.c_str()) == 0) return;
  throw EnvironmentError(fmt::format("cannot write {}: {}", output_.path.string(), std::strerror(errno)));
}

void Publication::rename_to_free_name() const {
  if (::renameat2(AT_FDCWD, name_.c_str(), AT_FDCWD, output_.path.c_str(), RENAME_NOREPLACE) == 0) return;
  int reason = errno;
  if (reason == EINVAL ||
      reason == ENOSYS) {  // a file system without that call: a second link, then the first name is removed
    if (::link(name_.c_str(), output_.path.c_str()) == 0) {
      ::unlink(name_.c_str());
      return;
    }
    reason = errno;
    // Without links too a file that appears between the check and the rename is replaced.
    if (reason != EEXIST && !std::filesystem::exists(output_.path)) return rename_over();
  }
  if (reason == EEXIST) {
    throw OutputRefusal(
        fmt::format("{} has been made by another program in the meantime and stays", output_.path.string()));
  }
  throw EnvironmentError(fmt::format("cannot write {}: {}", output_.path.string(), std::strerror(reason)));
}

void Publication::publish() {
  if (!is_same_file(descriptor_, name_)) {
    throw EnvironmentError(fmt::format("cannot write {}: its temporary file {} has been replaced",
                                       output_.path.string(), name_.string()));
  }
  Synchroniser(name_).synchronise();
  if (output_.overwrite) {
    rename_over();
  } else {
    rename_to_free_name();
  }
  name_.clear();
  // The name itself is on the disk only when the directory is.
  synchronise_directory(directory_of(output_.path));
}

void publish_text(const Output& output, const std::string& text) {
  Publication publication(output);
  std::ofstream file(publication.name(), std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    throw EnvironmentError(fmt::format("cannot write {}: {}", output.path.string(), std::strerror(errno)));
  }
  publication.publish();
}

}  // namespace rubatlas::atlas
