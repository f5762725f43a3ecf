/// Random machines of every kind, and random flights of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "contact/pose.hpp"
#include "modes/flight.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::test {

constexpr double kClearanceOfMachines = 0.01;  ///< [m]

inline double between(std::mt19937_64& generator, double least, double most) {
  return least + (most - least) * static_cast<double>(generator() >> 11U) * 0x1p-53;
}

struct RandomMachine {
  explicit RandomMachine(std::mt19937_64& generator)
      : machine{{between(generator, 0.05, 2.5), damping(generator), between(generator, -0.01, 0.01), 1.0,
                 kClearanceOfMachines},
                rotor::BladeSet(1, 1.0),
                {rotor::Harmonics({})},
                {}} {
    add_blades(generator);
    add_shaft(generator);
    add_ring(generator);
    kind += ", speed ratio " + std::to_string(machine.constants.speed_ratio) + ", damping ratio " +
            std::to_string(machine.constants.damping_ratio);
  }

  rotor::Machine machine;
  std::vector<contact::Geometry> blades;
  std::string kind;
  double fastest = 1.0;  ///< frequency of what moves [per unit τ]

 private:
  static double damping(std::mt19937_64& generator) {
    const double size = between(generator, -3.0, 0.5);
    return size < -2.5 ? 0.0 : std::pow(10.0, size);
  }
  static std::size_t any(std::mt19937_64& generator, std::size_t count) {
    return static_cast<std::size_t>(between(generator, 0.0, static_cast<double>(count)));
  }

  void add_blades(std::mt19937_64& generator) {
    const std::size_t count = 1 + any(generator, 5);
    std::vector<double> angles;
    for (std::size_t k = 0; k < count; ++k) {
      angles.push_back(between(generator, 0.0, 2.0 * std::numbers::pi));
      blades.push_back({0.11 - kClearanceOfMachines * between(generator, 1.0, 1.2), 0.11});
    }
    const double speed = machine.constants.speed_ratio;
    effects::SpeedRipple ripple{};
    ripple.amplitude = 0.0;
    if (any(generator, 2) == 0) {
      ripple.amplitude = std::pow(10.0, between(generator, -3.0, -0.05));
      ripple.order = 1 + static_cast<int>(any(generator, 5));
      ripple.phase = between(generator, 0.0, 6.0);
      kind += "rippling, ";
      fastest = std::max(fastest, ripple.order * speed);
    }
    fastest = std::max(fastest, speed * (1.0 + ripple.amplitude));
    machine.blades = rotor::BladeSet(angles, speed, ripple);
  }

  void add_shaft(std::mt19937_64& generator) {
    const std::size_t terms = std::vector<std::size_t>{0, 1, 2, 5, 40}[any(generator, 5)];
    std::vector<rotor::Harmonic> harmonics;
    std::vector<rotor::HarmonicForcing> forcing;
    for (std::size_t j = 0; j < terms; ++j) {
      const double amplitude = 1e-3 * between(generator, 0.0, 1.0) / static_cast<double>(terms);
      const double phase = between(generator, 0.0, 6.0);
      const double frequency =
          std::vector<double>{0.0, 1.0, between(generator, -3.0, 3.0), machine.constants.speed_ratio}[j % 4];
      harmonics.emplace_back(amplitude, phase, frequency, machine.constants.damping_ratio);
      forcing.push_back({std::polar(amplitude, phase), frequency});
      fastest = std::max(fastest, std::abs(frequency));
    }
    if (any(generator, 2) == 0) {
      machine.shaft.shaft = rotor::Harmonics(harmonics);
      kind += "isotropic, " + std::to_string(terms) + " harmonics";
      return;
    }
    const double size = std::pow(10.0, between(generator, -2.0, 1.5));
    Eigen::Matrix2d stiffness = Eigen::Matrix2d::Identity();
    Eigen::Matrix2d damping = 2.0 * machine.constants.damping_ratio * Eigen::Matrix2d::Identity();
    for (int i = 0; i < 4; ++i) {
      stiffness(i / 2, i % 2) += size * between(generator, -0.3, 1.0);
      damping(i / 2, i % 2) += 0.3 * std::sqrt(size) * between(generator, -0.3, 1.0);
    }
    machine.shaft.shaft = rotor::SupportedShaft(rotor::LinearSupport(stiffness, damping, forcing));
    kind += "supported, " + std::to_string(terms) + " forcings, added stiffness " + std::to_string(size);
    fastest = std::max({fastest, std::sqrt(stiffness.norm()), damping.norm()});
  }

  void add_ring(std::mt19937_64& generator) {
    const std::size_t which = any(generator, 4);
    if (which == 0) machine.ring = rotor::FollowingRing{1e4};
    if (which < 2) return;
    const double frequency = std::pow(10.0, between(generator, -0.3, which == 2 ? 0.5 : 1.7));
    const double damping_ratio = std::vector<double>{0.0, 0.02, 0.3, 1.0, 2.0}[any(generator, 5)];
    machine.ring = rotor::RingBody(1.0, frequency * frequency, 2.0 * damping_ratio * frequency, 1.0);
    kind += ", ring body of frequency " + std::to_string(frequency);
    fastest = std::max(fastest, frequency * std::max(1.0, 2.0 * damping_ratio));
  }
};

/// The largest gap of the blades at a time of a flight [m²].
inline double largest_gap(const RandomMachine& random, const modes::Flight& flight, double time) {
  const rotor::State seen = rotor::from_ring(flight.state(time));
  const contact::BladeDirection first = random.machine.blades.first(time);
  double largest = -INFINITY;
  for (std::size_t k = 0; k < random.blades.size(); ++k) {
    const auto er = random.machine.blades.direction(static_cast<int>(k), first);
    largest = std::max(largest, pose_of(random.machine.constants, random.blades[k], er, seen).gap);
  }
  return largest;
}

/// Starts a flight with a random state, all of whose tips are within the ring.
inline void start_anywhere(std::mt19937_64& generator, const RandomMachine& random, modes::Flight& flight) {
  const double size = kClearanceOfMachines * std::pow(10.0, between(generator, -2.0, 0.0));
  const double time = between(generator, 0.0, 2.0);
  double shrunk = 1.0;
  rotor::ShaftAndRing bodies;
  for (double& component : bodies) component = between(generator, -size, size);
  const rotor::RingBody* ring = random.machine.ring_body();
  if (ring == nullptr) bodies.tail<4>() = 0.0;
  if (ring != nullptr) bodies.tail<2>() *= ring->frequency();
  do {
    flight.start(time, shrunk * bodies);
    shrunk *= 0.5;
  } while (largest_gap(random, flight, time) >= 0.0 && shrunk > 1e-3);
}

}  // namespace rubatlas::test
