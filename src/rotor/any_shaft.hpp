/// What acts on a shaft besides blades, chosen at run time.
#pragma once

#include <complex>
#include <utility>
#include <variant>

#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/harmonic.hpp"
#include "rotor/linear_support.hpp"
#include "rotor/support_bounds.hpp"

namespace rubatlas::rotor {

/// A general linear support and all harmonic forcings, as one forcing.
struct SupportedShaft {
  explicit SupportedShaft(LinearSupport linear_support)
      : support(std::move(linear_support)), bounds(support) {}

  LinearSupport support;
  SupportBounds bounds;
};

/// Harmonic forcings on the paper's isotropic support, or any linear support with its forcings. Each has its
/// own closed form of flight (`modes/flight.hpp`).
struct AnyShaft {
  std::variant<Harmonics, SupportedShaft> shaft;

  /// z'' [m per unit τ²] at time τ of the revolution, where blades push the shaft by `force` [N].
  [[nodiscard]] std::complex<double> acceleration(const RotorConstants& rotor, double time,
                                                  const State& state,
                                                  const std::complex<double>& force) const {
    if (const auto* supported = std::get_if<SupportedShaft>(&shaft))
      return supported->support.acceleration(time, state.matrix()) + rotor.force_unit * force;
    return shaft_acceleration(rotor, state, force) + std::get_if<Harmonics>(&shaft)->acceleration(time);
  }
};

}  // namespace rubatlas::rotor
