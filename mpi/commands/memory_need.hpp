/// Does a run fit into the memory of this machine?
#pragma once

#include <cstdint>
#include <string>

#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// What a run keeps in memory, as far as it grows with the scene.
struct MemoryNeed {
  std::uint64_t of_lines = 0;  ///< [bytes] of a rank: rows and records of the lines that it keeps at hand
  std::uint64_t of_grid = 0;   ///< [bytes] of the first rank besides: the state of every point

  [[nodiscard]] double together() const {
    return static_cast<double>(of_lines) + static_cast<double>(of_grid);
  }
};

/// `lines_at_hand`: solvers that a rank keeps at most.
MemoryNeed memory_need(const settings::Scene& scene, std::uint64_t lines_at_hand);

/// Memory that this process may have [bytes]: the machine's, or less where its control group or `ulimit -v`
/// allows less.
std::uint64_t memory_of_process();

/// "100 points × 65.5 MB of rows; ...": how the need comes about.
std::string memory_text(const MemoryNeed& need);

}  // namespace rubatlas::mpi
