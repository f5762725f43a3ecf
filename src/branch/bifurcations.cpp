#include "branch/bifurcations.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace rubatlas::branch {

double test_function(EventKind kind, const Orbit& orbit) {
  if (kind == EventKind::fold) return (orbit.forward - orbit.backward).determinant();
  // From cut to cut: where an even number of them make a period, the multiplier over that passes +1.
  if (kind == EventKind::period_doubling) return (orbit.forward + orbit.backward).determinant();
  // Of all pairs of multipliers the product of μi μj − 1: real, since complex ones come in pairs.
  const Eigen::Vector4cd& multipliers = orbit.multipliers;
  std::complex<double> product = 1.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) product *= multipliers[i] * multipliers[j] - 1.0;
  }
  return product.real();
}

void add_bifurcations(Corrector& corrector, const OnBranch& from, const OnBranch& to, double length,
                      std::vector<Event>& events) {
  const auto find = [&](EventKind kind, auto value) {
    const double at_start = value(from);
    const double at_end = value(to);
    if (!(at_start * at_end < 0.0)) return;
    OnBranch found = from;
    const auto at_length = [&](double part) {
      const auto there = corrector.advance(from, part);
      if (!there) return std::numeric_limits<double>::quiet_NaN();
      found = *there;
      return value(*there);
    };
    // Across a grazing multipliers jump, and no zero lies between.
    double low = 0.0;
    double high = length;
    double value_low = at_start;
    double value_high = at_end;
    OnBranch state_low = from;
    OnBranch state_high = to;
    for (int i = 0; i < 200 && high - low > 1e-12; ++i) {
      double part =
          i % 2 == 0 ? (low * value_high - high * value_low) / (value_high - value_low) : 0.5 * (low + high);
      part = std::clamp(part, low + 1e-3 * (high - low), high - 1e-3 * (high - low));
      const double there = at_length(part);
      if (!std::isfinite(there)) return;
      const bool before = there * at_start > 0.0;
      (before ? low : high) = part;
      (before ? value_low : value_high) = there;
      (before ? state_low : state_high) = found;
      if (std::abs(there) < 1e-13 * (std::abs(at_start) + std::abs(at_end))) break;
    }
    if (kind == EventKind::neimark_sacker) {
      // μi μj = 1 holds for a real pair, too, which is no bifurcation.
      const auto& multipliers = found.orbit.multipliers;
      const bool on_circle = std::ranges::any_of(multipliers, [](const std::complex<double>& multiplier) {
        return std::abs(multiplier.imag()) > 1e-6 && std::abs(std::abs(multiplier) - 1.0) < 1e-4;
      });
      if (!on_circle) return;
    }
    // A change of sign without a zero is a jump of the multipliers at a grazing.
    if (std::abs(value_high - value_low) > 0.1 * std::abs(at_end - at_start)) return;
    events.push_back(
        {kind, found.orbit, observables::GrazingSide::none, corrector.difference(state_low, state_high)});
  };
  find(EventKind::fold, [](const OnBranch& state) { return state.tangent[4]; });
  for (const EventKind kind : {EventKind::period_doubling, EventKind::neimark_sacker})
    find(kind, [kind](const OnBranch& state) { return test_function(kind, state.orbit); });
}

Eigen::Vector4d half_a_period_on(Shooting& shooting, const Orbit& orbit) {
  const std::optional<int> passings = shooting.half_of_passings();
  if (!passings || !orbit.admissible) return Eigen::Vector4d::Zero();
  const Unknowns start = shooting.scaled(orbit.section, orbit.quantities);
  const point::SectionMap half = shooting.follow(start, *passings);
  if (half.status != ending::PointStatus::done) return Eigen::Vector4d::Zero();
  return (shooting.scaled(half.sections.back(), orbit.quantities) - start).head<4>();
}

namespace {

/// The period doubling of an orbit near to one of two places on its branch, by secants over the first
/// quantity.
std::optional<Event> doubling_near(Corrector& corrector, Unknowns at, double other) {
  constexpr int kMostSecants = 20;
  constexpr double kClosest = 1e-12;  // scaled
  Unknowns plane = Unknowns::Zero(at.size());
  plane[4] = 1.0;  // the first quantity stays
  auto last = corrector.correct(at, plane);
  if (!last) return std::nullopt;
  double value = test_function(EventKind::period_doubling, last->orbit);
  double step = other - at[4];
  for (int i = 0; i < kMostSecants && std::isfinite(step); ++i) {
    at = last->at;
    at[4] += step;
    auto next = corrector.correct(at, plane);
    if (!next) return std::nullopt;
    const double value_there = test_function(EventKind::period_doubling, next->orbit);
    last = std::move(next);
    if (std::abs(step) < kClosest) {
      return Event{EventKind::period_doubling, last->orbit, observables::GrazingSide::none,
                   std::abs(step) * corrector.shooting().varied()[0].scale};
    }
    step *= value_there / (value - value_there);
    value = value_there;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Event> halving(Corrector& corrector, const OnBranch& from, const OnBranch& to) {
  Shooting& shooting = corrector.shooting();
  const Eigen::Vector4d difference = half_a_period_on(shooting, from.orbit);
  if (!(half_a_period_on(shooting, to.orbit).dot(difference) < 0.0)) return std::nullopt;
  // The orbit of half the passings lies in the middle, and is cut at phase 0.
  Unknowns middle = shooting.scaled(from.orbit.section, from.orbit.quantities);
  middle.head<4>() += 0.5 * difference;
  const int passings = shooting.passings();
  const auto cut = shooting.cut();
  shooting.cut_at_section();
  shooting.set_passings(passings / 2);
  auto doubling = doubling_near(corrector, middle, to.at[4]);
  shooting.set_passings(passings);
  if (cut) shooting.cut_at(*cut);
  return doubling;
}

}  // namespace rubatlas::branch
