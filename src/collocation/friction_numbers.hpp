/// The friction law of an interval, as numbers (`contact/friction_law.hpp`).
#pragma once

#include <cstdint>

#include "contact/friction_law.hpp"
#include "contact/sticking.hpp"

namespace rubatlas::collocation {

struct FrictionNumbers {
  /// `rest`: a tip that sticks, under which v = 0 takes the place of c = c(v).
  enum class Law : std::uint8_t { coulomb, regularised, stribeck, rest };

  Law law;                             ///< c(v)
  double friction;                     ///< μ, or the kinetic μk [-]
  double static_friction = 0.0;        ///< μs [-], of a tip that may stick, too
  double stribeck_velocity = 0.0;      ///< vs [m per unit τ]
  double regularising_velocity = 0.0;  ///< v0 [m per unit τ]

  /// |c| up to which a rigid tip is held.
  [[nodiscard]] double largest_at_rest() const { return (1.0 + contact::kShareBeyondCone) * static_friction; }
};

FrictionNumbers numbers_of(const contact::CoulombFriction& friction);
FrictionNumbers numbers_of(const contact::VelocityFriction& friction);
/// Of a tip that slips.
FrictionNumbers numbers_of(const contact::StickingFriction& friction);

}  // namespace rubatlas::collocation
