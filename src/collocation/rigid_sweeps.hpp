/// The sweeps of rigid blades on a ring that yields under each tip: the force follows from where the tip
/// stands and how it moves, and the arc is a stretch of time. A ring without mass makes one Newton step a
/// sweep to where its spring balances the forces of all blades (`rotor/ring_balance.hpp`).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "collocation/arc_sweeps.hpp"
#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"
#include "contact/sticking.hpp"

namespace rubatlas::collocation {
namespace {

template <std::size_t kWidth, bool kPlain>
class RigidSweeps : public ArcSweeps<kWidth, kPlain> {
  using Base = ArcSweeps<kWidth, kPlain>;
  friend Base;
  using Base::er_;
  using Base::interval_;
  using Base::machine_;
  using Base::rigid_tip_of;
  using Base::ring_;
  using Base::shaft_;

 public:
  using Number = Lanes<kWidth>;

  RigidSweeps(const Machine& machine, const contact::Friction& friction, const Closeness& closeness,
              Interval& interval)
      : Base(machine, closeness, interval),
        friction_(friction),
        rests_(std::ranges::count(interval.tips, 0.0, &TipStart::slip) > 0) {
    this->take_direction();
  }

  bool solve() { return this->converge(*this, kMostSweeps, kMostSweeps); }

 private:
  using Direction = typename Base::Direction;
  using Vector = typename Base::Vector;

  static constexpr int kMostSweeps = 16;  ///< they are cheap
  /// Of the ring's last step, in R: the next, of its square, is below rounding.
  [[nodiscard]] static double largest_step_allowed() { return 1e-6; }

  using Tip = typename Base::RigidTip;
  /// What it does to the shaft, as an acceleration.
  Vector push_of(const TipStart& at, const Direction& er) const {
    const Tip tip = rigid_tip_of(at, er);
    return this->push_of_rigid(*at.blade, tip, friction_.at(tip.slip_velocity, at.slip).coefficient, er);
  }

  /// Calls `use` with each tip and the direction of its blade.
  template <class Use>
  void each_tip(Use use) const {
    use(interval_.leader(), er_);
    for (TipInTime& further : interval_.further()) use(further, Base::direction_at(er_, further.offset));
  }

  /// Of a ring without mass.
  struct Balance {
    Vector stiffness_x, stiffness_y;  ///< rows of kr I + ΣAk [N/m]
    Vector excess;                    ///< ΣNk − kr r [N]
    Vector carried;                   ///< ΣAk p'k [N per unit τ]

    /// K⁻¹ of a vector.
    Vector solved(const Vector& right) const {
      const auto& [kxx, kxy] = stiffness_x;
      const auto& [kyx, kyy] = stiffness_y;
      return Vector{kyy * right.x - kxy * right.y, kxx * right.y - kyx * right.x} *
             (Number(1.0) / (kxx * kyy - kxy * kyx));
    }
  };
  Balance weigh() const {
    const double spring = machine_.ring.spring;
    Balance sum{{spring, 0.0}, {0.0, spring}, ring_.place(interval_.ring) * -spring, {0.0, 0.0}};
    each_tip([&](const TipStart& at, const Direction& er) {
      const Tip tip = rigid_tip_of(at, er);
      const double friction = at.slip * friction_.friction;
      const double stiffness = at.blade->ring_stiffness;
      const Vector normal = Base::on_shaft(tip.normal, er);
      const Number load = tip.yielding * stiffness;
      sum.excess = sum.excess + Vector{normal.x - normal.y * friction, normal.y + normal.x * friction} * load;
      // kt (n nᵀ + (1 − R/|p|)(I − n nᵀ)), and turned by friction
      const Number across = load / tip.distance;
      const Number along = Number(stiffness) - across;
      const Number xx = across + along * normal.x * normal.x;
      const Number xy = along * normal.x * normal.y;
      const Number yy = across + along * normal.y * normal.y;
      const Vector change_x{xx - xy * friction, xy - yy * friction};
      const Vector change_y{xy + xx * friction, yy + xy * friction};
      sum.stiffness_x = sum.stiffness_x + change_x;
      sum.stiffness_y = sum.stiffness_y + change_y;
      const Vector velocity =
          shaft_.velocity + Base::quarter_turned(er) * (this->angular_speed() * at.blade->reach);
      sum.carried = sum.carried + Vector{dot(change_x, velocity), dot(change_y, velocity)};
    });
    return sum;
  }
  /// A step of Newton's method to where the ring stands.
  void place_ring() {
    const Balance balance = weigh();
    const Vector step = balance.solved(balance.excess);
    ring_.displacement = ring_.displacement + step;
    this->largest_step_ = step.largest() / machine_.ring_radius;
  }
  /// Where the shaft has been found to be, with the ring's velocity and acceleration.
  void settle_ring() {
    place_ring();
    const Balance balance = weigh();
    ring_.velocity = balance.solved(balance.carried);
    ring_.differentiate(interval_.ring, this->nodes_, this->time_rate_);
  }

  RUBATLAS_IN_ONE_FUNCTION double sweep(bool /*light*/) {
    if (this->ring_is_massless()) {
      place_ring();
      return this->move(ring_.place(interval_.ring) * (-machine_.ring.spring * machine_.force_unit));
    }
    Vector push{0.0, 0.0};
    each_tip([&](const TipStart& at, const Direction& er) { push = push + push_of(at, er); });
    if (!rests_) return this->move(push);
    this->accelerate(push);
    hold();
    return this->advance(push);
  }

  /// Adds the friction that keeps tips at rest: −q t of each, such that dv/dτ vanishes
  /// (`contact/sticking.hpp`). That of one tip changes dv/dτ of another one by the cosine between their
  /// tangents.
  void hold() {
    std::size_t count = 0;
    std::array<Vector, contact::kMostAtRest> tangent;
    each_tip([&](const TipStart& at, const Direction& er) {
      if (at.slip != 0.0 || count == contact::kMostAtRest) return;
      const Tip tip = rigid_tip_of(at, er);
      const auto pose = this->pose_of(this->straight_tip(at, er), at.blade->reach, er);
      const Number speed = this->angular_speed();
      typename Base::InBlade acceleration = Base::in_blade(shaft_.acceleration, er);
      // The hub's own angular acceleration moves the tip across the blade.
      acceleration.across = acceleration.across + this->angular_acceleration() * at.blade->reach;
      pull_[count] = contact::slip_acceleration(tip.normal, tip.distance, contact::tip_rate(pose, speed),
                                                contact::tip_acceleration(pose, speed, acceleration), speed);
      tangent[count] = Base::quarter_turned(Base::on_shaft(tip.normal, er));
      ++count;
    });
    if (count == 2) {
      const Number cosine = dot(tangent[0], tangent[1]);
      const Number sine = tangent[0].x * tangent[1].y - tangent[0].y * tangent[1].x;
      const Number per_square = Number(1.0) / (sine * sine);
      const Number first = (pull_[0] - cosine * pull_[1]) * per_square;
      pull_[1] = (pull_[1] - cosine * pull_[0]) * per_square;
      pull_[0] = first;
    }
    for (std::size_t i = 0; i < count; ++i) shaft_.acceleration = shaft_.acceleration - tangent[i] * pull_[i];
  }
  void store() {
    if (this->ring_is_massless()) settle_ring();
    this->store_motion();
    std::size_t at_rest = 0;  // tips before this one, in the order of `hold`
    each_tip([&](TipInTime& kept, const Direction& er) {
      const Tip tip = this->store_rigid_tip(er, kept);
      if (kept.slip != 0.0 || at_rest == contact::kMostAtRest) return;
      const Number load = tip.yielding * (kept.blade->ring_stiffness * machine_.force_unit);
      const Number largest = load * contact::largest_at_rest(friction_);
      (largest * largest - pull_[at_rest] * pull_[at_rest]).store(kept.cone_left);
      ++at_rest;
    });
    for (TipInTime& further : interval_.further()) further.square = further.gap_measure;
  }

  const contact::Friction& friction_;
  bool rests_;                                     ///< a tip is at rest
  std::array<Number, contact::kMostAtRest> pull_;  ///< q of tips at rest [m per unit τ²]
};

template <std::size_t kWidth>
bool rigid_solved(const Machine& machine, const contact::Friction& friction, const Closeness& closeness,
                  Interval& interval) {
  return machine.is_plain() ? solved_by<RigidSweeps<kWidth, true>>(machine, friction, closeness, interval)
                            : RigidSweeps<kWidth, false>(machine, friction, closeness, interval).solve();
}

}  // namespace
}  // namespace rubatlas::collocation
