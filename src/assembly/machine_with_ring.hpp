/// Machines whose ring moves.
#pragma once

#include "assembly/machine_with_effects.hpp"
#include "rotor/bodies.hpp"
#include "rotor/ring_body.hpp"
#include "settings/scene.hpp"

namespace rubatlas::assembly {

/// A machine whose ring is a body on a spring and a damper.
class InRingBody {
 public:
  static constexpr bool kMayChange = false;
  InRingBody(const settings::Scene& line, settings::Machine machine)
      : machine_(line, machine),
        ring_(line.ring_body->mass, 1.0 / line.ring_body->compliance, line.ring_body->damping,
              line.rotor.natural_frequency) {}

  [[nodiscard]] auto forcing(double speed_ratio) const {
    return rotor::WithRingBody<rotor::AnyShaft>{machine_.forcing(speed_ratio), ring_};
  }
  [[nodiscard]] rotor::RipplingBlades blades(double speed_ratio) const {
    return machine_.blades(speed_ratio);
  }

 private:
  MachineWithEffects machine_;
  rotor::RingBody ring_;
};

/// A machine whose ring has no mass and stands on a spring.
class InFollowingRing {
 public:
  static constexpr bool kMayChange = false;
  InFollowingRing(const settings::Scene& line, settings::Machine machine)
      : machine_(line, machine), stiffness_(1.0 / line.ring_body->compliance) {}

  [[nodiscard]] auto forcing(double speed_ratio) const {
    return rotor::WithFollowingRing<rotor::AnyShaft>{machine_.forcing(speed_ratio), {stiffness_}};
  }
  [[nodiscard]] rotor::RipplingBlades blades(double speed_ratio) const {
    return machine_.blades(speed_ratio);
  }

 private:
  MachineWithEffects machine_;
  double stiffness_;  ///< kr [N/m]
};

}  // namespace rubatlas::assembly
