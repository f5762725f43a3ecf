/// A branch of periodic orbits, stable or not, along one quantity: followed by its arclength, through folds
/// and grazings, with the bifurcations on it located.
///
/// Source: Seydel, Practical Bifurcation and Stability Analysis, chapters 4 (continuation) and 7 (periodic
/// orbits).
#pragma once

#include <optional>
#include <vector>

#include "branch/branch.hpp"
#include "branch/corrector.hpp"
#include "branch/grazings.hpp"
#include "branch/shooting.hpp"

namespace rubatlas::branch {

class Continuation {
 public:
  explicit Continuation(Shooting& shooting)
      : shooting_(&shooting), corrector_(shooting), grazings_(corrector_) {}
  Continuation(const Continuation&) = delete;
  Continuation& operator=(const Continuation&) = delete;

  /// The periodic orbit on which the motion from a state settles, if its period is 16 revolutions at most.
  /// Sets the period.
  [[nodiscard]] std::optional<Orbit> settle(const motion::SectionState& initial,
                                            const std::vector<double>& quantities, int transient_revolutions);

  /// From an orbit on, towards larger (+1) or smaller (−1) values of the first quantity at first, until a
  /// quantity leaves its range, the branch closes or is lost, or it is to go no further.
  [[nodiscard]] Branch follow(const Orbit& from, double direction, const GoOn& go_on);

  /// The branch of doubled period that begins at a period doubling, likewise.
  [[nodiscard]] std::optional<Branch> follow_doubled(const Event& doubling, const GoOn& go_on);

 private:
  [[nodiscard]] Branch follow(OnBranch state, const GoOn& go_on);

  Shooting* shooting_;
  Corrector corrector_;
  Grazings grazings_;  ///< uses `corrector_`
};

}  // namespace rubatlas::branch
