// Elastic blades under an axial load, in a rigid ring or one that yields, released at the ring or at the
// fold.

#include <memory>

#include "assembly/blade_tables.hpp"
#include "assembly/methods.hpp"
#include "modes/modes_of_axial_loads.hpp"
#include "settings/effects/list.hpp"
#include "variation/blades_of_scene.hpp"

namespace rubatlas::assembly {

std::shared_ptr<const blade::ElasticaCurve> curve_of(const LineRequest& request,
                                                     const settings::Blades& blade) {
  const settings::Scene& line = request.line;
  const auto theory = line.contact.law == settings::ContactLaw::beam_column ? blade::Theory::beam_column
                                                                            : blade::Theory::elastica;
  double compliance = 0.0;
  if (effects::acts<&effects::Effects::axial_compliance>(line)) {
    const double slenderness = blade.thickness / blade.length;
    compliance = line.axial_compliance->share * slenderness * slenderness / 12.0;
  }
  return request.tables.curve(line.contact.friction, theory, compliance);
}

std::vector<contact::ElasticaContact> elastica_of_blades(const LineRequest& request) {
  using effects::Effects;
  const settings::Scene& line = request.line;
  const settings::EffectSet& consumed = request.combination.consumed;
  contact::Ring ring;
  if (consumed.contains<&Effects::yielding_ring>()) ring.stiffness = 1.0 / line.yielding_ring->compliance;
  if (consumed.contains<&Effects::release>()) ring.release = contact::Release::at_fold;
  std::vector<contact::ElasticaContact> laws;
  for (const settings::Blades& blade : each_blade(line)) {
    laws.emplace_back(variation::geometry_of(line.ring, blade), variation::blade_of(blade),
                      curve_of(request, blade), ring);
  }
  return laws;
}

modes::MakeModes law_of_axial_loads(const LineRequest& request) {
  return modes::maker_of<modes::ModesOfAxialLoads<>>(contact::UnequalBlades(elastica_of_blades(request)));
}

}  // namespace rubatlas::assembly
