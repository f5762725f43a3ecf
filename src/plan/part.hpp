/// Part k of n of a grid: consecutive lines, computed by a job of its own into an atlas of its own.
///
/// Lines do not depend on each other, so that the points of a part have the same bits as in a run of the
/// whole grid.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "plan/grid.hpp"

namespace rubatlas::plan {

/// Consecutive points [first, end).
struct PointRange {
  std::size_t first = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t count() const { return end - first; }
};

/// By default the whole grid, which is part 1 of 1.
struct Part {
  std::size_t number = 1;  ///< from 1 to `count`
  std::size_t count = 1;   ///< parts of the grid

  [[nodiscard]] bool is_whole() const { return count == 1; }
  friend bool operator==(const Part&, const Part&) = default;
};

/// Its points in a grid of so many lines of `speeds` points each. The parts of a grid are disjoint and
/// together have all its points; their numbers of lines differ by one at most.
PointRange points_of(const Part& part, std::size_t lines, std::size_t speeds);
PointRange points_of(const Part& part, const Grid& grid);

/// "2/8".
std::string text_of(const Part& part);
/// The inverse; empty where the text is not K/N with K from 1 to N.
std::optional<Part> read_part(std::string_view text);

}  // namespace rubatlas::plan
