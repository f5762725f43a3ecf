/// What an observable sees of the motion: one piece after the other, in flight or in contact, without gaps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace rubatlas::trajectory {

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

/// One grid point's constants, as far as observables need them.
struct PointConstants {
  double period;       ///< τ of one revolution
  double speed_ratio;  ///< Ω [-]
  int blade_count;
};

/// The tip of an undeformed blade against the ring.
struct Tip {
  double overlap;  ///< |tip| − R [m]: positive where it is beyond the ring
  double rate;     ///< of the overlap [m per unit τ]
  double side;     ///< s ct [m], s the direction of slip: positive approaching, negative receding (MODEL 4.2)
};

/// A tip passes the ring without contact: a local maximum of its radius.
struct Pass {
  double miss;  ///< R − |tip| > 0 [m]
  double side;  ///< s ct there [m]
  int blade;    ///< from 0
  double time;  ///< τ of the revolution
};

/// What a blade in contact does to the rotor.
struct ContactForce {
  std::complex<double> on_rotor;  ///< along x and y [N]
  double normal;                  ///< F [N]
  double slip_velocity;           ///< v (MODEL 4.4) [m per unit τ]
  double slip;                    ///< s = ±1, 0 where the tip sticks
  double friction;                ///< c [-]: the ring pulls at the tip with −c F along t (MODEL 4.3)
  double torque;                  ///< of the force about the shaft's centre, along +z [N m]
  double root_strain = 0.0;       ///< bending strain at the blade's root [-]

  /// c F v, what friction takes from the motion [J per unit τ].
  [[nodiscard]] double friction_power() const { return friction * normal * slip_velocity; }
};

/// A place on the path of a piece in contact, as a function of a share θ in [0, 1] of the piece in which time
/// and bending are smooth, also where bending is no smooth function of time.
struct PathPoint {
  struct Contact {
    int blade;
    double slip;          ///< s = ±1
    double bending;       ///< u [-]; of a blade that is not `carried` a first guess; 0 of a rigid one
    double bending_rate;  ///< du/dθ, where carried
    bool carried;         ///< the bending is a coordinate of the path
    /// Of a blade under an inclined load, whose κ and φ are both coordinates of the path, in place of u.
    double modulus = 0.0, amplitude = 0.0;            ///< κ, φ
    double modulus_rate = 0.0, amplitude_rate = 0.0;  ///< their rates by θ
  };
  double time = 0.0;       ///< τ of the revolution
  double time_rate = 0.0;  ///< dτ/dθ
  State state{};
  State ring{};                   ///< as `state`, of a ring that is a body; zero of one that rests
  std::vector<Contact> contacts;  ///< none where the bends are no functions of the path
};

/// A place of a piece. ∫ f dτ over the piece is the sum of weight × f at its places.
struct Place {
  double weight;  ///< in τ
  double time;    ///< τ of the revolution
  const State& state;
  std::span<const ContactForce> forces;  ///< one a contact, where they are asked for
};
using VisitPlace = std::function<void(const Place&)>;

/// How a tip rubs at a place of a piece, which counts in sums as `Place` does.
struct Rub {
  std::size_t contact;
  double weight;          ///< in τ
  double normal;          ///< F [N]
  double friction_power;  ///< c F v [J per unit τ]
};
using VisitRub = std::function<void(const Rub&)>;

/// The motion between two times of one revolution. States are exact in flight, of the step's order in
/// contact.
class MotionPiece {
 public:
  virtual ~MotionPiece() = default;

  /// τ since the revolution started; pieces tile it from 0 to the period.
  [[nodiscard]] virtual double begin() const = 0;
  [[nodiscard]] virtual double end() const = 0;
  [[nodiscard]] virtual State state(double time) = 0;
  /// x, and y unless it is empty, at the times from number `first` on, which lie in the piece: for spectra,
  /// as good as dense output is.
  virtual void places(const SampleTimes& times, int first, std::span<double> x, std::span<double> y) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const State at = state(times[first + static_cast<int>(i)]);
      x[i] = at[0];
      if (!y.empty()) y[i] = at[1];
    }
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
  struct LargestLoad {
    double time;   ///< τ of the revolution
    double value;  ///< [N] or [-]
  };
  /// The largest load of a contact in the piece; where it is not larger than `known`, any value up to that.
  [[nodiscard]] virtual LargestLoad largest(Load load, std::size_t contact, double known);
  /// The force of a contact at a time of the piece.
  [[nodiscard]] virtual ContactForce contact_force(std::size_t contact, double time) = 0;
  [[nodiscard]] double normal_force(std::size_t contact, double time) {
    return contact_force(contact, time).normal;
  }
  /// A blade's tip at a time of the piece; `blade` from 0.
  [[nodiscard]] virtual Tip tip(int blade, double time) = 0;
  /// Of the tips that are not in contact, the one that passes the ring nearest within the piece; none where
  /// no tip passes it nearer than `known` [m].
  [[nodiscard]] virtual std::optional<Pass> nearest_pass(double known, const PointConstants& point);
  /// Where the undeformed tip of a blade in contact overlaps the ring most within the piece, the place where
  /// it begins left out. Where the overlap is beyond `enough` [m] it may be less accurate.
  [[nodiscard]] virtual Tip deepest(std::size_t contact, double enough);
  /// The path at a share θ of the piece, which is in contact, and the forces of its contacts there where they
  /// are asked for. A force that starts or ends like a root of the time (MODEL 3.3) is smooth along the path.
  virtual void path(double share, PathPoint& point, std::vector<ContactForce>* forces);
  /// Calls `visit` for the places at which the equations of the piece have been solved, where that is how it
  /// has been computed; else false.
  virtual bool solved_places(bool /*with_forces*/, const VisitPlace& /*visit*/) { return false; }
  /// The same for how the tips rub there, which has been found along with the motion.
  virtual bool solved_rubs(const VisitRub& /*visit*/) { return false; }

 private:
  /// τ at a share of the piece's time.
  [[nodiscard]] double time_at(double share) const {
    return share == 1.0 ? end() : begin() + share * (end() - begin());
  }
};

/// Between two times that are no further apart [τ] a distance has at most one maximum: an eighth of the
/// fastest period, that of the shaft or of the forcing; the square of the distance oscillates twice as fast.
inline double spacing_of_distances(double speed_ratio) {
  return 0.125 * std::numbers::pi / std::max(1.0, std::abs(speed_ratio));
}

/// A piece in which no blade touches.
class PieceWithoutContact : public MotionPiece {
 public:
  [[nodiscard]] std::size_t contact_count() const final { return 0; }
  [[nodiscard]] int blade(std::size_t /*contact*/) const final { return -1; }
  [[nodiscard]] bool load_peaks(std::size_t /*contact*/) const final { return false; }
  [[nodiscard]] ContactForce contact_force(std::size_t /*contact*/, double /*time*/) final { return {}; }
};

}  // namespace rubatlas::trajectory
