// Rigid blades on the elastic ring, whose tips may stick.

#include "assembly/effect_kernels.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "motion/modes_of_rigid_blades.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_sticking_rigid_blades(const FamilyRequest& request) {
  const settings::Scene& line = request.line;
  const double friction = line.contact.friction;
  const contact::StickingFriction law{friction, line.stick->static_ratio * friction};
  return with_law(request, [&](const settings::Blades& blade) {
    return contact::RigidBladeContact(geometry_of(line.ring, blade), line.ring.stiffness, law);
  });
}

}  // namespace rubatlas::assembly
