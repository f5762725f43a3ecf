#include "branch/grazings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace rubatlas::branch {
namespace {

/// Of the clearance: a tip that misses, or a contact that is as deep, at the end of a bisection grazes.
constexpr double kGrazes = 1e-4;
/// In clearances per unit τ: a tip that touches down more slowly, and ever more so along the branch, grazes.
/// There its place is known to rounding, which over the speed makes 1e-10 of a time.
constexpr double kGrazingSpeed = 1e-5;
constexpr double kNearlyClosed = 1e-2;  ///< in clearances: an orbit with such a touch-down closes nearly

}  // namespace

std::ptrdiff_t touches(const Orbit& orbit) {
  return std::ranges::count_if(orbit.map.events, [](std::int32_t event) { return event > 0; });
}

std::optional<OnBranch> Grazings::go_on_behind(const OnBranch& before, std::vector<Event>& events) {
  const auto grazing = locate(before, kFirstStep);
  if (!grazing) {
    events.push_back({EventKind::lost, before.orbit});
    return std::nullopt;
  }
  const auto cut = shooting_->cut();
  auto behind = vanishes(before) ? without_touch(grazing->event, before) : with_touch(grazing->event);
  if (!behind) cut ? shooting_->cut_at(*cut) : shooting_->cut_at_section();
  // A contact that becomes light is followed to where it vanishes, which is the grazing.
  const bool lightens = behind && shooting_->cut() && behind->tangent[kApproachSpeed] < 0.0;
  if (!lightens) events.push_back(grazing->event);
  return behind;
}

void Grazings::add(Event grazing, std::vector<Event>& events) const {
  // Blades that are alike graze at once, but for rounding.
  constexpr double kAtOnce = 1e-9;
  const double scale = shooting_->varied()[0].scale;
  const bool known =
      !events.empty() && events.back().kind == EventKind::grazing &&
      std::abs(events.back().orbit.quantities[0] - grazing.orbit.quantities[0]) < kAtOnce * scale;
  if (!known) events.push_back(std::move(grazing));
}

bool Grazings::vanishes(const OnBranch& from) const {
  return shooting_->cut() && from.at[kApproachSpeed] < kGrazingSpeed && from.tangent[kApproachSpeed] < 0.0;
}

double Grazings::longest_step(const OnBranch& from) const {
  // Step by step to a third of the approach speed.
  const double falls = -from.tangent[kApproachSpeed];
  return shooting_->cut() && falls > 0.0 ? 0.7 * from.at[kApproachSpeed] / falls
                                         : std::numeric_limits<double>::infinity();
}

std::optional<Grazing> Grazings::locate(const OnBranch& from, double length) {
  if (vanishes(from)) return Grazing{at_vanishing_touch(from), std::nullopt, 0.0};
  double reached = 0.0;
  double beyond = length;
  OnBranch last = from;
  std::optional<OnBranch> first_beyond;
  for (int i = 0; i < 60 && beyond - reached > 1e-13; ++i) {
    const double part = 0.5 * (reached + beyond);
    auto there = corrector_->advance(from, part);
    if (there && same_touches(there->orbit, from.orbit)) {
      reached = part;
      last = std::move(*there);
    } else {
      beyond = part;
      first_beyond = std::move(there);
    }
  }
  // Two orbits that are not the same branch's tell nothing of what is between them.
  if (first_beyond && !((first_beyond->at - last.at).norm() < kSame)) return std::nullopt;
  Event event{EventKind::grazing, last.orbit};
  double nearest = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Orbit& orbit) {
    const auto take = [&](double distance, double side) {
      if (!(distance < nearest)) return;
      nearest = distance;
      event.side = side > 0.0 ? observables::GrazingSide::approaching : observables::GrazingSide::receding;
    };
    if (orbit.map.nearest_pass) take(orbit.map.nearest_pass->miss, orbit.map.nearest_pass->side);
    take(orbit.map.lightest_touch, orbit.map.lightest_side);
  };
  consider(last.orbit);
  if (first_beyond) consider(first_beyond->orbit);
  if (!(nearest < kGrazes * shooting_->length())) return std::nullopt;
  event.uncertainty = first_beyond ? corrector_->difference(last, *first_beyond)
                                   : (beyond - reached) * shooting_->varied()[0].scale;
  extrapolate(last, event);
  return Grazing{std::move(event), std::move(first_beyond), beyond};
}

void Grazings::extrapolate(const OnBranch& last, Event& event) {
  constexpr double kBack = 1e-5;  // arclength over which the miss is straight
  const auto miss = [](const OnBranch& state) {
    return state.orbit.map.nearest_pass ? state.orbit.map.nearest_pass->miss
                                        : std::numeric_limits<double>::quiet_NaN();
  };
  const auto before = corrector_->advance(last, -kBack);
  if (!before || !same_touches(before->orbit, last.orbit)) return;
  const double change =
      miss(last) / (miss(*before) - miss(last)) * (last.orbit.quantities[0] - before->orbit.quantities[0]);
  if (std::abs(change) < kBack * shooting_->varied()[0].scale) event.orbit.quantities[0] += change;
  event.uncertainty = std::max(event.uncertainty, std::abs(change));
}

Event Grazings::at_vanishing_touch(const OnBranch& from) {
  // The contact vanishes where the approach speed does, and the branch is nearly straight up to there.
  const auto vanishing_at = [&](const OnBranch& state) {
    const double way = -state.at[kApproachSpeed] / state.tangent[kApproachSpeed];
    return (state.at[4] + way * state.tangent[4]) * shooting_->varied()[0].scale;
  };
  Event event{EventKind::grazing, from.orbit,
              from.orbit.map.lightest_side > 0.0 ? observables::GrazingSide::approaching
                                                 : observables::GrazingSide::receding};
  const double value = vanishing_at(from);
  const auto nearer = corrector_->advance(from, longest_step(from));
  event.uncertainty = std::abs(value - (nearer ? vanishing_at(*nearer) : from.orbit.quantities[0]));
  event.orbit.quantities[0] = value;
  return event;
}

std::optional<OnBranch> Grazings::with_touch(const Event& grazing) {
  const point::SectionMap& map = grazing.orbit.map;
  const bool touches =
      map.lightest_place && !(map.nearest_pass && map.nearest_pass->miss < map.lightest_touch);
  const auto& place = touches ? map.lightest_place : map.nearest_place;
  if (!place) return std::nullopt;
  Unknowns along = Unknowns::Zero(shooting_->size());
  along[kApproachSpeed] = touches ? -1.0 : 1.0;
  Unknowns at = shooting_->scaled(*place, grazing.orbit.quantities);
  const std::vector<int> periods = shooting_->passings_of_periods();
  for (const double speed : {1e-4, 3e-5}) {
    if (!touches) at[kApproachSpeed] = speed;
    for (const int passings : periods) {
      shooting_->cut_at({place->blade, place->revolution, passings});
      // Blades that are alike may touch one after the other: a shorter part of the orbit closes in itself
      // then.
      if (passings < periods.back()) {
        const auto orbit = shooting_->orbit(at);
        if (!orbit || orbit->mismatch.norm() > kNearlyClosed) continue;
      }
      if (auto state = corrector_->correct(at, along); state && state->orbit.admissible) return state;
    }
    if (touches) break;
  }
  return std::nullopt;
}

std::optional<OnBranch> Grazings::without_touch(const Event& grazing, const OnBranch& before) {
  const std::ptrdiff_t remaining = before.orbit.cuts * (touches(before.orbit) - 1);
  shooting_->cut_at_section();
  Unknowns along = Unknowns::Zero(shooting_->size());
  for (const double distance : {1e-6, 1e-5, 1e-4}) {
    for (const double direction : {-1.0, 1.0}) {
      Unknowns at = shooting_->scaled(before.orbit.section, grazing.orbit.quantities);
      at[4] += direction * distance;
      along[4] = direction;
      if (auto state = corrector_->correct(at, along);
          state && state->orbit.cuts * touches(state->orbit) == remaining)
        return state;
    }
  }
  return std::nullopt;
}

}  // namespace rubatlas::branch
