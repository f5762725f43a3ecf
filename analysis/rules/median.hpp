/// The median of numbers, of an even number of them the upper of the two in the middle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "analysis/rules/line.hpp"

namespace rubatlas::analysis {

/// NaN where there are none.
[[nodiscard]] inline double median(std::vector<double> values) {
  if (values.empty()) return kNotANumber;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace rubatlas::analysis
