/// Who may use an atlas while it is being filled.
///
/// MPI-IO takes no lock of its own, so two are taken by the rank that starts the job, both advisory, both
/// gone with the process however it ends:
///  - a shared one on the atlas: other readers take the same kind and are welcome, HDF5's own exclusive one
///    (h5py's `r+`) is refused;
///  - an exclusive one on a file beside it, `<atlas>.lock`: a second run is refused.
/// On a file system that knows no locks there are none.
#pragma once

#include <filesystem>

namespace rubatlas::atlas {

/// A lock that is held until the object goes.
class FileLock {
 public:
  /// The exclusive lock beside the atlas. Throws EnvironmentError when another run holds it.
  static FileLock beside(const std::filesystem::path& atlas);
  /// The shared lock on the atlas itself. Throws EnvironmentError when somebody has it open for writing.
  static FileLock shared_on(const std::filesystem::path& atlas);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  FileLock(int descriptor, std::filesystem::path remove_at_end);

  int descriptor_ = -1;
  std::filesystem::path remove_at_end_;
};

}  // namespace rubatlas::atlas
