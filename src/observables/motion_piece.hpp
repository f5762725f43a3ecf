/// What an observable sees of the motion: one piece after the other, in flight or in contact, without gaps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

namespace rubatlas::observables {

/// x, y [m], dx/dτ, dy/dτ [m]; from the shaft's own equilibrium.
using State = std::array<double, 4>;

/// Equally spaced times of a revolution.
struct SampleTimes {
  double period;  ///< τ of the revolution
  int count;      ///< in the revolution
  [[nodiscard]] double operator[](int i) const { return period * i / count; }
  [[nodiscard]] double spacing() const { return period / count; }
};

/// What a blade in contact bears.
enum class Load : std::uint8_t {
  normal_force,  ///< F [N]
  root_strain    ///< bending strain at the root [-]
};

/// The motion between two times of one revolution. States are exact in flight, of the step's order in
/// contact.
class MotionPiece {
 public:
  virtual ~MotionPiece() = default;

  /// τ since the revolution started; pieces tile it from 0 to the period.
  [[nodiscard]] virtual double begin() const = 0;
  [[nodiscard]] virtual double end() const = 0;
  [[nodiscard]] virtual State state(double time) = 0;
  /// x at the times from number `first` on, which lie in the piece: for spectra, as good as dense output is.
  virtual void places_x(const SampleTimes& times, int first, std::span<double> x) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = state(times[first + static_cast<int>(i)])[0];
  }
  /// Bound of the displacement over the piece [m]; infinity where none is known.
  [[nodiscard]] virtual double displacement_bound() const = 0;
  /// The largest displacement (x² + y²)^½ in the piece [m], or `known` where it is not larger than that.
  [[nodiscard]] virtual double largest_displacement(double known, double speed_ratio);

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
  struct LargestLoad {
    double time;   ///< τ of the revolution
    double value;  ///< [N] or [-]
  };
  /// The largest load of a contact in the piece; where it is not larger than `known`, any value up to that.
  [[nodiscard]] virtual LargestLoad largest(Load load, std::size_t contact, double known);
  /// Power of friction |c F v| at its tip [J per unit τ], v the slip velocity (MODEL 4.4).
  [[nodiscard]] virtual double friction_power(std::size_t contact, double time) = 0;
};

/// Between two times that are no further apart [τ] a distance has at most one maximum: an eighth of the
/// fastest period, that of the shaft or of the forcing; the square of the distance oscillates twice as fast.
inline double spacing_of_distances(double speed_ratio) {
  return 0.125 * std::numbers::pi / std::max(1.0, std::abs(speed_ratio));
}

/// One grid point's constants, as far as observables need them.
struct PointConstants {
  double period;       ///< τ of one revolution
  double speed_ratio;  ///< Ω [-]
  int blade_count;
};

}  // namespace rubatlas::observables
