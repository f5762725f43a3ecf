#include "modes/collocated_laws.hpp"

#include <utility>

#include "collocation/axial_law.hpp"
#include "collocation/damped_law.hpp"
#include "collocation/inclined_law.hpp"
#include "collocation/rigid_law.hpp"
#include "modes/collocated.hpp"

namespace rubatlas::modes {

namespace {

using collocation::ArcLaw;
using contact::UnequalBlades;

// The law of the arcs of contacts; null where they have none.

std::unique_ptr<ArcLaw> arcs_of(const ModesRequest& request,
                                const UnequalBlades<contact::ElasticaContact>& law) {
  const int count = request.machine.blades.count();
  for (int k = 0; k < count; ++k) {
    const contact::ElasticaContact& blade = law.of(k);
    if (blade.may_stand_straight() || blade.curve().over_asinh().last_piece() < 0) return nullptr;
  }
  return std::make_unique<collocation::AxialLaw>(law, count, request.limits.max_shortening);
}
std::unique_ptr<ArcLaw> arcs_of(const ModesRequest& request,
                                const UnequalBlades<contact::ElasticBladeOnDampedRing>& law) {
  const int count = request.machine.blades.count();
  for (int k = 0; k < count; ++k) {
    const blade::ElasticaCurve& curve = law.of(k).curve();
    if (!(curve.friction() > 0.0) || curve.over_asinh().last_piece() < 0) return nullptr;
  }
  return std::make_unique<collocation::DampedLaw>(law, count, request.limits.max_shortening);
}
template <class Friction>
std::unique_ptr<ArcLaw> arcs_of(const ModesRequest& request,
                                const UnequalBlades<contact::DirectedElastica<Friction>>& law) {
  using Law = UnequalBlades<contact::DirectedElastica<Friction>>;
  return std::make_unique<collocation::InclinedLaw<Law>>(law, request.machine.blades.count(),
                                                         request.limits.max_shortening);
}
/// Rigid blades.
template <class Blade>
std::unique_ptr<ArcLaw> arcs_of(const ModesRequest& request, const UnequalBlades<Blade>& law) {
  return std::make_unique<collocation::RigidLaw<UnequalBlades<Blade>>>(law, request.machine);
}

}  // namespace

template <class Blade>
std::unique_ptr<Phase> collocated(const ModesRequest& request, const UnequalBlades<Blade>& law) {
  if (!request.collocates) return nullptr;
  std::unique_ptr<ArcLaw> arcs = arcs_of(request, law);
  if (arcs == nullptr) return nullptr;
  return std::make_unique<Collocated>(request.machine, std::move(arcs), request.limits, request.meter);
}

template <class Blade>
using PhaseOf = std::unique_ptr<Phase>(const ModesRequest&, const UnequalBlades<Blade>&);
template PhaseOf<contact::ElasticaContact> collocated;
template PhaseOf<contact::DirectedElastica<contact::CoulombFriction>> collocated;
template PhaseOf<contact::DirectedElastica<contact::StickingFriction>> collocated;
template PhaseOf<contact::DirectedElastica<contact::VelocityFriction>> collocated;
template PhaseOf<contact::ElasticRingContact> collocated;
template PhaseOf<contact::RigidBladeContact<contact::StickingFriction>> collocated;
template PhaseOf<contact::RigidBladeContact<contact::VelocityFriction>> collocated;
template PhaseOf<contact::RigidBladeOnDampedRing> collocated;
template PhaseOf<contact::ElasticBladeOnDampedRing> collocated;

}  // namespace rubatlas::modes
