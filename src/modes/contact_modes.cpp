#include "modes/contact_modes.hpp"

#include <complex>
#include <utility>

#include "modes/rest_of_rigid_blades.hpp"

namespace rubatlas::modes {

ContactModes::ContactModes(const rotor::Machine& machine, std::unique_ptr<Law> law,
                           const ContactLimits& limits, WorkMeter& meter, MakePhases* make_phases)
    : TipPlaces(machine, *law),
      own_law_(std::move(law)),
      setup_{&machine, own_law_.get(), limits, &meter},
      make_phases_(make_phases) {
  if (law_->may_skim()) skimming_judge_.emplace(machine, *law_);
  if (law_->sticks()) {
    if (law_->is_rigid())
      judge_ = std::make_unique<RestOfRigidBlades>(machine, *law_);
    else
      judge_ = std::make_unique<RestOfElasticBlades>(machine, *law_);
  }
  std::vector<contact::DirectedElastica> at_rest;
  for (int k = 0; k < machine.blades.count(); ++k) {
    if (auto law_of_rest = law_->law_of_rest(k)) at_rest.push_back(std::move(*law_of_rest));
  }
  if (!at_rest.empty()) tips_at_rest_.emplace(contact::UnequalBlades(std::move(at_rest)), setup_);
  if (machine.following_ring() != nullptr) ring_placer_.emplace(machine, *law_);
}

bool ContactModes::let_go(const rotor::ContactState& state, const std::vector<OpenContact>& contacts,
                          OpenContact& contact) {
  if (!tips_at_rest_) return judge_ && judge_->let_go(state, contacts, contact);
  tips_at_rest_->judge.leave_rest(contact, state);
  return true;
}

bool ContactModes::comes_to_rest(const rotor::ContactState& state, OpenContact& contact) const {
  if (!tips_at_rest_) return false;
  OpenContact there = contact;
  if (!tips_at_rest_->judge.come_to_rest(there, state)) return false;
  contact = there;
  return true;
}

void ContactModes::set_out_from_rest(rotor::ShaftAndRing& state, const TipPlace& at, double time,
                                     OpenContact contact) const {
  contact::TipForce force{};
  if (!law_->respond(at, contact, force) || !(force.normal > 0.0)) return;
  if (!(contact.slip * force.slip_velocity < 0.0)) return;
  // The force is −F (n + c t), t = i n.
  const contact::BladeDirection er = blades().direction(contact.blade, blades().first(time));
  const double coefficient = law_->friction().coefficient(force.slip_velocity, contact.slip);
  const std::complex<double> tangent =
      -contact::on_rotor(force, er) / (force.normal * std::complex<double>(coefficient, -1.0));
  state[2] -= force.slip_velocity * tangent.real();
  state[3] -= force.slip_velocity * tangent.imag();
}

}  // namespace rubatlas::modes
