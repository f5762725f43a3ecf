// Blades on a ring with a damper beside its spring under each tip.

#include <utility>

#include "assembly/methods.hpp"
#include "modes/modes_of_damped_ring.hpp"
#include "variation/blades_of_scene.hpp"

namespace rubatlas::assembly {

modes::MakeModes law_of_damped_ring(const LineRequest& request) {
  const settings::Scene& line = request.line;
  const double damping = line.contact_damping->damping * line.rotor.natural_frequency;
  if (line.contact.law == settings::ContactLaw::elastic_ring) {
    std::vector<contact::RigidBladeOnDampedRing> laws;
    for (const settings::Blades& blade : each_blade(line)) {
      laws.emplace_back(variation::geometry_of(line.ring, blade),
                        contact::DampedRing{line.ring.stiffness, damping},
                        contact::CoulombFriction{line.contact.friction});
    }
    return modes::maker_of<modes::ModesOfRigidBladesOnDampedRing<>>(contact::UnequalBlades(std::move(laws)));
  }
  std::vector<contact::ElasticBladeOnDampedRing> laws;
  for (const settings::Blades& blade : each_blade(line)) {
    laws.emplace_back(contact::ElasticaContact(variation::geometry_of(line.ring, blade),
                                               variation::blade_of(blade), curve_of(request, blade)),
                      contact::DampedRing{1.0 / line.yielding_ring->compliance, damping});
  }
  return modes::maker_of<modes::ModesOfElasticBladesOnDampedRing<>>(contact::UnequalBlades(std::move(laws)));
}

}  // namespace rubatlas::assembly
