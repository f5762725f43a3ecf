/// The hybrid method: closed-form flight, contacts in steps of a Runge–Kutta pair, located events.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "scene/scene.hpp"
#include "solve/blade_set.hpp"
#include "solve/motion.hpp"
#include "solve/point_motion.hpp"
#include "solve/rotor.hpp"

namespace rubatlas::solve {

/// `Pair`: the Runge–Kutta coefficients in contact.
template <class Pair>
struct HybridMethod {
  /// `kMayChange`: the machine may change between revolutions.
  template <bool kMayChange, class Law, class Forcing, class Blades>
  static std::unique_ptr<PointMotion> make(const RotorConstants& rotor, Blades blades, const Law& law,
                                           const Forcing& forcing, const scene::Scene& scene) {
    // No step can be closer than positions are rounded: a clearance of nanometres asks for more.
    const double rounding = std::numeric_limits<double>::epsilon() * scene.ring.radius;
    const ContactLimits limits{std::max(scene.accuracy.tolerance * rotor.length_scale, rounding),
                               scene.validity.max_shortening};
    return std::make_unique<TypedMotion<Motion<Law, Forcing, Pair, Blades>, kMayChange>>(
        rotor, std::move(blades), law, forcing, limits);
  }
};

}  // namespace rubatlas::solve
