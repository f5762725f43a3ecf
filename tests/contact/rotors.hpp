/// The two rotors on which contacts are tested (MODEL 6.1, 6.2), and random poses of their blades.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <random>

#include "contact/elastica_contact.hpp"

namespace rubatlas::contact {

struct TestRotor {
  double ring_radius;     ///< R [m]
  double length;          ///< L [m]
  double hub_radius;      ///< rh [m]
  double youngs_modulus;  ///< E [Pa]
  double width;           ///< b [m]
  double thickness;       ///< h [m]
  double misalignment;    ///< y0 [m]

  [[nodiscard]] Geometry geometry() const { return {hub_radius + length, ring_radius}; }
  [[nodiscard]] double load_unit() const {  ///< EI/L² [N]
    return youngs_modulus * width * thickness * thickness * thickness / 12 / (length * length);
  }
  [[nodiscard]] double euler_load() const {
    return std::numbers::pi * std::numbers::pi / 4 * load_unit();
  }  ///< [N]
  [[nodiscard]] ElasticaContact contact(double friction) const {
    static std::map<double, std::shared_ptr<const blade::ElasticaCurve>> curves;
    auto& curve = curves[friction];
    if (!curve) curve = std::make_shared<const blade::ElasticaCurve>(friction);
    const double stiffness = youngs_modulus * width * thickness * thickness * thickness / 12;
    return {geometry(), {length, thickness, stiffness}, curve};
  }
};

inline constexpr TestRotor kDefaultRotor{0.11, 0.1, 0.0, 206e9, 0.01, 0.001, 0.01001};
inline constexpr TestRotor kRig{0.0625, 0.04, 0.02215, 206e9, 0.0127, 0.0005, 0.00036};

/// Blade k at the angle φ, the shaft centre at c in the frame of the ring.
inline Pose pose_at(const Geometry& geometry, double angle, double cx, double cy, double vx = 0.0,
                    double vy = 0.0) {
  return pose(geometry, {std::cos(angle), std::sin(angle)}, cx, cy, vx, vy);
}

/// Random contacts (g > 0) with the shaft up to `farthest` of R from the ring's centre.
class RandomContacts {
 public:
  RandomContacts(const TestRotor& rotor, double farthest, std::uint64_t seed)
      : geometry_(rotor.geometry()), farthest_(farthest * rotor.ring_radius), random_(seed) {}

  Pose next() {
    while (true) {
      const double distance = farthest_ * uniform_(random_);
      const double direction = 2 * std::numbers::pi * uniform_(random_);
      const double speed = 0.3 * geometry_.reach * uniform_(random_);
      const double heading = 2 * std::numbers::pi * uniform_(random_);
      const double angle = 2 * std::numbers::pi * uniform_(random_);
      const Pose at =
          pose_at(geometry_, angle, distance * std::cos(direction), distance * std::sin(direction),
                  speed * std::cos(heading), speed * std::sin(heading));
      if (at.gap > 0.0) return at;
    }
  }
  double uniform() { return uniform_(random_); }

 private:
  Geometry geometry_;
  double farthest_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

}  // namespace rubatlas::contact
