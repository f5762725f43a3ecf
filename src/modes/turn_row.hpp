/// How the hub turns until eight equally spaced times.
#pragma once

#include "modes/state_row.hpp"
#include "rotor/rippling_blades.hpp"

namespace rubatlas::modes {

class TurnRow {
 public:
  /// `blades` outlive the row. `spacing`: between two times [τ].
  TurnRow(const rotor::RipplingBlades& blades, double spacing);

  /// Moves the row to a time τ of the revolution, which its eight times follow.
  void start(double time) {
    if (blades_->ripples()) start_in_ripple(time);
  }

  /// Of the angle by which the hub turns from the start of the row.
  [[nodiscard]] const RowValues& cosine() const { return cosine_; }
  [[nodiscard]] const RowValues& sine() const { return sine_; }
  /// φ' at the start of the row, and at its times [per unit τ].
  [[nodiscard]] double speed_at_start() const { return speed_at_start_; }
  [[nodiscard]] const RowValues& speed() const { return speed_; }

 private:
  void start_in_ripple(double time);

  const rotor::RipplingBlades* blades_;
  RowValues mean_cosine_, mean_sine_;      ///< of the angle at the mean speed
  RowValues ripple_cosine_, ripple_sine_;  ///< of the angle by which the ripple goes on
  RowValues cosine_, sine_;
  double speed_at_start_;
  RowValues speed_;
};

}  // namespace rubatlas::modes
