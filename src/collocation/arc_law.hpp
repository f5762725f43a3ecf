/// What an arc asks of a law of contact: the equations of an interval, and what is known where a blade takes
/// the lead. Speeds are φ' of the hub [rad per unit τ].
#pragma once

#include <complex>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "blade/bending_table.hpp"
#include "collocation/blades_in_contact.hpp"
#include "collocation/interval.hpp"
#include "contact/tip.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::collocation {

/// How far a blade is bent, as coordinates of the arc.
struct Bending {
  double argument = 0.0;  ///< p
  double lean = 0.0;      ///< l, of a blade under an inclined load
  double yielding = 0.0;  ///< y of a ring with dampers under the tip [m]
  double share = 1.0;     ///< λ of a tip that skims
};

class ArcLaw {
 public:
  /// `friction`: of all blades.
  explicit ArcLaw(const contact::Friction& friction) : friction_(friction) {}
  ArcLaw(const ArcLaw&) = delete;
  ArcLaw& operator=(const ArcLaw&) = delete;
  virtual ~ArcLaw() = default;

  [[nodiscard]] virtual Blade numbers(int blade) const = 0;
  [[nodiscard]] virtual contact::Geometry geometry(int blade) const = 0;
  /// Friction takes its sign from s, so that a reversal of the slip is an event.
  [[nodiscard]] bool has_slip_state() const { return friction_.has_slip_state(); }
  /// The lean of the load is an unknown.
  [[nodiscard]] virtual bool leans() const { return false; }
  /// The force is explicit: the arc is a stretch of time.
  [[nodiscard]] virtual bool is_rigid() const { return false; }
  /// A contact that ends under load ends at g = 0.
  [[nodiscard]] virtual bool ends_at_ring() const { return true; }
  /// A tip that cannot rest may slip on against s (MODEL 4.4).
  [[nodiscard]] virtual bool may_slip_back() const { return false; }
  /// A contact goes on beyond the ring while it has a force.
  [[nodiscard]] virtual bool releases_at_fold(int /*blade*/) const { return false; }
  /// A blade that is bent begins and ends above the ring, straight.
  [[nodiscard]] virtual bool may_stand_straight(int /*blade*/) const { return false; }
  /// A straight blade that buckles finds no equilibrium next to it.
  [[nodiscard]] bool buckles_with_a_jump(const Touch& touch, const contact::Pose& at) const {
    return may_stand_straight(touch.blade) && touch.slip * at.tangential < 0.0;
  }
  /// Where the equilibria end in a fold, the blade may snap to others.
  [[nodiscard]] virtual bool has_branches(int /*blade*/) const { return false; }
  /// The force of the leading blade vanishes with the gap where its tip stands.
  [[nodiscard]] virtual bool starts_unloaded(int blade, double slip, const contact::Pose& at) const = 0;
  /// Up to which δ/L its contact is valid.
  [[nodiscard]] virtual double valid_shortening(int /*blade*/) const {
    return std::numeric_limits<double>::infinity();
  }

  /// A contact as it goes on where its blade stands, or as it opens there. None where the blade has no
  /// equilibrium.
  [[nodiscard]] virtual std::optional<Touch> open(const Touch& touch, const contact::Pose& at,
                                                  double speed) const = 0;
  /// A contact that does not open is free again at once, instead of having no equilibrium: a blade that does
  /// not bend, which a ring with dampers would pull.
  [[nodiscard]] bool is_free_at_once(const Touch& touch, const contact::Pose& at, double speed) const {
    return !ends_at_ring() && (is_rigid() || touch.straight) && !(force(touch, at, speed).normal > 0.0);
  }
  /// How often equilibria have been evaluated to find those.
  [[nodiscard]] virtual std::uint64_t evaluations() const { return 0; }

  /// A contact begins anew with the arc, the leading one first, which may be `alone`.
  virtual void take(const Touch& /*touch*/, bool /*alone*/) {}
  /// This contact leads. Gives how far its blade is bent.
  virtual Bending lead(const Touch& touch) = 0;
  /// ±1: to which side a blade is bent.
  [[nodiscard]] virtual double side(const Touch& touch) const { return touch.slip; }
  /// A contact where the next interval starts, but for `start_gap` and what a further blade has.
  [[nodiscard]] virtual BladeStart start(const Touch& touch, const contact::Pose& at, double speed) const = 0;
  /// Sets how a further blade goes on.
  virtual void set_course(const Touch& touch, const contact::Pose& at, double speed,
                          BladeStart& start) const = 0;
  /// Where the arc leads from there, for a blade that is bent: dτ, dp and dl, of any length.
  /// `acceleration`: of the shaft, seen from the ring, along (real) and across the blade [m per unit τ²].
  struct Tangent {
    double time, argument, lean;
  };
  [[nodiscard]] virtual Tangent tangent(const Touch& /*touch*/, const contact::Pose& /*at*/, double /*speed*/,
                                        const std::complex<double>& /*acceleration*/) const {
    return {1.0, 0.0, 0.0};
  }
  /// The leading blade's curve from the unbent blade on, roughly, with ends of pieces in p.
  [[nodiscard]] virtual std::span<const blade::BendingTable::Knot> knots() const { return {}; }
  /// Δ/p² [m] of the leading blade where it is hardly bent.
  [[nodiscard]] virtual double deflection_per_square() const { return 0.0; }

  [[nodiscard]] virtual bool solve(const Machine& machine, const Closeness& closeness,
                                   Interval& interval) const = 0;

  /// The contact of a blade that is bent so.
  [[nodiscard]] virtual Touch touch(const TipStart& tip, const Bending& bending) const = 0;
  /// Its force, and c [-].
  [[nodiscard]] virtual contact::TipForce force(const Touch& touch, const contact::Pose& at,
                                                double speed) const = 0;
  [[nodiscard]] double friction_coefficient(const Touch& touch, const contact::Pose& at,
                                            const contact::TipForce& force) const {
    return touch.slip == 0.0 ? holding(touch, at) : friction_.coefficient(force.slip_velocity, touch.slip);
  }
  /// Puts a ring without mass where its spring balances these contacts.
  virtual void place_ring(double /*time*/, std::span<const Touch> /*touching*/,
                          rotor::ShaftAndRing& /*bodies*/) const {}
  /// Rates of what the leading blade is bent by, from those of the arc.
  struct Rates {
    double bending = 0.0;                   ///< of u
    double modulus = 0.0, amplitude = 0.0;  ///< of κ and φ
  };
  [[nodiscard]] virtual Rates rates(const Bending& /*bending*/, const Tangent& /*along*/) const { return {}; }

 protected:
  /// c that holds a tip at rest.
  [[nodiscard]] virtual double holding(const Touch& touch, const contact::Pose& /*at*/) const {
    return touch.holding;
  }
  /// What a contact and its force say of its start.
  static BladeStart starts(const Touch& touch, const contact::TipForce& force, double gap_measure) {
    BladeStart start;
    start.force = force;
    start.number = touch.blade;
    start.slip = touch.slip;
    start.straight = touch.straight;
    start.skims = touch.skims;
    start.start_gap_measure = gap_measure;
    start.start_slip_velocity = force.slip_velocity;
    start.start_force = force.normal;
    start.start_strain = force.root_strain;
    start.start_shortening = force.shortening;
    start.start_yielding = touch.yielding;
    return start;
  }

  contact::Friction friction_;
  IntervalSolver solver_ = interval_solver();
};

}  // namespace rubatlas::collocation
