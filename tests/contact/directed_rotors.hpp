/// Directed blades of the test rotors, and what their contacts must satisfy, worked out anew.
#pragma once

#include <array>
#include <cmath>

#include "contact/directed_elastica.hpp"
#include "rotors.hpp"

namespace rubatlas::contact {

inline DirectedElastica directed(LoadDirection direction, const TestRotor& rotor, const Friction& friction) {
  return {direction,
          rotor.geometry(),
          {rotor.length, rotor.thickness, rotor.load_unit() * rotor.length * rotor.length},
          friction};
}

/// A contact with its blade, as `respond` leaves it.
struct Met {
  bool found;
  double bending = 0.0;
  double amplitude = 0.0;
  TipForce force{};
};

template <class Law>
Met meet(const Law& law, const Pose& at, double slip, double speed, double bending = 0.0,
         double amplitude = 0.0) {
  blade::Bend bend{bending, amplitude};
  TipForce force{};
  const bool found = law.respond(at, slip, speed, bend, force);
  return {found, bend.modulus, bend.amplitude, force};
}

inline double difference(const TipForce& one, const TipForce& other) {
  return std::hypot(one.radial - other.radial, one.tangential - other.tangential);
}

}  // namespace rubatlas::contact
