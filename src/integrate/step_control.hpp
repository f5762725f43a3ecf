/// From the error of a step to its acceptance and to the size of the next one.
///
/// Sizes are relative: the caller knows a scale on which the motion varies where the step stands, and the
/// control follows the share of it that keeps the tolerance. Since that share changes little along a motion,
/// it is followed slowly: the estimate of one step passes through zero now and then and says little by
/// itself.
#pragma once

#include <algorithm>
#include <cmath>

namespace rubatlas::integrate {

class StepControl {
 public:
  /// `order` p of a method whose local error falls with size^p; `first_size` relative to the scale.
  StepControl(int order, double first_size) : exponent_(1.0 / order), relative_size_(first_size) {}

  /// A new phase starts with the geometric mean of the sizes of the phase before.
  void begin_phase() {
    if (accepted_ > 0) relative_size_ = std::exp(log_sizes_ / accepted_);
    log_sizes_ = 0.0;
    accepted_ = 0;
  }

  /// To a power of four: what follows hangs less on what was before.
  void round_size() { relative_size_ = std::exp2(2.0 * std::round(0.5 * std::log2(relative_size_))); }

  [[nodiscard]] double relative_size() const { return relative_size_; }

  /// Errors in units of what is accepted: up to 1.
  [[nodiscard]] static bool acceptable(double error) { return error <= 1.0; }

  /// A step has been accepted. One that was cut short, to end at an event, tells nothing about the size.
  void accept(double error, bool cut_short) {
    if (!cut_short) relative_size_ *= std::pow(ideal_factor(error, kShrinkMost, kGrowMost), kTrust);
    log_sizes_ += std::log(relative_size_);
    ++accepted_;
  }

  /// A step of `share` of the proposed size has been rejected; the error is infinite where it could not be
  /// made at all.
  void reject(double error, double share) {
    relative_size_ *=
        share * (std::isfinite(error) ? ideal_factor(error, kShrinkAtRejection, kLeastShrink) : kRetreat);
  }

  /// Tries again with half the step, whatever its error.
  void halve(double share) { relative_size_ *= 0.5 * share; }

 private:
  /// Of what is accepted: low enough that one step in thirty is rejected, high enough that a step more in
  /// ten would be wasted below.
  static constexpr double kAim = 0.1;
  static constexpr double kTrust = 0.35;  ///< how far the size follows what one step says, in logarithms
  static constexpr double kShrinkMost = 0.5;
  static constexpr double kGrowMost = 4.0;
  static constexpr double kShrinkAtRejection = 0.2;
  static constexpr double kLeastShrink = 0.9;
  static constexpr double kRetreat = 0.25;

  /// Factor that would have brought the error to the aim.
  [[nodiscard]] double ideal_factor(double error, double least, double most) const {
    if (!(error > 0.0)) return most;
    return std::clamp(std::pow(kAim / error, exponent_), least, most);
  }

  double exponent_;
  double relative_size_;
  double log_sizes_ = 0.0;
  int accepted_ = 0;
};

}  // namespace rubatlas::integrate
