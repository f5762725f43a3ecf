#include "mpi/commands/pack_command.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <cstdint>

#include "atlas/atlas_reader.hpp"
#include "atlas/copy.hpp"
#include "atlas/free_space.hpp"
#include "mpi/commands/status_command.hpp"
#include "mpi/commands/unless_stopped.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/say.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {
namespace {

/// What a file occupies on the disk [bytes], without its holes.
std::uint64_t bytes_on_disk(const std::filesystem::path& path) {
  struct stat file {};
  constexpr std::uint64_t kBlock = 512;  // the unit of st_blocks
  return ::stat(path.c_str(), &file) == 0 ? static_cast<std::uint64_t>(file.st_blocks) * kBlock : 0;
}

}  // namespace

int pack(const PackCommand& command) {
  const auto output = atlas::permitted(
      {command.output, atlas::FileKind::atlas, atlas::existing(command.overwrite)}, {command.atlas});
  const atlas::AtlasReader loose(command.atlas);
  atlas::require_sound_header(loose);
  const std::uint64_t before = bytes_on_disk(command.atlas);
  atlas::require_space(output.path, before);
  const atlas::AtlasHeader header{settings::parse_scene(loose.scene_resolved(), "/scene_resolved"),
                                  loose.scene(), atlas::software_of(loose.file()), loose.part()};
  const std::array<atlas::RowSource, 1> source{{{loose, loose.points_of_part()}}};
  if (!copy_unless_stopped(output, header, atlas::RowStorage::packed, source)) return exit_code::kInterrupted;

  const std::uint64_t after = bytes_on_disk(output.path);
  const Standing standing = standing_of_atlas(atlas::AtlasReader(output.path));
  print(fmt::format(
      "{}: {} ({:.0f} % of the {} of {}); all rows of its {} finished points have their checksum\n",
      output.path.string(), atlas::readable_bytes(after),
      100.0 * static_cast<double>(after) / static_cast<double>(before), atlas::readable_bytes(before),
      command.atlas.string(), standing.finished));
  return exit_code::kDone;
}

}  // namespace rubatlas::mpi
