/// The compiled motions of elastic blades under an axial load, released at the ring or at the fold.
#pragma once

#include <memory>
#include <type_traits>

#include "assembly/effect_kernels.hpp"
#include "contact/elastica_contact.hpp"
#include "motion/modes_of_axial_loads.hpp"

namespace rubatlas::assembly {

/// Elastic blades in a rigid ring or in one that yields.
template <contact::Release kRelease>
std::unique_ptr<point::LineSolver> elastic_blades_in_any_ring(const FamilyRequest& request) {
  const settings::Scene& line = request.line;
  const auto with_ring = [&](const auto& ring) {
    using Law = contact::ElasticBladeContact<std::remove_cvref_t<decltype(ring)>, kRelease>;
    return with_law(request, [&](const settings::Blades& blade) {
      return Law(geometry_of(line.ring, blade), blade_of(blade), curve_of(request, blade), ring);
    });
  };
  if (request.combination.consumed.contains<&effects::Effects::yielding_ring>()) {
    return with_ring(contact::YieldingRing{1.0 / line.yielding_ring->compliance});
  }
  return with_ring(contact::RigidRing{});
}

}  // namespace rubatlas::assembly
