/// The expected cost of a point, estimated from the points already computed. It decides which rank computes a
/// point, and has no influence on the result.
///
/// The cost of a point depends on its speed ratio far more than on anything else (chaotic motion touches
/// often), and neighbouring lines have similar profiles. The model is therefore one profile over the speed
/// ratio, the mean over all points measured so far in each of up to 64 stretches of speeds, and interpolated
/// between these.
#pragma once

#include <cstddef>
#include <vector>

namespace rubatlas::mpi {

class CostModel {
 public:
  explicit CostModel(std::size_t speed_count);

  void record(std::size_t speed_index, double seconds);
  /// A measurement made before the job, of a point on some line.
  void assume(std::size_t speed_index, double seconds);

  /// Expected seconds of the points [first, last) of an average line. A stretch in which nothing has been
  /// measured has a cost between those of the nearest measured stretches on both sides, or that of the only
  /// one; 1 a point before any measurement.
  [[nodiscard]] double expected(std::size_t first, std::size_t last) const;

  /// Sum of all recorded seconds.
  [[nodiscard]] double recorded() const { return total_seconds_; }

 private:
  void refresh() const;
  [[nodiscard]] double up_to(std::size_t speed_index) const;

  struct Stretch {
    double seconds = 0.0;  ///< of the points measured
    std::size_t count = 0;
    double mean = 1.0;       ///< expected seconds of a point
    double cumulated = 0.0;  ///< expected seconds of all speeds below the stretch
  };
  std::size_t width_;  ///< speeds of a stretch
  mutable std::vector<Stretch> stretches_;
  double total_seconds_ = 0.0;
  mutable bool stale_ = true;
};

}  // namespace rubatlas::mpi
