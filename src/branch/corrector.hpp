/// Newton's method for the orbits of a branch: each step along the tangent is corrected in the plane normal
/// to it (pseudo-arclength).
///
/// Source: Seydel, Practical Bifurcation and Stability Analysis, chapter 4.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "branch/branch.hpp"
#include "branch/shooting.hpp"

namespace rubatlas::branch {

inline constexpr double kFirstStep = 1e-3;  ///< along a branch or a curve: arclength, scaled
inline constexpr double kShortestStep = 1e-9;
inline constexpr int kMostIterations = 8;  ///< of Newton's method
inline constexpr int kEasy = 3;            ///< iterations: the next step may be longer

/// Equations for the unknowns, linearised: one row each.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// The direction in which all rows vanish, of length 1, turned like `along`.
Unknowns null_direction(const Rows& rows, const Unknowns& along);
/// One step of Newton's method on rows(U) = 0 within the plane normal to `tangent`.
Unknowns newton_step(const Rows& rows, const Eigen::VectorXd& values, const Unknowns& tangent);

/// An orbit of a branch or of a curve, with the direction in which that goes on.
struct OnBranch {
  Unknowns at;
  Orbit orbit;
  Unknowns tangent;
};

class Corrector {
 public:
  explicit Corrector(Shooting& shooting) : shooting_(&shooting) {}

  [[nodiscard]] Shooting& shooting() const { return *shooting_; }

  /// Newton's method on the plane tangentᵀ(U − predicted) = 0.
  [[nodiscard]] std::optional<OnBranch> correct(const Unknowns& predicted, const Unknowns& tangent);
  /// The orbit at an arclength ahead.
  [[nodiscard]] std::optional<OnBranch> advance(const OnBranch& from, double length) {
    return correct(from.at + length * from.tangent, from.tangent);
  }
  /// The last correction took few iterations.
  [[nodiscard]] bool was_easy() const { return iterations_ <= kEasy; }

  /// By how much the first quantity differs, in its unit.
  [[nodiscard]] double difference(const OnBranch& a, const OnBranch& b) const;

 private:
  Shooting* shooting_;
  int iterations_ = 0;  ///< of the last correction
};

/// Where a branch or a curve that leaves the range of a quantity between two orbits reaches its end; nothing
/// where it is not found between them. `corrector`: that of a branch, or of a curve.
template <class Any>
std::optional<OnBranch> at_end_of_range(Any& corrector, const Shooting& shooting, const OnBranch& inside,
                                        const OnBranch& outside) {
  const Unknowns way = outside.at - inside.at;
  for (std::size_t i = 0; i < shooting.varied().size(); ++i) {
    const Varied& varied = shooting.varied()[i];
    const double value = shooting.quantity(outside.at, i);
    if (value >= varied.lowest && value <= varied.highest) continue;
    const double limit = (value > varied.highest ? varied.highest : varied.lowest) / varied.scale;
    const auto place = static_cast<Eigen::Index>(4 + i);
    Unknowns plane = Unknowns::Zero(way.size());
    plane[place] = 1.0;
    auto last = corrector.correct(inside.at + (limit - inside.at[place]) / way[place] * way, plane);
    return last && (last->at - inside.at).norm() <= way.norm() ? last : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace rubatlas::branch
