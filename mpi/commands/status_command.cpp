#include "mpi/commands/status_command.hpp"

#include <fmt/format.h>

#include "atlas/atlas_reader.hpp"

namespace rubatlas::mpi {

Standing standing_of_atlas(const std::filesystem::path& atlas) {
  return standing_of(atlas::AtlasReader(atlas).status());
}

std::string status_sentence(const std::filesystem::path& atlas, const Standing& standing) {
  std::string text = fmt::format("{}: {} of {} points: {}", atlas.string(), standing.finished, standing.total,
                                 outcomes(standing));
  if (standing.finished < standing.total) {
    text += fmt::format("; {} pending: `rubatlas run SCENE -o {} --resume` computes them",
                        standing.total - standing.finished, atlas.string());
  }
  return text;
}

}  // namespace rubatlas::mpi
