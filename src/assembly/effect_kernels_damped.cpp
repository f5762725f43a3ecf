// Blades on a ring with a damper beside its spring under each tip.

#include "assembly/effect_kernels.hpp"
#include "contact/damped_ring.hpp"
#include "contact/elastica_contact.hpp"
#include "motion/modes_of_damped_ring.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_blades_on_damped_ring(const FamilyRequest& request) {
  const settings::Scene& line = request.line;
  const double damping = line.contact_damping->damping * line.rotor.natural_frequency;
  if (line.contact.law == settings::ContactLaw::elastic_ring) {
    return with_law(request, [&](const settings::Blades& blade) {
      return contact::RigidBladeOnDampedRing(geometry_of(line.ring, blade), {line.ring.stiffness, damping},
                                             {line.contact.friction});
    });
  }
  return with_law(request, [&](const settings::Blades& blade) {
    return contact::ElasticBladeOnDampedRing(
        {geometry_of(line.ring, blade), blade_of(blade), curve_of(request, blade)},
        {1.0 / line.yielding_ring->compliance, damping});
  });
}

}  // namespace rubatlas::assembly
