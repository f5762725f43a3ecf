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

class RingBody : public FreeMotion {
 public:
  using State = Eigen::Array4d;  ///< rx, ry [m], rx', ry' [m per unit τ]

  /// `mass` m_r > 0 [kg], `stiffness` kr > 0 [N/m], `damping` c_r [N s/m], `natural_frequency` ωn [rad/s].
  RingBody(double mass, double stiffness, double damping, double natural_frequency)
      : FreeMotion(0.5 * damping / std::sqrt(stiffness * mass),
                   std::sqrt(stiffness / mass) / natural_frequency),
        force_unit_(1.0 / (mass * natural_frequency * natural_frequency)) {}

  /// 1/(m_r ωn²) [m/N]: acceleration per unit τ² of one newton.
  [[nodiscard]] double force_unit() const { return force_unit_; }

  /// Free motion a time `elapsed` >= 0 (τ) after `start`.
  [[nodiscard]] State free(const State& start, double elapsed) const {
    return moved(start, kernel(frequency() * elapsed));
  }

  /// r'' [m per unit τ²] under a force on the ring [N].
  [[nodiscard]] Complex acceleration(const State& ring, const Complex& force) const {
    return force_unit_ * force - 2.0 * damping_ratio() * frequency() * Complex(ring[2], ring[3]) -
           frequency() * frequency() * Complex(ring[0], ring[1]);
  }

  /// (|r'|² + ν² |r|²)^½ [m per unit τ], which does not grow in free motion: it bounds |r'| and ν|r|.
  [[nodiscard]] double energy_norm(const State& ring) const {
    return std::hypot(frequency() * std::hypot(ring[0], ring[1]), std::hypot(ring[2], ring[3]));
  }

 private:
  double force_unit_;
};

}  // namespace rubatlas::rotor
