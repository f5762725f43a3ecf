/// Effect `ring_body`: the ring is one body on a spring and a damper, which all blades in contact push
/// together.
///
///     m_r r'' + c_r r' + kr r = −ΣFk        r: the ring's centre from its place of rest (here in time, not
///     τ)
///
/// Blades meet the ring where it is: gaps, forces and slip follow from z − r and z' − r'. Under the laws
/// `elastica` and `beam_column` the blade's own compliance is the only one between shaft and ring; under
/// `elastic_ring` the ring yields under each tip by /ring/stiffness as before, and moves as a whole besides.
/// Without mass, m_r = 0, the spring balances the blades at every instant, kr r = −ΣFk, so that the forces of
/// the blades depend on each other; this is computed for the law `elastic_ring` without damping only. The
/// ring moves in the plane and does not turn.
/// Source: Newton; kr as in MODEL 4.7, for the whole ring.
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct RingBody {
  double mass = 1.0;         ///< m_r [kg]; 0: its spring balances the blades at every instant
  double compliance = 1e-4;  ///< 1/kr [m/N]; 0: the ring is fixed
  double damping = 0.0;      ///< c_r [N s/m]

  static constexpr Description kDescription{
      .section = "/ring_body",
      .meaning =
          "a ring that all blades in contact push as one body, on a spring and a damper, with mass or "
          "without",
      .equation = "m_r r'' + c_r r' + kr r = −ΣFk; z − r in place of z in each contact",
      .source = "Newton; kr as under the contact law elastic_ring, for the whole ring",
      .flight = "closed form: a free oscillator beside the shaft",
      .breaks =
          "a state alone no longer says how the ring moves; phase volume contracts by e^{-2 c_r T/(m_r ωn)} "
          "more",
  };
  static constexpr Memory kMemory{
      .inner_axis = "component",
      .units = "m",
      .long_name = "the ring's displacement from its place of rest and velocity, as final_state",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&RingBody::mass>{.pointer = "/ring_body/mass",
                                             .symbol = "m_r",
                                             .unit = "kg",
                                             .meaning = "mass of the ring",
                                             .source = "the rotor's",
                                             .range = settings::between(0.0, settings::kHeaviestMass)},
                      Field<&RingBody::compliance>{.pointer = "/ring_body/compliance",
                                                   .symbol = "1/kr",
                                                   .unit = "m/N",
                                                   .meaning = "compliance of the ring's suspension",
                                                   .source = "that of law elastic_ring's default",
                                                   .range = settings::between(0.0, 1e6)},
                      Field<&RingBody::damping>{.pointer = "/ring_body/damping",
                                                .symbol = "c_r",
                                                .unit = "N s/m",
                                                .meaning = "damping of the ring's suspension",
                                                .source = "none",
                                                .range = settings::between(0.0, 1e15)}};
  }
  /// A suspension that does not yield holds the ring where it is.
  [[nodiscard]] bool acts() const { return compliance != 0.0; }
};

}  // namespace rubatlas::effects
