/// Whether a tip that touches down skims the ring, the motion to which ever smaller hops tend where the force
/// starts from a finite value (MODEL 4.2, 4.6, 4.9).
///
/// On the receding side a blade that touches down is thrown back at once. Where the free motion then leads it
/// to the ring again, the hops grow smaller without end; in their limit the tip stays on g = 0 under the
/// share λ of its force that holds it there, 0 <= λ <= 1 (`rotor/skimming.hpp`). At λ = 0 the tip leaves the
/// ring, at λ = 1 it is pressed in. The tip is that of the first contact; the others bear their full force.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "contact/tip.hpp"
#include "modes/rest_judge.hpp"
#include "rotor/bodies.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::modes {

class SkimmingJudge : public TipPlaces {
 public:
  using State = rotor::ContactState;
  using TipPlaces::TipPlaces;

  /// Whether the first of these contacts, which touches down in a state, begins to skim: the blade would be
  /// thrown back and return, at most `hop` [m] away from the ring.
  [[nodiscard]] bool begins(const State& state, const std::vector<OpenContact>& contacts, double hop) const {
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

  /// Free motion against the blade's full force.
  struct Balance {
    std::complex<double> pushed;  ///< its full force on the rotor [N]
    double share;                 ///< λ
    contact::TipForce force;      ///< λ times the force
  };
  /// Of a contact, where the others push the rotor so [N]; none where it has no force.
  [[nodiscard]] std::optional<Balance> weigh(const State& state, OpenContact& contact,
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
  /// What the contacts behind the first do to the rotor [N]; none where one has no force.
  [[nodiscard]] std::optional<std::complex<double>> force_of_others(
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
};

}  // namespace rubatlas::modes
