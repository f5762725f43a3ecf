/// The one list of effects: what a scene can switch on by a section, and leaves out without it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "settings/effects/blade_and_ring.hpp"
#include "settings/effects/contact_damping.hpp"
#include "settings/effects/contact_load.hpp"
#include "settings/effects/ring_body.hpp"
#include "settings/effects/speed_ramp.hpp"
#include "settings/effects/speed_ripple.hpp"
#include "settings/effects/static_load.hpp"
#include "settings/effects/stick.hpp"
#include "settings/effects/support.hpp"
#include "settings/effects/unbalance.hpp"
#include "settings/effects/unequal_blades.hpp"
#include "settings/effects/wear.hpp"

namespace rubatlas::effects {

/// Sections of a scene that are present only where an effect is wanted. An absent effect has no term in the
/// equations.
struct Effects {
  std::optional<Unbalance> unbalance;
  std::optional<Gravity> gravity;
  std::optional<SideLoad> side_load;
  std::optional<Support> support;
  std::optional<SpeedRipple> speed_ripple;
  std::optional<UnequalBlades> unequal_blades;
  std::optional<AxialCompliance> axial_compliance;
  std::optional<YieldingRing> yielding_ring;
  std::optional<Release> release;
  std::optional<LoadDirection> load_direction;
  std::optional<RegularisedFriction> regularised_friction;
  std::optional<Stribeck> stribeck;
  std::optional<Wear> wear;
  std::optional<SpeedRamp> speed_ramp;
  std::optional<Stick> stick;
  std::optional<RingBody> ring_body;
  std::optional<ContactDamping> contact_damping;
};

/// The settings of an effect of the list: `Gravity` for `&Effects::gravity`.
template <auto Effect>
using Settings = std::remove_cvref_t<decltype(*(std::declval<const Effects&>().*Effect))>;

/// A build may leave out effects, named after their sections ("gravity ring_mass", or "all"), to show that an
/// effect costs nothing where it is absent (tests/bench/absence.sh). The program itself leaves out none.
#ifndef RUBATLAS_WITHOUT_EFFECTS
#define RUBATLAS_WITHOUT_EFFECTS ""
#endif
constexpr bool is_left_out(std::string_view section, std::string_view words = RUBATLAS_WITHOUT_EFFECTS) {
  const auto is_name = [&](std::string_view word) {
    if (word == "all") return true;
    bool same = word.size() + 1 == section.size();
    for (std::size_t i = 0; same && i < word.size(); ++i) {
      same = word[i] == (section[i + 1] == '/' ? '_' : section[i + 1]);
    }
    return same;
  };
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (is_name(words.substr(0, end))) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}
template <auto Effect>
inline constexpr bool kExists = !is_left_out(Settings<Effect>::kDescription.section);

/// Calls `given.operator()<&Effects::effect>()` for each, in the order of the documentation.
template <class Visit>
constexpr void for_each_effect(Visit given) {
  const auto visit = [&]<auto Effect>() {
    // The axis of the unbalance is part of every atlas, and so are its quantities.
    if constexpr (kExists<Effect> || std::is_same_v<Settings<Effect>, Unbalance>) {
      given.template operator()<Effect>();
    }
  };
  visit.template operator()<&Effects::unbalance>();
  visit.template operator()<&Effects::gravity>();
  visit.template operator()<&Effects::side_load>();
  visit.template operator()<&Effects::support>();
  visit.template operator()<&Effects::speed_ripple>();
  visit.template operator()<&Effects::unequal_blades>();
  visit.template operator()<&Effects::axial_compliance>();
  visit.template operator()<&Effects::yielding_ring>();
  visit.template operator()<&Effects::release>();
  visit.template operator()<&Effects::load_direction>();
  visit.template operator()<&Effects::regularised_friction>();
  visit.template operator()<&Effects::stribeck>();
  visit.template operator()<&Effects::wear>();
  visit.template operator()<&Effects::speed_ramp>();
  visit.template operator()<&Effects::stick>();
  visit.template operator()<&Effects::ring_body>();
  visit.template operator()<&Effects::contact_damping>();
}

/// Present and of a strength that is not zero.
template <auto Effect>
[[nodiscard]] bool acts([[maybe_unused]] const Effects& effects) {
  if constexpr (kExists<Effect>) return (effects.*Effect) && (effects.*Effect)->acts();
  return false;
}

}  // namespace rubatlas::effects
