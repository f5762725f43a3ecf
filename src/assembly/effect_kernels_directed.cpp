// Elastic blades whose load has a direction of its own, or a friction law with a velocity.

#include "assembly/effect_kernels.hpp"
#include "contact/directed_elastica.hpp"
#include "motion/modes_of_inclined_loads.hpp"
#include "variation/friction_of_scene.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_directed_elastic_blades(const FamilyRequest& request) {
  const settings::Scene& line = request.line;
  const auto direction = request.combination.consumed.contains<&effects::Effects::load_direction>()
                             ? contact::LoadDirection::normal
                             : contact::LoadDirection::axial;
  return variation::with_friction(line, [&](const auto& friction) {
    using Law = contact::DirectedElastica<std::remove_cvref_t<decltype(friction)>>;
    return with_law(request, [&](const settings::Blades& blade) {
      return Law(direction, geometry_of(line.ring, blade), blade_of(blade), friction);
    });
  });
}

}  // namespace rubatlas::assembly
