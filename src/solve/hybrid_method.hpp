/// The hybrid method: closed-form flight, contacts in steps of a Runge–Kutta pair, located events.
#pragma once

#include <memory>

#include "scene/scene.hpp"
#include "solve/motion.hpp"
#include "solve/rotor.hpp"

namespace rubatlas::solve {

/// `Pair`: the Runge–Kutta coefficients in contact.
template <class Pair>
struct HybridMethod {
  template <class Law, class Forcing>
  using Motion = solve::Motion<Law, Forcing, Pair>;

  template <class Law, class Forcing>
  static std::unique_ptr<Motion<Law, Forcing>> make(const RotorConstants& rotor, const Law& law,
                                                    const Forcing& forcing, const scene::Scene& scene) {
    const ContactLimits limits{scene.accuracy.tolerance * rotor.length_scale, scene.validity.max_shortening};
    return std::make_unique<Motion<Law, Forcing>>(rotor, scene.blades.count, law, forcing, limits);
  }
};

}  // namespace rubatlas::solve
