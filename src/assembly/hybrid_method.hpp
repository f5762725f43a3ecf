/// The hybrid method: closed-form flight, contacts in steps of a Runge–Kutta pair, or by collocation where
/// that is asked for, located events.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "motion/motion.hpp"
#include "motion/point_motion.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"
#include "settings/scene.hpp"

namespace rubatlas::assembly {

/// `Pair`: the Runge–Kutta coefficients in contact.
template <class Pair>
struct HybridMethod {
  /// `kMayChange`: the machine may change between revolutions.
  template <bool kMayChange, class Law, class Forcing, class Blades>
  static std::unique_ptr<motion::PointMotion> make(const rotor::RotorConstants& rotor, Blades blades,
                                                   const Law& law, const Forcing& forcing,
                                                   const settings::Scene& scene) {
    // No step can be closer than positions are rounded: a clearance of nanometres asks for more.
    const double rounding = std::numeric_limits<double>::epsilon() * scene.ring.radius;
    const modes::ContactLimits limits{std::max(scene.accuracy.tolerance * rotor.length_scale, rounding),
                                      scene.validity.max_shortening};
    return std::make_unique<motion::TypedMotion<motion::Motion<Law, Forcing, Pair, Blades>, kMayChange>>(
        rotor, std::move(blades), law, forcing, limits,
        scene.accuracy.method == settings::Method::collocation);
  }
};

}  // namespace rubatlas::assembly
