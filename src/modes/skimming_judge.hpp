/// Whether a tip that touches down skims the ring, the motion to which ever smaller hops tend where the force
/// starts from a finite value (MODEL 4.2, 4.6, 4.9).
///
/// On the receding side a blade that touches down is thrown back at once. Where the free motion then leads it
/// to the ring again, the hops grow smaller without end; in their limit the tip stays on g = 0 under the
/// share λ of its force that holds it there, 0 <= λ <= 1 (`rotor/skimming.hpp`). At λ = 0 the tip leaves the
/// ring, at λ = 1 it is pressed in. The tip is that of the first contact; the others bear their full force.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "contact/tip.hpp"
#include "modes/rest_judge.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

class SkimmingJudge : public TipPlaces {
 public:
  using State = rotor::ContactState;
  using TipPlaces::TipPlaces;

  /// Whether the first of these contacts, which touches down in a state, begins to skim: the blade would be
  /// thrown back and return, at most `hop` [m] away from the ring.
  [[nodiscard]] bool begins(const State& state, const std::vector<OpenContact>& contacts, double hop) const;

  /// Free motion against the blade's full force.
  struct Balance {
    std::complex<double> pushed;  ///< its full force on the rotor [N]
    double share;                 ///< λ
    contact::TipForce force;      ///< λ times the force
  };
  /// Of a contact, where the others push the rotor so [N]; none where it has no force.
  [[nodiscard]] std::optional<Balance> weigh(const State& state, OpenContact& contact,
                                             const std::complex<double>& others) const;
  /// What the contacts behind the first do to the rotor [N]; none where one has no force.
  [[nodiscard]] std::optional<std::complex<double>> force_of_others(
      const State& state, const std::vector<OpenContact>& contacts) const;
};

}  // namespace rubatlas::modes
