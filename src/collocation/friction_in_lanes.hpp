/// Friction laws at eight nodes.
#pragma once

#include "collocation/functions_in_lanes.hpp"
#include "collocation/nodes_in_lanes.hpp"
#include "contact/friction_law.hpp"

namespace rubatlas::collocation {
namespace {

/// c(v) and its slope.
template <std::size_t kWidth>
struct FrictionAtNodes {
  Lanes<kWidth> coefficient, slope;
};
template <std::size_t kWidth>
FrictionAtNodes<kWidth> friction_at(const contact::Friction& law, double slip,
                                    const Lanes<kWidth>& velocity) {
  using Number = Lanes<kWidth>;
  if (law.law == contact::Friction::Law::coulomb) return {Number(slip * law.friction), Number(0.0)};
  const double per_velocity = 1.0 / law.regularising_velocity;
  const Number share = hyperbolic_tangent(velocity * per_velocity);
  const Number rise = (Number(1.0) - share * share) * per_velocity;
  if (law.law == contact::Friction::Law::regularised) return {share * law.friction, rise * law.friction};
  const double excess = law.static_friction - law.friction;
  const Number ratio = velocity * (1.0 / law.stribeck_velocity);
  const Number more = (Number(1.0) - decayed(ratio * ratio)) * excess;
  const Number size = more + law.friction;
  return {size * share, size * rise - ratio * more * share * (2.0 / law.stribeck_velocity)};
}

}  // namespace
}  // namespace rubatlas::collocation
