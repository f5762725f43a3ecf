/// Flight as those see it who record a motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "observables/largest_distance.hpp"
#include "observables/motion_piece.hpp"
#include "solve/bodies.hpp"
#include "solve/flight.hpp"
#include "solve/rotor.hpp"

namespace rubatlas::solve {

/// A piece of flight, as listeners see it, or as seen from the ring.
template <class Forcing, bool kFromRing = false>
class FlightPiece final : public observables::MotionPiece {
 public:
  FlightPiece(const Flight<Forcing>& flight, double begin, double end, double bound)
      : flight_(&flight), begin_(begin), end_(end), bound_(bound) {}
  [[nodiscard]] double begin() const override { return begin_; }
  [[nodiscard]] double end() const override { return end_; }
  [[nodiscard]] observables::State state(double time) override {
    const BodiesOf<Forcing> bodies = flight_->state(time);
    return as_array(kFromRing ? from_ring(bodies) : shaft(bodies));
  }
  [[nodiscard]] double displacement_bound() const override { return bound_; }
  [[nodiscard]] std::size_t contact_count() const override { return 0; }
  [[nodiscard]] int blade(std::size_t /*contact*/) const override { return -1; }
  [[nodiscard]] bool load_peaks(std::size_t /*contact*/) const override { return false; }
  [[nodiscard]] double normal_force(std::size_t /*contact*/, double /*time*/) override { return 0.0; }
  [[nodiscard]] double root_strain(std::size_t /*contact*/, double /*time*/) override { return 0.0; }
  [[nodiscard]] double friction_power(std::size_t /*contact*/, double /*time*/) override { return 0.0; }

 private:
  const Flight<Forcing>* flight_;
  double begin_;
  double end_;
  double bound_;  ///< of the displacement [m]
};

/// |c| may reach R in a piece of flight, which starts from `bodies`, where no blade stands in the way (MODEL
/// 5). True also where the meter ends the revolution.
template <class Forcing>
bool passes_through_ring(FlightPiece<Forcing>& piece, [[maybe_unused]] const Flight<Forcing>& flight,
                         [[maybe_unused]] const BodiesOf<Forcing>& bodies, const RotorConstants& rotor,
                         double ring_radius, WorkMeter& meter) {
  const auto reaches_ring = [&](observables::MotionPiece& seen, double fastest) {
    constexpr double kSamples = 4.0;  // a unit of time, on which the fastest motion turns by one radian
    if (seen.displacement_bound() + std::abs(rotor.misalignment) < ring_radius) return false;
    const double samples = kSamples * std::max(1.0, fastest) * (seen.end() - seen.begin());
    const double price = samples * static_cast<double>(price_of_state(flight));
    return !meter.spend(Work::flight, static_cast<std::int64_t>(std::min(price, 1e15))) ||
           observables::largest_distance(seen, -rotor.misalignment, fastest) >= ring_radius;
  };
  if constexpr (kRingMoves<Forcing>) {
    const double bound = flight.bound_from_ring(piece.begin(), bodies, piece.end() - piece.begin());
    FlightPiece<Forcing, true> seen(flight, piece.begin(), piece.end(), bound);
    return reaches_ring(seen, flight.fastest());
  } else {
    return reaches_ring(piece, rotor.speed_ratio);
  }
}

}  // namespace rubatlas::solve
