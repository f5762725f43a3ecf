/// From a law of elastic blades under Coulomb's friction to the law of their tips at rest.
///
/// Under Coulomb's law a tip slips until its slip reversals accumulate (MODEL 4.4). Then it rests on the
/// ring, held by a friction coefficient within [−μ, μ]. The law of such a tip is `DirectedElastica` with
/// `StickingFriction` and μs = μ, for the same blade: a tip that slips has the same force under both laws.
#pragma once

#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "contact/directed_elastica.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "contact/unequal_blades.hpp"

namespace rubatlas::contact {

/// None for small slopes, and where axial compliance or a ring that yields gives way besides: there the place
/// of the tip is not a function of κ and φ. Nor for blades that are released at the fold.
inline std::optional<DirectedElastica<StickingFriction>> resting_law(const ElasticaContact& law) {
  const blade::ElasticaCurve& curve = law.curve();
  if (curve.theory() != blade::Theory::elastica || law.has_branches() || law.releases_at_fold() ||
      law.may_stand_straight())
    return std::nullopt;
  const double length = law.length();
  return DirectedElastica<StickingFriction>(
      LoadDirection::axial, law.geometry(),
      {length, 2.0 * length * law.strain_unit(), law.load_unit() * length * length},
      {curve.friction(), curve.friction()});
}
inline std::optional<DirectedElastica<StickingFriction>> resting_law(
    const DirectedElastica<CoulombFriction>& law) {
  return law.with_friction(StickingFriction{law.friction().friction, law.friction().friction});
}
template <class Law>
auto resting_law(const UnequalBlades<Law>& law, int count)
    -> std::optional<UnequalBlades<typename decltype(resting_law(law.of(0)))::value_type>> {
  std::vector<typename decltype(resting_law(law.of(0)))::value_type> blades;
  for (int k = 0; k < count; ++k) {
    auto blade = resting_law(law.of(k));
    if (!blade) return std::nullopt;
    blades.push_back(std::move(*blade));
  }
  return UnequalBlades(std::move(blades));
}
/// The same for blades that are alike, whatever their number.
template <class Law>
requires std::is_same_v<Law, typename Law::OfBlade>
auto resting_law(const Law& law, int /*count*/) -> decltype(resting_law(law)) {
  return resting_law(law);
}

/// The type of the law of tips at rest; void where there is none.
template <class Law>
struct RestingLawOf {
  using Type = void;
};
template <class Law>
requires requires(const Law& law) {
  resting_law(law, 1);
}
struct RestingLawOf<Law> {
  using Type = typename decltype(resting_law(std::declval<const Law&>(), 1))::value_type;
};

}  // namespace rubatlas::contact
