/// From a law of elastic blades under Coulomb's friction to the law of their tips at rest.
///
/// Under Coulomb's law a tip slips until its slip reversals accumulate (MODEL 4.4). Then it rests on the
/// ring, held by a friction coefficient within [−μ, μ]. The law of such a tip is `DirectedElastica` with
/// friction that sticks and μs = μ, for the same blade: a tip that slips has the same force under both laws.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "contact/directed_elastica.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "contact/unequal_blades.hpp"

namespace rubatlas::contact {

/// None for small slopes, and where axial compliance or a ring that yields gives way besides: there the place
/// of the tip is not a function of κ and φ. Nor for blades that are released at the fold.
inline std::optional<DirectedElastica> resting_law(const ElasticaContact& law) {
  const blade::ElasticaCurve& curve = law.curve();
  if (curve.theory() != blade::Theory::elastica || law.has_branches() || law.releases_at_fold() ||
      law.may_stand_straight())
    return std::nullopt;
  const double length = law.length();
  return DirectedElastica(LoadDirection::axial, law.geometry(),
                          {length, 2.0 * length * law.strain_unit(), law.load_unit() * length * length},
                          Friction::sticking(curve.friction(), curve.friction()));
}
/// None where friction depends on the slip velocity, or tips stick anyway.
inline std::optional<DirectedElastica> resting_law(const DirectedElastica& law) {
  const Friction& friction = law.friction();
  if (friction.depends_on_velocity() || friction.sticks) return std::nullopt;
  return law.with_friction(Friction::sticking(friction.friction, friction.friction));
}
template <class Blade>
std::optional<UnequalBlades<DirectedElastica>> resting_law(const UnequalBlades<Blade>& law, int count) {
  std::vector<DirectedElastica> blades;
  for (int k = 0; k < count; ++k) {
    const std::optional<DirectedElastica> blade = resting_law(law.of(k));
    if (!blade) return std::nullopt;
    blades.push_back(*blade);
  }
  return UnequalBlades(std::move(blades));
}

}  // namespace rubatlas::contact
