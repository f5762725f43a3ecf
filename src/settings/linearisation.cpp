#include "settings/linearisation.hpp"

#include <fmt/format.h>

#include "settings/combinations.hpp"
#include "settings/effects/list.hpp"

namespace rubatlas::settings {

std::optional<std::string> refusal_of_linearisation(const Scene& scene) {
  using effects::Effects;
  constexpr EffectSet kLinearised = effect_set<&Effects::unbalance, &Effects::gravity, &Effects::side_load>();
  const EffectSet others = given(scene) - kLinearised;
  if (!others.empty()) {
    return fmt::format(
        "{}: the motion under this effect has no linearised flow here; it is known with /unbalance, /gravity "
        "and /side_load only",
        others.sections().front());
  }
  switch (scene.accuracy.method) {
    case Method::hybrid:
    case Method::collocation:
    case Method::hybrid_54:
    case Method::hybrid_32:
      return std::nullopt;
    default:
      return std::string(
          "/accuracy/method: its steps do not follow the path of a contact; a linearised flow needs "
          "\"collocation\", "
          "\"hybrid\", \"hybrid_54\" or \"hybrid_32\"");
  }
}

}  // namespace rubatlas::settings
