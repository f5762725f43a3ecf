#include "mpi/commands/memory_need.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "atlas/atlas_writer.hpp"
#include "atlas/free_space.hpp"
#include "atlas/schema.hpp"
#include "plan/grid.hpp"
#include "plan/pieces.hpp"

namespace rubatlas::mpi {
namespace {

/// Samples of the signals and their transforms, each of half as many complex numbers [bytes].
std::uint64_t record_bytes(const settings::Scene& scene) {
  const auto samples = static_cast<std::uint64_t>(scene.protocol.sampled_revolutions) *
                       static_cast<std::uint64_t>(scene.protocol.samples_per_revolution);
  return 2 * sizeof(double) * samples * static_cast<std::uint64_t>(scene.transformed_signals());
}

}  // namespace

MemoryNeed memory_need(const settings::Scene& scene, std::uint64_t lines_at_hand) {
  const plan::Grid grid(scene);
  const atlas::Schema schema = atlas::schema_of(scene);
  const std::uint64_t lines =
      std::min<std::uint64_t>(lines_at_hand, grid.points_depend_on_each_other() ? grid.line_count() : 1);
  MemoryNeed need;
  // A row is computed and then kept until it is written. Small rows are gathered, and copied when written.
  need.of_lines = lines * (record_bytes(scene) + 2 * schema.bytes_per_point()) +
                  2 * std::uint64_t{atlas::AtlasWriter::kMostGathered};
  // Rows of a line that are held until its seams are decided.
  if (plan::Pieces(scene).per_line() > 1) need.of_lines += grid.speed_count() * schema.bytes_per_point();
  need.of_grid = grid.point_count() * MemoryNeed::kOfPoint + grid.line_count() * MemoryNeed::kOfLine;
  return need;
}

std::uint64_t memory_of_process() {
  auto bytes =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  for (const char* const limit :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::uint64_t allowed = 0;
    if (std::ifstream(limit) >> allowed)
      bytes = std::min(bytes, allowed);  // reading fails for the word "max", which means no limit
  }
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    bytes = std::min<std::uint64_t>(bytes, limit.rlim_cur);
  }
  return bytes;
}

std::string memory_text(const MemoryNeed& need) {
  return fmt::format(
      "{} for records and rows of the lines that a rank has at hand; in the first rank {} for the grid ({} "
      "bytes a point, {} a line)",
      atlas::readable_bytes(need.of_lines), atlas::readable_bytes(need.of_grid), MemoryNeed::kOfPoint,
      MemoryNeed::kOfLine);
}

}  // namespace rubatlas::mpi
