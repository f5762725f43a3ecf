#include "mpi/commands/unless_stopped.hpp"

#include <fmt/format.h>

#include <optional>

#include "atlas/lock.hpp"
#include "mpi/job/signals.hpp"
#include "mpi/say.hpp"

namespace rubatlas::mpi {

bool copy_unless_stopped(const atlas::Output& output, const atlas::AtlasHeader& header,
                         atlas::RowStorage storage, std::span<const atlas::RowSource> sources) {
  std::optional<atlas::AtlasLock> lock;
  if (output.overwrite) lock.emplace(output.path);
  note_stop_signals();
  if (atlas::copy_atlas(output, header, storage, sources, [] { return !stop_requested(); })) return true;
  say_sentence(fmt::format("stopped; {} has not been written", output.path.string()));
  return false;
}

}  // namespace rubatlas::mpi
