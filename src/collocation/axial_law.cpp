#include "collocation/axial_law.hpp"

#include <algorithm>

#include "rotor/skimming.hpp"

namespace rubatlas::collocation {

Blade AxialLaw::numbers(int blade) const {
  const contact::ElasticaContact& law = of(blade);
  return {.table = &table(blade),
          .reach = law.geometry().reach,
          .closing = law.geometry().closing(),
          .length = law.length(),
          .load_unit = law.load_unit(),
          .strain_unit = law.strain_unit(),
          .friction = law.curve().friction(),
          .yield_unit = law.yield_unit(),
          .first_shortening = law.first_shortening(),
          .first_yielding = law.first_yielding(),
          .axial_unit = law.may_stand_straight() ? law.axial_unit() : 0.0,
          .buckling_load = law.may_stand_straight() ? blade::kEulerLoad * law.load_unit() : 0.0,
          .held_beyond_ring = law.releases_at_fold()};
}

std::optional<Touch> AxialLaw::open(const Touch& touch, const contact::Pose& at, double /*speed*/) const {
  const contact::ElasticaContact& law = of(touch.blade);
  Touch found = touch;
  // One that has just buckled, or straightened, has its Euler load to rounding.
  constexpr double kClearlyLess = 1.0 - 1e-9;
  if (law.may_stand_straight() && touch.bending == 0.0)
    found.straight = touch.straight || law.straight_load(at) < kClearlyLess * blade::kEulerLoad;
  // Another arc has left it off its equilibrium by what sweeps leave.
  if (touch.bending > 0.0)
    found.bending = law.solve_near(at, touch.slip, touch.bending).value_or(touch.bending);
  return found;
}

Bending AxialLaw::lead(const Touch& touch) {
  leader_ = touch.blade;
  return {.argument = touch.straight ? kStraight : table(touch.blade).argument(touch.bending),
          .yielding = touch.yielding};
}

void AxialLaw::set_course(const Touch& touch, const contact::Pose& at, double speed,
                          BladeStart& start) const {
  start.square = touch.straight ? Course{start.start_gap_measure}
                                : square_of_bent(of(touch.blade), at, touch, speed, start.ring_opens);
  if (touch.just_bent) start.square.rate = 0.0;  // as `DampedLaw::tangent`
}

Touch AxialLaw::touch(const TipStart& tip, const Bending& bending) const {
  return {.blade = tip.number,
          .slip = tip.slip,
          .bending = tip.straight ? 0.0 : table(tip.number).bending(bending.argument),
          .yielding = bending.yielding,
          .straight = tip.straight,
          .skims = tip.skims,
          .share = bending.share};
}

contact::TipForce AxialLaw::force(const Touch& touch, const contact::Pose& at, double speed) const {
  const contact::ElasticaContact& law = of(touch.blade);
  if (touch.straight) return law.straight_force(at, touch.slip, speed);
  const contact::TipForce force = law.constraint(at, touch.slip, touch.bending, speed).force;
  return touch.skims ? rotor::share_of(force, touch.share) : force;
}

/// g/Δ, or g/2R of a column that bends from above the ring, where g/Δ has no limit.
double AxialLaw::gap_measure(const Touch& touch, const contact::Pose& at) const {
  if (touch.skims) return touch.share + kShareBeyond;
  const contact::ElasticaContact& law = of(touch.blade);
  return law.may_stand_straight() ? at.gap / (2.0 * law.geometry().ring_radius)
                                  : law.gap_per_deflection(at, touch.slip, touch.bending);
}

BladeStart AxialLaw::start(const Touch& touch, const contact::Pose& at, double speed) const {
  BladeStart there = starts(touch, force(touch, at, speed), gap_measure(touch, at));
  if (touch.skims) there.start_cone_left = 1.0 + kShareBeyond - touch.share;
  if (!touch.straight) return there;
  // Of a column that has just straightened no load is left, to rounding.
  constexpr double kLeast = 1e-12;
  const double buckling = numbers(touch.blade).buckling_load;
  there.start_cone_left = std::max(buckling - there.force.normal, kLeast * buckling);
  return there;
}

ArcLaw::Tangent AxialLaw::tangent(const Touch& touch, const contact::Pose& at, double speed,
                                  const std::complex<double>& /*acceleration*/) const {
  if (touch.straight) return {1.0, 0.0, 0.0};
  const contact::ElasticaContact& law = of(touch.blade);
  const auto there = law.constraint(at, touch.slip, touch.bending, speed);
  // dh = h_u du/dp dp + h_τ dτ
  const double slope = there.bending_slope * table(touch.blade).bending_slope_at(touch.bending);
  return {-slope, there.time_slope, 0.0};
}

}  // namespace rubatlas::collocation
