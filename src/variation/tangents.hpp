/// Small differences of the state and what becomes of them.
#pragma once

#include <Eigen/Core>

namespace rubatlas::variation {

/// δ(q, q') at the end against that at the start, column by column: 4 × 4, or 8 × 8 where the ring is a body.
inline constexpr int kMostCoordinates = 4;
using Tangents = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2 * kMostCoordinates,
                               2 * kMostCoordinates>;

}  // namespace rubatlas::variation
