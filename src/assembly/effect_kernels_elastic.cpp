// Elastic blades under an axial load, in a rigid ring or one that yields, released at the ring or at the
// fold.

#include "assembly/effect_kernels.hpp"
#include "contact/elastica_contact.hpp"
#include "motion/modes_of_axial_loads.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_elastic_blades(const FamilyRequest& request) {
  using effects::Effects;
  const settings::Scene& line = request.line;
  const settings::EffectSet& consumed = request.combination.consumed;
  contact::Ring ring;
  if (consumed.contains<&Effects::yielding_ring>()) ring.stiffness = 1.0 / line.yielding_ring->compliance;
  if (consumed.contains<&Effects::release>()) ring.release = contact::Release::at_fold;
  return with_law(request, [&](const settings::Blades& blade) {
    return contact::ElasticaContact(geometry_of(line.ring, blade), blade_of(blade), curve_of(request, blade),
                                    ring);
  });
}

}  // namespace rubatlas::assembly
