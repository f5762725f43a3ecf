#include "modes/contact_modes.hpp"

#include <cmath>
#include <complex>
#include <cstdint>
#include <utility>

namespace rubatlas::modes {

ContactModes::ContactModes(const ModesRequest& request, std::unique_ptr<Law> law)
    : law_(std::move(law)),
      setup_{&request.machine, law_.get(), request.limits, &request.meter},
      make_phases_(request.make_phases) {
  if (law_->may_skim(0)) skimming_judge_.emplace(setup_);
  const int count = request.machine.blades.count();
  judge_ = law_->rest_judge(setup_);
  if (auto law_of_rest = law_->law_of_rest(count)) tips_at_rest_.emplace(std::move(*law_of_rest), setup_);
  if (request.machine.following_ring() != nullptr) ring_placer_.emplace(setup_);
}

std::int64_t ContactModes::price_of_searches() {
  const Law::Kind kind = law_->kind();
  if (!kind.searches_long) return 0;
  const std::uint64_t evaluations = law_->evaluations();
  return static_cast<std::int64_t>(evaluations - std::exchange(paid_evaluations_, evaluations)) *
         kind.price_of_curve;
}

bool ContactModes::begins_to_skim(const rotor::ContactState& state, const std::vector<OpenContact>& contacts,
                                  double hop) const {
  return skimming_judge_ && law_->may_skim(contacts.front().blade) &&
         skimming_judge_->begins(state, contacts, hop);
}

void ContactModes::set_out_from_rest(rotor::ShaftAndRing& state, double time, OpenContact contact) const {
  const rotor::Machine& machine = *setup_.machine;
  const contact::BladeDirection er = machine.blades.direction(contact.blade, machine.blades.first(time));
  const TipPlace at{
      rotor::pose_of(machine.constants, law_->geometry(contact.blade), er, rotor::from_ring(state)),
      machine.blades.angular_speed(time)};
  contact::TipForce force{};
  if (!law_->respond(at, contact, force) || !(force.normal > 0.0)) return;
  if (!(contact.slip * force.slip_velocity < 0.0)) return;
  // The force is −F (n + c t), t = i n.
  const double coefficient = law_->friction_coefficient(contact.blade, force, contact.slip);
  const std::complex<double> tangent =
      -contact::on_rotor(force, er) / (force.normal * std::complex<double>(coefficient, -1.0));
  state[2] -= force.slip_velocity * tangent.real();
  state[3] -= force.slip_velocity * tangent.imag();
}

void ContactModes::leave_law_of_rest(OpenContact& contact) const {
  if (contact.slip == 0.0) contact.slip = std::copysign(1.0, contact.bend.modulus);
  if (law_->bends_in_u()) contact.bending = 0.0;
}

}  // namespace rubatlas::modes
