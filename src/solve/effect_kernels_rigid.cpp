// Rigid blades on the elastic ring, with any friction law.

#include "contact/elastic_ring_contact.hpp"
#include "solve/effect_kernels.hpp"
#include "solve/friction_choice.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> rigid_blades_with_effects(const LineRequest& request) {
  const scene::Scene& line = request.line;
  return with_friction(line, [&](const auto& friction) {
    return with_law(line, [&](const scene::Blades& blade) {
      return contact::RigidBladeContact(geometry_of(line.ring, blade), line.ring.stiffness, friction);
    });
  });
}

}  // namespace rubatlas::solve
