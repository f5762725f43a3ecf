#include "branch/first_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "branch/bifurcations.hpp"
#include "integrate/decompositions.hpp"

namespace rubatlas::branch {

std::optional<Orbit> settled_orbit(Corrector& corrector, const motion::SectionState& initial,
                                   const std::vector<double>& quantities, int transient_revolutions) {
  Shooting& shooting = corrector.shooting();
  constexpr int kLongestPeriod = 16;
  constexpr double kNear = 1e-3;   // of the clearance: close enough for Newton's method to be tried
  constexpr double kAlike = 1e-6;  // but for rounding
  shooting.cut_at_section();
  Unknowns at = shooting.scaled(initial, quantities);
  const point::SectionMap settled =
      shooting.follow(at, (transient_revolutions + kLongestPeriod) * shooting.scene().blades.count);
  if (settled.status != ending::PointStatus::done) return std::nullopt;
  const auto from_end = [&](int back) {
    return shooting.scaled(settled.sections[settled.sections.size() - 1 - static_cast<std::size_t>(back)],
                           quantities);
  };
  const Unknowns last = from_end(0);
  for (int period = 1; period <= kLongestPeriod; ++period) {
    const int back = std::min(period, static_cast<int>(settled.sections.size()) - 1);
    if ((last - from_end(back)).norm() > kNear) continue;
    shooting.set_period(period);
    Unknowns plane = Unknowns::Zero(shooting.size());
    plane[4] = 1.0;  // the first quantity stays
    auto found = corrector.correct(last, plane);
    if (!found) continue;
    // Blades that are alike: the motion may repeat itself before the revolution is over.
    while (shooting.half_of_passings() && half_a_period_on(shooting, found->orbit).norm() < kAlike) {
      const int passings = shooting.passings();
      shooting.set_passings(passings / 2);
      auto shorter = corrector.correct(found->at, plane);
      if (!shorter) {
        shooting.set_passings(passings);
        break;
      }
      found = std::move(shorter);
    }
    return found->orbit;
  }
  return std::nullopt;
}

std::optional<OnBranch> doubled_orbit(Corrector& corrector, const Event& doubling) {
  Shooting& shooting = corrector.shooting();
  shooting.cut_at_section();
  shooting.set_passings(doubling.orbit.passings);
  const Unknowns at = shooting.scaled(doubling.orbit.section, doubling.orbit.quantities);
  const auto single = shooting.orbit(at);
  if (!single) return std::nullopt;
  const integrate::EigenModes modes = integrate::eigen_modes(single->map.jacobian);
  int nearest = 0;
  for (int i = 1; i < 4; ++i) {
    if (std::abs(modes.values[i] + 1.0) < std::abs(modes.values[nearest] + 1.0)) nearest = i;
  }
  Unknowns along = Unknowns::Zero(shooting.size());
  along.head<4>() = modes.shapes.col(nearest).real();
  along.normalize();
  shooting.set_passings(2 * doubling.orbit.passings);
  // Away from the orbit itself, of which the doubled one is twice the same: too near, Newton's method falls
  // back onto it; too far, a tip may have grazed before.
  for (const double length : {1e-3, 3e-3, 1e-2, 3e-2, 3e-4, 1e-4}) {
    auto state = corrector.correct(at + length * along, along);
    if (!state) continue;
    if (half_a_period_on(shooting, state->orbit).norm() < 0.1 * length) continue;
    if (state->tangent.dot(along) < 0.0) state->tangent = -state->tangent;
    return state;
  }
  return std::nullopt;
}

}  // namespace rubatlas::branch
