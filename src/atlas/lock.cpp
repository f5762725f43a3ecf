#include "atlas/lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <fstream>
#include <mutex>
#include <random>
#include <stop_token>
#include <thread>
#include <utility>

#include "atlas/environment_error.hpp"

namespace rubatlas::atlas {
namespace {

using std::chrono::seconds;

constexpr seconds kBeat{5};
/// Two runs may take over the same side file at once. The last one to replace it has the lock. Each therefore
/// waits for this long, and then checks that the file is still its own.
constexpr seconds kSettling{1};

struct Inode {
  dev_t device = 0;
  ino_t number = 0;
  bool operator==(const Inode&) const = default;
};

std::optional<Inode> inode_of(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return std::nullopt;
  return Inode{status.st_dev, status.st_ino};
}

std::optional<Inode> inode_of(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return Inode{status.st_dev, status.st_ino};
}

std::string host_name() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

}  // namespace

/// `<atlas>.lock`, for file systems without locks.
class AtlasLock::SideFile {
 public:
  explicit SideFile(const std::filesystem::path& atlas) : path_(atlas.string() + ".lock") {
    if (!make(path_)) take_over(atlas);
    beat_ = std::jthread([this](const std::stop_token& stop) { renew(stop); });
  }
  ~SideFile() {
    beat_.request_stop();
    if (beat_.joinable()) beat_.join();
    if (inode_of(path_) == mine_) ::unlink(path_.c_str());
  }
  SideFile(const SideFile&) = delete;
  SideFile& operator=(const SideFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  /// False where there is a file of that name.
  bool make(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == EEXIST) return false;
    const std::string owner = fmt::format("host {}, process {}\n", host_name(), ::getpid());
    const bool written =
        descriptor >= 0 && ::write(descriptor, owner.data(), owner.size()) == std::ssize(owner);
    const int reason = errno;
    if (descriptor >= 0) {
      mine_ = inode_of(descriptor);
      ::close(descriptor);
    }
    if (!written) {
      throw EnvironmentError(fmt::format("cannot write {}: {}", path.string(), std::strerror(reason)));
    }
    return true;
  }

  /// Time stamps come from the clock of the file system, which is read from a file made now.
  void take_over(const std::filesystem::path& atlas) {
    std::random_device chance;
    const std::filesystem::path candidate = fmt::format("{}-{:08x}", path_.string(), chance());
    if (!make(candidate)) throw EnvironmentError(fmt::format("cannot write {}", candidate.string()));
    std::error_code gone;  // the holder may be through in this moment: then its file is as old as can be
    const auto renewed = std::filesystem::last_write_time(path_, gone);
    const auto silence =
        std::chrono::duration_cast<seconds>(std::filesystem::last_write_time(candidate) - renewed);
    if (!gone && silence < kLeftBehind) {
      ::unlink(candidate.c_str());
      throw EnvironmentError(
          fmt::format("another run is filling {}: {} says {}, renewed {} s ago; after {} s without a renewal "
                      "it counts as left behind",
                      atlas.string(), path_.string(), owner(), silence.count(), kLeftBehind.count()));
    }
    std::filesystem::rename(candidate, path_);
    std::this_thread::sleep_for(kSettling);
    if (inode_of(path_) != mine_) {
      throw EnvironmentError(
          fmt::format("another run is filling {}: {} says {}", atlas.string(), path_.string(), owner()));
    }
  }

  [[nodiscard]] std::string owner() const {
    std::ifstream file(path_);
    std::string line;
    std::getline(file, line);
    return line.empty() ? "nothing" : line;
  }

  /// Renews the time stamp. Another run may nevertheless take the file over, if this machine was suspended
  /// for longer than the limit.
  void renew(const std::stop_token& stop) const {
    sigset_t all;  // signals are the main thread's
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    std::mutex mutex;
    std::condition_variable_any wait;
    std::unique_lock<std::mutex> hold(mutex);
    while (!wait.wait_for(hold, stop, kBeat, [&] { return stop.stop_requested(); })) {
      if (inode_of(path_) == mine_) ::utimensat(AT_FDCWD, path_.c_str(), nullptr, 0);
    }
  }

  std::filesystem::path path_;
  std::optional<Inode> mine_;
  std::jthread beat_;
};

int AtlasLock::lock_byte_behind_the_end(int descriptor) {
  struct flock byte {};
  byte.l_type = F_WRLCK;
  byte.l_whence = SEEK_SET;
  byte.l_start = off_t{1} << 62;
  byte.l_len = 1;
  return ::fcntl(descriptor, F_OFD_SETLK, &byte) == 0 ? 0 : errno;
}

/// A descriptor that holds the locks. Another run may replace the file between opening and locking; the path
/// is therefore compared with the locked file afterwards.
int AtlasLock::locked(const std::filesystem::path& file) {
  while (true) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0) {
      throw EnvironmentError(fmt::format("cannot open {}: {}", atlas_.string(), std::strerror(errno)));
    }
    const int reason = call_(descriptor);
    const bool other_run = reason == EAGAIN || reason == EACCES;
    const bool other_writer = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!other_run && !other_writer && inode_of(file) == inode_of(descriptor)) {
      if (reason != 0) no_locks_because_ = std::strerror(reason);
      return descriptor;
    }
    ::close(descriptor);
    if (other_run) throw EnvironmentError(fmt::format("another run is filling {}", atlas_.string()));
    if (other_writer) {
      throw EnvironmentError(fmt::format("{} is open for writing in another program", atlas_.string()));
    }
  }
}

AtlasLock::AtlasLock(const std::filesystem::path& file, const std::filesystem::path& atlas, LockCall call)
    : atlas_(atlas), call_(call), descriptor_(locked(file)) {
  if (no_locks_because_.empty()) return;
  try {
    side_file_ = std::make_unique<SideFile>(atlas);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

void AtlasLock::move_to(const std::filesystem::path& file) {
  ::close(std::exchange(descriptor_, locked(file)));
}

AtlasLock::AtlasLock(AtlasLock&& other) noexcept
    : atlas_(std::move(other.atlas_)),
      call_(other.call_),
      no_locks_because_(std::move(other.no_locks_because_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      side_file_(std::move(other.side_file_)) {}

AtlasLock& AtlasLock::operator=(AtlasLock&& other) noexcept {
  std::swap(atlas_, other.atlas_);
  std::swap(call_, other.call_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(no_locks_because_, other.no_locks_because_);
  std::swap(side_file_, other.side_file_);
  return *this;
}

AtlasLock::~AtlasLock() {
  side_file_.reset();
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string AtlasLock::remark() const {
  if (!side_file_) return {};
  return fmt::format("the file system of {} takes no lock ({}); {} keeps a second run out instead",
                     atlas_.string(), no_locks_because_, side_file_->path().string());
}

bool AtlasLock::is_in_place() const {
  return inode_of(atlas_) == inode_of(descriptor_);
}

}  // namespace rubatlas::atlas
