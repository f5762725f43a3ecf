#include "hybrid_motion.hpp"

#include "modes/collocated.hpp"

namespace rubatlas {
namespace test {

struct CollocationAndSteps : integrate::DormandPrince853 {};

}  // namespace test

template <>
struct motion::CollocationOf<test::CollocationAndSteps> {
  static constexpr bool kOccurs = true;
  using Mode = modes::Collocated;
};

namespace test {

std::unique_ptr<motion::PointMotion> collocation_motion(const rotor::RotorConstants& rotor,
                                                        const rotor::BladeSet& blades,
                                                        const contact::ElasticaContact& law,
                                                        const modes::ContactLimits& limits) {
  using Motion = motion::Motion<contact::ElasticaContact, rotor::NoForcing, CollocationAndSteps>;
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

}  // namespace test
}  // namespace rubatlas
