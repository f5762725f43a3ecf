/// Flight: no blade in contact, motion in closed form (MODEL 4.5), of any machine. Shaft and ring move
/// independently; blades see the shaft as it moves against the ring.
#pragma once

#include <complex>
#include <cstdint>
#include <map>
#include <span>

#include "modes/flight_row.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/machine.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

/// Bounds of shaft and ring while they fly.
struct FlightBound {
  double shaft;                ///< of |z| [m] and |z'| [m per unit τ]
  double ring_position = 0.0;  ///< of |r| [m]
  double ring_velocity = 0.0;  ///< of |r'| [m per unit τ], and of the ring's energy norm

  /// Of |z − r| and |z' − r'|.
  [[nodiscard]] double position() const { return shaft + ring_position; }
  [[nodiscard]] double velocity() const { return shaft + ring_velocity; }
};

class Flight {
 public:
  using Complex = std::complex<double>;

  /// `machine` outlives the flight.
  explicit Flight(const rotor::Machine& machine);

  /// Takes off at time τ of the revolution. A ring that is no body is at rest in its place.
  void start(double time, const rotor::ShaftAndRing& bodies);

  [[nodiscard]] const rotor::Machine& machine() const { return *machine_; }
  [[nodiscard]] double start_time() const { return start_; }
  [[nodiscard]] const rotor::ShaftAndRing& at_start() const { return at_start_; }
  [[nodiscard]] rotor::ShaftAndRing state(double time) const;
  /// The shaft's part of it.
  [[nodiscard]] rotor::State shaft(double time) const;

  /// Whether double precision resolves free motion over this time.
  [[nodiscard]] bool resolves(double time) const;

  /// Bounds from a state of this flight over the time `horizon` that follows, which may be infinite.
  ///
  /// On an isotropic shaft damping only reduces (|z|² + |z'|²)^½, so that it grows by |forcing| per unit of
  /// time at most; and that of the distance to the steady response does not grow at all. `of_velocity`: |z'|
  /// is bounded, too, not |z| alone.
  [[nodiscard]] FlightBound bound(double time, const rotor::ShaftAndRing& bodies, double horizon,
                                  bool of_velocity = true) const;
  /// The shaft's part of it.
  [[nodiscard]] double shaft_bound(double time, const rotor::State& state, double horizon,
                                   bool of_velocity) const;
  /// The time over which a bound is to be asked for. Where free motion may grow, the bound is renewed after
  /// this time; else the time is infinite.
  [[nodiscard]] double time_of_bound() const;

  /// Of z − r while its bound holds.
  [[nodiscard]] rotor::DerivativeBounds derivative_bounds(const FlightBound& bound) const;

  /// Price of one state [ns].
  [[nodiscard]] std::int64_t price_of_state() const;

  /// x, and y unless it is empty [m], at the times from number `first` on, which lie in this flight.
  void places(const trajectory::SampleTimes& times, int first, std::span<double> x,
              std::span<double> y) const;
  /// The largest |z| between two times of this flight [m], or `known` where it is not larger than that.
  [[nodiscard]] double largest_displacement(double begin, double end, double known) const;

 private:
  /// What reads this flight at equally spaced times, made where it is asked for.
  StateRow& row_of(double spacing) const {
    return rows_.try_emplace(spacing, *machine_, spacing).first->second;
  }
  [[nodiscard]] double top_between(double from, double to, double rate_from, double rate_to) const;

  const rotor::Machine* machine_;
  rotor::FreeMotion free_;                  ///< of an isotropic shaft
  const rotor::Harmonics* harmonics_;       ///< on an isotropic shaft; null where none acts
  const rotor::SupportedShaft* supported_;  ///< null: isotropic
  const rotor::RingBody* ring_;             ///< null where the ring is no body
  double start_ = 0.0;
  rotor::ShaftAndRing at_start_ = rotor::ShaftAndRing::Zero();
  mutable std::map<double, StateRow> rows_;  ///< by their spacing
};

}  // namespace rubatlas::modes
