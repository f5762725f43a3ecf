/// The ring as one body on a spring and a damper, which the blades in contact push together.
///
///     m_r r'' ωn² + c_r r' ωn + kr r = F        r = (rx, ry) from the ring's place of rest; primes d/dτ
///
/// divided by m_r ωn²: r'' + 2ζ_ring ν r' + ν² r = F/(m_r ωn²), ν = sqrt(kr/m_r)/ωn, ζ_ring = c_r/(2 sqrt(kr
/// m_r)). Left to itself it is the free motion of the rotor in the time ντ. The ring does not turn: it is
/// held against rotation, and a force on it has no lever. Source: textbooks on vibration, any; MODEL 4.7 for
/// kr.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>

#include "rotor/free_motion.hpp"

namespace rubatlas::rotor {

class RingBody {
 public:
  using Complex = std::complex<double>;
  using State = Eigen::Array4d;  ///< rx, ry [m], rx', ry' [m per unit τ]

  /// `mass` m_r > 0 [kg], `stiffness` kr > 0 [N/m], `damping` c_r [N s/m], `natural_frequency` ωn [rad/s].
  RingBody(double mass, double stiffness, double damping, double natural_frequency)
      : frequency_(std::sqrt(stiffness / mass) / natural_frequency),
        free_(0.5 * damping / std::sqrt(stiffness * mass)),
        force_unit_(1.0 / (mass * natural_frequency * natural_frequency)) {}

  [[nodiscard]] double frequency() const { return frequency_; }                 ///< ν [-]
  [[nodiscard]] double damping_ratio() const { return free_.damping_ratio(); }  ///< ζ_ring [-]
  [[nodiscard]] const FreeMotion& free_motion() const { return free_; }         ///< in the time ντ
  /// 1/(m_r ωn²) [m/N]: acceleration per unit τ² of one newton.
  [[nodiscard]] double force_unit() const { return force_unit_; }
  /// d/dτ of the logarithm of the ring's phase volume, −4 ζ_ring ν.
  [[nodiscard]] double phase_volume_rate() const { return -4.0 * damping_ratio() * frequency_; }

  /// Free motion a time `elapsed` >= 0 (τ) after `start`.
  [[nodiscard]] State free(const State& start, double elapsed) const {
    const auto kernel = free_.kernel(frequency_ * elapsed);
    const Complex position(start[0], start[1]);
    const Complex velocity = Complex(start[2], start[3]) / frequency_;
    const Complex moved = FreeMotion::position(kernel, damping_ratio(), position, velocity);
    const Complex moves = frequency_ * FreeMotion::velocity(kernel, damping_ratio(), position, velocity);
    return {moved.real(), moved.imag(), moves.real(), moves.imag()};
  }

  /// r'' [m per unit τ²] under a force on the ring [N].
  [[nodiscard]] Complex acceleration(const State& ring, const Complex& force) const {
    return force_unit_ * force - 2.0 * damping_ratio() * frequency_ * Complex(ring[2], ring[3]) -
           frequency_ * frequency_ * Complex(ring[0], ring[1]);
  }

  /// (|r'|² + ν² |r|²)^½ [m per unit τ], which does not grow in free motion: it bounds |r'| and ν|r|.
  [[nodiscard]] double energy_norm(const State& ring) const {
    return std::hypot(frequency_ * std::hypot(ring[0], ring[1]), std::hypot(ring[2], ring[3]));
  }
  /// Bounds of |r''|, |r'''| and |r''''| in free motion whose energy norm is at most `norm`.
  [[nodiscard]] double second_bound(double norm) const {
    const double damping = 2.0 * damping_ratio();
    return frequency_ * std::sqrt(1.0 + damping * damping) * norm;
  }
  [[nodiscard]] double third_bound(double norm) const {
    return frequency_ * (2.0 * damping_ratio() * second_bound(norm) + frequency_ * norm);
  }
  [[nodiscard]] double fourth_bound(double norm) const {
    return frequency_ * (2.0 * damping_ratio() * third_bound(norm) + frequency_ * second_bound(norm));
  }

 private:
  double frequency_;
  FreeMotion free_;
  double force_unit_;
};

}  // namespace rubatlas::rotor
