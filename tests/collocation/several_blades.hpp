/// Random rotors of which several blades touch at a time.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>

#include "contact/elastica_contact.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::test {

inline constexpr double kClearanceOfSeveral = 0.01;  // [m]

struct Rotor {
  rotor::RotorConstants constants;
  rotor::BladeSet blades;
  contact::ElasticaContact law;
};

inline double uniform(std::mt19937_64& generator, double least, double most) {
  return least + (most - least) * static_cast<double>(generator() >> 11U) * 0x1p-53;
}

enum class Friction : std::uint8_t { some, none };

/// Two to twelve blades, so far beyond the ring's centre that several touch at a time.
inline Rotor random_rotor(std::mt19937_64& generator, Friction rubs = Friction::some) {
  const double drawn = std::pow(10.0, uniform(generator, -2.0, 0.0));
  const double friction = rubs == Friction::some ? drawn : 0.0;
  const double thickness = std::pow(10.0, uniform(generator, -3.7, -2.8));
  const double speed = uniform(generator, 0.1, 1.0);
  const double stiffness = 206e9 * 0.01 * thickness * thickness * thickness / 12.0;
  const int count = 2 + static_cast<int>(uniform(generator, 0.0, 11.0));
  return {{speed, std::pow(10.0, uniform(generator, -2.0, -0.3)),
           kClearanceOfSeveral * uniform(generator, 1.0, 2.0), 0.01, kClearanceOfSeveral},
          {count, speed},
          {{0.1, 0.11}, {0.1, thickness, stiffness}, std::make_shared<blade::ElasticaCurve>(friction)}};
}

inline rotor::State random_start(std::mt19937_64& generator) {
  rotor::State start;
  for (double& component : start) component = uniform(generator, -0.01, 0.01);
  return start;
}

}  // namespace rubatlas::test
