#include "settings/effects/list.hpp"

#include <vector>

namespace rubatlas::effects {

std::span<const Listed> listed() {
  static const std::vector<Listed> kAll = [] {
    std::vector<Listed> all;
    for_each_effect([&]<auto Effect>() {
      Listed& one = all.emplace_back();
      one.description = Settings<Effect>::kDescription;
      if constexpr (requires { Settings<Effect>::kMemory; }) one.memory = Settings<Effect>::kMemory;
      one.is_in = [](const Effects& effects) { return (effects.*Effect).has_value(); };
      one.acts = [](const Effects& effects) { return acts<Effect>(effects); };
      one.add = [](Effects& effects) { (effects.*Effect).emplace(); };
      one.remove = [](Effects& effects) { (effects.*Effect).reset(); };
    });
    return all;
  }();
  return kAll;
}

}  // namespace rubatlas::effects
