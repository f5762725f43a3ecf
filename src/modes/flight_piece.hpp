/// A flight as a piece of motion, for the listeners of the motion.
#pragma once

#include <optional>
#include <span>

#include "modes/flight.hpp"
#include "modes/touchdown_search.hpp"
#include "rotor/constants.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

class FlightPiece final : public trajectory::PieceWithoutContact {
 public:
  /// From the start of the flight. `search` knows the tips.
  FlightPiece(const Flight& flight, TouchdownSearch& search, double end)
      : flight_(&flight), search_(&search), end_(end) {}
  [[nodiscard]] double begin() const override { return flight_->start_time(); }
  [[nodiscard]] double end() const override { return end_; }
  [[nodiscard]] trajectory::State state(double time) override {
    return rotor::as_array(flight_->shaft(time));
  }
  void places(const trajectory::SampleTimes& times, int first, std::span<double> x,
              std::span<double> y) override {
    flight_->places(times, first, x, y);
  }
  [[nodiscard]] double displacement_bound() const override {
    return flight_->shaft_bound(begin(), rotor::shaft(flight_->at_start()), end_ - begin(), false);
  }
  [[nodiscard]] double largest_displacement(double known, double /*speed_ratio*/) override {
    return displacement_bound() > known ? flight_->largest_displacement(begin(), end_, known) : known;
  }
  [[nodiscard]] trajectory::Tip tip(int blade, double time) override { return search_->tip(blade, time); }
  [[nodiscard]] std::optional<trajectory::Pass> nearest_pass(
      double known, const trajectory::PointConstants& /*point*/) override {
    return search_->nearest_pass(end_, known);
  }

 private:
  const Flight* flight_;
  TouchdownSearch* search_;
  double end_;
};

}  // namespace rubatlas::modes
