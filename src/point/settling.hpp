/// When a transient has settled: it approaches a cycle so that no doubt is left that it ends there.
///
/// Newton's method on the section map finds the cycle ahead of the motion. That the motion ends on it follows
/// from what it has done, in coordinates w in which the map's derivative J at the cycle is diagonal: there J
/// takes off every difference from the cycle at least the share 1 − ρ, ρ the largest modulus of a multiplier,
/// and what the map differs from J by grows with the square of the difference. Where it is less than half of
/// what J takes off, all later differences are smaller, and what it differs by is an ever smaller share of
/// them. A saddle or another cycle that the motion might still go to lies beyond: half way to a saddle the
/// two are equal. Source: Seydel, Practical Bifurcation and Stability Analysis, chapter 7 (shooting,
/// multipliers).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "variation/tangents.hpp"

namespace rubatlas::point {

/// The state of all that moves at phase 0, in the order of the rows of `variation::Tangents`: places of the
/// shaft and of a ring that is a body [m], then their velocities [m per unit τ].
using Section = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * variation::kMostCoordinates, 1>;

/// What comes of a section in some revolutions.
struct Return {
  std::vector<Section> sections;  ///< after each revolution
  /// Touch-downs (blade + 1) and lift-offs −(blade + 1), in order of time.
  std::vector<std::int32_t> events;
  // Where the derivative is asked for:
  variation::Tangents jacobian;  ///< of the last section by the start
  double nearest_grazing = 0.0;  ///< least depth of a touch, or distance by which a tip passes the ring [m]
};
/// Nothing where the motion ends before, or has no derivative where that is asked for.
using ReturnFrom =
    std::function<std::optional<Return>(const Section& start, int revolutions, bool derivative)>;

class Settling {
 public:
  static constexpr std::size_t kLongestPeriod = 16;  ///< in revolutions, as the classes of `analyse`

  /// `error`: of a section, by which two that are the same may differ [m]; `scale` [m]: of the motion.
  /// `longest_period`: of the cycles that are looked for [revolutions].
  Settling(double error, double scale, ReturnFrom return_from, std::size_t longest_period = kLongestPeriod)
      : error_(error),
        scale_(scale),
        return_from_(std::move(return_from)),
        longest_period_(std::min(longest_period, kLongestPeriod)) {}

  /// The revolution that has just been run.
  void add(const Section& section, std::vector<std::int32_t> events);
  /// The sections of the cycle on which the motion ends, in order; the last section that was added is about
  /// to be the first of them. Nothing where that is not certain, or not worth the work before `left`
  /// revolutions.
  [[nodiscard]] std::optional<std::vector<Section>> cycle(int left);

 private:
  using Cycle = std::vector<Section>;
  static constexpr std::size_t kKept = 256;
  struct Revolution {
    Section section;  ///< at its end
    std::vector<std::int32_t> events;
  };
  /// A stable cycle that the motion may be approaching.
  struct Candidate {
    Cycle sections;
    variation::Tangents jacobian;
    double nearest_grazing;  ///< [m]
    std::size_t found;       ///< the last revolution then, which ended near the first of its sections
  };

  /// So many revolutions ago.
  [[nodiscard]] const Revolution& back(std::size_t revolutions) const {
    return revolutions_[(count_ - 1 - revolutions) % kKept];
  }
  [[nodiscard]] std::size_t known() const { return std::min(count_, kKept); }
  [[nodiscard]] bool same_events(std::size_t period, std::size_t revolutions) const;
  [[nodiscard]] std::size_t period() const;
  [[nodiscard]] std::optional<Candidate> candidate(std::size_t period) const;
  [[nodiscard]] bool approaches(const Candidate& candidate) const;

  double error_;
  double scale_;
  ReturnFrom return_from_;
  std::size_t longest_period_;
  std::array<Revolution, kKept> revolutions_{};
  std::size_t count_ = 0;
  std::optional<Candidate> candidate_;
  std::size_t next_search_ = 0;
  int searches_ = 0;
};

}  // namespace rubatlas::point
