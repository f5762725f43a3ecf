/// A branch of periodic orbits, stable or not, along one quantity: followed by its arclength, through folds,
/// with the bifurcations on it located. The same for curves of bifurcations in two quantities.
///
/// Source: Seydel, Practical Bifurcation and Stability Analysis, chapters 4 (continuation), 5 (test
/// functions) and 7 (periodic orbits).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "branch/branch.hpp"
#include "branch/shooting.hpp"

namespace rubatlas::branch {

/// Called after each orbit with its first quantity; for progress.
using OnOrbit = std::function<void(const Orbit&)>;

class Continuation {
 public:
  explicit Continuation(Shooting& shooting, OnOrbit on_orbit = {});

  /// The periodic orbit on which the motion from a state settles, if its period is 16 revolutions at most.
  /// Sets the period.
  [[nodiscard]] std::optional<Orbit> settle(const motion::SectionState& initial,
                                            const std::vector<double>& quantities, int transient_revolutions);

  /// From an orbit on, towards larger (+1) or smaller (−1) values of the first quantity at first, until a
  /// quantity leaves its range, the branch closes or is lost, or it has `most` orbits.
  [[nodiscard]] Branch follow(const Orbit& from, double direction, std::size_t most);

  /// The branch of doubled period that begins at a period doubling, likewise.
  [[nodiscard]] std::optional<Branch> follow_doubled(const Event& doubling, std::size_t most);

 private:
  struct State {
    Unknowns at;
    Orbit orbit;
    Unknowns tangent;
  };
  /// Newton's method on the plane tangentᵀ(U − predicted) = 0.
  [[nodiscard]] std::optional<State> correct(const Unknowns& predicted, const Unknowns& tangent);
  [[nodiscard]] std::optional<State> advance(const State& from, double length) {
    return correct(from.at + length * from.tangent, from.tangent);
  }
  [[nodiscard]] std::optional<Unknowns> tangent_at(const Unknowns& at, const Orbit& orbit,
                                                   const Unknowns& along);
  [[nodiscard]] Branch follow(State state, std::size_t most);
  /// The orbit where the first quantity's range ends, between an orbit in it and one beyond.
  [[nodiscard]] std::optional<State> at_end_of_range(const State& inside, const State& outside);
  void add_grazing(Event grazing, std::vector<Event>& events) const;
  /// The touch-down at which the orbit is cut is about to vanish.
  [[nodiscard]] bool vanishes(const State& state) const;
  [[nodiscard]] double longest_step(const State& from) const;
  /// Adds the bifurcations of a step.
  void locate(const State& from, const State& to, double length, std::vector<Event>& events);
  /// A grazing ahead of an orbit, and, if the branch goes on there, the first orbit behind it and the
  /// arclength to that.
  struct Grazing {
    Event event;
    std::optional<State> behind;
    double length;
  };
  [[nodiscard]] std::optional<Grazing> locate_grazing(const State& from, double length);
  /// Moves a grazing from the last orbit before it to where the miss, straight along the branch, is zero.
  void extrapolate(const State& last, Event& event);
  /// Where the touch-down at which the orbit is cut vanishes, ahead of an orbit that is near.
  [[nodiscard]] Event at_grazing_touch(const State& from);
  /// Where the branch goes on behind a grazing at which the section map ends: with the new touch, or without
  /// the one that has vanished. Cuts the orbit accordingly. Adds the grazing, or that the branch is lost.
  [[nodiscard]] std::optional<State> go_on_behind_grazing(const State& before, std::vector<Event>& events);
  [[nodiscard]] std::optional<State> with_touch(const Event& grazing);
  [[nodiscard]] std::optional<State> without_touch(const Event& grazing, const State& before);
  [[nodiscard]] double uncertainty(const State& a, const State& b) const;

  Shooting* shooting_;
  OnOrbit on_orbit_;
  int iterations_ = 0;  ///< of the last correction
};

/// Test functions: each changes its sign where the bifurcation is.
double test_function(EventKind kind, const Orbit& orbit);

/// A curve of bifurcations of one kind in two quantities, from one of them on, both ways. The shooting varies
/// both. Orbits along the curve; empty where the first cannot be found.
std::vector<Orbit> follow_curve(Shooting& shooting, EventKind kind, const Orbit& from, std::size_t most,
                                const OnOrbit& on_orbit = {});

}  // namespace rubatlas::branch
