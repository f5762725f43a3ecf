// Elastic blades whose load has a direction of its own, or a friction law with a velocity.

#include "contact/directed_elastica.hpp"
#include "solve/effect_kernels.hpp"
#include "solve/friction_choice.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> directed_blades_with_effects(const LineRequest& request) {
  const scene::Scene& line = request.line;
  const auto with_direction = [&]<class Direction>() {
    return with_friction(line, [&](const auto& friction) {
      using Law = contact::DirectedElastica<Direction, std::remove_cvref_t<decltype(friction)>>;
      return with_law(line, [&](const scene::Blades& blade) {
        return Law(geometry_of(line.ring, blade), blade_of(blade), friction);
      });
    });
  };
  if (effects::acts<&effects::Effects::load_direction>(line)) {
    return with_direction.template operator()<contact::NormalLoad>();
  }
  return with_direction.template operator()<contact::AxialLoad>();
}

}  // namespace rubatlas::solve
