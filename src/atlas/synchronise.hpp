/// What is to survive a power cut has to be brought to the disk, and in what order is ours to say.
#pragma once

#include <filesystem>

namespace rubatlas::atlas {

/// A descriptor of this process on a file that others write too. On a network file system each machine
/// brings its own writes to the disk, so that every rank has one.
class Synchroniser {
 public:
  /// Throws EnvironmentError.
  explicit Synchroniser(std::filesystem::path path);
  ~Synchroniser();
  Synchroniser(const Synchroniser&) = delete;
  Synchroniser& operator=(const Synchroniser&) = delete;

  /// Returns when all that this process has written into the file so far is on the disk. Throws
  /// EnvironmentError where the disk refuses; a file system that knows no such call is taken as it is.
  void synchronise() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// As above, of a directory: the names in it.
void synchronise_directory(const std::filesystem::path& path);

}  // namespace rubatlas::atlas
