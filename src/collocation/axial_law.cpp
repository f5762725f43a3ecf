#include "collocation/axial_law.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "integrate/root_between.hpp"

namespace rubatlas::collocation {

AxialLaw::AxialLaw(const Laws& laws, int blade_count, double max_shortening)
    : laws_(&laws), solver_(interval_solver()) {
  for (int k = 0; k < blade_count; ++k) {
    const auto& knots = table(k).knots();
    const auto beyond = std::ranges::find_if(
        knots, [&](const blade::BendingTable::Knot& knot) { return knot.shortening > max_shortening; });
    if (beyond == knots.end()) {
      valid_argument_.push_back(knots.empty() ? 0.0 : knots.back().argument);
      continue;
    }
    const auto excess = [&](double argument) {
      return laws_->of(k).curve().at(table(k).bending(argument)).shortening - max_shortening;
    };
    const double before = beyond == knots.begin() ? 0.0 : std::prev(beyond)->argument;
    valid_argument_.push_back(integrate::root_between(excess, before, beyond->argument, excess(before),
                                                      beyond->shortening - max_shortening));
  }
}

Blade AxialLaw::numbers(int blade) const {
  const contact::ElasticaContact& law = laws_->of(blade);
  return {.table = &table(blade),
          .reach = law.geometry().reach,
          .closing = law.geometry().closing(),
          .length = law.length(),
          .load_unit = law.load_unit(),
          .friction = law.curve().friction(),
          .yield_unit = law.yield_unit(),
          .first_shortening = law.first_shortening(),
          .first_yielding = law.first_yielding(),
          .held_beyond_ring = law.releases_at_fold()};
}

ArcLaw::Start AxialLaw::start(const Touch& touch, const contact::Pose& at, double speed) const {
  return {force(touch, at, speed), laws_->of(touch.blade).gap_per_deflection(at, touch.slip, touch.bending)};
}

ArcLaw::Tangent AxialLaw::tangent(const Touch& touch, const contact::Pose& at, double speed,
                                  const std::complex<double>& /*acceleration*/) const {
  const contact::ElasticaContact& law = laws_->of(touch.blade);
  const auto there = law.constraint(at, touch.slip, touch.bending, speed);
  // dh = h_u du/dp dp + h_τ dτ
  const double slope = there.bending_slope * table(touch.blade).bending_slope_at(touch.bending);
  return {-slope, there.time_slope, 0.0};
}

}  // namespace rubatlas::collocation
