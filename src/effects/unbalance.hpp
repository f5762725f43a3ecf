/// Effect `unbalance`: a mass eccentricity that turns with the rotor (MODEL 1).
///
/// An effect states its acceleration and the closed form of flight under it: the response from rest, which is
/// added to the free motion.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "effects/response.hpp"
#include "rotor/free_motion.hpp"

namespace rubatlas::effects {

class Unbalance {
 public:
  static constexpr bool kPresent = true;
  using Complex = std::complex<double>;

  /// `specific_moment` me/m [m]; `phase` γ [rad] from blade 1.
  Unbalance(double specific_moment, double phase, double speed_ratio, double damping_ratio)
      : amplitude_(specific_moment * speed_ratio * speed_ratio),
        phase_(phase),
        speed_ratio_(speed_ratio),
        dynamic_stiffness_(1.0 - speed_ratio * speed_ratio, 2.0 * damping_ratio * speed_ratio) {}

  /// (me/m) Ω² [m]: a bound of the acceleration.
  [[nodiscard]] double amplitude() const { return amplitude_; }

  /// Acceleration at time τ of the revolution [m per unit τ²].
  [[nodiscard]] Complex acceleration(double time) const {
    return std::polar(amplitude_, speed_ratio_ * time + phase_);
  }

  /// Steady response at time τ of the revolution; none near resonance, where it may not exist.
  [[nodiscard]] std::optional<Response> steady(double time) const {
    if (std::norm(dynamic_stiffness_) <= kNearResonance * kNearResonance) return std::nullopt;
    const Complex position = acceleration(time) / dynamic_stiffness_;
    return Response{position, Complex(0.0, speed_ratio_) * position};
  }

  /// Motion a time `elapsed` after rest at `start` (both in τ), in closed form; `motion` is the free motion's
  /// C and S at `elapsed`.
  ///
  /// Far from resonance Z (e^{iΩt} − …) as MODEL 4.5. Near Ω = 1 at small damping Z is huge and cancels, and
  /// at Ω = 1, ζ = 0 it does not exist; there the divided difference (e^{iΩt} − e^{λt})/(iΩ − λ) is taken as
  /// t e^{λt} (e^w − 1)/w with w = (iΩ − λ) t, which passes smoothly through the secular growth at w = 0.
  [[nodiscard]] Response from_rest(double start, double elapsed, const rotor::FreeMotion& free,
                                   const rotor::FreeMotion::Kernel& kernel) const {
    constexpr Complex i(0.0, 1.0);
    const Complex turned = std::polar(1.0, speed_ratio_ * elapsed);
    const Complex unit = std::polar(amplitude_, speed_ratio_ * start + phase_);
    Response response;
    if (std::norm(dynamic_stiffness_) > kNearResonance * kNearResonance) {
      const Complex compliance = unit / dynamic_stiffness_;
      response.position =
          compliance * (turned - kernel.cosine - (i * speed_ratio_ + free.damping_ratio()) * kernel.sine);
    } else {
      // Only underdamped rotors come here: kNearResonance bounds ζ.
      const double frequency = free.damped_frequency();
      const Complex positive(-free.damping_ratio(), frequency);
      const Complex negative = std::conj(positive);
      const auto difference = [&](Complex eigenvalue) {
        return elapsed * std::exp(eigenvalue * elapsed) *
               relative_growth((i * speed_ratio_ - eigenvalue) * elapsed);
      };
      response.position = unit * (difference(positive) - difference(negative)) / (2.0 * i * frequency);
    }
    response.velocity = i * speed_ratio_ * response.position + unit * kernel.sine;
    return response;
  }

 private:
  static constexpr double kNearResonance =
      0.25;  ///< of |1 − Ω² + 2iζΩ|: above, Z is at most four static ones

  /// (e^w − 1)/w without cancellation.
  static Complex relative_growth(Complex w) {
    if (w == Complex(0.0, 0.0)) return 1.0;
    const double half_sine = std::sin(0.5 * w.imag());
    const Complex growth(std::expm1(w.real()) * std::cos(w.imag()) - 2.0 * half_sine * half_sine,
                         std::exp(w.real()) * std::sin(w.imag()));
    return growth / w;
  }

  double amplitude_;
  double phase_;
  double speed_ratio_;
  Complex dynamic_stiffness_;  ///< 1 − Ω² + 2iζΩ
};

}  // namespace rubatlas::effects
