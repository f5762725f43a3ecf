#include "modes/turn_row.hpp"

#include <cmath>

namespace rubatlas::modes {
namespace {

/// An angle [rad] below which the first terms that `turned` leaves out, angle^15/15! and angle^16/16!, are
/// less than 3e-17.
constexpr double kFarTurnedInRow = 0.5;

/// Directions turned by small angles, by the series of sine and cosine.
void turn_by(const RowValues& angle, RowValues& cosine, RowValues& sine) {
  const RowValues square = angle * angle;
  const RowValues of_sine =
      angle + angle * square *
                  (-1.0 / 6.0 +
                   square * (1.0 / 120.0 +
                             square * (-1.0 / 5040.0 + square * (1.0 / 362880.0 +
                                                                 square * (-1.0 / 39916800.0 +
                                                                           square * (1.0 / 6227020800.0))))));
  const RowValues of_cosine_less_one =
      square *
      (-0.5 +
       square * (1.0 / 24.0 +
                 square * (-1.0 / 720.0 + square * (1.0 / 40320.0 +
                                                    square * (-1.0 / 3628800.0 +
                                                              square * (1.0 / 479001600.0 +
                                                                        square * (-1.0 / 87178291200.0)))))));
  const RowValues before = cosine;
  cosine += cosine * of_cosine_less_one - sine * of_sine;
  sine += sine * of_cosine_less_one + before * of_sine;
}

}  // namespace

TurnRow::TurnRow(const rotor::RipplingBlades& blades, double spacing)
    : blades_(&blades), speed_at_start_(blades.mean_speed()) {
  for (int i = 0; i < kTimesOfRow; ++i) {
    const double elapsed = (i + 1) * spacing;
    mean_cosine_[i] = std::cos(blades.mean_speed() * elapsed);
    mean_sine_[i] = std::sin(blades.mean_speed() * elapsed);
    ripple_cosine_[i] = std::cos(blades.ripple_frequency() * elapsed);
    ripple_sine_[i] = std::sin(blades.ripple_frequency() * elapsed);
  }
  cosine_ = mean_cosine_;
  sine_ = mean_sine_;
  speed_.setConstant(speed_at_start_);
}

void TurnRow::start_in_ripple(double time) {
  const contact::BladeDirection ripple = blades_->ripple(time);
  const RowValues cosine = ripple.cosine * ripple_cosine_ - ripple.sine * ripple_sine_;
  const RowValues sine = ripple.sine * ripple_cosine_ + ripple.cosine * ripple_sine_;
  const double amplitude = blades_->ripple_amplitude();
  speed_at_start_ = blades_->mean_speed() * (1.0 + amplitude * ripple.cosine);
  speed_ = blades_->mean_speed() * (1.0 + amplitude * cosine);
  const RowValues ahead = blades_->ripple_depth() * (sine - ripple.sine);
  cosine_ = mean_cosine_;
  sine_ = mean_sine_;
  if (ahead.abs().maxCoeff() < kFarTurnedInRow) {
    turn_by(ahead, cosine_, sine_);
    return;
  }
  for (int i = 0; i < kTimesOfRow; ++i) {
    const double turned_cosine = std::cos(ahead[i]);
    const double turned_sine = std::sin(ahead[i]);
    cosine_[i] = mean_cosine_[i] * turned_cosine - mean_sine_[i] * turned_sine;
    sine_[i] = mean_sine_[i] * turned_cosine + mean_cosine_[i] * turned_sine;
  }
}

}  // namespace rubatlas::modes
