#include "atlas/header_checksum.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include "atlas/environment_error.hpp"
#include "atlas/row_checksum.hpp"

namespace rubatlas::atlas {
namespace {

constexpr std::string_view kMark = "rubatlas header\n";
/// The mark is looked for in this many bytes, which is far more than precede the first dataset.
constexpr std::size_t kSearched = 1 << 16;
constexpr std::size_t kMostRanges = 1000;

struct Range {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;  ///< past the last byte
};

/// HDF5's flags in the file's first block: it sets one while the file is open for writing, and a run that is
/// killed leaves it set. No reader of this format looks at them.
constexpr Range kOpenFlags{20, 24};

/// The values that follow the mark.
struct Block {
  std::uint32_t checksum = 0;
  std::uint32_t count = 0;
};

struct Sealed {
  std::uint64_t place = 0;  ///< of the checksum
  std::uint32_t checksum = 0;
  std::vector<Range> rows;
};

template <typename T>
bool read_into(std::ifstream& file, std::span<T> values) {
  return static_cast<bool>(
      file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size_bytes())));
}

/// The values behind the mark; empty where the file has no mark.
std::optional<Sealed> find_block(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string beginning(kSearched, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  const auto mark = beginning.find(kMark);
  if (mark == std::string::npos) return std::nullopt;
  file.clear();
  Sealed header{.place = mark + kMark.size(), .checksum = 0, .rows = {}};
  file.seekg(static_cast<std::streamoff>(header.place));
  Block block;
  if (!read_into(file, std::span(&block, 1))) return std::nullopt;
  header.checksum = block.checksum;
  header.rows.resize(std::min<std::size_t>(block.count, kMostRanges));
  if (!read_into(file, std::span(header.rows))) return std::nullopt;
  return header;
}

/// CRC-32 over all bytes of a file except the ranges; empty where the file cannot be read.
std::optional<std::uint32_t> checksum_besides(const std::filesystem::path& path,
                                              std::vector<Range> left_out) {
  std::ranges::sort(left_out, {}, &Range::begin);
  std::ifstream file(path, std::ios::binary);
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(file.tellg());
  RowChecksum sum;
  std::vector<char> buffer;
  std::uint64_t at = 0;
  const auto add_until = [&](std::uint64_t end) {
    end = std::min(end, size);
    file.seekg(static_cast<std::streamoff>(at));
    while (at < end) {
      buffer.resize(std::min<std::uint64_t>(end - at, 1 << 20));
      if (!read_into(file, std::span(buffer))) return;
      sum.add(std::span<const char>(buffer));
      at += buffer.size();
    }
  };
  for (const auto& range : left_out) {
    add_until(range.begin);
    at = std::max(at, range.end);
  }
  add_until(size);
  if (!file) return std::nullopt;
  return sum.value();
}

std::optional<std::uint32_t> checksum_of(const std::filesystem::path& path, const Sealed& header) {
  std::vector<Range> left_out = header.rows;
  left_out.push_back(kOpenFlags);
  left_out.push_back({header.place, header.place + sizeof header.checksum});
  return checksum_besides(path, std::move(left_out));
}

/// Where rows may change: nowhere in a packed atlas.
std::vector<Range> rows_of(const std::filesystem::path& path) {
  const File file = File::open_to_read(path);
  std::istringstream names(file.dataset("row_checksum").text("order") + " row_checksum");
  std::vector<Range> found;
  for (std::string name; names >> name;) {
    const Dataset rows = file.dataset(name);
    const auto begin = rows.offset();
    if (!begin) return {};  // packed
    found.push_back({*begin, *begin + rows.size() * rows.number_size()});
  }
  return found;
}

void write_at(const std::filesystem::path& path, std::uint64_t place, const void* data, std::size_t size) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  const bool written = descriptor >= 0 && ::pwrite(descriptor, data, size, static_cast<off_t>(place)) ==
                                              static_cast<ssize_t>(size);
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!written) {
    throw EnvironmentError(fmt::format("{} cannot be written: {}", path.string(), std::strerror(reason)));
  }
}

}  // namespace

void create_header_checksum(Object root, std::size_t row_dataset_count) {
  std::vector<std::uint8_t> bytes(kMark.begin(), kMark.end());
  bytes.resize(kMark.size() + sizeof(Block) + row_dataset_count * sizeof(Range), 0);
  root.set_numbers<std::uint8_t>("header_checksum", bytes);
}

void seal_header(const std::filesystem::path& atlas) {
  auto header = find_block(atlas);
  if (!header)
    throw EnvironmentError(fmt::format("{} does not reach the disk as it was written", atlas.string()));
  header->rows = rows_of(atlas);
  const auto count = static_cast<std::uint32_t>(header->rows.size());
  write_at(atlas, header->place + sizeof header->checksum, &count, sizeof count);
  write_at(atlas, header->place + sizeof(Block), header->rows.data(), header->rows.size() * sizeof(Range));
  const auto sum = checksum_of(atlas, *header);
  if (!sum)
    throw EnvironmentError(fmt::format("{} cannot be read: {}", atlas.string(), std::strerror(errno)));
  write_at(atlas, header->place, &*sum, sizeof *sum);
}

Header header_of(const std::filesystem::path& atlas) {
  const auto header = find_block(atlas);
  if (!header) return Header::without_checksum;
  return checksum_of(atlas, *header) == header->checksum ? Header::sound : Header::damaged;
}

std::string header_damage(const std::filesystem::path& atlas) {
  const auto header = find_block(atlas);
  if (header && checksum_of(atlas, *header) == header->checksum) return {};
  return fmt::format(
      "{} is damaged, or has been changed by another program: something {} is not as it was when it was {}",
      atlas.string(), header && header->rows.empty() ? "in it" : "besides its rows",
      header && header->rows.empty() ? "packed" : "begun");
}

}  // namespace rubatlas::atlas
