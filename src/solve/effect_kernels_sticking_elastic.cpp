// Elastic blades under the axial or the normal load, whose tips may stick.

#include "contact/directed_elastica.hpp"
#include "solve/effect_kernels.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> sticking_elastic_blades_with_effects(const LineRequest& request) {
  const scene::Scene& line = request.line;
  const double friction = line.contact.friction;
  const contact::StickingFriction sticking{friction, line.stick->static_ratio * friction};
  const auto with_direction = [&]<class Direction>() {
    using Law = contact::DirectedElastica<Direction, contact::StickingFriction>;
    return with_law(line, [&](const scene::Blades& blade) {
      return Law(geometry_of(line.ring, blade), blade_of(blade), sticking);
    });
  };
  if (effects::acts<&effects::Effects::load_direction>(line)) {
    return with_direction.template operator()<contact::NormalLoad>();
  }
  return with_direction.template operator()<contact::AxialLoad>();
}

}  // namespace rubatlas::solve
