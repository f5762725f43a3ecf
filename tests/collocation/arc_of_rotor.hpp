/// The arc of contacts of a rotor whose blades are alike, with all that it needs.
#pragma once

#include <optional>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "collocation/axial_law.hpp"
#include "collocation/contact_arc.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::test {

struct ArcOfRotor {
  /// `unbalance`: null where none acts. `tolerance` [m].
  ArcOfRotor(const rotor::RotorConstants& rotor, int blade_count, const contact::ElasticaContact& law,
             const rotor::Harmonic* unbalance, double tolerance)
      : machine(machine_of(rotor, rotor::BladeSet(blade_count, rotor.speed_ratio),
                           rotor::Harmonics(unbalance != nullptr ? std::vector{*unbalance}
                                                                 : std::vector<rotor::Harmonic>{}))),
        law_of_arc(laws_of(law, blade_count)),
        arc(machine, law_of_arc, tolerance, kMaxShortening) {}
  ArcOfRotor(const ArcOfRotor&) = delete;
  ArcOfRotor& operator=(const ArcOfRotor&) = delete;

  /// Begins in a state of the shaft.
  void begin(double time, const rotor::State& state, std::span<collocation::Touch> touching) {
    arc.begin(time, rotor::shaft_and_ring(state), touching);
  }
  [[nodiscard]] bool lifts_off() const {
    using enum collocation::ContactArc::Guard;
    return arc.ending().guard == unbent || arc.ending().guard == under_load;
  }
  [[nodiscard]] rotor::State end_state() const { return rotor::shaft(arc.end().bodies); }

  rotor::Machine machine;
  static constexpr double kMaxShortening = 0.5;
  collocation::AxialLaw law_of_arc;
  collocation::ContactArc arc;
};

}  // namespace rubatlas::test
