/// Flight of a shaft on a general linear support, and of one whose support is chosen at run time, with the
/// interface of `Flight`.
#pragma once

#include <complex>
#include <cstdint>
#include <variant>

#include "modes/flight.hpp"
#include "rotor/any_shaft.hpp"
#include "rotor/harmonic.hpp"
#include "rotor/linear_support.hpp"

namespace rubatlas::modes {

template <>
class Flight<rotor::SupportedShaft> {
 public:
  Flight(const rotor::RotorConstants& /*rotor*/, const rotor::FreeMotion& /*free*/,
         const rotor::SupportedShaft& shaft)
      : shaft_(&shaft) {}

  void start(double time, const rotor::State& state) {
    start_ = time;
    state_ = state.matrix();
  }
  [[nodiscard]] bool is_isotropic() const { return false; }
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
  /// Bound of the harmonic forcings [m per unit τ²].
  [[nodiscard]] double forcing_bound() const { return shaft_->bounds.forcing_bound(); }
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
  const rotor::SupportedShaft* shaft_;
  double start_ = 0.0;
  rotor::LinearSupport::State state_ = rotor::LinearSupport::State::Zero();
};

template <>
class Flight<rotor::AnyShaft> {
  using OfEither = std::variant<Flight<rotor::Harmonics>, Flight<rotor::SupportedShaft>>;

  template <class Question>
  auto ask(Question question) const {
    return std::visit(question, flight_);
  }

 public:
  Flight(const rotor::RotorConstants& rotor, const rotor::FreeMotion& free, const rotor::AnyShaft& shaft)
      : flight_(std::visit([&]<class Forcing>(const Forcing& forcing)
                               -> OfEither { return Flight<Forcing>(rotor, free, forcing); },
                           shaft.shaft)) {}

  void start(double time, const rotor::State& state) {
    std::visit([&](auto& flight) { flight.start(time, state); }, flight_);
  }
  [[nodiscard]] bool is_isotropic() const {
    return ask([](const auto& flight) { return flight.is_isotropic(); });
  }
  [[nodiscard]] double start_time() const {
    return ask([](const auto& flight) { return flight.start_time(); });
  }
  [[nodiscard]] rotor::State state(double time) const {
    return ask([&](const auto& flight) { return flight.state(time); });
  }
  [[nodiscard]] std::complex<double> acceleration(double time, const rotor::State& state) const {
    return ask([&](const auto& flight) { return flight.acceleration(time, state); });
  }
  [[nodiscard]] double amplitude_bound(double time, const rotor::State& state, double horizon) const {
    return ask([&](const auto& flight) { return flight.amplitude_bound(time, state, horizon); });
  }
  [[nodiscard]] double displacement_bound(double time, const rotor::State& state, double horizon) const {
    return ask([&](const auto& flight) { return flight.displacement_bound(time, state, horizon); });
  }
  [[nodiscard]] double second_bound(double bound) const {
    return ask([&](const auto& flight) { return flight.second_bound(bound); });
  }
  [[nodiscard]] double third_bound(double bound) const {
    return ask([&](const auto& flight) { return flight.third_bound(bound); });
  }
  [[nodiscard]] double forcing_bound() const {
    return ask([](const auto& flight) { return flight.forcing_bound(); });
  }
  [[nodiscard]] double time_of_bound() const {
    return ask([](const auto& flight) { return modes::time_of_bound(flight); });
  }
  [[nodiscard]] bool resolves(double time) const {
    return ask([&](const auto& flight) { return flight.resolves(time); });
  }
  [[nodiscard]] std::int64_t price_of_state() const {
    return ask([](const auto& flight) { return modes::price_of_state(flight); });
  }

 private:
  OfEither flight_;
};

}  // namespace rubatlas::modes
