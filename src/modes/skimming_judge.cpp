#include "modes/skimming_judge.hpp"

#include <cstddef>

#include "rotor/skimming.hpp"

namespace rubatlas::modes {

bool SkimmingJudge::begins(const State& state, const std::vector<OpenContact>& contacts, double hop) const {
  const auto others = force_of_others(state, contacts);
  if (!others) return false;
  // Hops are seldom that low: the blade's force is asked for only where they are.
  OpenContact contact = contacts.front();
  const double rate =
      contact::gap_rate(law_->geometry(contact.blade), pose(contact.blade, state), angular_speed(state));
  const double curvature = free_curvature(state, contact.blade, *others);
  if (!(rate * rate <= 4.0 * ring_radius() * hop * curvature)) return false;
  const auto balance = weigh(state, contact, *others);
  return balance && balance->share > 0.0 && balance->share < 1.0;
}

std::optional<SkimmingJudge::Balance> SkimmingJudge::weigh(const State& state, OpenContact& contact,
                                                           const std::complex<double>& others) const {
  contact::TipForce force{};
  const contact::Pose at = pose(contact.blade, state);
  contact::Pose on_ring = at;
  on_ring.gap = 0.0;  // what rounding leaves of it would bend a blade of hardly any friction
  if (!law_->respond({on_ring, angular_speed(state)}, contact, force)) return std::nullopt;
  const double share = -free_curvature(state, contact.blade, others) /
                       rotor::pushed_gap_curvature(machine(), law_->geometry(contact.blade), at, force);
  return Balance{contact::on_rotor(force, direction(contact.blade, state)), share,
                 rotor::share_of(force, share)};
}

std::optional<std::complex<double>> SkimmingJudge::force_of_others(
    const State& state, const std::vector<OpenContact>& contacts) const {
  std::complex<double> sum;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    OpenContact open = contacts[i];
    contact::TipForce force{};
    if (!law_->respond(tip_place(open.blade, state), open, force)) return std::nullopt;
    sum += contact::on_rotor(force, direction(open.blade, state));
  }
  return sum;
}

/// g'' [m² per unit τ²] of the motion without the blade, under the force of the others.
double SkimmingJudge::free_curvature(const State& state, int blade,
                                     const std::complex<double>& others) const {
  return rotor::free_gap_curvature(machine(), law_->geometry(blade), direction(blade, state),
                                   pose(blade, state), state, others);
}

}  // namespace rubatlas::modes
