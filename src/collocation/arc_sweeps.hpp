/// What the sweeps of an interval do for any law of contact: shaft and ring move along the arc, and blades
/// turn.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "collocation/bodies_in_lanes.hpp"
#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"
#include "contact/tip.hpp"

namespace rubatlas::collocation {
namespace {

/// `kPlain`: nothing acts but what the paper's rotor has and harmonic forcings, which takes an eighth less.
template <std::size_t kWidth, bool kPlain>
class ArcSweeps {
 public:
  using Number = Lanes<kWidth>;

 protected:
  using Vector = VectorInLanes<kWidth>;
  using Motion = BodyInLanes<kWidth>;
  using InBlade = contact::BladeVector<Number>;
  using Pose = contact::PoseOf<Number>;
  /// Of a blade: er, that at the start, and what it has changed by, of which a short interval would lose
  /// digits.
  struct Direction : Vector {
    Vector change;
    std::array<double, 2> start;
  };

  ArcSweeps(const Machine& machine, const Closeness& closeness, Interval& interval)
      : machine_(machine),
        closeness_(closeness),
        interval_(interval),
        nodes_(kNodeTables),
        chord_time_(Number(nodes_.node) * interval.chord.time),
        chord_argument_(Number(nodes_.node) * interval.chord.argument + interval.start_argument),
        deviation_(interval.deviation),
        seen_start_{interval.shaft.start[0] - interval.ring.start[0],
                    interval.shaft.start[1] - interval.ring.start[1] + machine.misalignment} {
    er_.start = interval.blade;
    shaft_.start(interval.shaft, closeness.warm, elapsed());
    if (ring_moves()) ring_.start(interval.ring, closeness.warm, elapsed());
  }

  /// p² of a further blade after a step, of which a share is left. `lifts_off`: none would be, somewhere.
  Number stepped(const Number& square, const Number& step, bool& lifts_off) {
    constexpr double kLeastLeft = 0.01;
    const Number next = square + step;
    const Number kept = larger(next, square * kLeastLeft);
    lifts_off = !(next.least() > 0.0);
    const bool is_far = !lifts_off && (kept - next).largest() > 0.0;
    largest_step_ = is_far ? kFirstChange : std::max(largest_step_, magnitude(kept - square).largest());
    return kept;
  }
  /// Δ of a tip that is bent to the side ±1, at least so much that it is no rounding of what it is added to.
  template <class Tip>
  static Number bent_by(const Tip& tip, double side, double length) {
    return larger(tip.bent.across * side, Number(kUnbent * length));
  }
  /// g/Δ of a tip [m], as h = 0 has it, in a ring that does not yield. `first_shortening`: δ/Δ of the unbent
  /// blade, where the quotient is 0/0.
  template <class Tip>
  static Number gap_per_deflection(const Tip& tip, double side, double length, double first_shortening) {
    const Number shorter = larger(tip.bent.along, Number(first_shortening * kUnbent * length));
    return (tip.place.across * 2.0 + tip.bent.across) * side +
           shorter / bent_by(tip, side, length) * (tip.place.along * 2.0 + tip.bent.along);
  }
  /// v of a tip (MODEL 4.4), of the velocities that have been found. `per_radius`, `radius`: of the ring
  /// there.
  template <class Tip, class Radius>
  Number slip_velocity_of(const Tip& tip, const Vector& er, double reach, const Radius& per_radius,
                          const Radius& radius) const {
    const Number speed = angular_speed();
    const Pose at = pose_of({tip.place + tip.bent, {}}, reach, er);
    return contact::slip_velocity(tip.place, contact::tip_rate(at, speed), speed, per_radius, radius);
  }

  /// The tip of a blade that does not bend.
  struct RigidTip {
    Number depth;          ///< beyond the undeformed ring [m]
    Number yielding;       ///< F/kr
    Number slip_velocity;  ///< v
    Number distance;       ///< from the ring's centre
    InBlade normal;
  };
  /// Of a blade in the direction er (MODEL 4.3, 4.7).
  RigidTip rigid_tip_of(const TipStart& start, const Direction& er) const {
    const Blade& blade = *start.blade;
    const Straight straight = straight_tip(start, er);
    const Number speed = angular_speed();
    const Pose at = pose_of(straight, blade.reach, er);
    RigidTip tip;
    tip.distance = root(dot(straight.place, straight.place));
    tip.normal = straight.place * (Number(1.0) / tip.distance);
    tip.slip_velocity = contact::undeformed_slip_velocity(tip.normal, at, speed, blade.reach);
    tip.depth = straight.gap / (tip.distance + machine_.ring_radius);
    tip.yielding = tip.depth;
    if (blade.ring_damping > 0.0) {
      const Number closing = contact::square_change(tip.normal, contact::tip_rate(at, speed)) * 0.5;
      tip.yielding = tip.yielding + closing * (blade.ring_damping / blade.ring_stiffness);
    }
    return tip;
  }
  /// What an interval keeps of it, where shaft and ring have been found to be.
  RigidTip store_rigid_tip(const Direction& er, TipInTime& kept) const {
    const RigidTip tip = rigid_tip_of(kept, er);
    straight_tip(kept, er).gap.store(kept.gap);
    tip.yielding.store(kept.gap_measure);
    tip.slip_velocity.store(kept.slip_velocity);
    (tip.yielding * kept.blade->ring_stiffness).store(kept.normal_force);
    Number(0.0).store(kept.root_strain);
    return tip;
  }
  /// What it does to the shaft, as an acceleration; `coefficient`: c.
  template <class Coefficient>
  Vector push_of_rigid(const Blade& blade, const RigidTip& tip, const Coefficient& coefficient,
                       const Vector& er) const {
    const Number load = tip.yielding * (blade.ring_stiffness * machine_.force_unit);
    const InBlade direction = contact::push_direction(tip.normal, coefficient);
    return on_shaft(direction * load, er);
  }
  /// In x and y.
  static Vector on_shaft(const InBlade& vector, const Vector& er) {
    return {vector.along * er.x - vector.across * er.y, vector.along * er.y + vector.across * er.x};
  }
  /// Along and across a blade.
  static InBlade in_blade(const Vector& vector, const Vector& er) {
    return {vector.x * er.x + vector.y * er.y, vector.y * er.x - vector.x * er.y};
  }
  static Vector quarter_turned(const Vector& vector) { return {vector.y * -1.0, vector.x}; }

  /// Sweeps until what is left is below the tolerance. False where it does not become so. `full`: so many
  /// sweeps have slopes of their own.
  template <class Sweeps>
  bool converge(Sweeps& sweeps, int most, int full) {
    double before = kFirstChange;
    bool light = false;
    double ratio_before = kSlowest;
    for (interval_.sweeps = 1; interval_.sweeps <= most; ++interval_.sweeps) {
      const double change = sweeps.sweep(light);
      if (!(change < kFirstChange)) return false;
      // The changes form a geometric series in the end, of which this is the rest. The first one may hold
      // little of what falls slowest.
      const double ratio = interval_.sweeps > 1 ? std::min(change / before, kSlowest) : kSlowest;
      const double rest = change * std::max(ratio, interval_.sweeps > 2 ? ratio_before : kOfSecond);
      if (rest <= closeness_.velocity && largest_step_ < sweeps.largest_step_allowed()) {
        sweeps.store();
        return true;
      }
      light = interval_.sweeps >= full && change < kConverging * before;
      before = change;
      ratio_before = ratio;
    }
    return false;
  }

  [[nodiscard]] bool ring_moves() const { return !kPlain && machine_.ring.moves; }
  [[nodiscard]] bool ring_is_massless() const { return !kPlain && machine_.ring.is_massless(); }
  [[nodiscard]] bool ring_has_mass() const { return ring_moves() && !ring_is_massless(); }
  /// How much more than the shaft a ring with a mass moves under a push, the other way.
  [[nodiscard]] double ring_share() const {
    return ring_has_mass() ? machine_.ring.force_unit / machine_.force_unit : 0.0;
  }
  [[nodiscard]] bool ripples() const { return !kPlain && machine_.ripples(); }
  [[nodiscard]] bool is_isotropic() const { return kPlain || machine_.support.isotropic; }
  Number elapsed() const { return chord_time_ + deviation_ * interval_.normal.time; }
  Number angular_speed() const { return kPlain ? Number(machine_.speed_ratio) : angular_speed_; }
  Number angular_acceleration() const { return kPlain ? Number(0.0) : angular_acceleration_; }
  /// The tip of a blade that does not bend, from the ring's centre.
  struct Straight {
    InBlade place;  ///< [m]
    /// g, by how far the tip has come since the start: that of a light contact is smaller than the rounding
    /// of R².
    Number gap;
  };
  Straight straight_tip(const TipStart& start, const Direction& er) const {
    const double reach = start.blade->reach;
    Vector come = shaft_.displacement;
    if (ring_moves()) come = come - ring_.displacement;
    come = come + er.change * reach;
    const Vector from{seen_start_[0] + reach * er.start[0], seen_start_[1] + reach * er.start[1]};
    const Vector place = come + from;
    return {in_blade(place, er), dot(come, place + from) + start.start_gap};
  }
  /// The shaft seen from a blade whose tip would lie there if it did not bend.
  Pose pose_of(const Straight& tip, double reach, const Vector& er) const {
    const InBlade velocity = in_blade(seen_velocity(), er);
    return {tip.place.along - reach, tip.place.across, velocity.along, velocity.across, tip.gap};
  }
  /// The shaft's velocity as seen from the ring.
  Vector seen_velocity() const { return ring_moves() ? shaft_.velocity - ring_.velocity : shaft_.velocity; }

  /// Direction of the leading blade, and how fast it turns, at the nodes' times.
  void take_direction() {
    const Machine& m = machine_;
    Number angle = elapsed() * m.speed_ratio;
    angular_speed_ = m.speed_ratio;
    angular_acceleration_ = 0.0;
    if (ripples()) {
      const Vector ripple = turned(interval_.ripple, elapsed() * m.ripple.frequency);
      angle = angle + (ripple.y - interval_.ripple[1]) * m.ripple.depth;
      angular_speed_ = ripple.x * (m.speed_ratio * m.ripple.amplitude) + m.speed_ratio;
      angular_acceleration_ = ripple.y * (-m.speed_ratio * m.ripple.amplitude * m.ripple.frequency);
    }
    er_.change = change_by_turning(interval_.blade, angle);
    turn_to_change();
    direction_holds_ = true;
  }
  void turn_to_change() {
    er_.x = er_.change.x + interval_.blade[0];
    er_.y = er_.change.y + interval_.blade[1];
  }
  /// Adds the acceleration by the forcings to that of the shaft.
  void add_forcings() {
    const std::array<double, 2>& blade = interval_.blade;
    for (std::size_t j = 0; j < machine_.forcing_count; ++j) {
      const std::array<double, 2>& start = interval_.forcing[j];
      const double frequency = machine_.frequency[j];
      Vector term;
      if (frequency == 0.0) {
        term = {Number(start[0]), Number(start[1])};
      } else if (frequency == machine_.speed_ratio && !ripples()) {
        // It stands still against the blade.
        term = offset_by(
            er_, {start[0] * blade[0] + start[1] * blade[1], start[1] * blade[0] - start[0] * blade[1]});
      } else {
        term = turned(start, elapsed() * frequency);
      }
      shaft_.acceleration = shaft_.acceleration + term;
    }
  }

  static Vector offset_by(const Vector& from, const std::array<double, 2>& offset) {
    return {from.x * offset[0] - from.y * offset[1], from.y * offset[0] + from.x * offset[1]};
  }
  /// Of another blade.
  static Direction direction_at(const Direction& leader, const std::array<double, 2>& offset) {
    const auto& [x, y] = leader.start;
    return {offset_by(leader, offset),
            offset_by(leader.change, offset),
            {x * offset[0] - y * offset[1], y * offset[0] + x * offset[1]}};
  }

  /// Turns the leading blade's direction on, after a step in τ that the deviation has taken. No deviation has
  /// taken more than `largest_step_`.
  void turn_on(const Number& time_step) {
    if (ripples()) {
      take_direction();
    } else {
      const double farthest = largest_step_ * std::abs(interval_.normal.time * machine_.speed_ratio);
      const Number angle = time_step * machine_.speed_ratio;
      er_.change = er_.change + change_by_little_turn<kWidth>(er_, angle, farthest < kHardlyATurn);
      turn_to_change();
      direction_holds_ = farthest < kLittleTurn;
    }
  }

  /// Moves shaft and ring along the arc where the contacts push the shaft so, as an acceleration. Returns the
  /// largest change of a velocity [m per unit τ].
  double move(const Vector& push) {
    accelerate(push);
    return advance(push);
  }
  /// The shaft's acceleration.
  void accelerate(const Vector& push) {
    const Machine& m = machine_;
    const Vector place = shaft_.place(interval_.shaft);
    if (is_isotropic()) {
      shaft_.acceleration = (push - place) - shaft_.velocity * (2.0 * m.damping_ratio);
    } else {
      const auto product = [](const std::array<double, 4>& rows, const Vector& vector) {
        return Vector{vector.x * rows[0] + vector.y * rows[1], vector.x * rows[2] + vector.y * rows[3]};
      };
      shaft_.acceleration =
          (push - product(m.support.stiffness, place)) - product(m.support.damping, shaft_.velocity);
    }
    add_forcings();
  }
  /// Integrates it, and that of a ring that moves.
  double advance(const Vector& push) {
    const Interval& in = interval_;
    take_time_rate();
    double change = shaft_.integrate(in.shaft, nodes_, time_rate_);
    if (ring_has_mass()) {
      ring_.acceleration = acceleration_of_ring(push);
      change = std::max(change, ring_.integrate(in.ring, nodes_, time_rate_));
    }
    return change;
  }

  /// Of a ring with a mass, which the push on the shaft moves the other way.
  Vector acceleration_of_ring(const Vector& push) const {
    const Machine::Ring& ring = machine_.ring;
    return (push * -ring_share() - ring_.place(interval_.ring) * ring.stiffness) -
           ring_.velocity * ring.damping;
  }

  /// dτ/dθ as the deviation has it.
  void take_time_rate() {
    deviation_slope_ = Number::combined(nodes_.slope, deviation_);
    time_rate_ = deviation_slope_ * interval_.normal.time + interval_.chord.time;
  }

  /// Adds a push to the one by which shaft and ring have been moved.
  void add_push(const Vector& more) {
    shaft_.add(nodes_, time_rate_, more);
    if (ring_moves()) ring_.add(nodes_, time_rate_, more * -ring_share());
  }

  void store_motion() const {
    Interval& in = interval_;
    deviation_.store(in.deviation);
    shaft_.store(in.shaft);
    if (ring_moves()) ring_.store(in.ring);
    elapsed().store(in.elapsed);
    (chord_argument_ + deviation_ * in.normal.argument).store(in.argument);
    time_rate_.store(in.time_slope);
    (deviation_slope_ * in.normal.argument + in.chord.argument).store(in.argument_slope);
    er_.x.store(in.blade_x);
    er_.y.store(in.blade_y);
    angular_speed().store(in.angular_speed);
    Number squares = shaft_.squares(nodes_, time_rate_);
    if (ring_has_mass()) squares = squares + ring_.squares(nodes_, time_rate_);
    root(squares).store(in.coefficients);
  }

  static constexpr double kConverging = 0.25;  ///< ratio of changes below which slopes may be kept
  static constexpr double kFirstChange = std::numeric_limits<double>::infinity();
  static constexpr double kUnbent = 1e-9;  ///< Δ/L: below it δ/Δ is less than rounding
  /// Of Newton's steps: the next would be of its square. Velocities alone do not tell, where a blade is so
  /// soft that it hardly moves the shaft.
  static constexpr double kLargestStep = 1e-4;
  static constexpr double kSlowest = 0.5;  ///< ratio of changes, where none is known
  static constexpr double kOfSecond =
      0.1;  ///< the least ratio of the second change to the first one to believe

  const Machine& machine_;
  const Closeness& closeness_;
  Interval& interval_;
  const NodeTables& nodes_;
  Number chord_time_, chord_argument_;
  Number deviation_, deviation_slope_, time_rate_;
  Motion shaft_, ring_;
  std::array<double, 2> seen_start_;  ///< shaft's centre at the start, from the ring's [m]
  Direction er_;                      ///< of the leading blade
  Number angular_speed_;              ///< φ'
  Number angular_acceleration_;       ///< φ''
  double largest_step_ = 0.0;
  bool direction_holds_ = false;  ///< er_ is that of the deviation, to rounding
};

/// Solves an interval by sweeps of one kind.
template <class Sweeps, class... With>
RUBATLAS_IN_ONE_FUNCTION [[gnu::noinline]] bool solved_by(With&&... with) {
  return Sweeps(with...).solve();
}

}  // namespace
}  // namespace rubatlas::collocation
