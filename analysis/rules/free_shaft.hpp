/// The shaft where no blade touches: z = f + Z e^{iΩτ} + D, with the deflection f under constant loads, the
/// circle Z on which an unbalance drives it, and a free vibration D that dies out (MODEL 4.5).
#pragma once

#include <cmath>
#include <complex>
#include <span>

#include "rotor/free_motion.hpp"
#include "settings/scene.hpp"

namespace rubatlas::analysis {

/// At one speed of a line. Valid for lines that it `describes`.
class FreeShaft {
 public:
  using Complex = std::complex<double>;

  /// `line`: the scene of the line.
  FreeShaft(const settings::Scene& line, double speed_ratio);

  /// False for effects under which the shaft moves in flight in other ways than assumed here.
  [[nodiscard]] static bool describes(const settings::Scene& line);
  /// False also where an undamped shaft is driven at its natural frequency, and Z does not exist.
  [[nodiscard]] static bool describes(const settings::Scene& line, double speed_ratio);

  [[nodiscard]] Complex deflection() const { return deflection_; }  ///< f [m]
  [[nodiscard]] Complex circle() const { return circle_; }          ///< Z [m]

  /// D and D' of a section state x, y, x', y' [m, m per unit τ]; at sections blade 1 points along x.
  struct Vibration {
    Complex position;
    Complex velocity;
    /// Bound of |D| from here on, since |D|² + |D'|² never grows [m].
    [[nodiscard]] double bound() const { return std::hypot(std::abs(position), std::abs(velocity)); }
  };
  [[nodiscard]] Vibration vibration(std::span<const double> section) const;
  /// One revolution later.
  [[nodiscard]] Vibration later(const Vibration& now) const;

  /// Least distance between the tip of an unworn blade and the ring at any time, without any vibration [m].
  [[nodiscard]] double distance() const { return room_ - std::abs(centre_); }
  /// A lower bound of it from here on while `left` dies out.
  [[nodiscard]] double distance(const Vibration& left) const;

 private:
  double speed_ratio_;
  double damping_ratio_;
  rotor::FreeMotion::Kernel revolution_;
  Complex deflection_;
  Complex circle_;
  double room_;     ///< [m] left beside the circles of the tips
  Complex centre_;  ///< [m] of these circles, from that of the ring
};

/// The largest deflection under constant loads [m] of the lines on which it is larger than this share of
/// their `length_scale`; 0 where there are none.
[[nodiscard]] double largest_sag(const settings::Scene& scene, double share);

}  // namespace rubatlas::analysis
