// Elastic blades under the axial load, whose tips may stick.

#include "assembly/effect_kernels.hpp"
#include "contact/directed_elastica.hpp"
#include "motion/modes_of_inclined_loads.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_sticking_elastic_blades(const FamilyRequest& request) {
  const settings::Scene& line = request.line;
  const double friction = line.contact.friction;
  const contact::StickingFriction sticking{friction, line.stick->static_ratio * friction};
  using Law = contact::DirectedElastica<contact::StickingFriction>;
  return with_law(request, [&](const settings::Blades& blade) {
    return Law(contact::LoadDirection::axial, geometry_of(line.ring, blade), blade_of(blade), sticking);
  });
}

}  // namespace rubatlas::assembly
