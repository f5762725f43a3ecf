/// The two triggers: speeds near 1/n and 2/n at which the displacement rises steeply.
///
/// There the blades pass once, or twice, per period of the free rotor (n Ω = 1, n Ω = 2). The rule is in the
/// README of this folder, "Triggers".
#pragma once

#include <array>

#include "analysis/rules/line.hpp"

namespace rubatlas::analysis {

/// Scaled speeds Ω n/3 of the two triggers, and how far from them they are searched: a quarter of their
/// distance.
constexpr std::array<double, 2> kNominalTrigger{1.0 / 3.0, 2.0 / 3.0};
constexpr double kTriggerSearch = 1.0 / 12.0;
/// Scaled width of the stretches whose displacements are compared, below and above a speed.
constexpr double kTriggerStretch = 1.0 / 30.0;
/// The displacement rises steeply where it grows by this factor from the stretch below to the stretch above.
/// The forced response of a linear rotor, Ω²/(1 − Ω²), grows by at most 1.33 over the same distance with
/// three blades or more; two meet its resonance at the second trigger.
constexpr double kTriggerRise = 1.5;

struct Trigger {
  Presence presence = Presence::not_covered;
  double speed_ratio = kNotANumber;         ///< Ω [-], between the two stretches
  double displacement_below = kNotANumber;  ///< [m] geometric mean over the stretch below
  double displacement_above = kNotANumber;  ///< [m] over the stretch above

  [[nodiscard]] double rise() const { return displacement_above - displacement_below; }   ///< [m]
  [[nodiscard]] double ratio() const { return displacement_above / displacement_below; }  ///< [-]
};

/// Trigger 1 and trigger 2 of a line. `floor` [m] is the displacement below which two motions count as
/// equally small (the displacement of a shaft at rest is zero).
std::array<Trigger, 2> find_triggers(const Line& line, SpeedScale scale, double floor);

}  // namespace rubatlas::analysis
