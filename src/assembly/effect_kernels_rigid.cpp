// Rigid blades on the elastic ring, with any friction law.

#include "assembly/effect_kernels.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "motion/modes_of_rigid_blades.hpp"
#include "variation/friction_of_scene.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_rigid_blades(const FamilyRequest& request) {
  const settings::Scene& line = request.line;
  return variation::with_friction(line, [&](const auto& friction) {
    return with_law(request, [&](const settings::Blades& blade) {
      return contact::RigidBladeContact(geometry_of(line.ring, blade), line.ring.stiffness, friction);
    });
  });
}

}  // namespace rubatlas::assembly
