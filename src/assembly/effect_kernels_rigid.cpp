// Rigid blades on the elastic ring, with any friction law.

#include "assembly/effect_kernels.hpp"
#include "assembly/friction_choice.hpp"
#include "contact/elastic_ring_contact.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> rigid_blades_with_effects(const LineRequest& request) {
  const settings::Scene& line = request.line;
  return with_friction(line, [&](const auto& friction) {
    return with_law(line, [&](const settings::Blades& blade) {
      return contact::RigidBladeContact(geometry_of(line.ring, blade), line.ring.stiffness, friction);
    });
  });
}

}  // namespace rubatlas::assembly
