/// The expected cost of a point, estimated from the points already computed. It decides which rank computes a
/// point, and has no influence on the result.
///
/// The cost of a point depends on its speed ratio far more than on anything else (chaotic motion touches
/// often), and neighbouring lines have similar profiles. The model is therefore one profile over the speed
/// ratio, the mean over all lines measured so far, times a factor for each line.
#pragma once

#include <cstddef>
#include <vector>

namespace rubatlas::mpi {

class CostModel {
 public:
  explicit CostModel(std::size_t speed_count);

  void record(std::size_t speed_index, double seconds);

  /// Expected seconds of the points [first, last) of an average line. A speed that has not been measured has
  /// the mean cost of the measured speeds, or 1 before any measurement.
  [[nodiscard]] double expected(std::size_t first, std::size_t last) const;

  /// Sum of all recorded seconds.
  [[nodiscard]] double recorded() const { return total_seconds_; }

 private:
  void refresh() const;

  std::vector<double> seconds_;
  std::vector<std::size_t> count_;
  double total_seconds_ = 0.0;
  std::size_t total_count_ = 0;
  mutable std::vector<double> cumulated_;  ///< expected cost of the first i speeds
  mutable bool stale_ = true;
};

}  // namespace rubatlas::mpi
