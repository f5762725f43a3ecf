#include "modes/contact_modes.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <span>
#include <utility>

#include "modes/rest_of_rigid_blades.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::modes {

ContactModes::ContactModes(const rotor::Machine& machine, std::unique_ptr<Law> law,
                           const ContactLimits& limits, WorkMeter& meter, MakePhases* make_phases)
    : TipPlaces(machine, *law),
      own_law_(std::move(law)),
      limits_(limits),
      meter_(&meter),
      make_phases_(make_phases) {
  if (law_->sticks()) {
    if (law_->is_rigid())
      judge_ = std::make_unique<RestOfRigidBlades>(machine, *law_);
    else
      judge_ = std::make_unique<RestOfElasticBlades>(machine, *law_);
  }
  std::vector<contact::DirectedElastica> at_rest;
  for (int k = 0; k < machine.blades.count(); ++k) {
    if (auto law_of_rest = law_->law_of_rest(k)) at_rest.push_back(*law_of_rest);
  }
  if (!at_rest.empty()) law_of_rest_.emplace(std::move(at_rest), false);
}

bool ContactModes::place_ring(rotor::ShaftAndRing& bodies, double time, std::vector<OpenContact>& contacts,
                              const std::function<bool(int blade)>& touches) const {
  // Of R²: rounding of g where a touch-down or a lift-off has been located.
  constexpr double kGapRounding = 32.0 * std::numeric_limits<double>::epsilon();
  const double rounding = kGapRounding * ring_radius() * ring_radius();
  for (int change = 0; change <= 2 * blades().count(); ++change) {
    rotor::ContactState full = rotor::full_state(bodies, time, 0.0);
    if (!law_->place_ring(machine(), contacts, full)) return false;
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

/// The blade would be thrown back and return, where the force starts from a finite value (MODEL 4.2, 4.6):
/// such hops grow smaller without end. In their limit the tip stays on g = 0 under the share λ of its force
/// that holds it there (`rotor/skimming.hpp`), 0 <= λ <= 1. The others bear their full force.
bool ContactModes::begins_to_skim(const rotor::ContactState& state,
                                  std::vector<OpenContact>& contacts) const {
  // In tolerances: hops lower than this are replaced by their limit (MODEL 4.9). Their height may grow by
  // some tens of tolerances while the force changes along the ring.
  constexpr double kUnresolvedHop = 1.0;
  const OpenContact& touches = contacts.back();
  const std::span<const OpenContact> before = std::span(contacts).first(contacts.size() - 1);
  const auto force_of_others = [&](const rotor::ContactState& there) {
    std::complex<double> sum;
    for (const OpenContact& open : before)
      sum += contact::on_rotor(law_->force(open, tip_place(open.blade, there)), direction(open.blade, there));
    return sum;
  };
  const contact::Geometry& geometry = law_->geometry(touches.blade);
  const contact::BladeDirection er = direction(touches.blade, state);
  const double speed = angular_speed(state);
  const contact::Pose at = pose(touches.blade, state, er);
  const double rate = contact::gap_rate(geometry, at, speed);
  const double curvature =
      rotor::free_gap_curvature(machine(), geometry, er, at, state, force_of_others(state));
  const double hop = kUnresolvedHop * limits_.tolerance;
  if (!(rate * rate <= 4.0 * ring_radius() * hop * curvature)) return false;
  // It will be put on the ring.
  rotor::ContactState on_ring = state;
  OpenContact skims = touches;
  if (!touches.touches_down()) {
    rotor::put_on_ring(machine(), geometry, er, speed, on_ring);
    skims = law_->in_equilibrium(touches, {pose(touches.blade, on_ring, er), speed}).value_or(touches);
  }
  const TipPlace there{pose(touches.blade, on_ring, er), speed};
  const double share = rotor::skimming_share(machine(), geometry, er, there.pose, on_ring,
                                             force_of_others(on_ring), law_->force(skims, there));
  if (!(share > 0.0 && share < 1.0)) return false;
  std::swap(contacts.front(), contacts.back());
  return true;
}

bool ContactModes::let_go(const rotor::ContactState& state, const std::vector<OpenContact>& contacts,
                          OpenContact& contact) {
  if (!law_of_rest_) return judge_ && judge_->let_go(state, contacts, contact);
  RestOfElasticBlades(machine(), *law_of_rest_).leave_rest(contact, state);
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
