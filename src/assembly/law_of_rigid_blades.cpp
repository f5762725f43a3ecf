// Rigid blades on the elastic ring, with any friction law; on a ring that yields under each tip, is a body,
// or has no mass.

#include <utility>

#include "assembly/methods.hpp"
#include "modes/modes_of_rigid_blades.hpp"
#include "variation/blades_of_scene.hpp"
#include "variation/friction_of_scene.hpp"

namespace rubatlas::assembly {

namespace {

template <class Friction>
std::vector<contact::RigidBladeContact<Friction>> of_blades(const settings::Scene& line,
                                                            const Friction& friction) {
  std::vector<contact::RigidBladeContact<Friction>> laws;
  for (const settings::Blades& blade : each_blade(line))
    laws.emplace_back(variation::geometry_of(line.ring, blade), line.ring.stiffness, friction);
  return laws;
}

}  // namespace

std::vector<contact::ElasticRingContact> elastic_ring_of_blades(const settings::Scene& line) {
  return of_blades(line, contact::CoulombFriction{line.contact.friction});
}

modes::MakeModes law_of_rigid_blades(const LineRequest& request) {
  const settings::Scene& line = request.line;
  if (request.combination.consumed.contains<&effects::Effects::stick>()) {
    const double friction = line.contact.friction;
    const contact::StickingFriction sticking{friction, line.stick->static_ratio * friction};
    return modes::maker_of<modes::ModesOfStickingRigid<>>(contact::UnequalBlades(of_blades(line, sticking)));
  }
  return variation::with_friction(line, [&](const auto& friction) {
    using Friction = std::remove_cvref_t<decltype(friction)>;
    return modes::maker_of<modes::ModesOfRigidBlades<Friction>>(
        contact::UnequalBlades(of_blades(line, friction)));
  });
}

}  // namespace rubatlas::assembly
