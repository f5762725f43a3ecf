/// The methods that ours is compared with, as methods that motions are made by.
#pragma once

#include <memory>

#include "assembly/typed_motions.hpp"
#include "compared/stepped_motion.hpp"

namespace rubatlas::assembly {

/// `Scheme`: what `compared::SteppedMotion` asks of one, and of a scene
///     largest_step(accuracy)   τ
///     search(accuracy)         how forces are found
template <class Scheme>
struct SteppedMethod {
  template <bool kMayChange, class Law, class Forcing>
  static std::unique_ptr<motion::PointMotion> make(const rotor::RotorConstants& rotor,
                                                   const rotor::BladeSet& blades, const Law& law,
                                                   const Forcing& forcing, const settings::Scene& scene) {
    const compared::SteppedLimits limits{scene.accuracy.tolerance * rotor.length_scale,
                                         Scheme::largest_step(scene.accuracy), scene.validity.max_shortening};
    return std::make_unique<motion::TypedMotion<compared::SteppedMotion<Law, Forcing, Scheme>, kMayChange>>(
        rotor, blades, law, forcing, Scheme::search(scene.accuracy), limits);
  }
};

}  // namespace rubatlas::assembly
