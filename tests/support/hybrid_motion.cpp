#include "hybrid_motion.hpp"

namespace rubatlas::test {

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
