/// Which tips of rigid blades rest on the ring: the friction on a tip at rest is the one that keeps it there.
///
/// The slip velocities v of the tips at rest stay zero, and dv/dτ of each is linear in the friction q = c
/// F/(m ωn²) at all of them (`contact/sticking.hpp`), so that q solves a system with the cosines between the
/// tangents (`collocation/straight_tips.hpp`). A tip comes loose where |c| > μs (Filippov's sliding mode on v
/// = 0; with two tips, on the intersection). No more than two can rest: with v = Ω (|r| − p·n), p the rotor's
/// instantaneous centre, all of them touch the ring where a tangent to it leads to p.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "collocation/straight_tips.hpp"
#include "contact/sticking.hpp"
#include "modes/rest_judge.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

class RestOfRigidBlades : public RestJudge, public collocation::StraightTips {
 public:
  using StraightTips::StraightTips;

  /// Of the contacts with s = 0 in a state, those stay at rest that friction can hold; the others get the
  /// direction in which they are pulled. A rigid tip can always do either: true.
  bool settle(const State& state, std::vector<OpenContact>& contacts) override {
    std::size_t count = 0;
    for (OpenContact& contact : contacts) {
      if (contact.slip == 0.0 && ++count > contact::kMostAtRest) contact.slip = 1.0;
    }
    if (count == 0) return true;
    while (true) {
      hold(state, contacts);
      OpenContact* loosest = nullptr;
      double most = 0.0;
      for (OpenContact& contact : contacts) {
        if (contact.slip != 0.0) continue;
        const double beyond = excess(state, contact);
        if (beyond <= most) continue;
        most = beyond;
        loosest = &contact;
      }
      if (loosest == nullptr) return true;
      loosest->slip = loosest->holding >= 0.0 ? 1.0 : -1.0;
    }
  }
  /// Where two tips rest already, a third passes through.
  bool arrest(const State& /*state*/, const std::vector<OpenContact>& contacts,
              OpenContact& contact) override {
    const auto count = std::ranges::count(contacts, 0.0, &OpenContact::slip);
    contact.slip = count >= static_cast<std::ptrdiff_t>(contact::kMostAtRest) ? -contact.slip : 0.0;
    return true;
  }
  /// It slips the way it is pulled.
  bool let_go(const State& state, const std::vector<OpenContact>& contacts, OpenContact& contact) override {
    std::vector<OpenContact> held = contacts;
    hold(state, held);
    contact.slip = std::copysign(1.0, std::ranges::find(held, contact.blade, &OpenContact::blade)->holding);
    return true;
  }

  /// What friction has to give on a tip that is held in a state beyond what it can [N]: the tip comes loose
  /// where it is positive.
  [[nodiscard]] double excess(const State& state, const OpenContact& held) const {
    const double load = law_->force(held, tip_place(held.blade, state)).normal;
    return std::abs(held.holding * load) - contact::largest_at_rest(law_->friction()) * load;
  }
};

}  // namespace rubatlas::modes
