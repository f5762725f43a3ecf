/// Forces files to the disk, in an order that the program decides: without this call a file need not survive
/// a power cut.
#pragma once

#include <filesystem>

namespace rubatlas::atlas {

/// A descriptor of this process on a file that other processes write too. On a network file system each
/// machine has to force its own writes to the disk; therefore every rank has a descriptor.
class Synchroniser {
 public:
  /// Throws EnvironmentError.
  explicit Synchroniser(std::filesystem::path path);
  ~Synchroniser();
  Synchroniser(const Synchroniser&) = delete;
  Synchroniser& operator=(const Synchroniser&) = delete;

  /// Returns when everything that this process has written into the file so far is on the disk. Throws
  /// EnvironmentError where the disk refuses. A file system without such a call is no error.
  void synchronise() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// The same for a directory, that is, for the names in it.
void synchronise_directory(const std::filesystem::path& path);

}  // namespace rubatlas::atlas
