#include "modes/rest_of_rigid_blades.hpp"

#include <algorithm>

#include "rotor/constants.hpp"

namespace rubatlas::modes {

bool RestOfRigidBlades::settle(const State& state, std::vector<OpenContact>& contacts) {
  std::size_t count = 0;
  for (OpenContact& contact : contacts) {
    if (contact.slip == 0.0 && ++count > contact::kMostAtRest) contact.slip = 1.0;
  }
  if (count == 0) return true;
  while (true) {
    const Balance now = balance(state, contacts);
    const AtRest* loosest = nullptr;
    for (std::size_t i = 0; i < now.count; ++i) {
      const AtRest& tip = now.at_rest[i];
      if (tip.excess() <= 0.0) continue;
      if (loosest == nullptr || tip.excess() > loosest->excess()) loosest = &tip;
    }
    if (loosest == nullptr) return true;
    contacts[loosest->contact].slip = loosest->pull >= 0.0 ? 1.0 : -1.0;
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
  contact.slip = std::copysign(1.0, at_rest(state, contacts, contact).coefficient());
  return true;
}

RestOfRigidBlades::Slipping RestOfRigidBlades::slipping(OpenContact contact, const State& state) const {
  Slipping result{direction(contact.blade, state), pose(contact.blade, state), {}};
  law_->respond({result.pose, angular_speed(state)}, contact, result.force);
  return result;
}

RestOfRigidBlades::AtRest RestOfRigidBlades::at_rest(Contacts contacts, std::size_t contact,
                                                     const Slipping& at) const {
  const std::complex<double> er(at.direction.cosine, at.direction.sine);
  return {.contact = contact,
          .direction = er,
          .tangent = er * contact::tangent(law_->geometry(contacts[contact].blade), at.pose),
          .load = at.force.normal * rotor().force_unit,
          .largest = contact::largest_at_rest(law_->friction())};
}

RestOfRigidBlades::Balance RestOfRigidBlades::balance(const State& state, Contacts contacts) const {
  Balance result;
  std::complex<double> force;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Slipping at = slipping(contacts[i], state);
    force += contact::on_rotor(at.force, at.direction);
    if (contacts[i].slip == 0.0) result.at_rest[result.count++] = at_rest(contacts, i, at);
  }
  result.acceleration = machine().acceleration(state, force).shaft;
  const std::span<AtRest> tips(result.at_rest.data(), result.count);
  for (AtRest& tip : tips) {
    const contact::Geometry& geometry = law_->geometry(contacts[tip.contact].blade);
    const std::complex<double> seen = result.acceleration * std::conj(tip.direction);
    // The hub's own angular acceleration moves the tip across the blade.
    const double turning = geometry.reach * blades().angular_acceleration(state[rotor::kTime]);
    tip.pull = contact::slip_acceleration(geometry, pose(contacts[tip.contact].blade, state),
                                          angular_speed(state), {seen.real(), seen.imag() + turning});
  }
  contact::share_out(tips);
  for (const AtRest& tip : tips) result.acceleration -= tip.pull * tip.tangent;
  return result;
}

RestOfRigidBlades::AtRest RestOfRigidBlades::at_rest(const State& state, Contacts contacts,
                                                     const OpenContact& contact) const {
  const Balance now = balance(state, contacts);
  const bool is_second = now.count == 2 && contacts[now.at_rest[1].contact].blade == contact.blade;
  return now.at_rest[is_second ? 1 : 0];
}

}  // namespace rubatlas::modes
