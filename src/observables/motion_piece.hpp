/// What an observable sees of the motion: one piece after the other, in flight or in contact, without gaps.
#pragma once

#include <array>
#include <cstddef>

namespace rubatlas::observables {

/// x, y [m], dx/dτ, dy/dτ [m]; from the shaft's own equilibrium.
using State = std::array<double, 4>;

/// The motion between two times of one revolution. States are exact in flight, of the step's order in
/// contact.
class MotionPiece {
 public:
  virtual ~MotionPiece() = default;

  /// τ since the revolution started; pieces tile it from 0 to the period.
  [[nodiscard]] virtual double begin() const = 0;
  [[nodiscard]] virtual double end() const = 0;
  [[nodiscard]] virtual State state(double time) = 0;
  /// x there, for pictures and spectra: as good as dense output is.
  [[nodiscard]] virtual double place_x(double time) { return state(time)[0]; }
  /// Bound of the displacement over the piece [m]; infinity where none is known.
  [[nodiscard]] virtual double displacement_bound() const = 0;

  /// Blades in contact, the same throughout the piece; 0 in flight.
  [[nodiscard]] virtual std::size_t contact_count() const = 0;
  /// Number of the blade, from 0, of one of the contacts.
  [[nodiscard]] virtual int blade(std::size_t contact) const = 0;
  /// True where the load of a contact may rise and fall again within the piece; else the load is largest at
  /// an end.
  [[nodiscard]] virtual bool load_peaks(std::size_t contact) const = 0;
  /// Normal force F [N] and bending strain at the blade's root [-] of a contact at a time of the piece.
  [[nodiscard]] virtual double normal_force(std::size_t contact, double time) = 0;
  [[nodiscard]] virtual double root_strain(std::size_t contact, double time) = 0;
  /// Power of friction |c F v| at its tip [J per unit τ], v the slip velocity (MODEL 4.4).
  [[nodiscard]] virtual double friction_power(std::size_t contact, double time) = 0;
};

/// One grid point's constants, as far as observables need them.
struct PointConstants {
  double period;       ///< τ of one revolution
  double speed_ratio;  ///< Ω [-]
  int blade_count;
};

}  // namespace rubatlas::observables
