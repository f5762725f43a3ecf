/// What moves and what turns at one point, chosen at run time: the shaft on its support with what acts on it,
/// the blades on the hub, and the ring.
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "rotor/any_shaft.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/harmonic.hpp"
#include "rotor/ring_body.hpp"
#include "rotor/rippling_blades.hpp"

namespace rubatlas::rotor {

/// A ring that stands still, has no mass, or is a body.
using Ring = std::variant<std::monostate, FollowingRing, RingBody>;

struct Machine {
  RotorConstants constants;
  RipplingBlades blades;
  AnyShaft shaft;
  Ring ring;

  /// Null where the ring is no body.
  [[nodiscard]] const RingBody* ring_body() const { return std::get_if<RingBody>(&ring); }
  /// What acts on an isotropic shaft; null where the shaft has another support.
  [[nodiscard]] const Harmonics* harmonics() const { return std::get_if<Harmonics>(&shaft.shaft); }
  /// Null where the shaft is isotropic.
  [[nodiscard]] const SupportedShaft* supported() const { return std::get_if<SupportedShaft>(&shaft.shaft); }
};

/// The same of what a motion is compiled for.
inline Machine machine_of(const RotorConstants& rotor, const RipplingBlades& blades, const AnyShaft& shaft) {
  return {rotor, blades, shaft, {}};
}
inline Machine machine_of(const RotorConstants& rotor, const RipplingBlades& blades,
                          const Harmonics& forcing) {
  return {rotor, blades, {forcing}, {}};
}
inline Machine machine_of(const RotorConstants& rotor, const RipplingBlades& blades,
                          const NoForcing& /*forcing*/) {
  return {rotor, blades, {Harmonics({})}, {}};
}
inline Machine machine_of(const RotorConstants& rotor, const RipplingBlades& blades,
                          const Harmonic& forcing) {
  return {rotor, blades, {Harmonics({forcing})}, {}};
}
template <class Forcing>
requires kRingMoves<Forcing> Machine machine_of(const RotorConstants& rotor, const RipplingBlades& blades,
                                                const Forcing& forcing) {
  Machine machine = machine_of(rotor, blades, forcing.shaft);
  machine.ring = forcing.ring;
  return machine;
}

}  // namespace rubatlas::rotor
