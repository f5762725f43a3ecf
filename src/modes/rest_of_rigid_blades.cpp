#include "modes/rest_of_rigid_blades.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "contact/sticking.hpp"

namespace rubatlas::modes {

bool RestOfRigidBlades::settle(const State& state, std::vector<OpenContact>& contacts) {
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

bool RestOfRigidBlades::arrest(const State& /*state*/, const std::vector<OpenContact>& contacts,
                               OpenContact& contact) {
  const auto count = std::ranges::count(contacts, 0.0, &OpenContact::slip);
  contact.slip = count >= static_cast<std::ptrdiff_t>(contact::kMostAtRest) ? -contact.slip : 0.0;
  return true;
}

bool RestOfRigidBlades::let_go(const State& state, const std::vector<OpenContact>& contacts,
                               OpenContact& contact) {
  std::vector<OpenContact> held = contacts;
  hold(state, held);
  contact.slip = std::copysign(1.0, std::ranges::find(held, contact.blade, &OpenContact::blade)->holding);
  return true;
}

double RestOfRigidBlades::excess(const State& state, const OpenContact& held) const {
  const double load = law_->force(held, tip_place(held.blade, state)).normal;
  return std::abs(held.holding * load) - contact::largest_at_rest(law_->friction()) * load;
}

}  // namespace rubatlas::modes
