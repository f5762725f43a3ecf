/// Newton's method for the orbits of a branch: each step along the tangent is corrected in the plane normal
/// to it (pseudo-arclength).
///
/// Source: Seydel, Practical Bifurcation and Stability Analysis, chapter 4.
#pragma once

#include <Eigen/Core>
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

}  // namespace rubatlas::branch
