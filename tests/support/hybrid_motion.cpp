#include "hybrid_motion.hpp"

#include "motion/collocation_and_steps.hpp"

namespace rubatlas::test {

std::unique_ptr<motion::PointMotion> collocation_motion(const rotor::RotorConstants& rotor,
                                                        const rotor::BladeSet& blades,
                                                        const contact::ElasticaContact& law,
                                                        const modes::ContactLimits& limits) {
  using Motion = motion::Motion<contact::ElasticaContact, rotor::NoForcing, motion::CollocationAndSteps>;
  return std::make_unique<motion::TypedMotion<Motion, false>>(rotor, blades, law, rotor::NoForcing{}, limits);
}

template std::unique_ptr<motion::PointMotion> hybrid_motion(const rotor::RotorConstants&,
                                                            const rotor::BladeSet&,
                                                            const contact::ElasticaContact&,
                                                            const rotor::NoForcing&,
                                                            const modes::ContactLimits&);
template std::unique_ptr<motion::PointMotion> hybrid_motion(const rotor::RotorConstants&,
                                                            const rotor::BladeSet&,
                                                            const contact::ElasticaContact&,
                                                            const rotor::RotatingUnbalance&,
                                                            const modes::ContactLimits&);
template std::unique_ptr<motion::PointMotion> hybrid_motion(const rotor::RotorConstants&,
                                                            const rotor::BladeSet&,
                                                            const contact::ElasticRingContact&,
                                                            const rotor::NoForcing&,
                                                            const modes::ContactLimits&);

}  // namespace rubatlas::test
