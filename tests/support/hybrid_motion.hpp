/// Motions below the scene.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "assembly/methods.hpp"
#include "contact/damped_ring.hpp"
#include "contact/directed_elastica.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "machine_of.hpp"
#include "modes/rest_judge.hpp"
#include "motion/motion.hpp"

namespace rubatlas::test {

/// The law of blades that are alike.
template <class Blade>
std::vector<Blade> laws_of(const Blade& blade, int count) {
  return std::vector(static_cast<std::size_t>(count), blade);
}
template <class Blade>
const std::vector<Blade>& laws_of(const std::vector<Blade>& laws, int /*count*/) {
  return laws;
}

template <class Blade>
using Blades = std::vector<Blade>;
std::unique_ptr<collocation::Law> law_of(const Blades<contact::ElasticaContact>& blades);
std::unique_ptr<collocation::Law> law_of(const Blades<contact::ElasticRingContact>& blades);
std::unique_ptr<collocation::Law> law_of(const Blades<contact::DirectedElastica>& blades);
std::unique_ptr<collocation::Law> law_of(const Blades<contact::ElasticBladeOnDampedRing>& blades);

/// A motion by the method `hybrid`, or where it `collocates` by `collocation`; `law` of one blade, the same
/// for all, or of all.
template <class Law>
std::unique_ptr<motion::Motion> hybrid_motion(const rotor::Machine& machine, const Law& law,
                                              const modes::ContactLimits& limits, bool collocates = false) {
  return std::make_unique<motion::Motion>(machine, law_of(laws_of(law, machine.blades.count())), limits,
                                          collocates ? modes::phases_on_arcs : assembly::phases_in_steps);
}
template <class Law, class Forcing>
std::unique_ptr<motion::Motion> hybrid_motion(const rotor::RotorConstants& rotor,
                                              const rotor::BladeSet& blades, const Law& law,
                                              const Forcing& forcing, const modes::ContactLimits& limits) {
  return hybrid_motion(machine_of(rotor, blades, forcing), law, limits);
}

/// A rotor without unbalance by the method `collocation`.
inline std::unique_ptr<motion::Motion> collocation_motion(const rotor::RotorConstants& rotor, int blade_count,
                                                          const contact::ElasticaContact& law,
                                                          const modes::ContactLimits& limits) {
  return hybrid_motion(machine_of(rotor, rotor::BladeSet(blade_count, rotor.speed_ratio)), law, limits, true);
}

/// Starts with shaft and ring in a state.
inline ending::PointStatus start(motion::PointMotion& motion, const rotor::ShaftAndRing& state) {
  return ending::status_of(motion.start(
      {rotor::as_array(rotor::shaft(state)), motion::Memory(rotor::as_array(rotor::ring(state)))}));
}
/// Starts with the shaft in a state and the ring at rest in its place.
inline ending::PointStatus start(motion::PointMotion& motion, const rotor::State& state) {
  return start(motion, rotor::shaft_and_ring(state));
}
/// The next revolution.
inline ending::PointStatus revolve(motion::PointMotion& motion, modes::MotionListener& listener) {
  return ending::status_of(motion.revolution(listener, {}, 0));
}

}  // namespace rubatlas::test
