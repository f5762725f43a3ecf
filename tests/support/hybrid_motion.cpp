#include "hybrid_motion.hpp"

#include <vector>

#include "contact/unequal_blades.hpp"
#include "rotor/any_shaft.hpp"
#include "rotor/rippling_blades.hpp"

namespace rubatlas::test {

std::unique_ptr<motion::PointMotion> collocation_motion(const rotor::RotorConstants& rotor, int blade_count,
                                                        const contact::ElasticaContact& law,
                                                        const modes::ContactLimits& limits) {
  using Laws = contact::UnequalBlades<contact::ElasticaContact>;
  using Motion = motion::Motion<Laws, rotor::AnyShaft, integrate::DormandPrince853, rotor::RipplingBlades>;
  return std::make_unique<motion::TypedMotion<Motion, false>>(
      rotor, rotor::RipplingBlades(rotor::equal_angles(blade_count), rotor.speed_ratio, {}),
      Laws(std::vector(static_cast<std::size_t>(blade_count), law)), rotor::AnyShaft{rotor::Harmonics({})},
      limits, true);
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
