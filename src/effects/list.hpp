/// The one list of effects: what a scene can switch on by a section, and leaves out without it.
#pragma once

#include <optional>

#include "effects/speed_ripple.hpp"
#include "effects/static_load.hpp"
#include "effects/unbalance.hpp"
#include "effects/unequal_blades.hpp"

namespace rubatlas::effects {

/// Sections of a scene that are there only where an effect is wanted. Absent means absent.
struct Effects {
  std::optional<Unbalance> unbalance;
  std::optional<Gravity> gravity;
  std::optional<SideLoad> side_load;
  std::optional<SpeedRipple> speed_ripple;
  std::optional<UnequalBlades> unequal_blades;
};

/// Calls `visit.operator()<&Effects::effect>()` for each, in the order of the documentation.
template <class Visit>
constexpr void for_each_effect(Visit visit) {
  visit.template operator()<&Effects::unbalance>();
  visit.template operator()<&Effects::gravity>();
  visit.template operator()<&Effects::side_load>();
  visit.template operator()<&Effects::speed_ripple>();
  visit.template operator()<&Effects::unequal_blades>();
}

/// Present and of a strength that is not zero.
template <auto Effect>
[[nodiscard]] bool acts(const Effects& effects) {
  return (effects.*Effect) && (effects.*Effect)->acts();
}

}  // namespace rubatlas::effects
