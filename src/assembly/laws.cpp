// The law of contact of a line, from its blades, ring, friction and effects.

#include <memory>
#include <utility>

#include "assembly/blade_tables.hpp"
#include "assembly/methods.hpp"
#include "collocation/axial_law.hpp"
#include "collocation/damped_law.hpp"
#include "collocation/inclined_law.hpp"
#include "collocation/rigid_law.hpp"
#include "settings/effects/list.hpp"
#include "variation/parts_of_scene.hpp"

namespace rubatlas::assembly {

namespace {

using effects::Effects;

/// With its axial compliance.
std::shared_ptr<const blade::ElasticaCurve> curve_of(const LineRequest& request,
                                                     const settings::Blades& blade) {
  const settings::Scene& line = request.line;
  double compliance = 0.0;
  if (effects::acts<&Effects::axial_compliance>(line)) {
    const double slenderness = blade.thickness / blade.length;
    compliance = line.axial_compliance->share * slenderness * slenderness / 12.0;
  }
  return request.tables.curve(line.contact.friction, variation::theory_of(line), compliance);
}

contact::Friction friction_of(const LineRequest& request) {
  const settings::Scene& line = request.line;
  const double friction = line.contact.friction;
  if (request.combination.consumed.contains<&Effects::stick>())
    return contact::Friction::sticking(friction, line.stick->static_ratio * friction);
  return variation::friction_of(line);
}

/// c ωn of the dampers under the tips [N per (m per unit τ)]; 0 where there are none.
double ring_damping(const LineRequest& request) {
  const settings::Scene& line = request.line;
  return request.combination.family->kind == settings::MotionFamily::blades_on_damped_ring
             ? line.contact_damping->damping * line.rotor.natural_frequency
             : 0.0;
}

/// `make`: the law of one blade, from its geometry and what it is.
template <class Law>
std::unique_ptr<collocation::Law> of_blades(const LineRequest& request, const auto& make) {
  typename Law::Blades blades;
  for (const settings::Blades& blade : variation::each_blade(request.line))
    blades.push_back(make(variation::geometry_of(request.line.ring, blade), blade));
  return std::make_unique<Law>(std::move(blades));
}

std::unique_ptr<collocation::Law> law_of_inclined_loads(const LineRequest& request) {
  const auto direction = request.combination.consumed.contains<&Effects::load_direction>()
                             ? contact::LoadDirection::normal
                             : contact::LoadDirection::axial;
  const contact::Friction friction = friction_of(request);
  return of_blades<collocation::InclinedLaw>(request, [&](const auto& geometry, const auto& blade) {
    return contact::DirectedElastica(direction, geometry, variation::blade_of(blade), friction);
  });
}

std::unique_ptr<collocation::Law> law_of_damped_ring(const LineRequest& request) {
  const double stiffness = 1.0 / request.line.yielding_ring->compliance;
  return of_blades<collocation::DampedLaw>(request, [&](const auto& geometry, const auto& blade) {
    return contact::ElasticBladeOnDampedRing(
        contact::ElasticaContact(geometry, variation::blade_of(blade), curve_of(request, blade)), stiffness,
        ring_damping(request));
  });
}

std::unique_ptr<collocation::Law> law_of_rigid_blades(const LineRequest& request) {
  return of_blades<collocation::RigidLaw>(request, [&](const auto& geometry, const auto& /*blade*/) {
    return contact::ElasticRingContact(geometry, request.line.ring.stiffness, friction_of(request),
                                       ring_damping(request));
  });
}

std::unique_ptr<collocation::Law> law_of_axial_loads(const LineRequest& request) {
  const settings::EffectSet& consumed = request.combination.consumed;
  contact::Ring ring;
  if (consumed.contains<&Effects::yielding_ring>())
    ring.stiffness = 1.0 / request.line.yielding_ring->compliance;
  ring.releases_at_fold = consumed.contains<&Effects::release>();
  return of_blades<collocation::AxialLaw>(request, [&](const auto& geometry, const auto& blade) {
    return contact::ElasticaContact(geometry, variation::blade_of(blade), curve_of(request, blade), ring);
  });
}

}  // namespace

std::unique_ptr<collocation::Law> law_of(const LineRequest& request) {
  using enum settings::MotionFamily;
  if (request.line.contact.law == settings::ContactLaw::elastic_ring) return law_of_rigid_blades(request);
  switch (request.combination.family->kind) {
    case directed_elastic_blades:
    case sticking_elastic_blades:
      return law_of_inclined_loads(request);
    case blades_on_damped_ring:
      return law_of_damped_ring(request);
    default:
      return law_of_axial_loads(request);
  }
}

}  // namespace rubatlas::assembly
