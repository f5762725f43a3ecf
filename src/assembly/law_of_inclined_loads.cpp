// Elastic blades whose load has a direction of its own, a friction law with a velocity, or whose tips may
// stick.

#include <type_traits>

#include "assembly/methods.hpp"
#include "modes/modes_of_inclined_loads.hpp"
#include "settings/effects/list.hpp"
#include "variation/blades_of_scene.hpp"
#include "variation/friction_of_scene.hpp"

namespace rubatlas::assembly {

namespace {

template <class Modes, class Friction>
modes::MakeModes of_blades(const LineRequest& request, const Friction& friction) {
  const settings::Scene& line = request.line;
  const auto direction = request.combination.consumed.contains<&effects::Effects::load_direction>()
                             ? contact::LoadDirection::normal
                             : contact::LoadDirection::axial;
  std::vector<contact::DirectedElastica<Friction>> laws;
  for (const settings::Blades& blade : each_blade(line)) {
    laws.emplace_back(direction, variation::geometry_of(line.ring, blade), variation::blade_of(blade),
                      friction);
  }
  return modes::maker_of<Modes>(contact::UnequalBlades(std::move(laws)));
}

}  // namespace

modes::MakeModes law_of_inclined_loads(const LineRequest& request) {
  const settings::Scene& line = request.line;
  if (request.combination.consumed.contains<&effects::Effects::stick>()) {
    const double friction = line.contact.friction;
    const contact::StickingFriction sticking{friction, line.stick->static_ratio * friction};
    return of_blades<modes::ModesOfStickingInclined<>>(request, sticking);
  }
  return variation::with_friction(line, [&](const auto& friction) {
    using Friction = std::remove_cvref_t<decltype(friction)>;
    using Modes = std::conditional_t<std::is_same_v<Friction, contact::CoulombFriction>,
                                     modes::ModesOfInclinedCoulomb<>, modes::ModesOfInclinedVelocity<>>;
    return of_blades<Modes>(request, friction);
  });
}

}  // namespace rubatlas::assembly
