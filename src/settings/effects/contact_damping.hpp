/// Effect `contact_damping`: a damper beside the ring's spring under each tip.
///
///     F = kr y + cr y'        y: how far the ring yields under the tip; y' here in time, not τ
///
/// This is a massless Kelvin–Voigt ring. It pushes and never pulls: where F comes to zero the tip lifts off
/// and the ring creeps back, y' = −(kr/cr) y; the program does not follow that creep. Rigid blades (law
/// `elastic_ring`): y is the depth of the tip, kr is /ring/stiffness. Elastic blades (`elastica`,
/// `beam_column`) beside /yielding_ring: y is a state of each contact, driven by the force that bends the
/// blade, and kr is 1/compliance. In contact the damper takes the power cr y'² from the energy of rotor,
/// blades and ring.
/// Source: Johnson, Contact Mechanics, 1985, §6.4 (Kelvin solid, foundation model); Goldsmith, Impact, 1960,
/// §4.2 (a damped contact must not pull).
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct ContactDamping {
  double damping = 0.0;  ///< cr [N s/m]

  static constexpr Description kDescription{
      .section = "/contact_damping",
      .meaning = "a damper beside the ring's spring under each tip, which never pulls",
      .equation = "F = kr y + cr y' >= 0 in place of kr y, y how far the ring yields under the tip",
      .source = "Johnson, Contact Mechanics, 1985, section 6.4; Goldsmith, Impact, 1960, section 4.2",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "a state alone no longer says how far the ring has yielded; phase volume shrinks in contact",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&ContactDamping::damping>{.pointer = "/contact_damping/damping",
                                                      .symbol = "cr",
                                                      .unit = "N s/m",
                                                      .meaning = "damping of the ring under each tip",
                                                      .source = "none",
                                                      .range = settings::between(0.0, 1e15)}};
  }
  [[nodiscard]] bool acts() const { return damping != 0.0; }
};

}  // namespace rubatlas::effects
