// Elastic or rigid blades in a ring that is one body, on any machine; rigid ones in such a ring without mass.

#include "assembly/effect_kernels.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::assembly {
namespace {

template <template <class> class InRing, class MakeLaw>
std::unique_ptr<point::LineSolver> in_ring_body(const settings::Scene& line, MakeLaw make_law) {
  using effects::Effects;
  using Hybrid = HybridMethod<integrate::DormandPrince853>;
  auto law = blade_by_blade(line, make_law);
  const auto on_machine = [&]<class Machine>() -> std::unique_ptr<point::LineSolver> {
    return make_point_solver<Hybrid>(line, std::move(law), InRing<Machine>(line));
  };
  if (effects::acts<&Effects::support>(line) || effects::acts<&Effects::speed_ripple>(line)) {
    return on_machine.template operator()<AnyMachine>();
  }
  return on_machine.template operator()<MachineWithEffects>();
}

}  // namespace

std::unique_ptr<point::LineSolver> blades_in_ring_body(const LineRequest& request) {
  const settings::Scene& line = request.line;
  if (line.contact.law == settings::ContactLaw::elastic_ring) {
    const auto rigid_blade = [&](const settings::Blades& blade) {
      return elastic_ring_law(line.ring, blade, line.contact.friction);
    };
    return line.ring_body->mass == 0.0 ? in_ring_body<InFollowingRing>(line, rigid_blade)
                                       : in_ring_body<InRingBody>(line, rigid_blade);
  }
  return in_ring_body<InRingBody>(line, [&](const settings::Blades& blade) {
    return contact::ElasticaContact(geometry_of(line.ring, blade), blade_of(blade), curve_of(request, blade));
  });
}

}  // namespace rubatlas::assembly
