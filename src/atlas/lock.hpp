/// Who may use an atlas while it is being filled.
///
/// MPI-IO takes no lock of its own. The rank that starts the job therefore takes two locks on the atlas
/// itself. Both are advisory, and the system removes them when the process ends, however it ends:
///  - a shared `flock`: readers take the same kind of lock and are admitted; the exclusive lock of HDF5
///  (h5py's `r+`) is refused;
///  - an exclusive lock on one byte far behind the file's end, which belongs to this opening of the file
///  (`F_OFD_SETLK`). Neither readers nor MPI-IO ask for it. It refuses a second run by whatever path, since
///  the lock is on the inode.
///
/// On a file system without locks a side file `<atlas>.lock` replaces them. It is created exclusively and
/// contains host and process, and its time stamp is renewed as long as the run goes on. A side file with an
/// old time stamp was left by a run that was killed, and a new run takes it over. The side file does not
/// protect against a second path to the atlas.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace rubatlas::atlas {

class AtlasLock {
 public:
  /// Takes the exclusive lock on an open file. Returns 0, or the reason (errno) for which the system refuses
  /// it.
  using LockCall = int (*)(int descriptor);
  static int lock_byte_behind_the_end(int descriptor);

  /// A side file that has not been renewed for this long was left by a run that was killed.
  static constexpr std::chrono::seconds kLeftBehind{60};

  /// Locks `file`, which is the atlas or is about to get its name. Throws EnvironmentError when another run
  /// holds the lock, or somebody has the file open for writing.
  AtlasLock(const std::filesystem::path& file, const std::filesystem::path& atlas,
            LockCall call = lock_byte_behind_the_end);
  explicit AtlasLock(const std::filesystem::path& atlas) : AtlasLock(atlas, atlas) {}
  AtlasLock(AtlasLock&& other) noexcept;
  AtlasLock& operator=(AtlasLock&& other) noexcept;
  ~AtlasLock();

  /// Locks another file that is about to replace the atlas.
  void move_to(const std::filesystem::path& file);

  /// A sentence for the user where a side file replaces the locks; else empty.
  [[nodiscard]] std::string remark() const;
  /// True while the atlas' path leads to the file that is locked.
  [[nodiscard]] bool is_in_place() const;

 private:
  class SideFile;
  [[nodiscard]] int locked(const std::filesystem::path& file);

  std::filesystem::path atlas_;
  LockCall call_;
  std::string no_locks_because_;  ///< declared before the descriptor, whose initialisation sets it
  int descriptor_ = -1;
  std::unique_ptr<SideFile> side_file_;
};

}  // namespace rubatlas::atlas
