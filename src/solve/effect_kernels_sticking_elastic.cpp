// Elastic blades under the axial load, whose tips may stick.

#include "contact/directed_elastica.hpp"
#include "solve/effect_kernels.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> sticking_elastic_blades_with_effects(const LineRequest& request) {
  const scene::Scene& line = request.line;
  const double friction = line.contact.friction;
  const contact::StickingFriction sticking{friction, line.stick->static_ratio * friction};
  using Law = contact::DirectedElastica<contact::AxialLoad, contact::StickingFriction>;
  return with_law(line, [&](const scene::Blades& blade) {
    return Law(geometry_of(line.ring, blade), blade_of(blade), sticking);
  });
}

}  // namespace rubatlas::solve
