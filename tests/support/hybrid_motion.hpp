/// A motion of the method `hybrid` below the scene. Those of the paper's rotor are compiled once for all
/// suites: each takes ten seconds or more of the compiler's time.
#pragma once

#include <memory>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/modes_of_rigid_blades.hpp"
#include "motion/motion.hpp"
#include "motion/point_motion.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::test {

/// A law or a forcing of another kind needs the `motion/modes_of_...hpp` of its modes.
template <class Law, class Forcing, class Blades>
std::unique_ptr<motion::PointMotion> hybrid_motion(const rotor::RotorConstants& rotor, const Blades& blades,
                                                   const Law& law, const Forcing& forcing,
                                                   const modes::ContactLimits& limits) {
  using Motion = motion::Motion<Law, Forcing, integrate::DormandPrince853, Blades>;
  return std::make_unique<motion::TypedMotion<Motion, false>>(rotor, blades, law, forcing, limits);
}

extern template std::unique_ptr<motion::PointMotion> hybrid_motion(const rotor::RotorConstants&,
                                                                   const rotor::BladeSet&,
                                                                   const contact::ElasticaContact&,
                                                                   const rotor::NoForcing&,
                                                                   const modes::ContactLimits&);
extern template std::unique_ptr<motion::PointMotion> hybrid_motion(const rotor::RotorConstants&,
                                                                   const rotor::BladeSet&,
                                                                   const contact::ElasticaContact&,
                                                                   const rotor::RotatingUnbalance&,
                                                                   const modes::ContactLimits&);
extern template std::unique_ptr<motion::PointMotion> hybrid_motion(const rotor::RotorConstants&,
                                                                   const rotor::BladeSet&,
                                                                   const contact::ElasticRingContact&,
                                                                   const rotor::NoForcing&,
                                                                   const modes::ContactLimits&);

/// The same rotor without unbalance by the method `collocation`.
std::unique_ptr<motion::PointMotion> collocation_motion(const rotor::RotorConstants& rotor, int blade_count,
                                                        const contact::ElasticaContact& law,
                                                        const modes::ContactLimits& limits);

/// The next revolution.
inline ending::PointStatus revolve(motion::PointMotion& motion, modes::MotionListener& listener) {
  return motion.revolution(listener, {}, 0);
}

}  // namespace rubatlas::test
