/// Blades of the default rotor with axial compliance, as elastica or beam-columns, in rings that yield or
/// hold them to the fold: laws, places of the tip and forces for the tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "rotors.hpp"

namespace rubatlas::contact {

using blade::Theory;
inline constexpr Ring kReleasedAtFold{.releases_at_fold = true};

inline constexpr double kYoungsModulus = 206e9;
inline constexpr double kWidth = 0.01;

/// A blade of the default rotor; `share` of its full axial compliance ε = h²/(12 L²).
struct BladeCase {
  double friction = 0.1;
  double share = 0.0;
  Theory theory = Theory::elastica;
  double thickness = kDefaultRotor.thickness;

  [[nodiscard]] double axial_stiffness() const {
    return kYoungsModulus * kWidth * thickness / share;
  }  ///< EA
  [[nodiscard]] double load_unit() const {
    return kYoungsModulus * kWidth * std::pow(thickness, 3) / 12 / std::pow(kDefaultRotor.length, 2);
  }
  [[nodiscard]] double euler_load() const { return blade::kEulerLoad * load_unit(); }
};

inline ElasticaContact make(const BladeCase& blade, const Ring& ring = {}) {
  const double length = kDefaultRotor.length;
  const double compliance = blade.share * blade.thickness * blade.thickness / (12 * length * length);
  return {kDefaultRotor.geometry(),
          {length, blade.thickness, blade.load_unit() * length * length},
          std::make_shared<const blade::ElasticaCurve>(blade.friction, blade.theory, compliance),
          ring};
}

/// Tip at ct = `lateral`, `penetration` beyond the ring along the radius.
inline Pose pressed_tip(double penetration, double lateral = 0.0) {
  const double radius = kDefaultRotor.ring_radius;
  const double outward = std::sqrt(std::pow(radius + penetration, 2) - lateral * lateral);
  return {outward - kDefaultRotor.geometry().reach, lateral, 0.001, 0.002,
          penetration * (2 * radius + penetration)};
}

/// Force of a contact that has just opened (`bending` 0), or of a contact that is followed from `bending`.
inline TipForce force_at(const ElasticaContact& law, const Pose& at, double slip = 1.0,
                         double bending = 0.0) {
  TipForce force{};
  if (bending == 0.0) bending = law.solve(at, slip).value_or(0.0);
  EXPECT_TRUE(law.respond(at, slip, 0.3, bending, force));
  return force;
}
inline TipForce force_at(const ElasticRingContact& law, const Pose& at) {
  return law.force(at, 1.0, 0.3);
}

}  // namespace rubatlas::contact
