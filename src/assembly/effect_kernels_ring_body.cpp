// Elastic or rigid blades in a ring that is one body, on any machine; rigid ones in such a ring without mass.

#include "assembly/effect_kernels.hpp"
#include "assembly/machine_with_ring.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/modes_of_following_ring.hpp"
#include "motion/modes_of_rigid_blades.hpp"

namespace rubatlas::assembly {
namespace {

template <class MachineInRing, class MakeLaw>
std::unique_ptr<point::LineSolver> in_ring(const FamilyRequest& request, MakeLaw make_law) {
  using Hybrid = HybridMethod<integrate::DormandPrince853>;
  const settings::Scene& line = request.line;
  return make_point_solver<Hybrid>(line, blade_by_blade(line, make_law),
                                   MachineInRing(line, request.combination.machine));
}

template <class MachineInRing>
std::unique_ptr<point::LineSolver> rigid_blades_in_ring(const FamilyRequest& request) {
  const settings::Scene& line = request.line;
  return in_ring<MachineInRing>(request, [&](const settings::Blades& blade) {
    return elastic_ring_law(line.ring, blade, line.contact.friction);
  });
}

}  // namespace

std::unique_ptr<point::LineSolver> make_blades_in_ring_body(const FamilyRequest& request) {
  const settings::Scene& line = request.line;
  if (line.contact.law == settings::ContactLaw::elastic_ring)
    return rigid_blades_in_ring<InRingBody>(request);
  return in_ring<InRingBody>(request, [&](const settings::Blades& blade) {
    return contact::ElasticaContact(geometry_of(line.ring, blade), blade_of(blade), curve_of(request, blade));
  });
}

std::unique_ptr<point::LineSolver> make_blades_in_ring_without_mass(const FamilyRequest& request) {
  return rigid_blades_in_ring<InFollowingRing>(request);
}

}  // namespace rubatlas::assembly
