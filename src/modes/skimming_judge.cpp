#include "modes/skimming_judge.hpp"

#include <cstddef>

#include "rotor/skimming.hpp"

namespace rubatlas::modes {

bool SkimmingJudge::begins(const State& state, const std::vector<OpenContact>& contacts, double hop) const {
  const auto others = force_of_others(state, contacts);
  if (!others) return false;
  // Hops are seldom that low: the blade's force is asked for only where they are.
  OpenContact contact = contacts.front();
  const contact::Geometry& geometry = law_->geometry(contact.blade);
  const contact::BladeDirection er = direction(contact.blade, state);
  const contact::Pose at = pose(contact.blade, state, er);
  const double rate = contact::gap_rate(geometry, at, angular_speed(state));
  const double curvature = rotor::free_gap_curvature(machine(), geometry, er, at, state, *others);
  if (!(rate * rate <= 4.0 * ring_radius() * hop * curvature)) return false;
  const auto balance = weigh(state, contact, *others);
  return balance && balance->share > 0.0 && balance->share < 1.0;
}

std::optional<SkimmingJudge::Balance> SkimmingJudge::weigh(const State& state, OpenContact& contact,
                                                           const std::complex<double>& others) const {
  const contact::Geometry& geometry = law_->geometry(contact.blade);
  const contact::BladeDirection er = direction(contact.blade, state);
  const contact::Pose at = pose(contact.blade, state, er);
  contact::TipForce force{};
  contact::Pose on_ring = at;
  on_ring.gap = 0.0;  // what rounding leaves of it would bend a blade of hardly any friction
  if (!law_->respond({on_ring, angular_speed(state)}, contact, force)) return std::nullopt;
  const double share = rotor::skimming_share(machine(), geometry, er, at, state, others, force);
  return Balance{contact::on_rotor(force, er), share, rotor::share_of(force, share)};
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

}  // namespace rubatlas::modes
