/// Effects `gravity` and `side_load`: forces that keep size and direction.
///
/// z'' + 2ζ z' + z = f with f = w/k e^{iα}, w the weight m g or the load: the rotor's equilibrium moves by f.
/// Displacements stay relative to the equilibrium without the load, so that the load changes the place of the
/// rotor in the ring (statics; Childs, Turbomachinery Rotordynamics, 1993, §1.4: side loads change the
/// response to rubs).
#pragma once

#include <complex>
#include <numbers>
#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct Gravity {
  double acceleration = 9.81;                  ///< g [m/s²]
  double direction = -0.5 * std::numbers::pi;  ///< α [rad] from x towards y

  static constexpr Description kDescription{
      .section = "/gravity",
      .meaning = "the rotor's weight; a vertical machine has none",
      .equation = "z'' + 2ζ z' + z = g/ωn² e^{iα}",
      .source = "statics",
      .flight = "closed form: a harmonic of frequency 0",
      .breaks = "mirror symmetry, but along y",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&Gravity::acceleration>{.pointer = "/gravity/acceleration",
                                                    .symbol = "g",
                                                    .unit = "m/s2",
                                                    .meaning = "acceleration of gravity",
                                                    .source = "standard gravity, rounded",
                                                    .range = settings::between(0.0, 1e6)},
                      Field<&Gravity::direction>{.pointer = "/gravity/direction",
                                                 .symbol = "α",
                                                 .unit = "rad",
                                                 .meaning = "direction of gravity, from x towards y",
                                                 .source = "down",
                                                 .range = settings::between(-1e3, 1e3)}};
  }
  [[nodiscard]] bool acts() const { return acceleration != 0.0; }
  /// f [m].
  [[nodiscard]] std::complex<double> deflection(double /*stiffness*/, double natural_frequency) const {
    return std::polar(acceleration / (natural_frequency * natural_frequency), direction);
  }
};

struct SideLoad {
  double force = 0.0;      ///< [N]
  double direction = 0.0;  ///< α [rad] from x towards y

  static constexpr Description kDescription{
      .section = "/side_load",
      .meaning = "a constant force on the shaft: a seal, a gear, a belt",
      .equation = "z'' + 2ζ z' + z = w/k e^{iα}",
      .source = "statics",
      .flight = "closed form: a harmonic of frequency 0",
      .breaks = "mirror symmetry, but for a load along y",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&SideLoad::force>{.pointer = "/side_load/force",
                                              .symbol = "w",
                                              .unit = "N",
                                              .meaning = "constant force on the shaft",
                                              .source = "none",
                                              .range = settings::between(0.0, 1e12)},
                      Field<&SideLoad::direction>{.pointer = "/side_load/direction",
                                                  .symbol = "α",
                                                  .unit = "rad",
                                                  .meaning = "direction of the force, from x towards y",
                                                  .source = "along x",
                                                  .range = settings::between(-1e3, 1e3)}};
  }
  [[nodiscard]] bool acts() const { return force != 0.0; }
  /// f [m].
  [[nodiscard]] std::complex<double> deflection(double stiffness, double /*natural_frequency*/) const {
    return std::polar(force / stiffness, direction);
  }
};

}  // namespace rubatlas::effects
