/// The median of numbers, of an even number of them the mean of the two in the middle.
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
  return values.size() % 2 == 1 ? *middle : 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace rubatlas::analysis
