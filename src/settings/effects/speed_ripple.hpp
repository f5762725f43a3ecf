/// Effect `speed_ripple`: the spin speed varies periodically within a revolution, as a motor's or an engine's
/// does.
///
///     φ' = Ω (1 + a cos(pΩτ + ψ)),   φ = Ωτ + (a/p) (sin(pΩτ + ψ) − sin ψ)
///
/// The order p is whole, so that a revolution still takes 2π/Ω and ends where it began. The rig of the paper
/// varied by ±3 to ±167 rpm (section 4). An unbalance then acts with −(me/m) d²/dτ² e^{i(φ+γ)}: by Jacobi and
/// Anger a sum of harmonics Ω (1 + kp) with Bessel functions for weights (Abramowitz & Stegun 9.1.42), so
/// that flight stays in closed form.
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct SpeedRipple {
  double amplitude = 0.0;  ///< a [-]: largest departure of the speed, relative to its mean
  int order = 1;           ///< p [-]: ripples in a revolution
  double phase = 0.0;      ///< ψ [rad]

  static constexpr Description kDescription{
      .section = "/speed_ripple",
      .meaning = "a spin speed that varies within each revolution",
      .equation =
          "φ' = Ω (1 + a cos(pΩτ + ψ)) in place of Ω; an unbalance acts with −(me/m) d²/dτ² e^{i(φ+γ)}; "
          "rotating damping keeps the mean Ω",
      .source = "Jacobi-Anger: Abramowitz & Stegun 9.1.42",
      .flight = "closed form: an unbalance acts with side bands Ω (1 + kp)",
      .breaks = "blade passing, but for p a multiple of n",
  };
  static constexpr auto quantities() {
    return std::tuple{
        Field<&SpeedRipple::amplitude>{.pointer = "/speed_ripple/amplitude",
                                       .symbol = "a",
                                       .unit = "1",
                                       .meaning = "largest departure of the spin speed, share of its mean",
                                       .source = "none",
                                       .range = settings::between(0.0, 0.9)},
        Field<&SpeedRipple::order>{.pointer = "/speed_ripple/order",
                                   .symbol = "p",
                                   .unit = "1",
                                   .meaning = "ripples in a revolution",
                                   .source = "once a revolution",
                                   .range = settings::between(1, 1000)},
        Field<&SpeedRipple::phase>{.pointer = "/speed_ripple/phase",
                                   .symbol = "ψ",
                                   .unit = "rad",
                                   .meaning = "phase of the ripple when blade 1 is at angle 0",
                                   .source = "fastest there",
                                   .range = settings::between(-1e3, 1e3)}};
  }
  [[nodiscard]] bool acts() const { return amplitude != 0.0; }
};

}  // namespace rubatlas::effects
