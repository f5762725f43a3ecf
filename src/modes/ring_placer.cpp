#include "modes/ring_placer.hpp"

#include <algorithm>
#include <limits>

#include "collocation/rigid_law.hpp"
#include "contact/tip.hpp"
#include "rotor/ring_balance.hpp"

namespace rubatlas::modes {

bool RingPlacer::place(State& state, const std::vector<OpenContact>& contacts) const {
  return rotor::RingBalance(machine(), static_cast<const collocation::RigidLaw&>(*law_).blades(), contacts)
      .place(state);
}

bool RingPlacer::settle(rotor::ShaftAndRing& bodies, double time, std::vector<OpenContact>& contacts,
                        const Touches& touches) const {
  // Of R²: rounding of g where a touch-down or a lift-off has been located.
  constexpr double kGapRounding = 32.0 * std::numeric_limits<double>::epsilon();
  const double rounding = kGapRounding * ring_radius() * ring_radius();
  for (int change = 0; change <= 2 * blades().count(); ++change) {
    State full = rotor::full_state(bodies, time, 0.0);
    if (!place(full, contacts)) return false;
    bodies = rotor::bodies(full);
    int enters = -1;
    double deepest = rounding;
    auto leaves = contacts.end();
    for (int k = 0; k < blades().count(); ++k) {
      const double gap = pose(k, full).gap;
      const auto open = std::ranges::find(contacts, k, &OpenContact::blade);
      if (open == contacts.end() && gap > deepest) {
        deepest = gap;
        enters = k;
      }
      if (open != contacts.end() && gap < -rounding) leaves = open;
    }
    if (leaves != contacts.end()) {
      contacts.erase(leaves);
    } else if (enters < 0) {
      // All contacts have to slip in the direction of their s.
      return std::ranges::all_of(contacts, [&](const OpenContact& contact) {
        const double velocity = contact::undeformed_slip_velocity(
            law_->geometry(contact.blade), pose(contact.blade, full), angular_speed(full));
        return contact.slip * velocity >= -slip_rounding(full);
      });
    } else if (!touches(enters)) {
      return false;
    }
  }
  return false;
}

}  // namespace rubatlas::modes
