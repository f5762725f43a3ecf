#include "atlas/copy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "atlas/environment_error.hpp"
#include "atlas/header_checksum.hpp"
#include "atlas/publish.hpp"
#include "atlas/row_block.hpp"
#include "atlas/verify.hpp"

namespace rubatlas::atlas {
namespace {

template <Number T>
void write_rows(File& file, const std::string& name, const PointBlock& block, std::span<const T> rows) {
  Dataset dataset = file.dataset(name);
  const auto [start, count] = place_in(dataset, block);
  dataset.write_block<T>(start, count, rows);
}

void copy_block(const AtlasReader& atlas, const PointBlock& block, std::span<const std::uint8_t> status,
                File& file) {
  BlockSums sums(block.count);
  for (const auto& name : summed_names(atlas)) {
    const auto copy = [&]<typename T>(std::span<const T> rows) {
      sums.add(rows);
      write_rows(file, name, block, rows);
    };
    if (name == "status") {
      copy(status);
    } else {
      with_rows(atlas.file().dataset(name), block,
                [&]<typename T>(const std::vector<T>& rows) { copy(std::span<const T>(rows)); });
    }
  }
  const auto stored =
      atlas.file().dataset("row_checksum").read_block<std::uint32_t>(block.start, block.extent);
  for (std::size_t i = 0; i < block.count; ++i) {
    if (status[i] != 0 && sums.at(i) != stored[i]) {
      throw EnvironmentError(fmt::format("{} is damaged: {}; rubatlas verify lists what is",
                                         atlas.path().string(), damage_of(atlas, block.first + i)));
    }
  }
  write_rows<std::uint32_t>(file, "row_checksum", block, stored);
}

bool copy_rows(const RowSource& source, File& file, const std::function<bool()>& go_on) {
  // Read first: the rows of these statuses are complete, whatever a run adds in the meantime.
  const auto status = source.atlas.status();
  return for_each_block(source.atlas, source.points.first, source.points.end, [&](const PointBlock& block) {
    const auto some = std::span(status).subspan(block.first, block.count);
    if (std::ranges::any_of(some, [](auto code) { return code != 0; }))
      copy_block(source.atlas, block, some, file);
    return go_on();
  });
}

void require_sound_copy(const std::filesystem::path& copy, const std::filesystem::path& output) {
  if (header_of(copy) == Header::sound && damaged_rows(AtlasReader(copy)).empty()) return;
  throw EnvironmentError(
      fmt::format("what has been written for {} is not what is read from the disk; no file has been made",
                  output.string()));
}

}  // namespace

void require_sound_header(const AtlasReader& atlas) {
  if (!atlas.has_checksums()) {
    throw EnvironmentError(fmt::format(
        "{} was begun by a version whose rows have no checksums: it can be read, or begun anew with run "
        "--overwrite, but neither resumed nor merged nor packed",
        atlas.path().string()));
  }
  if (const std::string damage = header_damage(atlas.path()); !damage.empty()) throw EnvironmentError(damage);
}

bool copy_atlas(const Output& output, const AtlasHeader& header, RowStorage storage,
                std::span<const RowSource> sources, const std::function<bool()>& go_on) {
  Publication publication(output);
  File file = create_unsealed(publication.name(), header, storage);
  for (const auto& source : sources) {
    if (!copy_rows(source, file, go_on)) return false;
  }
  file.close();
  seal_header(publication.name());
  require_sound_copy(publication.name(), output.path);
  publication.publish();
  return true;
}

}  // namespace rubatlas::atlas
