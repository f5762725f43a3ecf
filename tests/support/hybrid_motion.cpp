#include "hybrid_motion.hpp"

#include "modes/modes_of_axial_loads.hpp"
#include "modes/modes_of_damped_ring.hpp"
#include "modes/modes_of_inclined_loads.hpp"
#include "modes/modes_of_rigid_blades.hpp"

namespace rubatlas::test {

modes::MakeModes modes_of(const Blades<contact::ElasticaContact>& law) {
  return modes::maker_of<modes::ModesOfAxialLoads<>>(law);
}
modes::MakeModes modes_of(const Blades<contact::ElasticRingContact>& law) {
  return modes::maker_of<modes::ModesOfRigidBlades<contact::CoulombFriction>>(law);
}
modes::MakeModes modes_of(const Blades<contact::RigidBladeContact<contact::StickingFriction>>& law) {
  return modes::maker_of<modes::ModesOfStickingRigid<>>(law);
}
modes::MakeModes modes_of(const Blades<contact::RigidBladeContact<contact::VelocityFriction>>& law) {
  return modes::maker_of<modes::ModesOfRigidBlades<contact::VelocityFriction>>(law);
}
modes::MakeModes modes_of(const Blades<contact::DirectedElastica<contact::CoulombFriction>>& law) {
  return modes::maker_of<modes::ModesOfInclinedCoulomb<>>(law);
}
modes::MakeModes modes_of(const Blades<contact::DirectedElastica<contact::StickingFriction>>& law) {
  return modes::maker_of<modes::ModesOfStickingInclined<>>(law);
}
modes::MakeModes modes_of(const Blades<contact::DirectedElastica<contact::VelocityFriction>>& law) {
  return modes::maker_of<modes::ModesOfInclinedVelocity<>>(law);
}
modes::MakeModes modes_of(const Blades<contact::RigidBladeOnDampedRing>& law) {
  return modes::maker_of<modes::ModesOfRigidBladesOnDampedRing<>>(law);
}
modes::MakeModes modes_of(const Blades<contact::ElasticBladeOnDampedRing>& law) {
  return modes::maker_of<modes::ModesOfElasticBladesOnDampedRing<>>(law);
}

}  // namespace rubatlas::test
