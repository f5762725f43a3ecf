#include "collocation/damped_law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rubatlas::collocation {
namespace {

AxialLaw::Laws blades_of(const DampedLaw::Laws& laws, int blade_count) {
  std::vector<contact::ElasticaContact> blades;
  for (int k = 0; k < blade_count; ++k) blades.push_back(laws.of(k).blade());
  return AxialLaw::Laws(std::move(blades));
}

}  // namespace

DampedLaw::DampedLaw(const Laws& laws, int blade_count, double max_shortening)
    : BladesOfRing{blades_of(laws, blade_count)},
      AxialLaw(BladesOfRing::blades, blade_count, max_shortening),
      laws_(&laws) {}

Blade DampedLaw::numbers(int blade) const {
  const contact::DampedRing& ring = laws_->of(blade).ring();
  Blade numbers = AxialLaw::numbers(blade);
  numbers.ring_stiffness = ring.stiffness;
  numbers.ring_damping = ring.damping;
  return numbers;
}

/// A new contact stands on the ring, which yields by as much as its tip is deep.
std::optional<Touch> DampedLaw::open(const Touch& touch, const contact::Pose& at, double speed) const {
  const contact::ElasticBladeOnDampedRing& law = laws_->of(touch.blade);
  const double radius = law.geometry().ring_radius;
  Touch found = touch;
  if (touch.touches_down() && touch.yielding == 0.0)
    found.yielding = std::max(0.0, at.gap / (radius + std::sqrt(radius * radius + at.gap)));
  contact::Pose there = at;
  there.gap = touch.touches_down() ? 0.0 : at.gap - found.yielding * (2.0 * radius + found.yielding);
  if (touch.touches_down() && starts_unloaded(touch.blade, touch.slip, there)) return found;
  contact::TipForce force{};
  if (!law.respond(there, touch.slip, speed, found.yielding, found.bending, force)) return std::nullopt;
  return found;
}

Bending DampedLaw::lead(const Touch& touch) {
  Bending bending = AxialLaw::lead(touch);
  bending.yielding = touch.yielding;
  return bending;
}

double DampedLaw::ring_opens(const Touch& touch, const contact::Pose& at, double speed) const {
  const contact::ElasticBladeOnDampedRing& law = laws_->of(touch.blade);
  return 2.0 * (law.geometry().ring_radius + touch.yielding) *
         law.yielding_rate(force(touch, at, speed).normal, touch.yielding);
}

ArcLaw::Start DampedLaw::start(const Touch& touch, const contact::Pose& at, double speed) const {
  Start start = AxialLaw::start(touch, at, speed);
  start.ring_opens = ring_opens(touch, at, speed);
  return start;
}

ArcLaw::Tangent DampedLaw::tangent(const Touch& touch, const contact::Pose& at, double speed,
                                   const std::complex<double>& acceleration) const {
  Tangent along = AxialLaw::tangent(touch, at, speed, acceleration);
  along.argument -= ring_opens(touch, at, speed);
  return along;
}

FurtherStart DampedLaw::further(const Touch& touch, const contact::Pose& at, double speed) {
  return further_start(of(touch.blade), at, touch, speed, ring_opens(touch, at, speed));
}

Touch DampedLaw::touch(int blade, double slip, const Bending& bending) const {
  Touch touch = AxialLaw::touch(blade, slip, bending);
  touch.yielding = bending.yielding;
  return touch;
}

}  // namespace rubatlas::collocation
