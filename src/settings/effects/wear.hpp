/// Effect `wear`: blades lose length at their tips, in proportion to the work of friction there.
///
/// Archard: a tip of area A that slides by s under the normal load F loses the volume K F s / H, H the
/// hardness of the softer material, K the wear coefficient. With the work of friction W = ∫ |c F v| dτ [J], v
/// the slip velocity of MODEL 4.4, that is the length
///     ΔL = w W,   w = K / (μ H A)
/// (Archard, J. Appl. Phys. 24 (1953) 981; Rabinowicz, Friction and Wear of Materials, 2nd edition 1995,
/// chapter 6: K from 1e-2, unlubricated like metals, to 1e-8). Without friction nothing wears.
///
/// Wear is slow: within a revolution the blades keep their lengths, and at its end each loses w times its
/// friction work in that revolution. A blade keeps its rh, E, b and h, and the axial compliance of its unworn
/// length.
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct Wear {
  double rate = 0.0;      ///< w [m/J]
  double max_loss = 0.1;  ///< of a blade's length [-]; beyond this loss the point has left validity
  bool carries_over = false;

  static constexpr Description kDescription{
      .section = "/wear",
      .meaning = "blades that lose length by the work of friction at their tips",
      .equation = "L − w Σ W in place of L, W = ∫ abs(c F v) dτ of a revolution, taken off at its end",
      .source = "Archard 1953; Rabinowicz, Friction and Wear of Materials",
      .flight = "closed form: blades keep their lengths within a revolution",
      .breaks = "blade passing; a state alone no longer says how long the blades are",
  };
  static constexpr Memory kMemory{
      .inner_axis = "blade",
      .units = "m",
      .long_name = "length that each blade has lost at the end of the point",
  };
  static constexpr auto quantities() {
    return std::tuple{
        Field<&Wear::rate>{.pointer = "/wear/rate",
                           .symbol = "w",
                           .unit = "m/J",
                           .meaning = "length that a blade loses under one joule of friction work",
                           .source = "none",
                           .range = settings::between(0.0, 1e6)},
        Field<&Wear::max_loss>{.pointer = "/wear/max_loss",
                               .symbol = "",
                               .unit = "1",
                               .meaning = "share of a blade's length whose loss ends a point",
                               .source = "the law of contact is that of blades that nearly fill the ring",
                               .range = settings::above_zero_up_to(0.9)},
        Field<&Wear::carries_over>{
            .pointer = "/wear/carries_over",
            .symbol = "",
            .unit = "",
            .meaning = "whether the blades of a point are those that the sweep has worn so far",
            .source = "false: each point starts with new blades"}};
  }
  [[nodiscard]] bool acts() const { return rate != 0.0; }
};

}  // namespace rubatlas::effects
