/// Grazings on a branch: where a touch-down begins or vanishes, and how the branch goes on behind (README.md,
/// "Through a grazing").
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "branch/branch.hpp"
#include "branch/corrector.hpp"

namespace rubatlas::branch {

/// Scaled: orbits that are nearer to each other are of one branch.
inline constexpr double kSame = 1e-4;

/// Touch-downs from cut to cut: their number does not change but by a grazing.
std::ptrdiff_t touches(const Orbit& orbit);
inline bool same_touches(const Orbit& a, const Orbit& b) {
  return touches(a) == touches(b);
}

/// A grazing ahead of an orbit, and, if the branch goes on there, the first orbit behind it and the arclength
/// to that.
struct Grazing {
  Event event;
  std::optional<OnBranch> behind;
  double length;
};

class Grazings {
 public:
  explicit Grazings(Corrector& corrector) : corrector_(&corrector), shooting_(&corrector.shooting()) {}

  /// The touch-down at which the orbit is cut is about to vanish.
  [[nodiscard]] bool vanishes(const OnBranch& from) const;
  /// The arclength that a step may have: towards a grazing at the cut the steps become shorter.
  [[nodiscard]] double longest_step(const OnBranch& from) const;
  /// The grazing within this arclength.
  [[nodiscard]] std::optional<Grazing> locate(const OnBranch& from, double length);
  void add(Event grazing, std::vector<Event>& events) const;
  /// Where the branch goes on behind a grazing at which the section map ends: with the new touch, or without
  /// the one that has vanished. Cuts the orbit accordingly. Adds the grazing, or that the branch is lost.
  [[nodiscard]] std::optional<OnBranch> go_on_behind(const OnBranch& before, std::vector<Event>& events);

 private:
  /// Moves a grazing from the last orbit before it to where the miss, straight along the branch, is zero.
  void extrapolate(const OnBranch& last, Event& event);
  /// Where the touch-down at which the orbit is cut vanishes, ahead of an orbit that is near.
  [[nodiscard]] Event at_vanishing_touch(const OnBranch& from);
  [[nodiscard]] std::optional<OnBranch> with_touch(const Event& grazing);
  [[nodiscard]] std::optional<OnBranch> without_touch(const Event& grazing, const OnBranch& before);

  Corrector* corrector_;
  Shooting* shooting_;
};

}  // namespace rubatlas::branch
