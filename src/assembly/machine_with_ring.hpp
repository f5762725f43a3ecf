/// Machines whose ring moves.
#pragma once

#include "modes/ring_flight.hpp"
#include "rotor/bodies.hpp"
#include "rotor/ring_body.hpp"
#include "settings/scene.hpp"

namespace rubatlas::assembly {

/// A machine whose ring is a body on a spring and a damper.
template <class Machine>
class InRingBody {
 public:
  static constexpr bool kMayChange = false;
  explicit InRingBody(const settings::Scene& line)
      : machine_(line),
        ring_(line.ring_body->mass, 1.0 / line.ring_body->compliance, line.ring_body->damping,
              line.rotor.natural_frequency) {}

  [[nodiscard]] auto forcing(double speed_ratio) const {
    return rotor::WithRingBody<decltype(machine_.forcing(speed_ratio))>{machine_.forcing(speed_ratio), ring_};
  }
  [[nodiscard]] auto blades(double speed_ratio) const { return machine_.blades(speed_ratio); }

 private:
  Machine machine_;
  rotor::RingBody ring_;
};

/// A machine whose ring has no mass and stands on a spring.
template <class Machine>
class InFollowingRing {
 public:
  static constexpr bool kMayChange = false;
  explicit InFollowingRing(const settings::Scene& line)
      : machine_(line), stiffness_(1.0 / line.ring_body->compliance) {}

  [[nodiscard]] auto forcing(double speed_ratio) const {
    return rotor::WithFollowingRing<decltype(machine_.forcing(speed_ratio))>{machine_.forcing(speed_ratio),
                                                                             {stiffness_}};
  }
  [[nodiscard]] auto blades(double speed_ratio) const { return machine_.blades(speed_ratio); }

 private:
  Machine machine_;
  double stiffness_;  ///< kr [N/m]
};

}  // namespace rubatlas::assembly
