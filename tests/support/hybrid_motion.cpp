#include "hybrid_motion.hpp"

#include "modes/laws.hpp"

namespace rubatlas::test {

std::unique_ptr<modes::Law> law_of(const Blades<contact::ElasticaContact>& blades) {
  return std::make_unique<modes::LawOfAxialLoads>(blades);
}
std::unique_ptr<modes::Law> law_of(const Blades<contact::ElasticRingContact>& blades) {
  return std::make_unique<modes::LawOfRigidBlades>(blades);
}
std::unique_ptr<modes::Law> law_of(const Blades<contact::DirectedElastica>& blades) {
  return std::make_unique<modes::LawOfInclinedLoads>(blades);
}
std::unique_ptr<modes::Law> law_of(const Blades<contact::ElasticBladeOnDampedRing>& blades) {
  return std::make_unique<modes::LawOfDampedRing>(blades);
}

}  // namespace rubatlas::test
