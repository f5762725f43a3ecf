/// The Jeffcott rotor left to itself: z'' + 2ζ z' + z = 0 in closed form (MODEL 1, 4.5).
#pragma once

#include <cmath>
#include <complex>

namespace rubatlas::rotor {

class FreeMotion {
 public:
  using Complex = std::complex<double>;

  explicit FreeMotion(double damping_ratio)
      : damping_ratio_(damping_ratio),
        // |1 − ζ²| as a product: 1 ± 1e-12 must not lose ωd.
        damped_frequency_(std::sqrt(std::abs((1.0 - damping_ratio) * (1.0 + damping_ratio)))) {}

  [[nodiscard]] double damping_ratio() const { return damping_ratio_; }        ///< ζ [-]
  [[nodiscard]] double damped_frequency() const { return damped_frequency_; }  ///< ωd = sqrt|1 − ζ²| [-]

  /// e^{−ζτ} C(τ) and e^{−ζτ} S(τ): `cos, sin/ωd`, `1, τ` or `cosh, sinh/ωd`.
  struct Kernel {
    double cosine;
    double sine;
  };

  [[nodiscard]] Kernel kernel(double time) const {
    if (damping_ratio_ < 1.0) {
      const double decay = std::exp(-damping_ratio_ * time);
      const double angle = damped_frequency_ * time;
      return {decay * std::cos(angle), decay * std::sin(angle) / damped_frequency_};
    }
    if (damped_frequency_ == 0.0) {
      const double decay = std::exp(-time);
      return {decay, decay * time};
    }
    // Rates ζ + ωd and 1/(ζ + ωd): cosh would overflow, and their difference cancels near ζ = 1.
    const double slow = std::exp(-time / (damping_ratio_ + damped_frequency_));
    const double spread = std::expm1(-2.0 * damped_frequency_ * time);  // fast/slow − 1
    return {slow * (1.0 + 0.5 * spread), -0.5 * slow * spread / damped_frequency_};
  }

  [[nodiscard]] static Complex position(const Kernel& kernel, double damping_ratio, Complex start,
                                        Complex start_velocity) {
    return start * kernel.cosine + (start_velocity + damping_ratio * start) * kernel.sine;
  }
  [[nodiscard]] static Complex velocity(const Kernel& kernel, double damping_ratio, Complex start,
                                        Complex start_velocity) {
    return start_velocity * kernel.cosine - (start + damping_ratio * start_velocity) * kernel.sine;
  }

 private:
  double damping_ratio_;
  double damped_frequency_;
};

}  // namespace rubatlas::rotor
