/// Forcings of one frequency, and sums of them: unbalance (MODEL 1), static loads (frequency 0), the side
/// bands of a speed that ripples. The shaft is linear: responses add up.
///
/// A forcing states its acceleration and the closed form of flight under it, the response from rest, which is
/// added to the free motion:
///     amplitude(), rate(), rate_of_rate()   bounds of the acceleration and of its derivatives
///     acceleration(time)              at time τ of the revolution [m per unit τ²]
///     steady(time)                    the steady response with its bounds, where it is known to exist
///     from_rest(start, elapsed, free, kernel)   the motion a time after rest at `start`
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "rotor/free_motion.hpp"

namespace rubatlas::rotor {

/// Position [m] and velocity [m per unit τ], as x + iy.
struct Response {
  std::complex<double> position;
  std::complex<double> velocity;
};

/// A steady response at one time, and what bounds it at every time.
struct Steady : Response {
  double largest_square;           ///< of |position| [m²]
  double largest_velocity_square;  ///< of |velocity| [(m per unit τ)²]
};

/// z'' + 2ζ z' + z = a e^{i(ντ+γ)}.
class Harmonic {
 public:
  using Complex = std::complex<double>;

  /// `amplitude` a [m per unit τ²], `phase` γ [rad], `frequency` ν [per unit τ]. Differences by an unbalance
  /// that is zero ask for a below zero: |a|, half a turn ahead.
  Harmonic(double amplitude, double phase, double frequency, double damping_ratio)
      : amplitude_(std::abs(amplitude)),
        phase_(amplitude < 0.0 ? phase + std::numbers::pi : phase),
        frequency_(frequency),
        at_zero_(std::polar(amplitude_, phase_)) {
    const Complex dynamic_stiffness(1.0 - frequency * frequency, 2.0 * damping_ratio * frequency);
    if (std::norm(dynamic_stiffness) > kNearResonance * kNearResonance)
      steady_at_zero_ = at_zero_ / dynamic_stiffness;
  }

  /// |a| [m per unit τ²], a bound of the acceleration; |a ν| and |a ν²|, bounds of its derivatives.
  [[nodiscard]] double amplitude() const { return amplitude_; }
  [[nodiscard]] double rate() const { return amplitude_ * std::abs(frequency_); }
  [[nodiscard]] double rate_of_rate() const { return amplitude_ * frequency_ * frequency_; }
  [[nodiscard]] double frequency() const { return frequency_; }  ///< ν [per unit τ]
  [[nodiscard]] double phase() const { return phase_; }          ///< γ [rad]

  /// Acceleration at time τ of the revolution [m per unit τ²].
  [[nodiscard]] Complex acceleration(double time) const { return at_zero_ * turned(time); }

  /// Steady response at time τ of the revolution; none near resonance, where it may not exist.
  [[nodiscard]] std::optional<Steady> steady(double time) const {
    if (!steady_at_zero_) return std::nullopt;
    const Complex position = *steady_at_zero_ * turned(time);
    const Complex velocity = Complex(0.0, frequency_) * position;
    return Steady{{position, velocity}, std::norm(position), std::norm(velocity)};
  }

  /// Motion a time `elapsed` after rest at `start` (both in τ), in closed form; `motion` is the free motion's
  /// C and S at `elapsed`.
  ///
  /// Far from resonance Z (e^{iΩt} − …) as MODEL 4.5. Near Ω = 1 at small damping Z is huge and cancels, and
  /// at Ω = 1, ζ = 0 it does not exist; there the divided difference (e^{iΩt} − e^{λt})/(iΩ − λ) is taken as
  /// t e^{λt} (e^w − 1)/w with w = (iΩ − λ) t, which passes smoothly through the secular growth at w = 0.
  [[nodiscard]] Response from_rest(double start, double elapsed, const rotor::FreeMotion& free,
                                   const rotor::FreeMotion::Kernel& kernel) const {
    if (frequency_ == 0.0)
      return {*steady_at_zero_ * (1.0 - kernel.cosine - free.damping_ratio() * kernel.sine),
              at_zero_ * kernel.sine};
    constexpr Complex i(0.0, 1.0);
    const Complex at_start = turned(start);
    const Complex unit = at_zero_ * at_start;
    Response response;
    if (steady_at_zero_) [[likely]] {
      response.position =
          *steady_at_zero_ * at_start *
          (turned(elapsed) - kernel.cosine - (i * frequency_ + free.damping_ratio()) * kernel.sine);
    } else {
      // Only underdamped rotors come here: kNearResonance bounds ζ.
      const double frequency = free.damped_frequency();
      const Complex positive(-free.damping_ratio(), frequency);
      const Complex negative = std::conj(positive);
      const auto difference = [&](Complex eigenvalue) {
        return elapsed * std::exp(eigenvalue * elapsed) *
               relative_growth((i * frequency_ - eigenvalue) * elapsed);
      };
      response.position = unit * (difference(positive) - difference(negative)) / (2.0 * i * frequency);
    }
    response.velocity = i * frequency_ * response.position + unit * kernel.sine;
    return response;
  }

 private:
  static constexpr double kNearResonance =
      0.25;  ///< of |1 − ν² + 2iζν|: above, Z is at most four static ones

  /// e^{iντ}; a static load does not turn.
  [[nodiscard]] Complex turned(double time) const {
    return frequency_ == 0.0 ? Complex(1.0, 0.0) : std::polar(1.0, frequency_ * time);
  }

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
  double frequency_;
  Complex at_zero_;                        ///< acceleration at τ = 0
  std::optional<Complex> steady_at_zero_;  ///< steady position at τ = 0; none near resonance
};

/// The rotor's own unbalance: a = (me/m) Ω² (MODEL 1).
class RotatingUnbalance final : public Harmonic {
 public:
  /// `specific_moment` me/m [m]; `phase` γ [rad] from blade 1.
  RotatingUnbalance(double specific_moment, double phase, double speed_ratio, double damping_ratio)
      : Harmonic(specific_moment * speed_ratio * speed_ratio, phase, speed_ratio, damping_ratio) {}
};

/// A sum of harmonics.
class Harmonics {
 public:
  using Complex = std::complex<double>;

  explicit Harmonics(std::vector<Harmonic> terms) : terms_(std::move(terms)) {
    for (const Harmonic& term : terms_) {
      bounds_.second += term.amplitude();
      bounds_.third += term.rate();
      bounds_.fourth += term.rate_of_rate();
    }
  }

  [[nodiscard]] const std::vector<Harmonic>& terms() const { return terms_; }
  [[nodiscard]] double amplitude() const { return bounds_.second; }
  /// Of the acceleration and of its derivatives.
  [[nodiscard]] const DerivativeBounds& bounds() const { return bounds_; }
  [[nodiscard]] Complex acceleration(double time) const {
    Complex sum = 0.0;
    for (const Harmonic& term : terms_) sum += term.acceleration(time);
    return sum;
  }
  /// Terms of different frequency come into step at some time.
  [[nodiscard]] std::optional<Steady> steady(double time) const {
    if (terms_.size() == 1) return terms_.front().steady(time);
    Steady sum{};
    double largest = 0.0;
    double largest_velocity = 0.0;
    for (const Harmonic& term : terms_) {
      const auto one = term.steady(time);
      if (!one) return std::nullopt;
      sum.position += one->position;
      sum.velocity += one->velocity;
      largest += std::sqrt(one->largest_square);
      largest_velocity += std::sqrt(one->largest_velocity_square);
    }
    sum.largest_square = largest * largest;
    sum.largest_velocity_square = largest_velocity * largest_velocity;
    return sum;
  }
  [[nodiscard]] Response from_rest(double start, double elapsed, const rotor::FreeMotion& free,
                                   const rotor::FreeMotion::Kernel& kernel) const {
    Response sum{};
    for (const Harmonic& term : terms_) {
      const Response one = term.from_rest(start, elapsed, free, kernel);
      sum.position += one.position;
      sum.velocity += one.velocity;
    }
    return sum;
  }

 private:
  std::vector<Harmonic> terms_;
  DerivativeBounds bounds_{};
};

}  // namespace rubatlas::rotor
