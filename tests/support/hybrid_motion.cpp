#include "hybrid_motion.hpp"

#include "collocation/axial_law.hpp"
#include "collocation/damped_law.hpp"
#include "collocation/inclined_law.hpp"
#include "collocation/rigid_law.hpp"

namespace rubatlas::test {

std::unique_ptr<collocation::Law> law_of(const Blades<contact::ElasticaContact>& blades) {
  return std::make_unique<collocation::AxialLaw>(blades);
}
std::unique_ptr<collocation::Law> law_of(const Blades<contact::ElasticRingContact>& blades) {
  return std::make_unique<collocation::RigidLaw>(blades);
}
std::unique_ptr<collocation::Law> law_of(const Blades<contact::DirectedElastica>& blades) {
  return std::make_unique<collocation::InclinedLaw>(blades);
}
std::unique_ptr<collocation::Law> law_of(const Blades<contact::ElasticBladeOnDampedRing>& blades) {
  return std::make_unique<collocation::DampedLaw>(blades);
}

}  // namespace rubatlas::test
