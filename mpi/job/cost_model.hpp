/// What a point will probably cost, from what others have cost. It decides who computes what, never what is
/// computed.
///
/// The cost of a point depends on its speed ratio far more than on anything else (chaotic motion touches
/// often), and neighbouring lines have similar profiles. So: one profile over the speed ratio, the mean over
/// all lines measured so far, times a factor per line.
#pragma once

#include <cstddef>
#include <vector>

namespace rubatlas::mpi {

class CostModel {
 public:
  explicit CostModel(std::size_t speed_count);

  void record(std::size_t speed_index, double seconds);

  /// Expected seconds of the points [first, last) of an average line. Speeds never met count as the mean of
  /// those met, or as 1 before anything is known.
  [[nodiscard]] double expected(std::size_t first, std::size_t last) const;

  /// All seconds recorded.
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
