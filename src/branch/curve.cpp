#include "branch/curve.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "branch/bifurcations.hpp"
#include "branch/corrector.hpp"

namespace rubatlas::branch {
namespace {

constexpr double kLongestOnCurve = 0.5;    ///< there are no bifurcations to be stepped over
constexpr double kShortestOnCurve = 1e-4;  ///< next to a grazing ever shorter ones would go on for long

class Curve {
 public:
  Curve(Shooting& shooting, EventKind kind) : shooting_(&shooting), kind_(kind) {}

  /// Newton's method on the orbit's equations and the test function, within the plane normal to `tangent`.
  std::optional<OnBranch> correct(const Unknowns& predicted, const Unknowns& tangent) {
    Unknowns at = predicted;
    for (iterations_ = 0; iterations_ < kMostIterations; ++iterations_) {
      const auto orbit = shooting_->orbit(at);
      if (!orbit) return std::nullopt;
      const auto rows = derivative(at, *orbit);
      if (!rows) return std::nullopt;
      Eigen::VectorXd values(5);
      values << orbit->mismatch, test_function(kind_, *orbit);
      const Unknowns step = newton_step(*rows, values, tangent);
      if (!step.allFinite() || step.norm() > 1.0) return std::nullopt;
      if (shooting_->closes(at, *orbit) && step.norm() <= kLastStep)
        return OnBranch{at, *orbit, null_direction(*rows, tangent)};
      at += step;
    }
    return std::nullopt;
  }
  /// The last correction took few iterations.
  [[nodiscard]] bool was_easy() const { return iterations_ <= kEasy; }

 private:
  static constexpr double kStep = 1e-6;      ///< of the differences of the test function, scaled
  static constexpr double kLastStep = 1e-8;  ///< of Newton's method: what differences leave

  std::optional<Rows> derivative(const Unknowns& at, const Orbit& orbit) {
    const auto closing = shooting_->derivative(at, orbit);
    if (!closing) return std::nullopt;
    Rows rows(5, shooting_->size());
    rows.topRows(4) = *closing;
    for (Eigen::Index column = 0; column < shooting_->size(); ++column) {
      double difference = 0.0;
      for (const double side : {-1.0, 1.0}) {
        Unknowns moved = at;
        moved[column] += side * kStep;
        const auto there = shooting_->orbit(moved);
        if (!there) return std::nullopt;
        difference += side * test_function(kind_, *there);
      }
      rows(4, column) = difference / (2.0 * kStep);
    }
    return rows;
  }

  Shooting* shooting_;
  EventKind kind_;
  int iterations_ = 0;
};

}  // namespace

Branch follow_curve(Shooting& shooting, EventKind kind, const Orbit& from, const GoOn& go_on) {
  shooting.set_passings(from.passings);
  shooting.cut_at_section();
  Curve curve(shooting, kind);
  Unknowns along = Unknowns::Zero(shooting.size());
  along[shooting.size() - 1] = 1.0;  // the second quantity grows at first
  const auto start = curve.correct(shooting.scaled(from.section, from.quantities), along);
  if (!start) return {};
  Branch found{.orbits = {start->orbit}, .events = {}};
  std::vector<Orbit>& orbits = found.orbits;
  for (const double direction : {-1.0, 1.0}) {
    OnBranch state = *start;
    state.tangent *= direction;
    double length = kFirstStep;
    std::size_t count = 1;
    while (length >= kShortestOnCurve) {
      if (!go_on(count, state.orbit)) {
        found.goes_on = true;
        break;
      }
      const auto next = curve.correct(state.at + length * state.tangent, state.tangent);
      if (!next || !(next->tangent.dot(state.tangent) > 0.9)) {
        length *= 0.5;
        continue;
      }
      if (!shooting.in_range(next->at)) {
        const auto last = at_end_of_range(curve, shooting, state, *next);
        if (last) {
          orbits.push_back(last->orbit);
          break;
        }
        length *= 0.5;
        continue;
      }
      state = *next;
      ++count;
      orbits.push_back(state.orbit);
      if (curve.was_easy()) length = std::min(1.5 * length, kLongestOnCurve);
    }
    if (length < kShortestOnCurve) found.events.push_back({.kind = EventKind::lost, .orbit = state.orbit});
    // From one end of the curve to the other.
    if (direction < 0.0) std::ranges::reverse(orbits);
  }
  return found;
}

}  // namespace rubatlas::branch
