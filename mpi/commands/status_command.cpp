#include "mpi/commands/status_command.hpp"

#include <fmt/format.h>

#include <span>

namespace rubatlas::mpi {

Standing standing_of_atlas(const atlas::AtlasReader& atlas) {
  const auto status = atlas.status();
  const auto [first, end] = atlas.points_of_part();
  return standing_of(std::span(status).subspan(first, end - first));
}

std::string status_sentence(const atlas::AtlasReader& atlas, const Standing& standing) {
  const std::string part =
      atlas.part().is_whole() ? "" : fmt::format(" (part {})", plan::text_of(atlas.part()));
  std::string text = fmt::format("{}{}: {} of {} points: {}", atlas.path().string(), part, standing.finished,
                                 standing.total, outcomes(standing));
  if (standing.finished < standing.total) {
    text += fmt::format("; {} pending: `rubatlas run SCENE -o {} --resume` computes them",
                        standing.total - standing.finished, atlas.path().string());
  }
  return text;
}

}  // namespace rubatlas::mpi
