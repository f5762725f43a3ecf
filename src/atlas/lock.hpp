/// Who may use an atlas while it is being filled.
///
/// MPI-IO takes no lock of its own, so the rank that starts the job takes two on the atlas itself, both
/// advisory, both gone with the process however it ends:
///  - a shared `flock`: other readers take the same kind and are welcome, HDF5's own exclusive one (h5py's
///    `r+`) is refused;
///  - an exclusive lock on one byte far behind the file's end, which belongs to this opening of the file
///    (`F_OFD_SETLK`) and which no reader and no MPI-IO asks for: a second run is refused by whatever path,
///    since the lock is on the inode.
///
/// Where the file system knows no such lock, a side file `<atlas>.lock` stands for it: made exclusively, it
/// says host and process, and its time stamp is renewed as long as the run lives. One that nobody has renewed
/// for a while was left behind by a run that was killed, and is taken over. It does not see a second path to
/// the atlas.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace rubatlas::atlas {

class AtlasLock {
 public:
  /// Takes the exclusive lock on an open file; 0, or the system's reason (errno) for refusing.
  using LockCall = int (*)(int descriptor);
  static int lock_byte_behind_the_end(int descriptor);

  /// A side file that was not renewed for so long was left behind.
  static constexpr std::chrono::seconds kLeftBehind{60};

  /// Locks `file`, which is the atlas or is about to get its name. Throws EnvironmentError when another run
  /// holds the lock, or somebody has the file open for writing.
  AtlasLock(const std::filesystem::path& file, const std::filesystem::path& atlas,
            LockCall call = lock_byte_behind_the_end);
  explicit AtlasLock(const std::filesystem::path& atlas) : AtlasLock(atlas, atlas) {}
  AtlasLock(AtlasLock&& other) noexcept;
  AtlasLock& operator=(AtlasLock&& other) noexcept;
  ~AtlasLock();

  /// Goes over to another file that is about to take the atlas' place.
  void move_to(const std::filesystem::path& file);

  /// What the user should know: that a side file has to do; else empty.
  [[nodiscard]] std::string remark() const;
  /// True while the atlas' path leads to the file that is locked.
  [[nodiscard]] bool is_in_place() const;

 private:
  class SideFile;
  [[nodiscard]] int locked(const std::filesystem::path& file);

  std::filesystem::path atlas_;
  LockCall call_;
  std::string no_locks_because_;  ///< before the descriptor, whose making sets it
  int descriptor_ = -1;
  std::unique_ptr<SideFile> side_file_;
};

}  // namespace rubatlas::atlas
