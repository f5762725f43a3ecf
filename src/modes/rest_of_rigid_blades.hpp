/// Which tips of rigid blades rest on the ring: the friction on a tip at rest is the one that keeps it there.
///
/// The slip velocities v of the tips at rest stay zero, and dv/dτ of each is linear in the friction q = c
/// F/(m ωn²) at all of them (`contact/sticking.hpp`), so that q solves a system with the cosines between the
/// tangents. A tip comes loose where |c| > μs (Filippov's sliding mode on v = 0; with two tips, on the
/// intersection). No more than two can rest: with v = Ω (|r| − p·n), p the rotor's instantaneous centre, all
/// of them touch the ring where a tangent to it leads to p.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "contact/sticking.hpp"
#include "contact/tip.hpp"
#include "modes/rest_judge.hpp"
#include "modes/tip_places.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

class RestOfRigidBlades : public RestJudge, public TipPlaces {
 public:
  using State = rotor::ContactState;
  using Contacts = std::span<const OpenContact>;
  using TipPlaces::TipPlaces;

  /// Of the contacts with s = 0 in a state, those stay at rest that friction can hold; the others get the
  /// direction in which they are pulled. A rigid tip can always do either: true.
  bool settle(const State& state, std::vector<OpenContact>& contacts) override;
  /// Where two tips rest already, a third passes through.
  bool arrest(const State& state, const std::vector<OpenContact>& contacts, OpenContact& contact) override;
  /// It slips the way it is pulled.
  bool let_go(const State& state, const std::vector<OpenContact>& contacts, OpenContact& contact) override;

  struct AtRest {
    std::size_t contact = 0;
    std::complex<double> direction;  ///< er
    std::complex<double> tangent;    ///< t
    double load = 0.0;               ///< F/(m ωn²) [m per unit τ²]
    double largest = 0.0;            ///< |c| up to which it is held [-]
    double pull = 0.0;  ///< q [m per unit τ²]: dv/dτ without friction at the tips at rest, then shared out
    /// What friction has to give beyond what it can [m per unit τ²]: the tip comes loose where it is
    /// positive.
    [[nodiscard]] double excess() const { return std::abs(pull) - largest * load; }
    [[nodiscard]] double coefficient() const { return pull / load; }  ///< c [-]
  };
  /// The motion, and the tips at rest, whose friction is worked out of it.
  struct Balance {
    std::complex<double> acceleration;  ///< z''
    std::array<AtRest, contact::kMostAtRest> at_rest{};
    std::size_t count = 0;
  };
  [[nodiscard]] Balance balance(const State& state, Contacts contacts) const;
  /// A tip at rest of these contacts.
  [[nodiscard]] AtRest at_rest(const State& state, Contacts contacts, const OpenContact& contact) const;

  /// A contact under the friction of its slip, of which one at rest has none.
  struct Slipping {
    contact::BladeDirection direction;
    contact::Pose pose;
    contact::TipForce force;
  };
  [[nodiscard]] Slipping slipping(OpenContact contact, const State& state) const;
  [[nodiscard]] AtRest at_rest(Contacts contacts, std::size_t contact, const Slipping& at) const;
};

}  // namespace rubatlas::modes
