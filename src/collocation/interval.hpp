/// An interval of a contact, as collocation solves it: numbers in and out, without types of the motion.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "blade/bending_table.hpp"
#include "collocation/inclined_load.hpp"
#include "collocation/nodes.hpp"
#include "contact/friction_law.hpp"
#include "contact/pose.hpp"
#include "contact/tip.hpp"

namespace rubatlas::collocation {

/// What turns the blades, and what moves shaft and ring besides their contacts. Lengths in m, times in τ.
struct Machine {
  double speed_ratio;    ///< Ω, the mean where the speed ripples [-]
  double damping_ratio;  ///< ζ, where the support is isotropic [-]
  double misalignment;   ///< y0
  double ring_radius;    ///< R
  double force_unit;     ///< 1/(m ωn²) [m/N]

  /// z'' + C z' + K z = f, row by row; not read where the support is isotropic: K = 1, C = 2ζ.
  struct Support {
    bool isotropic = true;
    std::array<double, 4> stiffness{};  ///< K [-]
    std::array<double, 4> damping{};    ///< C [-]
  } support{};

  /// Σ F_j e^{iν_j τ}; the vectors stand in the interval.
  static constexpr std::size_t kMostForcings = 40;
  std::size_t forcing_count = 0;
  std::array<double, kMostForcings> frequency{};  ///< ν_j [-]

  /// φ' = Ω (1 + a cos(fτ + ψ)).
  struct Ripple {
    double amplitude = 0.0;  ///< a [-]
    double frequency = 0.0;  ///< f [per unit τ]
    double depth = 0.0;      ///< aΩ/f [rad]
  } ripple{};

  /// r'' + damping r' + stiffness r = −F force_unit; or spring r = −F, without mass.
  struct Ring {
    bool moves = false;
    double stiffness = 0.0;   ///< ν² [-]
    double damping = 0.0;     ///< 2ζ_ring ν [-]
    double force_unit = 0.0;  ///< 1/(m_r ωn²) [m/N]
    double spring = 0.0;      ///< kr [N/m] of a ring without mass

    [[nodiscard]] bool is_massless() const { return spring > 0.0; }
  } ring{};

  [[nodiscard]] bool ripples() const { return ripple.amplitude != 0.0; }
  /// Nothing acts but what the paper's rotor has and harmonic forcings.
  [[nodiscard]] bool is_plain() const { return support.isotropic && !ripples() && !ring.moves; }
};

/// A blade and the ring under its tip. Lengths in m.
struct Blade {
  const blade::BendingTable* table = nullptr;  ///< of a blade under an axial load
  double reach = 0.0;                          ///< rh + L
  double closing = 0.0;                        ///< (rh + L)² − R² [m²]
  double length = 0.0;                         ///< L
  double load_unit = 0.0;                      ///< EI/L² [N]
  double strain_unit = 0.0;                    ///< h/(2L) [-]
  double friction = 0.0;                       ///< μ [-]
  double yield_unit = 0.0;  ///< EI/(L² kr) [m]: yielding of the ring under F = EI/L²; 0 where it does not
  double first_shortening = 0.0;  ///< δ/Δ of a blade that is hardly bent [-]
  double first_yielding = 0.0;    ///< (F/kr)/Δ there [-]
  // Of a column that may stand straight: axial shortening under F = EI/L² [m], and the F at which it bends
  // [N].
  double axial_unit = 0.0;
  double buckling_load = 0.0;
  bool held_beyond_ring = false;  ///< its contact goes on there while it has a force
  double valid_shortening = 0.0;  ///< δ/L up to which its contact is valid
  // Of a rigid blade, and of one on a ring with dampers.
  double ring_stiffness = 0.0;  ///< kr [N/m]
  double ring_damping = 0.0;    ///< cr ωn [N per (m per unit τ)]
};

/// Of λ past 0 or 1: a tip that skims ends to so late that rounding does not lead it back.
inline constexpr double kShareBeyond = 1e-9;

/// A tip in contact where an interval starts.
struct TipStart {
  int number = 0;  ///< of its blade
  const Blade* blade = nullptr;
  const InclinedLoad* load = nullptr;      ///< where it is inclined
  std::array<double, 2> offset{1.0, 0.0};  ///< cosine and sine of its angle from the leading blade
  double slip = 1.0;                       ///< s = ±1; 0: it is at rest
  bool straight = false;                   ///< the blade does not bend: a column below its Euler load, or
                                           ///< one under which only a ring with dampers yields (MODEL 7.16)
  bool skims = false;                      ///< it stays on the ring under a share λ of its force (MODEL 4.9)
  double short_of_fold = 0.0;  ///< share of δ in ∂h/∂p by which `firmness` is zero before the fold
  double start_square = 0.0;   ///< p² of a further blade
  /// Its force, of which the parts along and across the blade are those where the contact, or its leader, is
  /// new.
  contact::TipForce at_start{};
  // What is named so in `TipInTime`.
  double start_gap = 0.0;          ///< g of the straight tip [m²]
  double start_gap_measure = 0.0;  ///< [m]
  double start_lean = 0.0;
  double start_chart_left = 0.0;
  double start_cone_left = 0.0;
  double start_yielding = 0.0;

  /// er of its blade where the leading one stands at (x, y).
  [[nodiscard]] contact::BladeDirection direction(double x, double y) const {
    return {x * offset[0] - y * offset[1], y * offset[0] + x * offset[1]};
  }
};

/// A tip in contact within an interval.
struct TipInTime : TipStart {
  AtNodes gap;            ///< g of the straight tip [m²]
  AtNodes gap_measure;    ///< g/Δ [m], as h = 0 has it: it has the sign of g where the blade is bent; F/kr
                          ///< of a rigid blade; λ, and `kShareBeyond`, of a tip that skims
  AtNodes slip_velocity;  ///< v of the tip (MODEL 4.4) [m per unit τ]
  AtNodes normal_force;   ///< F [N]
  AtNodes root_strain;    ///< bending strain at the root [-]
  AtNodes shortening;     ///< δ/L
  // Of a blade under an inclined load (`inclined_load.hpp`).
  AtNodes lean;        ///< l: a first guess, then the solution
  AtNodes chart_left;  ///< `InclinedLoad::chart_left`
  /// What is left of the guard that ends the mode of a blade. Of a tip at rest `InclinedLoad::cone` less c²;
  /// of a rigid one (μs² − c²) F²/(m ωn²)² [m² per unit τ⁴]. Of a blade that stands straight the load that
  /// would bend it, that of Euler of a column, less F [N]. Of a tip that skims 1 − λ.
  AtNodes cone_left;
  AtNodes yielding;  ///< y of a ring with dampers under an elastic blade [m]
  // Of a further blade, whose bending follows from where the shaft is.
  AtNodes square;          ///< p²; F/kr of a rigid blade [m]: a first guess, then the solution. Smooth at a
                           ///< touch-down, unlike p
  bool lifts_off = false;  ///< it would be bent by less than nothing at a node, where some p² is left to it
  AtNodes firmness;  ///< zero at the fold of its branch, or short of it: of one under an inclined load, and
                     ///< of one that is held beyond the ring
};

/// Where shaft or ring are within an interval.
struct Places {
  std::array<double, 4> start{};  ///< place [m] and velocity [m per unit τ]
  AtNodes x, y, vx, vy;           ///< a first guess, then the solution
};
/// Second and third derivatives of a place by τ.
struct Derivatives {
  std::array<double, 2> acceleration{};  ///< [m per unit τ²]
  std::array<double, 2> jerk{};          ///< [m per unit τ³]
};
struct Body : Places {
  Derivatives at_start;  ///< for the first guess
  AtNodes ax, ay;        ///< [m per unit τ²]
};

/// The leading blade and what depends on time where an interval starts.
struct IntervalStart {
  double start_time = 0.0;           ///< τ of the revolution
  double start_argument = 0.0;       ///< p
  std::array<double, 2> blade{};     ///< er of the blade in contact at the start
  double start_angular_speed = 0.0;  ///< φ' there [rad per unit τ]
  std::array<std::array<double, 2>, Machine::kMostForcings> forcing{};  ///< there [m per unit τ²]
  std::array<double, 2> ripple{};                                       ///< e^{i(fτ + ψ)} there
};

/// A stretch of the curve h = 0 of one blade, which leads, in the plane (τ, p), written as a graph over its
/// chord: at θ in [0, 1]
///     (τ, p) = start + θ chord + w(θ) normal,
/// where both vectors are the caller's. Every quantity is a polynomial of degree 8 through the start and the
/// nodes. All of this is relative to the start, so that time keeps its digits.
struct Interval : IntervalStart {
  struct Direction {
    double time;      ///< τ
    double argument;  ///< p
  };

  Direction chord{};
  Direction normal{};

  AtNodes deviation;         ///< w: a first guess, then the solution
  Body shaft;                ///< likewise
  Body ring;                 ///< zero where it does not move
  AtNodes elapsed;           ///< τ since the start
  AtNodes argument;          ///< p
  AtNodes time_slope;        ///< dτ/dθ
  AtNodes argument_slope;    ///< dp/dθ
  AtNodes blade_x, blade_y;  ///< er of the blade
  AtNodes angular_speed;     ///< φ' [rad per unit τ]
  AtNodes coefficients;      ///< magnitudes of Legendre's coefficients of z'' dτ/dθ [m per unit τ]

  std::vector<TipInTime> tips = std::vector<TipInTime>(1);  ///< in contact; the first leads
  int sweeps = 0;                                           ///< that were made

  [[nodiscard]] TipInTime& leader() { return tips.front(); }
  [[nodiscard]] const TipInTime& leader() const { return tips.front(); }
  [[nodiscard]] std::span<TipInTime> further() { return std::span(tips).subspan(1); }
  [[nodiscard]] std::span<const TipInTime> further() const { return std::span(tips).subspan(1); }
  [[nodiscard]] bool leans() const { return leader().load != nullptr; }  ///< the loads are inclined
};

/// How closely the equations are to be solved.
struct Closeness {
  double velocity;  ///< error of x', y' that may be left [m per unit τ]
  bool warm;        ///< places and velocities at the nodes are known
};

inline constexpr double kFarthestTurn = 0.8;  ///< [rad]: series of sine and cosine lose 1e-16 there

/// Blades under an inclined load, one bent more than the other, where a shaft stands.
struct BranchPoints {
  AtNodes argument;  ///< p
  AtNodes lean;      ///< l: a first guess, then that of the equilibrium
  AtNodes residual;  ///< h of it [m²]
};

/// Bounds of what changes within an interval that is solved, as the polynomials through the start and the
/// nodes have it. None of them goes farther from its start than `kFarther` times the farthest node; where
/// that does not exclude a guard, its Bernstein coefficients tell, whose range it does not leave.
struct Bounds {
  double gap_measure;  ///< least g/Δ of the leading blade; the start is left out, where it may be 0 [m]
  double moved;        ///< how far the shaft comes from where it starts, seen from the ring [m]
  double latest;       ///< τ since the start at the latest node
  double distance;     ///< largest |c|, of the shaft from the ring's centre [m]
  struct OfTip {
    double slip_velocity;  ///< least |v|: its slip does not reverse where it is positive [m per unit τ]
    double shortening;     ///< largest δ/L [-]
    bool stays;            ///< bent, and on its branch; a leading blade always

    friend bool operator==(const OfTip&, const OfTip&) = default;
  };
  std::vector<OfTip> tips;
  // Of a blade under an inclined load, the end left out.
  double chart_left;  ///< least of `InclinedLoad::chart_left`
  double cone_left;   ///< least of `cone_left`, of tips at rest and of blades that stand straight
  double time_slope;  ///< least dτ/dθ, without that where a contact begins: it vanishes where a blade snaps

  friend bool operator==(const Bounds&, const Bounds&) = default;
};

struct IntervalSolver {
  /// Solves the equations at the nodes by sweeps. False where the sweeps do not converge; the interval then
  /// is of no use. No frequency of the machine times the length of the interval is above `kFarthestTurn`.
  ///
  /// A sweep makes one Newton step of h = 0 along the normal at all nodes, with the shaft moving along its
  /// path; there follow the forces, accelerations, velocities and places, the last two as integrals of the
  /// polynomials through the nodes. Only what the force does to the place, and the place to h, is left to
  /// converge.
  bool (*solve)(const Machine& machine, const Closeness& closeness, Interval& interval);
  /// The same for a blade under an inclined load.
  bool (*solve_inclined)(const Machine& machine, const Closeness& closeness, Interval& interval);
  /// The same for rigid blades, whose arc is a stretch of time: (p, w) = (p at the start, 0).
  bool (*solve_rigid)(const Machine& machine, const contact::Friction& friction, const Closeness& closeness,
                      Interval& interval);
  /// Finds the equilibria of these blades but for h = 0. False where one of them has none that goes on from
  /// the unbent blade.
  bool (*inclined_branch)(const TipStart& tip, double ring_radius, const contact::Pose& pose,
                          double angular_speed, BranchPoints& points);
  void (*bounds)(const Machine& machine, const Interval& interval, Bounds& bounds);
  /// Bound of |z| [m].
  double (*largest_displacement)(const Interval& interval);
  /// Bound of the polynomial through values at the start and the nodes.
  double (*upper_bound)(const AtPlaces& values);
  /// Bound of the gap [m²] of another blade, straight, whose direction is that of the leading blade turned
  /// by the angle whose cosine and sine are given. The start is left out, where it may be 0.
  double (*largest_gap)(const Machine& machine, const Interval& interval, const Blade& blade,
                        const std::array<double, 2>& offset);
  /// Sets the places and velocities of a stretch to those of the interval up to θ, as a first guess. θ may be
  /// a little beyond 1, and both the same interval.
  void (*read_stretch)(const Machine& machine, const Interval& interval, double fraction, Interval& stretch);
};
/// Those for this processor. All have the same bits: each has eight nodes, in parts of as many numbers as a
/// register holds, and no fused operations.
IntervalSolver interval_solver();

IntervalSolver solver_in_pairs();
IntervalSolver solver_avx2();
IntervalSolver solver_avx512();

}  // namespace rubatlas::collocation
