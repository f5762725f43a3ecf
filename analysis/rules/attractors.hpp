/// Which of the motions at the same parameters, found from different starts, ended on the same attractor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/rules/same_motion.hpp"

namespace rubatlas::analysis {

/// Sections of one periodic attractor, reached from different starts, lie within this many closing tolerances
/// of each other. A motion whose distance from its orbit shrinks by a factor r a period, and which closes
/// within one tolerance, is still up to 1/(1 - r) tolerances away from it.
constexpr double kMatchingFactor = kUnresolvedFactor;

/// Whether two different attractors may be one motion in which other blades touch: equal blades can change
/// places, which leaves class and maximum displacement [m] as they are.
[[nodiscard]] bool may_be_shifted(std::uint8_t motion, double displacement, std::uint8_t other_motion,
                                  double other_displacement);

/// The attractors of one set of motions, numbered from 1 in the order in which they appear.
///
/// Two motions are on one attractor if they are the same (`is_same_motion`), or if a chain of motions that
/// are pairwise the same leads from one to the other: statistics of aperiodic motions scatter, and two of
/// them are told apart only where there is a gap between the two groups. A motion that is not resolved has
/// not shown its attractor, and has none, as a point that is not done.
class Attractors {
 public:
  explicit Attractors(const ClosingTolerance& closing);

  /// The next motion, with its sections (sections × 4).
  void add(const MotionTrace& motion, std::span<const double> sections);
  /// For each motion the number of its attractor; 0 where it has none.
  [[nodiscard]] std::vector<std::int32_t> numbers() const;

 private:
  struct Known {
    std::size_t motion = 0;
    MotionTrace trace;
  };

  /// The first motion on the attractor of a motion.
  std::size_t first_of(std::size_t motion);

  ClosingTolerance matching_;
  std::vector<std::size_t> earlier_;  ///< a motion on the same attractor; itself: the first on it
  std::vector<bool> has_attractor_;
  std::vector<Known> known_;  ///< those that later motions are compared with
};

}  // namespace rubatlas::analysis
