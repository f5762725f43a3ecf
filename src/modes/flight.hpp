/// Flight: no blade in contact, motion in closed form (MODEL 4.5).
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "integrate/newton_between.hpp"
#include "modes/flight_row.hpp"
#include "modes/state_row.hpp"
#include "modes/work_meter.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/harmonic.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

template <class Forcing>
class Flight {
 public:
  using Complex = std::complex<double>;

  Flight(const rotor::RotorConstants& rotor, const rotor::FreeMotion& free, const Forcing& forcing)
      : rotor_(&rotor), free_(&free), forcing_(&forcing) {}

  /// Takes off at time τ of the revolution.
  void start(double time, const rotor::State& state) {
    start_ = time;
    position_ = {state[0], state[1]};
    velocity_ = {state[2], state[3]};
  }

  /// Whether the shaft's support and ring are the paper's, so that bounds of single terms hold.
  [[nodiscard]] bool is_isotropic() const { return true; }
  [[nodiscard]] double start_time() const { return start_; }

  [[nodiscard]] rotor::State state(double time) const {
    const double elapsed = time - start_;
    const auto kernel = free_->kernel(elapsed);
    const double damping = free_->damping_ratio();
    Complex position = rotor::FreeMotion::position(kernel, damping, position_, velocity_);
    Complex velocity = rotor::FreeMotion::velocity(kernel, damping, position_, velocity_);
    if constexpr (Forcing::kPresent) {
      const auto response = forcing_->from_rest(start_, elapsed, *free_, kernel);
      position += response.position;
      velocity += response.velocity;
    }
    return {position.real(), position.imag(), velocity.real(), velocity.imag()};
  }

  /// Whether double precision resolves free motion over this time.
  [[nodiscard]] static bool resolves(double /*time*/) { return true; }
  /// z'' [m per unit τ²] of a state in flight.
  [[nodiscard]] Complex acceleration(double time, const rotor::State& state) const {
    Complex result = -2.0 * rotor_->damping_ratio * Complex(state[2], state[3]) - Complex(state[0], state[1]);
    if constexpr (Forcing::kPresent) result += forcing_->acceleration(time);
    return result;
  }

  /// Bound of (|z|² + |z'|²)^½ from a state of this flight over the time `horizon` that follows, which may be
  /// infinite. Damping only reduces this norm, so that it grows by |forcing| per unit of time at most; and
  /// the norm of the distance to the steady response does not grow at all.
  [[nodiscard]] double amplitude_bound(double time, const rotor::State& state, double horizon) const {
    return bound(time, state, horizon, [](const auto& steady) {
      return std::sqrt(steady.largest_square + steady.largest_velocity_square);
    });
  }
  /// The same of |z| alone.
  [[nodiscard]] double displacement_bound(double time, const rotor::State& state, double horizon) const {
    return bound(time, state, horizon, [](const auto& steady) { return std::sqrt(steady.largest_square); });
  }

  /// Bounds of |z''| and |z'''| while |z| and |z'| are within `bound`.
  [[nodiscard]] double second_bound(double bound) const {
    const double damping = 2.0 * rotor_->damping_ratio;
    return std::sqrt(1.0 + damping * damping) * bound + forcing_bound();
  }
  [[nodiscard]] double third_bound(double bound) const {
    double result = 2.0 * rotor_->damping_ratio * second_bound(bound) + bound;
    if constexpr (Forcing::kPresent) result += forcing_->rate();
    return result;
  }

  /// Moves a row of eight times to this state; `more`: what else its start takes.
  template <class Row, class... More>
  void start_row(Row& row, double time, const rotor::State& state,
                 const More&... more) const requires FliesInRows<Forcing> {
    if constexpr (Forcing::kPresent) {
      const Complex direction = std::polar(1.0, forcing_->frequency() * time);
      row.start(state, &direction, more...);
    } else {
      row.start(state, nullptr, more...);
    }
  }
  [[nodiscard]] FlightRow row() const requires FliesInRows<Forcing> {
    return FlightRow(*rotor_, *free_, *forcing_);
  }

  /// x, and y unless it is empty [m], at the times from number `first` on, which lie in this flight.
  void places(const trajectory::SampleTimes& times, int first, std::span<double> x,
              std::span<double> y) const requires FliesInRows<Forcing> {
    constexpr int kRowsFromClosedForm = 16;  // rounding of each row adds up
    StateRow& row = row_of(sample_row_, times.spacing());
    int number = first;
    rotor::State at = state(times[number]);
    x[0] = at[0];
    if (!y.empty()) y[0] = at[1];
    std::size_t done = 1;
    for (int rows = 1; done < x.size(); ++rows) {
      start_row(row, times[number], at);
      const std::size_t count = std::min<std::size_t>(StateRow::kTimes, x.size() - done);
      std::copy_n(row.x().data(), count, &x[done]);
      if (!y.empty()) std::copy_n(row.y().data(), count, &y[done]);
      done += count;
      number += static_cast<int>(count);
      at = rows % kRowsFromClosedForm == 0 ? state(times[number]) : row.state(StateRow::kTimes - 1);
    }
  }

  /// The largest |z| between two times of this flight [m], or `known` where it is not larger than that.
  [[nodiscard]] double largest_displacement(double begin, double end,
                                            double known) const requires FliesInRows<Forcing> {
    const double spacing = trajectory::spacing_of_distances(rotor_->speed_ratio);
    StateRow& row = row_of(distance_row_, spacing);
    double largest = known * known;
    const auto take = [&](const rotor::State& there) {
      largest = std::max(largest, there[0] * there[0] + there[1] * there[1]);
    };
    rotor::State at = state(begin);
    double time = begin;
    double rate = distance_rate(at);
    take(at);
    while (time < end) {
      const double bound = displacement_bound(time, at, end - time);
      if (!(bound * bound > largest)) break;
      start_row(row, time, at);
      const double row_begin = time;
      for (int i = 0; i < StateRow::kTimes && time < end; ++i) {
        const double next = std::min(row_begin + (i + 1) * spacing, end);
        const rotor::State there = next < end ? row.state(i) : state(end);
        const double rate_there = distance_rate(there);
        take(there);
        if (rate > 0.0 && rate_there < 0.0) take(state(top_between(time, next, rate, rate_there)));
        time = next;
        at = there;
        rate = rate_there;
      }
    }
    return largest > known * known ? std::sqrt(largest) : known;
  }

  /// Bound of the forcing's acceleration [m per unit τ²].
  [[nodiscard]] double forcing_bound() const {
    if constexpr (Forcing::kPresent) return forcing_->amplitude();
    return 0.0;
  }

 private:
  StateRow& row_of(std::optional<StateRow>& row, double spacing) const {
    if (!row || row->spacing() != spacing) row.emplace(*free_, *forcing_, spacing);
    return *row;
  }
  /// z·z', half of the rate of |z|².
  static double distance_rate(const rotor::State& state) { return state[0] * state[2] + state[1] * state[3]; }
  /// The time between two others when |z| is largest, from its rates there.
  [[nodiscard]] double top_between(double from, double to, double rate_from, double rate_to) const {
    const auto rate = [&](double time) {
      const rotor::State at = state(time);
      const Complex second = acceleration(time, at);
      return integrate::ValueAndSlope{
          distance_rate(at), at[2] * at[2] + at[3] * at[3] + at[0] * second.real() + at[1] * second.imag()};
    };
    constexpr double kClosest = 1e-4;  // a maximum is flat
    const double guess = from + (to - from) * rate_from / (rate_from - rate_to);
    return integrate::newton_between(rate, from, to, guess, false, kClosest * (to - from));
  }
  /// `size`: a bound of the norm in question, of the steady response.
  template <class Size>
  [[nodiscard]] double bound(double time, const rotor::State& state, double horizon, Size size) const {
    double result = std::sqrt(state.square().sum());
    if constexpr (Forcing::kPresent) {
      result += forcing_->amplitude() * horizon;
      if (const auto steady = forcing_->steady(time)) {
        const double distance = std::sqrt(std::norm(Complex(state[0], state[1]) - steady->position) +
                                          std::norm(Complex(state[2], state[3]) - steady->velocity));
        result = std::min(result, distance + size(*steady));
      }
    }
    return result;
  }

  const rotor::RotorConstants* rotor_;
  const rotor::FreeMotion* free_;
  const Forcing* forcing_;
  double start_ = 0.0;
  Complex position_;
  Complex velocity_;
  // What reads this flight at equally spaced times, made where it is asked for.
  mutable std::optional<StateRow> sample_row_;
  mutable std::optional<StateRow> distance_row_;
};

/// Bounds of |z| and |z'|, in a flight where one number bounds both.
inline double position_bound(double bound) {
  return bound;
}
inline double velocity_bound(double bound) {
  return bound;
}

/// As `displacement_bound`, for the shaft's displacement relative to that of the ring.
template <class Flight, class Bodies>
double bound_from_ring(const Flight& flight, double time, const Bodies& bodies, double horizon) {
  if constexpr (requires { flight.bound_from_ring(time, bodies, horizon); }) {
    return flight.bound_from_ring(time, bodies, horizon);
  } else {
    return flight.displacement_bound(time, bodies, horizon);
  }
}

/// Price of one state in a flight [ns].
template <class Flight>
std::int64_t price_of_state(const Flight& flight) {
  if constexpr (requires { flight.price_of_state(); }) return flight.price_of_state();
  return WorkPrice::kState;
}

/// The time over which a bound of a flight's motion is computed. Where free motion may grow the bound is
/// renewed after this time; else the time is infinite.
template <class Flight>
double time_of_bound(const Flight& flight) {
  if constexpr (requires { flight.time_of_bound(); }) return flight.time_of_bound();
  return std::numeric_limits<double>::infinity();
}

}  // namespace rubatlas::modes
