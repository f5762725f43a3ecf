#include "branch/continuation.hpp"

#include <algorithm>
#include <utility>

#include "branch/bifurcations.hpp"
#include "branch/first_orbit.hpp"

namespace rubatlas::branch {
namespace {

constexpr double kLongestStep = 0.05;  ///< arclength, scaled
constexpr double kBehindGrazing = 1e-7;

}  // namespace

std::optional<Orbit> Continuation::settle(const motion::SectionState& initial,
                                          const std::vector<double>& quantities, int transient_revolutions) {
  return settled_orbit(corrector_, initial, quantities, transient_revolutions);
}

Branch Continuation::follow(const Orbit& from, double direction, const GoOn& go_on) {
  Unknowns along = Unknowns::Zero(shooting_->size());
  along[4] = direction;
  shooting_->set_passings(from.passings);
  shooting_->cut_at_section();
  const auto state = corrector_.correct(shooting_->scaled(from.section, from.quantities), along);
  if (!state) return {};
  return follow(*state, go_on);
}

std::optional<Branch> Continuation::follow_doubled(const Event& doubling, const GoOn& go_on) {
  const auto start = doubled_orbit(corrector_, doubling);
  if (!start) return std::nullopt;
  return follow(*start, go_on);
}

Branch Continuation::follow(OnBranch state, const GoOn& go_on) {
  Branch branch;
  branch.orbits.push_back(state.orbit);
  double length = kFirstStep;
  const auto in_section = [&](const Orbit& orbit) {
    return shooting_->scaled(orbit.section, orbit.quantities);
  };
  const Unknowns first = in_section(state.orbit);
  std::vector<Unknowns> behind_grazings;
  while (true) {
    if (!go_on(branch.orbits.size(), state.orbit)) {
      branch.goes_on = true;
      break;
    }
    std::optional<OnBranch> next;
    if (!grazings_.vanishes(state)) {
      length = std::min(length, grazings_.longest_step(state));
      next = corrector_.advance(state, length);
      // Of two orbits that are close in arclength the tangents are alike; else the step has left the branch.
      if (next && !(next->tangent.dot(state.tangent) > 0.9)) next.reset();
    }
    const bool eased = corrector_.was_easy();
    if (next && !shooting_->in_range(next->at)) {
      const auto last = at_end_of_range(corrector_, *shooting_, state, *next);
      if (last && same_touches(state.orbit, last->orbit)) {
        add_bifurcations(corrector_, state, *last, std::max((last->at - state.at).norm(), kShortestStep),
                         branch.events);
        branch.orbits.push_back(last->orbit);
        break;
      }
      next.reset();  // another branch, or a grazing before the end of the range
    }
    std::optional<Grazing> within;
    if (next && !same_touches(state.orbit, next->orbit)) {
      // Touch-downs change at a grazing, or else the step has left the branch. Right behind a grazing the
      // branch may turn: it goes on from there by small steps.
      within = grazings_.locate(state, length);
      next = within ? within->behind : std::nullopt;
      if (next) length = within->length;
    }
    if (!next) {
      length *= 0.5;
      if (length >= kShortestStep && !grazings_.vanishes(state)) continue;
      auto behind = grazings_.go_on_behind(state, branch.events);
      if (!behind) break;
      // A branch that has come back to where it went on before has closed.
      const Unknowns place = in_section(behind->orbit);
      const bool closed = std::ranges::any_of(
          behind_grazings, [&](const Unknowns& other) { return (place - other).norm() < kSame; });
      if (closed) break;
      behind_grazings.push_back(place);
      state = std::move(*behind);
      branch.orbits.push_back(state.orbit);
      length = kFirstStep;
      continue;
    }
    if (auto end = halving(corrector_, state, *next)) {
      branch.events.push_back(std::move(*end));
      break;
    }
    add_bifurcations(corrector_, state, *next, length, branch.events);
    if (within) grazings_.add(std::move(within->event), branch.events);
    state = std::move(*next);
    branch.orbits.push_back(state.orbit);
    if (branch.orbits.size() > 10 && (in_section(state.orbit) - first).norm() < 0.5 * length) break;
    if (within) length = kBehindGrazing;
    length = eased ? std::min(1.5 * length, kLongestStep) : length;
  }
  return branch;
}

}  // namespace rubatlas::branch
