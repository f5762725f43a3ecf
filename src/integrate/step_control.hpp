/// From the error of a step to its acceptance and to the size of the next one.
///
/// Sizes are relative to a scale on which the motion varies at the present step; the caller knows this scale.
/// The control follows the share of the scale that keeps the tolerance. It follows slowly, since the share
/// changes little along a motion, and since the error estimate of a single step says little: it passes
/// through zero now and then.
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

  /// Rounds the size to a power of four, so that what follows depends less on what was before.
  void round_size() { relative_size_ = std::exp2(2.0 * std::round(0.5 * std::log2(relative_size_))); }

  [[nodiscard]] double relative_size() const { return relative_size_; }

  /// Errors in units of what is accepted: up to 1.
  [[nodiscard]] static bool acceptable(double error) { return error <= 1.0; }

  /// A step has been accepted.
  void accept(double error) {
    relative_size_ *= std::pow(ideal_factor(error, kShrinkMost, kGrowMost), kTrust);
    log_sizes_ += std::log(relative_size_);
    ++accepted_;
  }

  /// A step has been rejected; the error is infinite where it could not be made at all.
  void reject(double error) {
    relative_size_ *= std::isfinite(error) ? ideal_factor(error, kShrinkAtRejection, kLeastShrink) : kRetreat;
  }

  /// Tries again with half the step, whatever its error.
  void halve() { relative_size_ *= 0.5; }

 private:
  /// Aimed error, as a share of the largest accepted one: low enough that only one step in thirty is
  /// rejected. A lower aim would waste one step more in ten.
  static constexpr double kAim = 0.1;
  static constexpr double kTrust = 0.35;  ///< share of the ideal change, in logarithms, made after one step
  static constexpr double kShrinkMost = 0.5;
  static constexpr double kGrowMost = 4.0;
  static constexpr double kShrinkAtRejection = 0.2;
  static constexpr double kLeastShrink = 0.9;
  static constexpr double kRetreat = 0.25;

  /// Factor of the size that would have brought the error to the aim.
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
