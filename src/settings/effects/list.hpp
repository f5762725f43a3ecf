/// The one list of effects: what a scene can switch on by a section, and leaves out without it.
#pragma once

#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "settings/effects/blade_and_ring.hpp"
#include "settings/effects/contact_damping.hpp"
#include "settings/effects/contact_load.hpp"
#include "settings/effects/description.hpp"
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

/// Calls `visit.operator()<&Effects::effect>()` for each, in the order of the documentation.
template <class Visit>
constexpr void for_each_effect(Visit visit) {
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
[[nodiscard]] bool acts(const Effects& effects) {
  return (effects.*Effect) && (effects.*Effect)->acts();
}

/// An effect of the list at run time.
struct Listed {
  Description description;
  std::optional<Memory> memory;
  bool (*is_in)(const Effects&);
  bool (*acts)(const Effects&);  ///< `effects::acts`
  void (*add)(Effects&);         ///< its section, as it is by default
  void (*remove)(Effects&);
};
/// In the order of `for_each_effect`.
std::span<const Listed> listed();

}  // namespace rubatlas::effects
