/// What moves and what turns at one point: the shaft on its support with what acts on it, the blades on the
/// hub, and the ring. Chosen at run time.
#pragma once

#include <complex>
#include <variant>

#include "rotor/any_shaft.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/harmonic.hpp"
#include "rotor/ring_body.hpp"
#include "rotor/support_matrices.hpp"

namespace rubatlas::rotor {

/// A ring without mass on a spring, which stands where blades push it, and in its place where none does.
struct FollowingRing {
  double stiffness;  ///< kr [N/m]
};

/// A ring that stands still, has no mass, or is a body.
using Ring = std::variant<std::monostate, FollowingRing, RingBody>;

struct Machine {
  RotorConstants constants;
  BladeSet blades;
  AnyShaft shaft;
  Ring ring;

  /// Null where the ring is no body.
  [[nodiscard]] const RingBody* ring_body() const { return std::get_if<RingBody>(&ring); }
  /// Null where the ring has a mass, or stands still.
  [[nodiscard]] const FollowingRing* following_ring() const { return std::get_if<FollowingRing>(&ring); }
  [[nodiscard]] bool ring_moves() const { return ring.index() != 0; }
  /// What acts on an isotropic shaft; null where the shaft has another support.
  [[nodiscard]] const Harmonics* harmonics() const { return std::get_if<Harmonics>(&shaft.shaft); }
  /// Null where the shaft is isotropic.
  [[nodiscard]] const SupportedShaft* supported() const { return std::get_if<SupportedShaft>(&shaft.shaft); }

  /// K and C of the shaft.
  [[nodiscard]] SupportMatrices support() const {
    if (const SupportedShaft* other = supported())
      return {other->support.stiffness(), other->support.damping()};
    return isotropic_shaft(constants.damping_ratio);
  }

  /// Accelerations in a state of contact where blades push the shaft by `force` [N], and the ring by as much
  /// the other way. A ring without mass has none: its velocity follows from the shaft's.
  template <class FullState>
  [[nodiscard]] Acceleration acceleration(const FullState& state, const std::complex<double>& force) const {
    Acceleration result{shaft.acceleration(constants, state[kTime], state.template head<4>(), force), 0.0};
    if (const RingBody* body = ring_body()) result.ring = body->acceleration(rotor::ring(state), -force);
    return result;
  }
  /// Acceleration of one newton between shaft and ring, as a contact sees it [m/N].
  [[nodiscard]] double closing_unit() const {
    const RingBody* body = ring_body();
    return constants.force_unit + (body ? body->force_unit() : 0.0);
  }
};

}  // namespace rubatlas::rotor
