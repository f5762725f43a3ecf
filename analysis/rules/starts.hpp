/// Points of an atlas that differ in nothing but where they start: in the initial state, or in the direction
/// of the sweep that leads to them.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "plan/grid.hpp"

namespace rubatlas::analysis {

/// An axis along which only the start of a point changes: `direction`, or one of the initial state.
[[nodiscard]] bool is_start_axis(std::string_view name);
[[nodiscard]] bool is_initial_axis(std::string_view name);

/// The points of an atlas in sets: those of one set have all parameters in common.
class Starts {
 public:
  explicit Starts(std::span<const plan::Axis> axes);

  /// True where the sets have more than one point.
  [[nodiscard]] bool several() const { return per_set_ > 1; }
  [[nodiscard]] std::size_t set_count() const { return sets_; }
  /// Number of a point's set; sets are numbered in C order over the axes that are not starts.
  [[nodiscard]] std::size_t set_of(std::size_t point) const;
  /// Places of the axes that are not starts.
  [[nodiscard]] const std::vector<std::size_t>& parameter_axes() const { return parameter_axes_; }

 private:
  std::vector<std::size_t> extents_;
  std::vector<bool> is_start_;
  std::vector<std::size_t> parameter_axes_;
  std::size_t sets_ = 1;
  std::size_t per_set_ = 1;
};

}  // namespace rubatlas::analysis
