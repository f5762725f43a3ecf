/// What has a value for each revolution, where only the first period of a cycle has been observed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace rubatlas::observables {

/// Fills the rest of `values` with its first `observed` ones, again and again.
inline void repeat(std::span<double> values, std::size_t observed) {
  for (std::size_t i = observed; i < values.size(); ++i) values[i] = values[i - observed];
}

}  // namespace rubatlas::observables
