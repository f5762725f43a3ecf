/// The arc of contacts of a rotor whose blades are alike, with all that it needs.
#pragma once

#include <optional>
#include <vector>

#include "collocation/contact_arc.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::test {

struct ArcOfRotor {
  /// `unbalance`: null where none acts.
  ArcOfRotor(const rotor::RotorConstants& rotor_constants, int blade_count,
             const contact::ElasticaContact& law, const rotor::Harmonic* unbalance,
             const collocation::ContactArc::Limits& limits)
      : rotor(rotor_constants),
        blades(rotor::equal_angles(blade_count), rotor.speed_ratio, {}),
        laws(std::vector(static_cast<std::size_t>(blade_count), law)),
        shaft{rotor::Harmonics(unbalance != nullptr ? std::vector{*unbalance}
                                                    : std::vector<rotor::Harmonic>{})},
        arc(rotor, blades, laws, shaft, nullptr, limits) {}
  ArcOfRotor(const ArcOfRotor&) = delete;
  ArcOfRotor& operator=(const ArcOfRotor&) = delete;

  /// Begins in a state of the shaft.
  void begin(double time, const rotor::State& state, std::span<const collocation::Touch> touching) {
    arc.begin(time, rotor::as<rotor::ShaftAndRing>(state), touching);
  }
  [[nodiscard]] bool lifts_off() const {
    using enum collocation::ContactArc::Guard;
    return arc.ending().guard == unbent || arc.ending().guard == under_load;
  }
  [[nodiscard]] rotor::State end_state() const { return rotor::shaft(arc.end().bodies); }

  rotor::RotorConstants rotor;
  rotor::RipplingBlades blades;
  collocation::ContactArc::Laws laws;
  rotor::AnyShaft shaft;
  collocation::ContactArc arc;
};

}  // namespace rubatlas::test
