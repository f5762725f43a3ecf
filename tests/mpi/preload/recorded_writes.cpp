// Preloaded into the program: keeps what it writes into one file, and when it brings that to the disk, in a
// log of each process, so that a test can say what a power cut would have left.
//
//   RECORDED_FILE  the file's name (its last part)       RECORDED_LOG  the log is <this>.<process>
//
// An entry: int64 offset (−1: brought to the disk), int64 length, then so many bytes. Native byte order.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

bool is_recorded(int descriptor) {
  const char* wanted = std::getenv("RECORDED_FILE");
  if (wanted == nullptr) return false;
  std::array<char, 4096> path{};
  const auto link = "/proc/self/fd/" + std::to_string(descriptor);
  const auto length = ::readlink(link.c_str(), path.data(), path.size());
  if (length <= 0) return false;
  const std::string_view opened(path.data(), static_cast<std::size_t>(length));
  return opened.ends_with(std::string("/") + wanted);
}

template <typename Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

void keep(std::int64_t offset, const void* data, std::int64_t length) {
  using Write = ssize_t (*)(int, const void*, std::size_t);
  static const auto write_next = next<Write>("write");
  static const int log =
      ::open((std::string(std::getenv("RECORDED_LOG")) + "." + std::to_string(::getpid())).c_str(),
             O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const std::array<std::int64_t, 2> head{offset, length};
  write_next(log, head.data(), sizeof head);
  if (length > 0) write_next(log, data, static_cast<std::size_t>(length));
}

}  // namespace

extern "C" {

ssize_t pwrite64(int descriptor, const void* data, std::size_t length, off64_t offset) {
  static const auto call = next<ssize_t (*)(int, const void*, std::size_t, off64_t)>("pwrite64");
  const ssize_t written = call(descriptor, data, length, offset);
  if (written > 0 && is_recorded(descriptor)) keep(offset, data, written);
  return written;
}

ssize_t pwrite(int descriptor, const void* data, std::size_t length, off_t offset) {
  return pwrite64(descriptor, data, length, offset);
}

ssize_t pwritev64(int descriptor, const iovec* pieces, int count, off64_t offset) {
  ssize_t sum = 0;
  for (int i = 0; i < count; ++i) {
    const ssize_t written = pwrite64(descriptor, pieces[i].iov_base, pieces[i].iov_len, offset + sum);
    if (written < 0) return written;
    sum += written;
  }
  return sum;
}

ssize_t pwritev(int descriptor, const iovec* pieces, int count, off_t offset) {
  return pwritev64(descriptor, pieces, count, offset);
}

ssize_t write(int descriptor, const void* data, std::size_t length) {
  static const auto call = next<ssize_t (*)(int, const void*, std::size_t)>("write");
  if (!is_recorded(descriptor)) return call(descriptor, data, length);
  const off_t offset = ::lseek(descriptor, 0, SEEK_CUR);
  const ssize_t written = call(descriptor, data, length);
  if (written > 0) keep(offset, data, written);
  return written;
}

int fdatasync(int descriptor) {
  static const auto call = next<int (*)(int)>("fdatasync");
  const int result = call(descriptor);
  if (result == 0 && is_recorded(descriptor)) keep(-1, nullptr, 0);
  return result;
}

int fsync(int descriptor) {
  static const auto call = next<int (*)(int)>("fsync");
  const int result = call(descriptor);
  if (result == 0 && is_recorded(descriptor)) keep(-1, nullptr, 0);
  return result;
}

}  // extern "C"
