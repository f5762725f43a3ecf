/// An interval of a contact, as collocation solves it: numbers in and out, without types of the motion.
#pragma once

#include <array>
#include <cstddef>

#include "blade/bending_table.hpp"
#include "collocation/nodes.hpp"

namespace rubatlas::collocation {

/// What does not change during a contact. Lengths in m.
struct Contact {
  double reach;          ///< rh + L
  double ring_radius;    ///< R
  double closing;        ///< (rh + L)² − R² [m²]
  double length;         ///< L
  double load_unit;      ///< EI/L² [N]
  double friction;       ///< μ [-]
  double force_unit;     ///< 1/(m ωn²) [m/N]
  double damping_ratio;  ///< ζ [-]
  double speed_ratio;    ///< Ω [-]
  double misalignment;   ///< y0
  double slip;           ///< s = ±1 of the leading blade
  bool forced;           ///< an unbalance acts
};

/// A further blade in contact. How far it is bent follows from where the shaft is.
struct FurtherBlade {
  std::array<double, 2> offset{};    ///< cosine and sine of its angle from the leading blade
  double slip = 1.0;                 ///< s = ±1
  double start_square = 0.0;         ///< p² at the start
  double start_gap_measure = 0.0;    ///< `gap_measure` there
  double start_slip_velocity = 0.0;  ///< `slip_velocity` there
  AtNodes square;         ///< p²: a first guess, then the solution. Smooth at a touch-down, unlike p
  AtNodes gap_measure;    ///< as in `Interval`
  AtNodes slip_velocity;  ///< likewise
};
inline constexpr std::size_t kMostFurther = 3;

/// A stretch of the curve h = 0 of one blade, which leads, in the plane (τ, p), written as a graph over its
/// chord: at θ in [0, 1]
///     (τ, p) = start + θ chord + w(θ) normal,
/// where both vectors are the caller's. Every quantity is a polynomial of degree 8 through the start and the
/// nodes. All of this is relative to the start, so that time keeps its digits.
struct Interval {
  struct Direction {
    double time;      ///< τ
    double argument;  ///< p
  };

  double start_time = 0.0;               ///< τ of the revolution
  double start_argument = 0.0;           ///< p
  std::array<double, 4> start{};         ///< x, y, x', y'
  std::array<double, 2> acceleration{};  ///< z'' there, for the first guess [m per unit τ²]
  std::array<double, 2> jerk{};          ///< z''' there, likewise [m per unit τ³]
  std::array<double, 2> blade{};         ///< er of the blade in contact at the start
  std::array<double, 2> forcing{};       ///< acceleration by the unbalance there [m per unit τ²]
  double start_gap_measure = 0.0;        ///< `gap_measure` there
  double start_slip_velocity = 0.0;      ///< `slip_velocity` there
  Direction chord{};
  Direction normal{};

  AtNodes deviation;         ///< w: a first guess, then the solution
  AtNodes x, y, vx, vy;      ///< likewise
  AtNodes elapsed;           ///< τ since the start
  AtNodes argument;          ///< p
  AtNodes time_slope;        ///< dτ/dθ
  AtNodes argument_slope;    ///< dp/dθ
  AtNodes ax, ay;            ///< z'' [m per unit τ²]
  AtNodes blade_x, blade_y;  ///< er of the blade
  AtNodes gap_measure;       ///< g/Δ [m], as h = 0 has it: it has the sign of g where the blade is bent
  AtNodes slip_velocity;     ///< v of the tip (MODEL 4.4) [m per unit τ]
  AtNodes coefficients;      ///< magnitudes of Legendre's coefficients of z'' dτ/dθ [m per unit τ]
  std::size_t further_count = 0;
  std::array<FurtherBlade, kMostFurther> further;
  int sweeps = 0;  ///< that were made
};

/// How closely the equations are to be solved.
struct Closeness {
  double velocity;  ///< error of x', y' that may be left [m per unit τ]
  bool warm;        ///< x, y, x', y' at the nodes are known
};

/// Solves the equations at the nodes by sweeps. False where the sweeps do not converge; the interval then is
/// of no use.
///
/// A sweep makes one Newton step of h = 0 along the normal at all nodes, with the shaft moving along its
/// path; there follow the forces, accelerations, velocities and places, the last two as integrals of the
/// polynomials through the nodes. Only what the force does to the place, and the place to h, is left to
/// converge.
using Solve = bool (*)(const Contact& contact, const blade::BendingTable& table, const Closeness& closeness,
                       Interval& interval);

/// Bounds of what changes within an interval that is solved, as the polynomials through the start and the
/// nodes have it: none of them leaves the range of its Bernstein coefficients.
struct Bounds {
  double slip_velocity;  ///< least s v of all blades: no slip reverses where it is positive [m per unit τ]
  double gap_measure;    ///< least g/Δ of the leading blade; the start is left out, where it may be 0 [m]
  double argument;       ///< largest p of all blades
  double displacement;   ///< largest |z| [m]
  double distance;       ///< largest |c|, of the shaft from the ring's centre [m]
  std::array<bool, kMostFurther> stays;  ///< a further blade stays bent

  friend bool operator==(const Bounds&, const Bounds&) = default;
};
using BoundsOf = Bounds (*)(const Contact& contact, const Interval& interval);
/// Bound of the gap [m²] of another blade, straight, whose direction is that of the leading blade turned
/// by the angle whose cosine and sine are given. The start is left out, where it may be 0.
using LargestGap = double (*)(const Contact& contact, const Interval& interval,
                              const std::array<double, 2>& offset);

struct IntervalSolver {
  Solve solve;
  BoundsOf bounds;
  LargestGap largest_gap;
};
/// Those for this processor. All have the same bits: each has eight nodes, in parts of as many numbers as a
/// register holds, and no fused operations.
IntervalSolver interval_solver();

IntervalSolver solver_in_pairs();
IntervalSolver solver_avx2();
IntervalSolver solver_avx512();

}  // namespace rubatlas::collocation
