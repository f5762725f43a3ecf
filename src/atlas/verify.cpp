#include "atlas/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "atlas/environment_error.hpp"
#include "atlas/row_block.hpp"

namespace rubatlas::atlas {
namespace {

/// Adds the damaged ones of the finished points of a block.
void find_damage(const AtlasReader& atlas, std::span<const std::uint8_t> status, const PointBlock& block,
                 std::vector<std::size_t>& found) {
  BlockSums sums(block.count);
  const auto add = [&]<typename T>(const std::vector<T>& rows) { sums.add(std::span<const T>(rows)); };
  for (const auto& name : summed_names(atlas)) with_rows(atlas.file().dataset(name), block, add);
  const auto stored =
      atlas.file().dataset("row_checksum").read_block<std::uint32_t>(block.start, block.extent);
  for (std::size_t i = 0; i < block.count; ++i) {
    if (status[block.first + i] != 0 && sums.at(i) != stored[i]) found.push_back(block.first + i);
  }
}

PointBlock one_point(const AtlasReader& atlas, std::size_t point) {
  return block_at(atlas.shape(), point, point + 1, 1);
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
  std::vector<std::size_t> found;
  for_each_block(atlas, 0, status.size(), [&](const PointBlock& block) {
    const auto some = std::span(status).subspan(block.first, block.count);
    if (std::ranges::any_of(some, [](auto code) { return code != 0; }))
      find_damage(atlas, status, block, found);
    return true;
  });
  return found;
}

std::uint32_t stored_checksum(const AtlasReader& atlas, const std::string& dataset, std::size_t point) {
  BlockSums sums(1);
  with_rows(atlas.file().dataset(dataset), one_point(atlas, point),
            [&]<typename T>(const std::vector<T>& row) { sums.add(std::span<const T>(row)); });
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
  find_damage(atlas, atlas.status(), one_point(atlas, point), found);
  refuse(atlas, found);
}

}  // namespace rubatlas::atlas
