#include "modes/collocated_laws.hpp"

#include <utility>

#include "collocation/axial_law.hpp"
#include "collocation/inclined_law.hpp"
#include "collocation/rigid_law.hpp"
#include "modes/collocated.hpp"

namespace rubatlas::modes {

namespace {

std::unique_ptr<Phase> by_arcs(const ModesRequest& request, std::unique_ptr<collocation::ArcLaw> law) {
  return std::make_unique<Collocated>(request.machine, std::move(law), request.limits.tolerance,
                                      request.meter);
}

/// On a ring without mass the place of the ring hangs on all blades.
template <class Blade>
std::unique_ptr<Phase> rigid(const ModesRequest& request, const contact::UnequalBlades<Blade>& law) {
  if (!request.collocates || request.machine.following_ring() != nullptr) return nullptr;
  return by_arcs(request, std::make_unique<collocation::RigidLaw<contact::UnequalBlades<Blade>>>(law));
}

template <class Blade>
std::unique_ptr<Phase> under_inclined_loads(const ModesRequest& request,
                                            const contact::UnequalBlades<Blade>& law) {
  if (!request.collocates) return nullptr;
  return by_arcs(request, std::make_unique<collocation::InclinedLaw<contact::UnequalBlades<Blade>>>(
                              law, request.limits.max_shortening));
}

}  // namespace

template <>
std::unique_ptr<Phase> collocated(const ModesRequest& request,
                                  const contact::UnequalBlades<contact::ElasticaContact>& law) {
  if (!request.collocates) return nullptr;
  const int count = request.machine.blades.count();
  for (int k = 0; k < count; ++k) {
    if (law.of(k).curve().over_asinh().last_piece() < 0) return nullptr;
  }
  return by_arcs(request, std::make_unique<collocation::AxialLaw>(law, count, request.limits.max_shortening));
}
template <>
std::unique_ptr<Phase> collocated(
    const ModesRequest& request,
    const contact::UnequalBlades<contact::DirectedElastica<contact::CoulombFriction>>& law) {
  return under_inclined_loads(request, law);
}
template <>
std::unique_ptr<Phase> collocated(
    const ModesRequest& request,
    const contact::UnequalBlades<contact::DirectedElastica<contact::StickingFriction>>& law) {
  return under_inclined_loads(request, law);
}
template <>
std::unique_ptr<Phase> collocated(
    const ModesRequest& request,
    const contact::UnequalBlades<contact::DirectedElastica<contact::VelocityFriction>>& law) {
  return under_inclined_loads(request, law);
}

template <>
std::unique_ptr<Phase> collocated(const ModesRequest& request,
                                  const contact::UnequalBlades<contact::ElasticRingContact>& law) {
  return rigid(request, law);
}
template <>
std::unique_ptr<Phase> collocated(
    const ModesRequest& request,
    const contact::UnequalBlades<contact::RigidBladeContact<contact::StickingFriction>>& law) {
  return rigid(request, law);
}
template <>
std::unique_ptr<Phase> collocated(
    const ModesRequest& request,
    const contact::UnequalBlades<contact::RigidBladeContact<contact::VelocityFriction>>& law) {
  return rigid(request, law);
}
template <>
std::unique_ptr<Phase> collocated(const ModesRequest& request,
                                  const contact::UnequalBlades<contact::RigidBladeOnDampedRing>& law) {
  return rigid(request, law);
}

}  // namespace rubatlas::modes
