// Rigid blades on the elastic ring, whose tips may stick.

#include "contact/elastic_ring_contact.hpp"
#include "solve/effect_kernels.hpp"

namespace rubatlas::solve {

std::unique_ptr<LineSolver> sticking_blades_with_effects(const LineRequest& request) {
  const scene::Scene& line = request.line;
  const double friction = line.contact.friction;
  const contact::StickingFriction law{friction, line.stick->static_ratio * friction};
  return with_law(line, [&](const scene::Blades& blade) {
    return contact::RigidBladeContact(geometry_of(line.ring, blade), line.ring.stiffness, law);
  });
}

}  // namespace rubatlas::solve
