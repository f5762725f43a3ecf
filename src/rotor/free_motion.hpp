/// What swings by itself in closed form: z'' + 2ζν z' + ν² z = 0, the Jeffcott rotor with ν = 1 (MODEL
/// 1, 4.5), and a ring that is a body.
#pragma once

#include <cmath>
#include <complex>

namespace rubatlas::rotor {

/// Bounds of derivatives [m per unit τ², τ³, τ⁴].
struct DerivativeBounds {
  double second;
  double third;
  double fourth;
};

class FreeMotion {
 public:
  using Complex = std::complex<double>;

  explicit FreeMotion(double damping_ratio, double frequency = 1.0)
      : damping_ratio_(damping_ratio),
        frequency_(frequency),
        // |1 − ζ²| as a product: 1 ± 1e-12 must not lose ωd.
        damped_frequency_(std::sqrt(std::abs((1.0 - damping_ratio) * (1.0 + damping_ratio)))) {}

  [[nodiscard]] double damping_ratio() const { return damping_ratio_; }        ///< ζ [-]
  [[nodiscard]] double frequency() const { return frequency_; }                ///< ν [-]
  [[nodiscard]] double damped_frequency() const { return damped_frequency_; }  ///< ωd = sqrt|1 − ζ²| [-]

  /// e^{−ζt} C(t) and e^{−ζt} S(t) in the time t = ντ: `cos, sin/ωd`, `1, t` or `cosh, sinh/ωd`.
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
  /// x, y and their rates by τ, over the time of the kernel.
  template <class State>
  [[nodiscard]] State moved(const State& start, const Kernel& over) const {
    const Complex place(start[0], start[1]);
    const Complex rate = Complex(start[2], start[3]) / frequency_;
    const Complex to = position(over, damping_ratio_, place, rate);
    const Complex moves = frequency_ * velocity(over, damping_ratio_, place, rate);
    return {to.real(), to.imag(), moves.real(), moves.imag()};
  }

  /// Bounds where (ν² |z|² + |z'|²)^½ is at most `norm`, under a forcing with these bounds of itself and of
  /// its derivatives.
  [[nodiscard]] DerivativeBounds derivative_bounds(double norm, const DerivativeBounds& forcing = {}) const {
    const double damping = 2.0 * damping_ratio_;
    const double second = frequency_ * std::sqrt(1.0 + damping * damping) * norm + forcing.second;
    const double third = frequency_ * (damping * second + frequency_ * norm) + forcing.third;
    return {second, third, frequency_ * (damping * third + frequency_ * second) + forcing.fourth};
  }

 private:
  double damping_ratio_;
  double frequency_;
  double damped_frequency_;
};

}  // namespace rubatlas::rotor
