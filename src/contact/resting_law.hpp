/// The law of a tip at rest that belongs to a law of elastic blades under Coulomb's friction.
///
/// In the model a tip always slips (MODEL 4.4). Where its slip reversals accumulate it comes to rest on the
/// ring, held by friction of any coefficient within [−μ, μ], and that is `DirectedElastica` with
/// `StickingFriction`, μs = μ: of the same blade, which slips under the same force.
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

/// None where the blade can be shortened by its load or has small slopes: the place of its tip is then no
/// function of κ and φ.
inline std::optional<DirectedElastica<AxialLoad, StickingFriction>> resting_law(const ElasticaContact& law) {
  const blade::ElasticaCurve& curve = law.curve();
  if (curve.theory() != blade::Theory::elastica || curve.axial_compliance() != 0.0 || !law.carried())
    return std::nullopt;
  const double length = law.length();
  return DirectedElastica<AxialLoad, StickingFriction>(
      law.geometry(), {length, 2.0 * length * law.strain_unit(), law.load_unit() * length * length},
      {curve.friction(), curve.friction()});
}
template <class Direction>
std::optional<DirectedElastica<Direction, StickingFriction>> resting_law(
    const DirectedElastica<Direction, CoulombFriction>& law) {
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

/// The type of that law; void where there is none.
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
