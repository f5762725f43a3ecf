/// Effect `unequal_blades`: errors of length, thickness and angle, blade by blade.
///
/// Errors are given as lists, as normal spreads drawn from a seed, or as both, which then add. The rig's
/// blades were set by hand (section 3.2 of the paper).
#pragma once

#include <tuple>
#include <vector>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

/// Errors of one blade.
struct BladeError {
  double length = 0.0;     ///< [m]
  double thickness = 0.0;  ///< [m]
  double angle = 0.0;      ///< [rad], positive with the rotation
};

struct UnequalBlades {
  std::vector<double> length_errors;     ///< one a blade [m], or none
  std::vector<double> thickness_errors;  ///< one a blade [m], or none
  std::vector<double> angle_errors;      ///< one a blade [rad], or none
  double length_spread = 0.0;            ///< standard deviation [m]
  double thickness_spread = 0.0;         ///< standard deviation [m]
  double angle_spread = 0.0;             ///< standard deviation [rad]
  int seed = 1;

  static constexpr Description kDescription{
      .section = "/unequal_blades",
      .meaning = "errors of length, thickness and angle of each blade",
      .equation =
          "L, h and φ of each blade, in its gap, its bending and its compliance, in place of those of all",
      .source = "the paper, section 3.2: blades set by hand",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "blade passing, independence of blade numbering",
  };
  static constexpr auto quantities() {
    using settings::between;
    return std::tuple{
        Field<&UnequalBlades::length_errors>{.pointer = "/unequal_blades/length_errors",
                                             .symbol = "",
                                             .unit = "m",
                                             .meaning = "how much longer each blade is, one number a blade",
                                             .source = "none",
                                             .range = between(-1e3, 1e3)},
        Field<&UnequalBlades::thickness_errors>{
            .pointer = "/unequal_blades/thickness_errors",
            .symbol = "",
            .unit = "m",
            .meaning = "how much thicker each blade is, one number a blade",
            .source = "none",
            .range = between(-1e3, 1e3)},
        Field<&UnequalBlades::angle_errors>{
            .pointer = "/unequal_blades/angle_errors",
            .symbol = "",
            .unit = "rad",
            .meaning = "how far each blade is ahead of its place, one number a blade",
            .source = "none",
            .range = between(-4.0, 4.0)},
        Field<&UnequalBlades::length_spread>{.pointer = "/unequal_blades/length_spread",
                                             .symbol = "",
                                             .unit = "m",
                                             .meaning = "standard deviation of the lengths",
                                             .source = "none",
                                             .range = between(0.0, 1e3)},
        Field<&UnequalBlades::thickness_spread>{.pointer = "/unequal_blades/thickness_spread",
                                                .symbol = "",
                                                .unit = "m",
                                                .meaning = "standard deviation of the thicknesses",
                                                .source = "none",
                                                .range = between(0.0, 1e3)},
        Field<&UnequalBlades::angle_spread>{.pointer = "/unequal_blades/angle_spread",
                                            .symbol = "",
                                            .unit = "rad",
                                            .meaning = "standard deviation of the angles",
                                            .source = "none",
                                            .range = between(0.0, 1.0)},
        Field<&UnequalBlades::seed>{.pointer = "/unequal_blades/seed",
                                    .symbol = "",
                                    .unit = "1",
                                    .meaning = "which random errors the spreads draw",
                                    .source = "any",
                                    .range = between(0, 1e9)}};
  }
  [[nodiscard]] bool acts() const;
  /// The errors of all blades. Each spread draws its own random numbers: changing one spread leaves the
  /// errors of the others as they were.
  [[nodiscard]] std::vector<BladeError> errors(int blade_count) const;
};

}  // namespace rubatlas::effects
