/// Whether a run fits into the memory of this machine.
#pragma once

#include <cstdint>
#include <string>

#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// The memory of a run that grows with the scene.
struct MemoryNeed {
  /// For the first rank in addition [bytes]: what it knows of each point, and of each line.
  static constexpr std::uint64_t kOfPoint = 24;
  static constexpr std::uint64_t kOfLine = 128;

  std::uint64_t of_lines =
      0;                      ///< [bytes] for each rank: rows and records of the lines whose solvers it keeps
  std::uint64_t of_grid = 0;  ///< [bytes] for the first rank in addition: all points and lines of the grid

  [[nodiscard]] double together() const {
    return static_cast<double>(of_lines) + static_cast<double>(of_grid);
  }
};

/// `lines_at_hand`: largest number of solvers that a rank keeps.
MemoryNeed memory_need(const settings::Scene& scene, std::uint64_t lines_at_hand);

/// Memory that this process may have [bytes]: the machine's, or less where its control group or `ulimit -v`
/// allows less.
std::uint64_t memory_of_process();

/// "1.1 MB for records and rows of ...": the parts of which the need consists.
std::string memory_text(const MemoryNeed& need);

}  // namespace rubatlas::mpi
