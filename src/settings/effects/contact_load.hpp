/// Effects `load_direction`, `regularised_friction` and `stribeck`: how the ring loads a tip.
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

/// The blade carries its load in the direction of the ring's forces, along the contact normal and across it;
/// the paper's appendix takes the load along the blade.
struct LoadDirection {
  bool along_normal = true;

  static constexpr Description kDescription{
      .section = "/load_direction",
      .meaning = "elastic blades under the load's true direction, the contact normal",
      .equation = "load P = F sqrt(1 + c²) at the angle α + atan c to the blade, not at s atan μ",
      .source = "the paper's appendix leaves α out; Love, Treatise, chapter XIX",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&LoadDirection::along_normal>{.pointer = "/load_direction/along_normal",
                                                          .symbol = "",
                                                          .unit = "",
                                                          .meaning = "load along the contact normal",
                                                          .source = "true: the section asks for it"}};
  }
  [[nodiscard]] bool acts() const { return along_normal; }
};

struct RegularisedFriction {
  double velocity = 0.0;  ///< v0 [m/s]

  static constexpr Description kDescription{
      .section = "/regularised_friction",
      .meaning = "friction that passes smoothly through zero slip",
      .equation = "c = μ tanh(v/v0) in place of s μ",
      .source = "Andersson, Söderberg & Björklund 2007",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "phase volume: forces depend on velocities",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&RegularisedFriction::velocity>{
        .pointer = "/regularised_friction/velocity",
        .symbol = "v0",
        .unit = "m/s",
        .meaning = "slip velocity over which friction passes through zero",
        .source = "0: Coulomb's law",
        .range = settings::between(0.0, 1e6)}};
  }
  [[nodiscard]] bool acts() const { return velocity != 0.0; }
};

struct Stribeck {
  double static_friction = 0.0;         ///< μs [-]
  double velocity = 0.01;               ///< vs [m/s]
  double regularising_velocity = 1e-4;  ///< v0 [m/s]

  static constexpr Description kDescription{
      .section = "/stribeck",
      .meaning = "friction that falls with the slip velocity, from a static to the kinetic coefficient",
      .equation = "c = [μ + (μs − μ) exp(−(v/vs)²)] tanh(v/v0) in place of s μ",
      .source = "Armstrong-Hélouvry, Dupont & Canudas de Wit 1994",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "phase volume: forces depend on velocities",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&Stribeck::static_friction>{.pointer = "/stribeck/static_friction",
                                                        .symbol = "μs",
                                                        .unit = "1",
                                                        .meaning = "friction coefficient at low slip",
                                                        .source = "0: Coulomb's law",
                                                        .range = settings::between(0.0, 2.0)},
                      Field<&Stribeck::velocity>{.pointer = "/stribeck/velocity",
                                                 .symbol = "vs",
                                                 .unit = "m/s",
                                                 .meaning = "slip velocity over which friction falls",
                                                 .source = "a hundredth of the default rotor's tip speed",
                                                 .range = settings::above_zero_up_to(1e6)},
                      Field<&Stribeck::regularising_velocity>{
                          .pointer = "/stribeck/regularising_velocity",
                          .symbol = "v0",
                          .unit = "m/s",
                          .meaning = "slip velocity over which friction passes through zero",
                          .source = "a hundredth of vs",
                          .range = settings::above_zero_up_to(1e6)}};
  }
  [[nodiscard]] bool acts() const { return static_friction != 0.0; }
};

}  // namespace rubatlas::effects
