/// When a transient has come to its end: the motion repeats from revolution to revolution.
///
/// Sections approach a stable cycle geometrically. So sections that repeat over several periods, far more
/// closely than later comparisons resolve, have reached the cycle. A chaotic motion returns close to earlier
/// sections too, but not three times in succession at every section within a tenth of the local error of a
/// step.
#pragma once

#include <array>
#include <cstddef>

#include "rotor/bodies.hpp"

namespace rubatlas::point {

class Settling {
 public:
  using Section = rotor::ShaftAndRing;               ///< the state of shaft and ring
  static constexpr std::size_t kLongestPeriod = 16;  ///< in revolutions, as the classes of `analyse`
  static constexpr std::size_t kRepeats = 3;         ///< periods in succession that repeat the one before
  static constexpr double kCloseness = 0.1;          ///< of accuracy.tolerance × δc

  /// `distance` bounds the difference of any component of two sections that are the same [m].
  explicit Settling(double distance) : distance_(distance) {}

  /// The section at the end of a revolution.
  void add(const Section& section) { sections_[count_++ % kKept] = section; }

  /// Smallest period in which the last sections repeat, 0 where they do not.
  [[nodiscard]] int period() const {
    for (std::size_t period = 1; period <= kLongestPeriod; ++period) {
      if (count_ < (kRepeats + 1) * period) break;
      if (repeats(period)) return static_cast<int>(period);
    }
    return 0;
  }

 private:
  static constexpr std::size_t kKept = (kRepeats + 1) * kLongestPeriod;

  [[nodiscard]] bool repeats(std::size_t period) const {
    for (std::size_t i = 1; i <= kRepeats * period; ++i) {
      const Section& section = sections_[(count_ - i) % kKept];
      const Section& earlier = sections_[(count_ - i - period) % kKept];
      if (!((section - earlier).abs().maxCoeff() <= distance_)) return false;
    }
    return true;
  }

  double distance_;
  std::array<Section, kKept> sections_{};
  std::size_t count_ = 0;
};

}  // namespace rubatlas::point
