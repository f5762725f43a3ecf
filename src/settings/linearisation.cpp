#include "settings/linearisation.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "settings/combinations.hpp"
#include "settings/effects/list.hpp"

namespace rubatlas::settings {

namespace {

using effects::Effects;
constexpr EffectSet kLinearised =
    effect_set<&Effects::unbalance, &Effects::gravity, &Effects::side_load, &Effects::support,
               &Effects::ring_body, &Effects::regularised_friction, &Effects::stribeck,
               &Effects::unequal_blades>();

bool follows_paths(Method method) {
  switch (method) {
    case Method::hybrid:
    case Method::collocation:
    case Method::hybrid_54:
    case Method::hybrid_32:
      return true;
    default:
      return false;
  }
}

/// `linearised`: the effects that are followed.
std::optional<std::string> refusal_beyond(EffectSet linearised, const Scene& scene) {
  for (const Combination& line : combinations_in(scene)) {
    const EffectSet others = line.consumed - linearised;
    if (others.empty()) continue;
    return fmt::format(
        "{}: the motion under this effect has no linearised flow here; effects that have one: {}",
        others.sections().front(), fmt::join(linearised.sections(), ", "));
  }
  if (ring_has_no_mass(scene)) {
    return std::string(
        "/ring_body/mass: a ring without mass stands where the blades push it, and has no linearised flow "
        "here; allowed: a mass above 0");
  }
  if (!follows_paths(scene.accuracy.method)) {
    return std::string(
        "/accuracy/method: its steps do not follow the path of a contact; a linearised flow needs "
        "\"collocation\", \"hybrid\", \"hybrid_54\" or \"hybrid_32\"");
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> refusal_of_linearisation(const Scene& scene) {
  return refusal_beyond(kLinearised, scene);
}

std::optional<std::string> refusal_of_shooting(const Scene& scene) {
  if (scene.ring_body) {
    return std::string(
        "/ring_body: periodic orbits are found by the state of the shaft at a section, which is not all of "
        "it where the ring is a body");
  }
  if (scene.unequal_blades) {
    return std::string(
        "/unequal_blades: orbits are followed from touch-down to touch-down of blades that are alike");
  }
  return refusal_beyond(kLinearised - effect_set<&Effects::ring_body, &Effects::unequal_blades>(), scene);
}

bool settles(const Scene& line) {
  return line.protocol.settle == Settle::newton && !refusal_of_linearisation(line);
}
bool may_settle(const Scene& scene) {
  return scene.protocol.settle == Settle::newton && follows_paths(scene.accuracy.method) &&
         std::ranges::any_of(combinations_in(scene),
                             [](const Combination& line) { return line.consumed.is_within(kLinearised); });
}

}  // namespace rubatlas::settings
