/// Equally spaced times of the sampled revolutions, as they fall into the pieces of the motion.
#pragma once

#include <algorithm>
#include <cstddef>

#include "trajectory/motion_piece.hpp"

namespace rubatlas::observables {

class SampleCursor {
 public:
  explicit SampleCursor(int samples_per_revolution) : samples_per_revolution_(samples_per_revolution) {}

  void begin(const trajectory::PointConstants& point) {
    period_ = point.period;
    sample_ = 0;
    filled_ = 0;
  }
  void speed_changes(const trajectory::PointConstants& point) { period_ = point.period; }
  void revolution_ends() { sample_ = 0; }
  /// Samples so far.
  [[nodiscard]] std::size_t filled() const { return filled_; }

  /// The times of a piece.
  struct Stretch {
    trajectory::SampleTimes times;
    int first;           ///< number of the first of them within the revolution
    std::size_t before;  ///< samples of all revolutions before it
    std::size_t count;
  };
  /// Those of the next piece.
  [[nodiscard]] Stretch next(const trajectory::MotionPiece& piece) {
    const trajectory::SampleTimes times{period_, samples_per_revolution_};
    const int after = std::max(sample_, first_from(times, piece.end()));
    const Stretch stretch{times, sample_, filled_, static_cast<std::size_t>(after - sample_)};
    filled_ += stretch.count;
    sample_ = after;
    return stretch;
  }

 private:
  /// Number of the first time that is not before `end`.
  static int first_from(const trajectory::SampleTimes& times, double end) {
    int number = std::clamp(static_cast<int>(end / times.spacing()), 0, times.count);
    while (number > 0 && times[number - 1] >= end) --number;
    while (number < times.count && times[number] < end) ++number;
    return number;
  }

  int samples_per_revolution_;
  double period_ = 0.0;
  int sample_ = 0;  ///< next one within the revolution
  std::size_t filled_ = 0;
};

}  // namespace rubatlas::observables
