#include "atlas/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <sstream>

#include "atlas/environment_error.hpp"
#include "atlas/point_index.hpp"
#include "atlas/row_checksum.hpp"

namespace rubatlas::atlas {
namespace {

/// Rows are read in pieces of lines: a row may be a megabyte.
constexpr std::size_t kPointsAtOnce = 256;

/// Checksums of neighbouring points, computed from the rows in the file.
class Sums {
 public:
  Sums(const AtlasReader& atlas, std::size_t first_point, std::size_t count)
      : atlas_(atlas), start_(point_index(atlas.shape(), first_point)), sums_(count) {}

  void add_rows() {
    std::istringstream order(atlas_.file().dataset("row_checksum").text("order"));
    for (std::string name; order >> name;) add(name);
  }

  [[nodiscard]] std::uint32_t at(std::size_t i) const { return sums_[i].value(); }

  [[nodiscard]] std::vector<std::uint32_t> stored() const {
    return block<std::uint32_t>(atlas_.file().dataset("row_checksum"));
  }

  void add(const std::string& name) {
    const Dataset dataset = atlas_.file().dataset(name);
    if (dataset.holds<double>()) return add(block<double>(dataset));
    if (dataset.holds<std::int32_t>()) return add(block<std::int32_t>(dataset));
    if (dataset.holds<std::uint32_t>()) return add(block<std::uint32_t>(dataset));
    add(block<std::uint8_t>(dataset));
  }

 private:
  template <Number T>
  void add(const std::vector<T>& values) {
    const std::size_t size = values.size() / sums_.size();
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].add(std::span(values).subspan(i * size, size));
  }

  template <Number T>
  [[nodiscard]] std::vector<T> block(const Dataset& dataset) const {
    Shape start = start_;
    Shape count = dataset.shape();
    start.resize(count.size(), 0);
    std::fill_n(count.begin(), start_.size() - 1, std::size_t{1});
    count[start_.size() - 1] = sums_.size();
    return dataset.read_block<T>(start, count);
  }

  const AtlasReader& atlas_;
  Shape start_;
  std::vector<RowChecksum> sums_;
};

/// Of `count` points of one line, the damaged ones.
void find_damage(const AtlasReader& atlas, std::span<const std::uint8_t> status, std::size_t first,
                 std::size_t count, std::vector<std::size_t>& found) {
  Sums sums(atlas, first, count);
  sums.add_rows();
  const auto stored = sums.stored();
  for (std::size_t i = 0; i < count; ++i) {
    if (status[first + i] != 0 && sums.at(i) != stored[i]) found.push_back(first + i);
  }
}

void refuse(const AtlasReader& atlas, const std::vector<std::size_t>& damaged) {
  if (damaged.empty()) return;
  throw EnvironmentError(
      fmt::format("{} is damaged: {}{}; rubatlas verify lists what is", atlas.path().string(),
                  damage_of(atlas, damaged.front()),
                  damaged.size() > 1 ? fmt::format(", nor have {} others", damaged.size() - 1) : ""));
}

}  // namespace

std::vector<std::size_t> damaged_rows(const AtlasReader& atlas) {
  // Statuses are read first, because another process may be adding rows, and a row is written before its
  // status.
  const auto status = atlas.status();
  const std::size_t speeds = atlas.speed_count();
  std::vector<std::size_t> found;
  for (std::size_t first = 0; first < status.size();) {
    const std::size_t left_of_line = speeds - first % speeds;
    const std::size_t count = std::min(left_of_line, kPointsAtOnce);
    const auto some = std::span(status).subspan(first, count);
    if (std::ranges::any_of(some, [](auto code) { return code != 0; })) {
      find_damage(atlas, status, first, count, found);
    }
    first += count;
  }
  return found;
}

std::uint32_t stored_checksum(const AtlasReader& atlas, const std::string& dataset, std::size_t point) {
  Sums sums(atlas, point, 1);
  sums.add(dataset);
  return sums.at(0);
}

std::string damage_of(const AtlasReader& atlas, std::size_t point) {
  return fmt::format("the row at {} does not have its checksum", atlas.place_of(point));
}

void require_sound_rows(const AtlasReader& atlas) {
  if (atlas.has_checksums()) refuse(atlas, damaged_rows(atlas));
}

void require_sound_row(const AtlasReader& atlas, std::size_t point) {
  if (!atlas.has_checksums()) return;
  std::vector<std::size_t> found;
  find_damage(atlas, atlas.status(), point, 1, found);
  refuse(atlas, found);
}

}  // namespace rubatlas::atlas
