#include "modes/skimming_judge.hpp"

#include <cstddef>

#include "rotor/skimming.hpp"

namespace rubatlas::modes {

/// The motion without the blade, under the force of the others, as the blade sees it.
struct SkimmingJudge::FreeMotion {
  contact::BladeDirection direction;
  contact::Pose pose;
  double curvature;  ///< g'' [m² per unit τ²]
};

bool SkimmingJudge::begins(const State& state, const std::vector<OpenContact>& contacts, double hop) const {
  const auto others = force_of_others(state, contacts);
  if (!others) return false;
  // Hops are seldom that low: the blade's force is asked for only where they are.
  OpenContact contact = contacts.front();
  const FreeMotion free = free_motion(state, contact.blade, *others);
  const double rate = contact::gap_rate(law_->geometry(contact.blade), free.pose, angular_speed(state));
  if (!(rate * rate <= 4.0 * ring_radius() * hop * free.curvature)) return false;
  const auto balance = weigh(state, contact, *others);
  return balance && balance->share > 0.0 && balance->share < 1.0;
}

std::optional<SkimmingJudge::Balance> SkimmingJudge::weigh(const State& state, OpenContact& contact,
                                                           const std::complex<double>& others) const {
  const FreeMotion free = free_motion(state, contact.blade, others);
  contact::TipForce force{};
  contact::Pose on_ring = free.pose;
  on_ring.gap = 0.0;  // what rounding leaves of it would bend a blade of hardly any friction
  if (!law_->respond({on_ring, angular_speed(state)}, contact, force)) return std::nullopt;
  const double share = -free.curvature / rotor::pushed_gap_curvature(machine(), law_->geometry(contact.blade),
                                                                     free.pose, force);
  return Balance{contact::on_rotor(force, free.direction), share, rotor::share_of(force, share)};
}

std::optional<std::complex<double>> SkimmingJudge::force_of_others(
    const State& state, const std::vector<OpenContact>& contacts) const {
  std::complex<double> sum;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    OpenContact open = contacts[i];
    contact::TipForce force{};
    if (!law_->respond(tip_place(open.blade, state), open, force)) return std::nullopt;
    sum += contact::on_rotor(force, direction(state, open.blade));
  }
  return sum;
}

SkimmingJudge::FreeMotion SkimmingJudge::free_motion(const State& state, int blade,
                                                     const std::complex<double>& others) const {
  const contact::BladeDirection er = direction(state, blade);
  const contact::Geometry& geometry = law_->geometry(blade);
  const contact::Pose at = rotor::pose_of(rotor(), geometry, er, rotor::from_ring(state));
  return {er, at, rotor::free_gap_curvature(machine(), geometry, er, at, state, others)};
}

}  // namespace rubatlas::modes
