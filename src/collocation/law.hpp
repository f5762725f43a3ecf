/// A law of contact: the equations of an interval and what is known where a blade takes the lead, for arcs;
/// what becomes of a contact, for modes and resets. Each kind of law implements this interface once, and does
/// not override what cannot occur under it. Speeds are φ' of the hub [rad per unit τ].
#pragma once

#include <complex>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "blade/bending_table.hpp"
#include "collocation/blades_in_contact.hpp"
#include "collocation/interval.hpp"
#include "contact/directed_elastica.hpp"
#include "contact/tip.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::collocation {

/// How far a blade is bent, as coordinates of the arc.
struct Bending {
  double argument = 0.0;  ///< p
  double lean = 0.0;      ///< l, of a blade under an inclined load
  double yielding = 0.0;  ///< y of a ring with dampers under the tip [m]
  double share = 1.0;     ///< λ of a tip that skims
};

/// Where the tip of a contact is: its pose, and φ' there.
struct TipPlace {
  contact::Pose pose;
  double speed;
};

/// What has become of a contact: it stands in equilibrium, it is free, or neither (MODEL 5).
enum class Standing : std::uint8_t { stands, free, lost };

class Law {
 public:
  /// `friction`: of all blades.
  explicit Law(const contact::Friction& friction) : friction_(friction) {}
  Law(const Law&) = delete;  // phases point at it
  Law& operator=(const Law&) = delete;
  virtual ~Law() = default;
  /// The law of the same blades, each shorter at its tip by what it has lost [m]; empty: none has.
  [[nodiscard]] virtual std::unique_ptr<Law> of_shortened(std::span<const double> lost) const = 0;

  [[nodiscard]] virtual Blade numbers(int blade) const = 0;
  [[nodiscard]] virtual const contact::Geometry& geometry(int blade) const = 0;
  [[nodiscard]] const contact::Friction& friction() const { return friction_; }
  /// Friction takes its sign from s, so that a reversal of the slip is an event.
  [[nodiscard]] bool has_slip_state() const { return friction_.has_slip_state(); }
  /// The lean of the load is an unknown.
  [[nodiscard]] bool leans() const { return leans_; }
  /// The force is explicit: the arc is a stretch of time.
  [[nodiscard]] bool is_rigid() const { return is_rigid_; }
  /// A contact that ends under load ends at g = 0. Else a tip may lift off where its blade has pushed the
  /// ring outwards, and touch down there.
  [[nodiscard]] bool ends_at_ring() const { return ends_at_ring_; }
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
  /// The largest δ/L that is known.
  [[nodiscard]] virtual double largest_shortening(int /*blade*/) const {
    return std::numeric_limits<double>::infinity();
  }
  /// Tips that hop without end skim (MODEL 4.9).
  [[nodiscard]] virtual bool may_skim() const { return false; }
  /// How often curves of blades have been evaluated.
  [[nodiscard]] virtual std::uint64_t evaluations() const = 0;

  // Arcs.

  /// Takes a place on this machine, which outlives the law's arcs.
  virtual void take_machine(const rotor::Machine& /*machine*/) {}
  /// A contact as it goes on where its blade stands, or as it begins there. None where the blade has no
  /// equilibrium.
  [[nodiscard]] virtual std::optional<Touch> in_equilibrium(const Touch& touch, const TipPlace& at) const = 0;
  /// A contact without equilibrium is free again at once: that of a blade that does not bend, which a ring
  /// with dampers would pull.
  [[nodiscard]] bool is_free_at_once(const Touch& touch, const TipPlace& at) const {
    return !ends_at_ring() && (is_rigid() || touch.straight) && !(force(touch, at).normal > 0.0);
  }
  /// A contact begins anew with the arc, the leading one first.
  virtual void take(const Touch& /*touch*/) {}
  /// This contact leads. Gives how far its blade is bent.
  virtual Bending lead(const Touch& touch) = 0;
  /// ±1: to which side a blade is bent.
  [[nodiscard]] virtual double side(const Touch& touch) const { return touch.slip; }
  /// A contact where the next interval starts, but for `start_gap` and what a further blade has.
  [[nodiscard]] virtual BladeStart start(const Touch& touch, const TipPlace& at) const = 0;
  /// Sets how a further blade goes on.
  virtual void set_course(const Touch& touch, const TipPlace& at, BladeStart& start) const = 0;
  /// Where the arc leads from there, for a blade that is bent: dτ, dp and dl, of any length.
  /// `acceleration`: of the shaft, seen from the ring, along (real) and across the blade [m per unit τ²].
  struct Tangent {
    double time, argument, lean;
  };
  [[nodiscard]] virtual Tangent tangent(const Touch& /*touch*/, const TipPlace& /*at*/,
                                        const std::complex<double>& /*acceleration*/) const {
    return {1.0, 0.0, 0.0};
  }
  /// The leading blade's curve from the unbent blade on, roughly, with ends of pieces in p.
  [[nodiscard]] virtual std::span<const blade::BendingTable::Knot> knots(int /*blade*/) const { return {}; }
  /// Δ/p² [m] where a blade is hardly bent.
  [[nodiscard]] virtual double deflection_per_square(const Touch& /*touch*/) const { return 0.0; }

  [[nodiscard]] virtual bool solve(const Machine& machine, const Closeness& closeness,
                                   Interval& interval) const = 0;

  /// The contact of a blade that is bent so.
  [[nodiscard]] virtual Touch touch(const TipStart& tip, const Bending& bending) const = 0;
  /// Its force, and c [-].
  [[nodiscard]] virtual contact::TipForce force(const Touch& touch, const TipPlace& at) const = 0;
  [[nodiscard]] double friction_coefficient(const Touch& touch, const contact::Pose& at,
                                            const contact::TipForce& force) const {
    return touch.slip == 0.0 ? holding(touch, at) : friction_.coefficient(force.slip_velocity, touch.slip);
  }
  /// Puts a ring without mass where its spring balances these contacts. False where there is no such place
  /// (MODEL 5).
  virtual bool place_ring(const rotor::Machine& /*machine*/, std::span<const Touch> /*touching*/,
                          rotor::ContactState& /*state*/) const {
    return true;
  }
  /// Rates of what the leading blade is bent by, from those of the arc.
  struct Rates {
    double bending = 0.0;                   ///< of u
    double modulus = 0.0, amplitude = 0.0;  ///< of κ and φ
  };
  [[nodiscard]] virtual Rates rates(int /*blade*/, const Bending& /*bending*/,
                                    const Tangent& /*along*/) const {
    return {};
  }

  // Resets of one contact.

  /// A contact opens. False where no force exists (MODEL 5).
  [[nodiscard]] virtual bool open(const TipPlace& /*at*/, Touch& /*touch*/) const { return true; }
  /// A contact goes on where the tip stands now, after a change of the blade or of its speed.
  [[nodiscard]] virtual Standing keep(const TipPlace& at, Touch& /*touch*/) const {
    return at.pose.gap <= 0.0 ? Standing::free : Standing::stands;
  }
  /// Goes from the end of a branch to the next equilibrium.
  [[nodiscard]] virtual Standing snap(const TipPlace& /*at*/, Touch& /*touch*/) const {
    return Standing::lost;
  }
  /// Finds the bending after a change of the slip direction. False where there is none.
  [[nodiscard]] virtual bool bend_anew(const TipPlace& /*at*/, Touch& /*touch*/) const { return true; }
  /// A blade that has unbent stays in contact, standing straight.
  [[nodiscard]] virtual bool straightens(const TipPlace& /*at*/, Touch& /*touch*/) const { return false; }
  /// The force of an open contact where its blade stands; updates its bending. False where there is none, or
  /// where it does not follow from the place of the tip.
  virtual bool respond(const TipPlace& /*at*/, Touch& /*touch*/, contact::TipForce& /*force*/) const {
    return false;
  }

  // Rest.

  /// A tip whose slip velocity comes to zero may rest at once (MODEL 7.14).
  [[nodiscard]] virtual bool sticks() const { return friction_.sticks; }
  // Where slip reversals accumulate (MODEL 4.4):
  /// Whether the model says what follows there.
  [[nodiscard]] virtual bool knows_rest() const { return law_of_rest(0).has_value(); }
  /// The law of a blade whose tip then rests, held by a friction coefficient within [−μ, μ], if it is another
  /// one. A tip that slips has the same force under both.
  [[nodiscard]] virtual std::optional<contact::DirectedElastica> law_of_rest(int /*blade*/) const {
    return std::nullopt;
  }

 protected:
  /// c that holds a tip at rest.
  [[nodiscard]] virtual double holding(const Touch& touch, const contact::Pose& /*at*/) const {
    return touch.holding;
  }
  /// p² of a further blade that is bent, as the shaft would move on without forces.
  static Course square_of_bent(double argument, const Tangent& along) {
    return {argument * argument, 2.0 * argument * along.argument / along.time};
  }
  /// What a contact and its force say of its start.
  static BladeStart starts(const Touch& touch, const contact::TipForce& force, double gap_measure) {
    return {{.number = touch.blade,
             .slip = touch.slip,
             .straight = touch.straight,
             .skims = touch.skims,
             .at_start = force,
             .start_gap_measure = gap_measure,
             .start_yielding = touch.yielding}};
  }

  contact::Friction friction_;
  // Of a kind of law.
  bool leans_ = false, is_rigid_ = false, ends_at_ring_ = true;
  IntervalSolver solver_ = interval_solver();
};

/// What all kinds have in common: blades with a law each, which need not be alike.
template <class Derived, class BladeLaw, class Base = Law>
class LawOfBlades : public Base {
 public:
  using Blades = std::vector<BladeLaw>;
  explicit LawOfBlades(Blades blades) : Base(blades.front().friction()), blades_(std::move(blades)) {}

  [[nodiscard]] std::unique_ptr<Law> of_shortened(std::span<const double> lost) const override {
    Blades worn = blades_;
    for (std::size_t k = 0; k < lost.size(); ++k) {
      if (lost[k] != 0.0) worn[k] = blades_[k].shortened(lost[k]);
    }
    return std::make_unique<Derived>(std::move(worn));
  }
  [[nodiscard]] const contact::Geometry& geometry(int blade) const override { return of(blade).geometry(); }
  [[nodiscard]] std::uint64_t evaluations() const override {
    std::uint64_t sum = 0;
    for (const BladeLaw& blade : blades_) sum += blade.evaluations();
    return sum;
  }
  [[nodiscard]] const BladeLaw& of(int blade) const { return blades_[static_cast<std::size_t>(blade)]; }
  [[nodiscard]] int count() const { return static_cast<int>(blades_.size()); }  ///< of blades

 private:
  Blades blades_;
};

}  // namespace rubatlas::collocation
