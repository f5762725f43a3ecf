// Elastic blades under the axial load, whose tips may stick.

#include "assembly/effect_kernels.hpp"
#include "contact/directed_elastica.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> sticking_elastic_blades_with_effects(const LineRequest& request) {
  const settings::Scene& line = request.line;
  const double friction = line.contact.friction;
  const contact::StickingFriction sticking{friction, line.stick->static_ratio * friction};
  using Law = contact::DirectedElastica<contact::AxialLoad, contact::StickingFriction>;
  return with_law(line, [&](const settings::Blades& blade) {
    return Law(geometry_of(line.ring, blade), blade_of(blade), sticking);
  });
}

}  // namespace rubatlas::assembly
