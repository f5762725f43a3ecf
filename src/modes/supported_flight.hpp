/// Flight of a shaft on a general linear support, with the interface of `Flight`.
#pragma once

#include <complex>
#include <cstdint>

#include "modes/flight.hpp"
#include "rotor/linear_support.hpp"
#include "rotor/support_bounds.hpp"

namespace rubatlas::modes {

/// What acts on such a shaft besides blades: its support and all harmonic forcings, as one forcing.
struct SupportedShaft {
  static constexpr bool kPresent = true;
  static constexpr bool kAnySupport = true;

  explicit SupportedShaft(rotor::LinearSupport linear_support)
      : support(std::move(linear_support)), bounds(support) {}

  rotor::LinearSupport support;
  rotor::SupportBounds bounds;
};

template <>
class Flight<SupportedShaft> {
 public:
  static constexpr bool kAnySupport = true;

  Flight(const rotor::RotorConstants& /*rotor*/, const rotor::FreeMotion& /*free*/,
         const SupportedShaft& shaft)
      : shaft_(&shaft) {}

  void start(double time, const rotor::State& state) {
    start_ = time;
    state_ = state.matrix();
  }
  [[nodiscard]] double start_time() const { return start_; }
  [[nodiscard]] rotor::State state(double time) const {
    return shaft_->support.state(start_, state_, time - start_).array();
  }
  [[nodiscard]] std::complex<double> acceleration(double time, const rotor::State& state) const {
    return shaft_->support.acceleration(time, state.matrix());
  }
  [[nodiscard]] double amplitude_bound(double time, const rotor::State& state, double horizon) const {
    return shaft_->bounds.amplitude_bound(time, state.matrix(), horizon);
  }
  [[nodiscard]] double displacement_bound(double time, const rotor::State& state, double horizon) const {
    return amplitude_bound(time, state, horizon);
  }
  /// Time in which the bound of a growing motion grows by a factor of e.
  [[nodiscard]] double time_of_bound() const { return shaft_->bounds.growth_time(); }
  /// Whether double precision resolves free motion over this time.
  [[nodiscard]] bool resolves(double time) const { return shaft_->support.resolves(time); }
  /// Price of one state [ns].
  [[nodiscard]] std::int64_t price_of_state() const {
    constexpr std::int64_t kMatrix = 300;
    constexpr std::int64_t kTerm = 150;
    return kMatrix + kTerm * static_cast<std::int64_t>(shaft_->support.terms().size());
  }
  [[nodiscard]] double second_bound(double bound) const { return shaft_->bounds.second_bound(bound); }
  [[nodiscard]] double third_bound(double bound) const { return shaft_->bounds.third_bound(bound); }

 private:
  const SupportedShaft* shaft_;
  double start_ = 0.0;
  rotor::LinearSupport::State state_ = rotor::LinearSupport::State::Zero();
};

}  // namespace rubatlas::modes
