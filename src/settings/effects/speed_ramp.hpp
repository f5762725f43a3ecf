/// Effect `speed_ramp`: run-up or run-down, the speed changes from revolution to revolution.
///
///     Ω_j = Ω + j r   in the sampled revolution j = 0, 1, ... S − 1
///
/// The speed ratio of the grid is that of the transient and of the first sampled revolution; the speed ratio
/// of each further revolution is higher by r. So one point with many sampled revolutions is one run-up, in
/// which each section belongs to another speed; and a sweep in steps of S r without a transient is one run-up
/// from the first point to the last. The angle of the rotor, its state and its contacts go on without a jump.
///
/// Within a revolution the speed is constant, so that flight stays in closed form: the limit of a slow ramp,
/// |r| ≪ Ω. Two effects of a real ramp are left out: the unbalance's tangential acceleration (me/m) φ'',
/// smaller by |r| / (2π Ω) than its centrifugal one (Genta, Dynamics of Rotating Systems, 2005, on
/// nonstationary motion), and a phase of the rotor that is ahead by at most π r / (4 Ω), in the middle of a
/// revolution.
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct SpeedRamp {
  double rate = 0.0;  ///< r [-]: change of Ω per revolution

  static constexpr Description kDescription{
      .section = "/speed_ramp",
      .meaning = "run-up or run-down: a speed that changes from each sampled revolution to the next",
      .equation = "Ω + j r in place of Ω in the sampled revolution j = 0, 1, ...",
      .source = "the limit of a slow ramp; Genta, Dynamics of Rotating Systems",
      .flight = "closed form: the speed is constant within a revolution",
      .breaks = "blade passing; a state alone does not say how fast the rotor turns by now",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&SpeedRamp::rate>{.pointer = "/speed_ramp/rate",
                                              .symbol = "r",
                                              .unit = "1",
                                              .meaning = "change of the speed ratio per sampled revolution",
                                              .source = "none",
                                              .range = settings::between(-1.0, 1.0)}};
  }
  [[nodiscard]] bool acts() const { return rate != 0.0; }
  /// Ω of the sampled revolution j = `sampled`, from Ω of the first one; Ω of the first one in the transient
  /// (`sampled` < 0).
  [[nodiscard]] double speed_ratio(double first, int sampled) const {
    return sampled > 0 ? first + sampled * rate : first;
  }
};

}  // namespace rubatlas::effects
