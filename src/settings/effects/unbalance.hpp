/// Effect `unbalance`: a mass eccentricity that turns with the rotor (MODEL 1).
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct Unbalance {
  double moment = 0.0;  ///< me [kg m]
  double phase = 0.0;   ///< γ [rad], from blade 1, positive with the rotation

  static constexpr Description kDescription{
      .section = "/unbalance",
      .meaning = "a mass eccentricity that turns with the rotor",
      .equation = "z'' + 2ζ z' + z = (me/m) Ω² e^{i(Ωτ+γ)}",
      .source = "the paper, equation of motion",
      .flight = "closed form, at resonance too",
      .breaks = "blade passing",
  };
  static constexpr auto quantities() {
    return std::tuple{
        Field<&Unbalance::moment>{.pointer = "/unbalance/moment",
                                  .symbol = "me",
                                  .unit = "kg m",
                                  .meaning = "unbalance, mass times eccentricity",
                                  .source = "the paper, equation of motion",
                                  .range = settings::between(0.0, 1e6)},
        Field<&Unbalance::phase>{.pointer = "/unbalance/phase",
                                 .symbol = "γ",
                                 .unit = "rad",
                                 .meaning = "angle of the unbalance from blade 1, positive with the rotation",
                                 .source = "the paper, equation of motion",
                                 .range = settings::between(-1e3, 1e3)}};
  }
  [[nodiscard]] bool acts() const { return moment != 0.0; }
};

}  // namespace rubatlas::effects
