/// The sweeps that solve an interval (`interval.hpp`). Compiled once for each kind of processor; everything
/// here has internal linkage, so that no other source can come to use instructions of a processor that it was
/// not compiled for.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "collocation/arc_sweeps.hpp"
#include "collocation/bending_in_lanes.hpp"
#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"
#include "collocation/yielding_step.hpp"

namespace rubatlas::collocation {
namespace {

template <std::size_t kWidth, bool kPlain>
class Sweeps : public ArcSweeps<kWidth, kPlain> {
  using Base = ArcSweeps<kWidth, kPlain>;
  friend Base;
  using Base::deviation_;
  using Base::direction_at;
  using Base::er_;
  using Base::interval_;
  using Base::machine_;
  using Base::straight_tip;

 public:
  using Number = Lanes<kWidth>;

  Sweeps(const Machine& machine, const Closeness& closeness, Interval& interval)
      : Base(machine, closeness, interval),
        lead_(interval.leader()),
        further_(interval.further().begin(), interval.further().end()) {
    if (!kPlain) this->take_time_rate();
  }

  bool solve() {
    // With several blades changes fall unevenly, and the slopes of one that is hardly bent change too fast to
    // be kept.
    const bool keeps_slopes = further_.empty() && !is_damped(*lead_.blade);
    return this->converge(*this, kMostSweeps, keeps_slopes ? kFullSweeps : kMostSweeps);
  }

 private:
  using Direction = typename Base::Direction;
  using Vector = typename Base::Vector;
  using InBlade = typename Base::InBlade;

  static constexpr int kMostSweeps = 9;
  static constexpr int kFullSweeps = 3;       ///< with slopes of their own
  static constexpr double kLittleBent = 0.1;  ///< p: blades that are bent less have shorter last steps
  [[nodiscard]] double largest_step_allowed() const {
    if (is_straight(lead_)) return Base::kLargestStep;
    const Number argument = this->chord_argument_ + deviation_ * interval_.normal.argument;
    const double largest = std::max(std::abs(interval_.start_argument), magnitude(argument).largest());
    return Base::kLargestStep * std::min(1.0, largest / kLittleBent);
  }

  using Table = BendingInLanes<kWidth>;
  using Bend = typename Table::Bend;

  /// A blade in contact.
  struct Tip {
    explicit Tip(TipInTime& tip)
        : in_time(&tip), blade(tip.blade), slip(tip.slip), yielding(tip.start_yielding) {}

    TipInTime* in_time;
    const Blade* blade;
    double slip;                        ///< s = ±1
    Number load;                        ///< F, all of it where the tip skims [N]
    InBlade bent;                       ///< (δ, s Δ) [m]
    InBlade place, rate;                ///< of the tip from the ring's centre [m], and by τ
    Bend slope;                         ///< of load, δ and s Δ by p
    Number argument_slope, time_slope;  ///< of h by p, and along the motion (MODEL 4.1)
    Number yielding;                    ///< y of the ring under the tip, F/kr without dampers [m]
  };
  /// A further one, of which h = 0 is solved for p².
  struct FurtherTip : Tip {
    explicit FurtherTip(TipInTime& tip) : Tip(tip), square(tip.square) { tip.lifts_off = false; }

    Number square;
  };

  /// The ring yields as the load is, or in its own time.
  [[nodiscard]] static bool yields(const Blade& blade) { return !kPlain && blade.yield_unit != 0.0; }
  [[nodiscard]] static bool is_damped(const Blade& blade) { return !kPlain && blade.ring_damping > 0.0; }

  /// Load, shortening and deflection of a tip, with their slopes unless those are kept.
  template <bool kLight>
  static Bend bend_of(Tip& tip, const Number& argument) {
    const Bend bend = Table::template curve<!kLight>(*tip.blade->table, argument, tip.slope);
    if (kLight) return bend;
    const double per_argument = 1.0 / tip.blade->table->width();
    const double length = per_argument * tip.blade->length;
    tip.slope = {tip.slope.load * per_argument, tip.slope.shortening * length,
                 tip.slope.deflection * (tip.slip * length)};
    return bend;
  }

  /// Pose of the blade (MODEL 2), and its residual of h = 0 (MODEL 4.1) with the slopes.
  template <bool kLight>
  Number residual_of(Tip& tip, const Bend& bend, const Direction& er) const {
    const Blade& blade = *tip.blade;
    const auto straight = straight_tip(*tip.in_time, er);
    tip.bent = {bend.shortening * blade.length, bend.deflection * (tip.slip * blade.length)};
    Number residual = contact::contact_equation(straight.gap, straight.place, tip.bent);
    tip.place = straight.place - tip.bent;
    if (!kLight) {
      tip.argument_slope = dot(tip.place, InBlade{tip.slope.shortening, tip.slope.deflection}) * -2.0;
      tip.rate = contact::tip_rate(this->pose_of(straight, blade.reach, er), this->angular_speed());
      tip.time_slope = contact::square_change(tip.place, tip.rate);
    }
    if (yields(blade)) {
      const Number yielding = bend.load * blade.yield_unit;
      residual = residual - contact::widening(yielding, machine_.ring_radius);
      if (!kLight)
        tip.argument_slope = tip.argument_slope -
                             (yielding + machine_.ring_radius) * tip.slope.load * (2.0 * blade.yield_unit);
    }
    if (is_damped(blade)) residual = residual - contact::widening(tip.yielding, machine_.ring_radius);
    return residual;
  }

  /// Lets a ring with dampers yield, in the step in which a residual of h makes a blade bend more by
  /// `argument_by_residual` and time go on by `time_by_residual` times as much, and time by `time_step`
  /// besides, which the residual contains. Returns the residual in the ring that has yielded.
  Number yield(Tip& tip, const Bend& bend, const Number& residual, const Number& argument_by_residual,
               const Number& time_by_residual, const Number& time_step) const {
    const Number by_yielding = (tip.yielding + machine_.ring_radius) * -2.0;  // ∂h/∂y
    const Number load_by_residual = tip.slope.load * argument_by_residual * tip.blade->load_unit;
    const auto at_nodes = [](const Number& number) {
      AtNodes at;
      number.store(at);
      return at;
    };
    const Number step(yielding_step(
        *tip.blade, tip.in_time->start_yielding, at_nodes(tip.yielding),
        at_nodes(bend.load * tip.blade->load_unit), at_nodes(this->time_rate_),
        {at_nodes(load_by_residual * residual), at_nodes(load_by_residual * by_yielding)},
        {at_nodes(time_by_residual * residual + time_step), at_nodes(time_by_residual * by_yielding)}));
    tip.yielding = tip.yielding + step;
    return residual + by_yielding * step;
  }

  /// Moves a tip on by steps in p and τ, and gives what it does to the shaft, as an acceleration (MODEL 4.3).
  /// `er`: at the end of the steps. The force's normal is (a, b)/(R + F/kr) where h = 0.
  Vector push_of(Tip& tip, const Bend& bend, const Number& argument_step, const Number& time_step,
                 const Vector& er) const {
    const Number of_unit = bend.load + tip.slope.load * argument_step;
    const InBlade more{tip.slope.shortening * argument_step, tip.slope.deflection * argument_step};
    tip.bent = tip.bent + more;
    tip.place = tip.place + (tip.rate * time_step - more);
    return push_by(tip, of_unit, er);
  }
  /// What a tip does to the shaft under a load [EI/L²], where it stands.
  Vector push_by(Tip& tip, const Number& of_unit, const Vector& er) const {
    const Blade& blade = *tip.blade;
    const Number load = of_unit * blade.load_unit;
    tip.load = load;
    Number per_radius = machine_.force_unit / machine_.ring_radius;
    if (yields(blade)) tip.yielding = of_unit * blade.yield_unit;
    if (yields(blade) || is_damped(blade))
      per_radius = Number(machine_.force_unit) / (tip.yielding + machine_.ring_radius);
    const InBlade direction = contact::push_direction(tip.place, tip.slip * blade.friction);
    return this->on_shaft(direction * per_radius * load, er);
  }

  /// The same for a further blade, with a step of its own: one of Newton's for p², of which h is nearly
  /// linear where the blade is hardly bent.
  template <bool kLight>
  Vector push_of_further(FurtherTip& tip, const Direction& er_before, const Number& time_step) {
    const std::array<double, 2>& offset = tip.in_time->offset;
    if (is_straight(tip)) return push_of_straight(tip, direction_at(er_, offset));
    const Number argument = root(tip.square);
    const Bend bend = bend_of<kLight>(tip, argument);
    // Its slope along the motion is of this sweep.
    const Number before = residual_of<kLight>(tip, bend, direction_at(er_before, offset));
    Number residual = before + tip.time_slope * time_step;
    if (is_damped(*tip.blade))
      residual = yield(tip, bend, residual, Number(-1.0) / tip.argument_slope, Number(0.0), time_step);
    const Number step = argument * -2.0 * (residual / tip.argument_slope);
    tip.square = this->stepped(tip.square, step, tip.in_time->lifts_off);
    return push_of(tip, bend, root(tip.square) - argument, time_step, Base::offset_by(er_, offset));
  }

  double sweep(bool light) { return light ? sweep<true>() : sweep<false>(); }
  /// Returns the largest change of a velocity [m per unit τ].
  ///
  /// A `light` sweep keeps the slopes of the sweep before, and turns its directions on: changes are small by
  /// then, and the solution does not depend on the slopes.
  template <bool kLight>
  double sweep() {
    const Interval& in = interval_;
    if (!this->direction_holds_) this->take_direction();
    if (is_straight(lead_)) {
      this->largest_step_ = 0.0;
      return move_by<kLight>(push_of_straight(lead_, er_), er_, Number(0.0));
    }
    const Bend bend = bend_of<kLight>(lead_, this->chord_argument_ + deviation_ * in.normal.argument);
    Number residual = residual_of<kLight>(lead_, bend, er_);
    if (!kLight) {
      per_residual_ =
          Number(-1.0) / (lead_.argument_slope * in.normal.argument + lead_.time_slope * in.normal.time);
    }

    if (is_damped(*lead_.blade))
      residual = yield(lead_, bend, residual, per_residual_ * in.normal.argument,
                       per_residual_ * in.normal.time, Number(0.0));
    // One Newton step along the normal; what follows is taken at its end.
    const Number step = residual * per_residual_;
    deviation_ = deviation_ + step;
    this->largest_step_ = magnitude(step).largest();
    const Number time_step = step * in.normal.time;
    const Direction er_before = er_;
    this->turn_on(time_step);
    const Vector push = push_of(lead_, bend, step * in.normal.argument, time_step, er_);
    return move_by<kLight>(push, er_before, time_step);
  }
  /// Under the push of the leading blade and those of the others.
  template <bool kLight>
  double move_by(const Vector& push_of_lead, const Direction& er_before, const Number& time_step) {
    Vector push = push_of_lead;
    if (skims(lead_)) push = {Number(0.0), Number(0.0)};
    const Tip* skimming = skims(lead_) ? &lead_ : nullptr;
    Vector full = push_of_lead;
    Direction er = er_;
    for (FurtherTip& further : further_) {
      const Vector more = push_of_further<kLight>(further, er_before, time_step);
      if (skims(further)) {
        skimming = &further;
        full = more;
        er = direction_at(er_, further.in_time->offset);
      } else {
        push = push + more;
      }
    }
    if (skimming == nullptr) return this->move(push);
    share_ = share_on_ring(push, full, *skimming->in_time, er);
    return this->move(push + full * share_);
  }

  [[nodiscard]] static bool skims(const Tip& tip) { return !kPlain && tip.in_time->skims; }
  /// λ: that share of its full push keeps a tip on the ring, g'' = 0. The place p of the tip from the ring's
  /// centre has p·p'' + p'·p' = 0 there.
  Number share_on_ring(const Vector& others, const Vector& full, const TipStart& tip, const Direction& er) {
    const double reach = tip.blade->reach;
    this->accelerate(others);
    Vector acceleration = this->shaft_.acceleration;
    if (this->ring_has_mass()) acceleration = acceleration - this->acceleration_of_ring(others);
    const Number speed = this->angular_speed();
    const Vector across = Base::quarter_turned(er);
    acceleration =
        acceleration + across * (this->angular_acceleration() * reach) - er * (speed * speed * reach);
    const Vector velocity = this->seen_velocity() + across * (speed * reach);
    const Vector place = this->on_shaft(straight_tip(tip, er).place, er);
    const Number free = dot(place, acceleration) + velocity.x * velocity.x + velocity.y * velocity.y;
    return free * (-1.0 / (1.0 + this->ring_share())) / dot(place, full);
  }

  [[nodiscard]] static bool is_straight(const Tip& tip) { return !kPlain && tip.in_time->straight; }
  Vector push_of_straight(Tip& tip, const Direction& er) const {
    const Blade& blade = *tip.blade;
    if (!is_damped(blade)) return push_by(tip, compress(tip, er), er);
    return this->push_of_rigid(blade, this->rigid_tip_of(*tip.in_time, er), Number(tip.slip * blade.friction),
                               er);
  }
  /// Load [EI/L²] of a straight column whose tip lies on the ring, h = 0 at Δ = 0.
  Number compress(Tip& tip, const Direction& er) const {
    const Blade& blade = *tip.blade;
    const auto straight = straight_tip(*tip.in_time, er);
    const Number linear = straight.place.along * blade.axial_unit + machine_.ring_radius * blade.yield_unit;
    const double square = blade.axial_unit * blade.axial_unit - blade.yield_unit * blade.yield_unit;
    const Number load = straight.gap / (linear + root(linear * linear - straight.gap * square));
    tip.bent = {load * blade.axial_unit, Number(0.0)};
    tip.place = straight.place - tip.bent;
    tip.yielding = load * blade.yield_unit;
    return load;
  }

  /// g/Δ of a tip [m], as h = 0 has it. Next to the unbent blade F/kr is Δ's share there.
  static Number gap_measure_of(const Tip& tip, double ring_radius) {
    const Blade& blade = *tip.blade;
    const Number measure = Base::gap_per_deflection(tip, tip.slip, blade.length, blade.first_shortening);
    if (!yields(blade)) return measure;
    const Number yielding = larger(tip.yielding, Number(blade.first_yielding * Base::kUnbent * blade.length));
    return measure +
           yielding / Base::bent_by(tip, tip.slip, blade.length) * (tip.yielding + 2.0 * ring_radius);
  }
  Number slip_velocity_of(const Tip& tip, const Vector& er) const {
    const double radius = machine_.ring_radius;
    const double reach = tip.blade->reach;
    if (!yields(*tip.blade) && !is_damped(*tip.blade))
      return Base::slip_velocity_of(tip, er, reach, 1.0 / radius, radius);
    const Number yielded = tip.yielding + radius;
    return Base::slip_velocity_of(tip, er, reach, Number(1.0) / yielded, yielded);
  }

  /// What ∂h/∂p leaves of the share in it of δ and of the ring that yields.
  static Number firmness_of(const Tip& tip, double short_of_fold) {
    return tip.argument_slope * (-0.5 * (1.0 - short_of_fold)) +
           tip.place.across * tip.slope.deflection * short_of_fold;
  }
  void store(Tip& tip, const Direction& er) const {
    TipInTime& stored = *tip.in_time;
    if (is_straight(tip) && is_damped(*tip.blade)) {
      this->store_rigid_tip(er, stored).depth.store(stored.yielding);
      Number(0.0).store(stored.shortening);
      stored.square = stored.gap_measure;
      return;
    }
    const Number gap = straight_tip(stored, er).gap;
    gap.store(stored.gap);
    const bool is_column = tip.blade->buckling_load > 0.0;
    if (is_column) (gap * (0.5 / machine_.ring_radius)).store(stored.gap_measure);
    if (is_straight(tip)) {
      tip.load = compress(tip, er) * tip.blade->load_unit;
      (tip.load * -1.0 + tip.blade->buckling_load).store(stored.cone_left);
      stored.square = stored.gap_measure;
    } else if (skims(tip)) {
      (share_ + kShareBeyond).store(stored.gap_measure);
      (share_ * -1.0 + (1.0 + kShareBeyond)).store(stored.cone_left);
    } else if (!is_column) {
      gap_measure_of(tip, machine_.ring_radius).store(stored.gap_measure);
    }
    slip_velocity_of(tip, er).store(stored.slip_velocity);
    (skims(tip) ? tip.load * share_ : tip.load).store(stored.normal_force);
    const Blade& blade = *tip.blade;
    const Number shortening = tip.bent.along * (1.0 / blade.length);
    shortening.store(stored.shortening);
    // The moment F Δ + μ F (L − δ).
    const Number lever =
        tip.bent.across * (tip.slip / blade.length) + (Number(1.0) - shortening) * blade.friction;
    (tip.load * lever * (blade.strain_unit / blade.load_unit)).store(stored.root_strain);
    if (is_damped(*tip.blade)) tip.yielding.store(stored.yielding);
  }
  void store() {
    this->store_motion();
    store(lead_, er_);
    for (FurtherTip& further : further_) {
      TipInTime& stored = *further.in_time;
      store(further, direction_at(er_, stored.offset));
      if (is_straight(further)) continue;
      further.square.store(stored.square);
      if (further.blade->held_beyond_ring) firmness_of(further, stored.short_of_fold).store(stored.firmness);
    }
  }

  Tip lead_;
  std::vector<FurtherTip> further_;
  Number share_;         ///< λ of a tip that skims
  Number per_residual_;  ///< Newton's step along the normal for a residual of h
};

/// `kPlainWidth`: for the paper's rotor, whose sweeps may gain more from many registers than from wide ones.
template <std::size_t kWidth, std::size_t kPlainWidth = kWidth>
bool solved(const Machine& machine, const Closeness& closeness, Interval& interval) {
  const auto is_plain = [](const TipStart& tip) {
    const Blade& blade = *tip.blade;
    return blade.yield_unit == 0.0 && blade.ring_damping == 0.0 && blade.axial_unit == 0.0 && !tip.skims;
  };
  const bool plain = machine.is_plain() && std::ranges::all_of(interval.tips, is_plain);
  return plain ? solved_by<Sweeps<kPlainWidth, true>>(machine, closeness, interval)
               : Sweeps<kWidth, false>(machine, closeness, interval).solve();
}

}  // namespace
}  // namespace rubatlas::collocation
