/// Modes and reset of blades on a ring with dampers, which yields in its own time.
#pragma once

#include "contact/damped_ring.hpp"
#include "modes/damped_ring.hpp"
#include "motion/modes_of.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
requires contact::kOnDampedRing<Law>
struct ModesOf<Law, Forcing, Pair, Blades> : ModesOfAnyLaw<Law, Pair> {
  using Solved = modes::DampedRingOf<Law, Forcing, Blades>;
};

/// For elastic blades on a ring with dampers: on the receding side a blade stands straight while the ring's
/// load is too small to bend it.
template <>
struct ContactReset<contact::ElasticBladeOnDampedRing> : ResetWithoutUnknowns {
  using Blade = contact::ElasticBladeOnDampedRing;
  static bool open(const Blade& blade, const TipPlace& at, modes::OpenContact& contact) {
    const double load = blade.ring_load(0.0, blade.depth_rate(at.pose, at.speed));
    contact.straight = load < blade.bending_load(at.pose, contact.slip, at.speed);
    return true;
  }
  /// A blade that has unbent to the ring's circle stays in contact, standing straight, where the ring pushes
  /// it.
  static bool straightens(const Blade& blade, const TipPlace& at, modes::OpenContact& contact) {
    const double rate = blade.depth_rate(at.pose, at.speed);
    if (contact.straight || !(blade.ring_load(contact.yielding, rate) > 0.0)) return false;
    contact.straight = true;
    contact.bending = 0.0;
    return true;
  }
};

}  // namespace rubatlas::motion
