/// The sweeps of rigid blades on a ring that yields under each tip: the force follows from where the tip
/// stands and how it moves, and the arc is a stretch of time. A ring without mass makes one Newton step a
/// sweep to where its spring balances the forces of all blades (`rotor/ring_balance.hpp`).
#pragma once

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

  RigidSweeps(const Contact& contact, const contact::Friction& friction, const Closeness& closeness,
              Interval& interval)
      : Base(contact, closeness, interval), contact_(contact), friction_(friction) {
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
  struct Touching {
    const TipStart& start;
    const Blade& blade;
    double slip;  ///< s
    Direction er;
  };
  /// What it does to the shaft, as an acceleration.
  Vector push_of(const Touching& at) const {
    const Tip tip = rigid_tip_of(at.start, at.blade, at.er);
    return this->push_of_rigid(at.blade, tip, friction_.at(tip.slip_velocity, at.slip).coefficient, at.er);
  }

  /// Calls `use` with each blade in contact.
  template <class Use>
  void each_blade(Use use) const {
    use(Touching{interval_, *contact_.blade, contact_.slip, er_});
    for (std::size_t k = 0; k < interval_.further.size(); ++k) {
      const FurtherBlade& further = interval_.further[k];
      use(Touching{further, *further.blade, further.slip, Base::direction_at(er_, further.offset)});
    }
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
    each_blade([&](const Touching& at) {
      const Tip tip = rigid_tip_of(at.start, at.blade, at.er);
      const Direction& er = at.er;
      const double friction = at.slip * friction_.friction;
      const double stiffness = at.blade.ring_stiffness;
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
          shaft_.velocity + Base::quarter_turned(er) * (this->angular_speed() * at.blade.reach);
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

  template <bool kLight>
  [[gnu::flatten]] double sweep() {  // as `solved_by` is
    if (this->ring_is_massless()) {
      place_ring();
      return this->move(ring_.place(interval_.ring) * (-machine_.ring.spring * machine_.force_unit));
    }
    Vector push{0.0, 0.0};
    each_blade([&](const Touching& at) { push = push + push_of(at); });
    if (count_at_rest() == 0) return this->move(push);
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
    each_blade([&](const Touching& at) {
      if (at.slip != 0.0 || count == contact::kMostAtRest) return;
      const Tip tip = rigid_tip_of(at.start, at.blade, at.er);
      const Direction& er = at.er;
      const Number speed = this->angular_speed();
      typename Base::InBlade acceleration = Base::in_blade(shaft_.acceleration, er);
      // The hub's own angular acceleration moves the tip across the blade.
      acceleration.across = acceleration.across + this->angular_acceleration() * at.blade.reach;
      pull_[count] =
          contact::slip_acceleration(tip.normal, tip.distance, contact::tip_rate(tip.at, speed),
                                     contact::tip_acceleration(tip.at, speed, acceleration), speed);
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
  [[nodiscard]] std::size_t count_at_rest() const {
    std::size_t count = contact_.slip == 0.0 ? 1 : 0;
    for (const FurtherBlade& further : interval_.further) count += further.slip == 0.0 ? 1 : 0;
    return count;
  }

  void store() {
    if (this->ring_is_massless()) settle_ring();
    this->store_motion();
    std::size_t at_rest = 0;
    store_tip(*contact_.blade, contact_.slip, er_, at_rest, interval_);
    for (FurtherBlade& further : interval_.further) {
      store_tip(*further.blade, further.slip, Base::direction_at(er_, further.offset), at_rest, further);
      further.square = further.gap_measure;
    }
  }
  /// `at_rest`: tips at rest before this one, in the order of `hold`.
  void store_tip(const Blade& blade, double slip, const Direction& er, std::size_t& at_rest,
                 TipInTime& kept) const {
    const Tip tip = rigid_tip_of(kept, blade, er);
    this->straight_tip(kept, blade, er).gap.store(kept.gap);
    tip.yielding.store(kept.gap_measure);
    tip.slip_velocity.store(kept.slip_velocity);
    (tip.yielding * blade.ring_stiffness).store(kept.normal_force);
    Number(0.0).store(kept.root_strain);
    if (slip != 0.0 || at_rest == contact::kMostAtRest) return;
    const Number load = tip.yielding * (blade.ring_stiffness * machine_.force_unit);
    const Number largest = load * contact::largest_at_rest(friction_);
    (largest * largest - pull_[at_rest] * pull_[at_rest]).store(kept.cone_left);
    ++at_rest;
  }

  const Contact& contact_;
  const contact::Friction& friction_;
  std::array<Number, contact::kMostAtRest> pull_;  ///< q of tips at rest [m per unit τ²]
};

template <std::size_t kWidth>
bool rigid_solved(const Contact& contact, const contact::Friction& friction, const Closeness& closeness,
                  Interval& interval) {
  return contact.machine->is_plain()
             ? solved_by<RigidSweeps<kWidth, true>>(contact, friction, closeness, interval)
             : RigidSweeps<kWidth, false>(contact, friction, closeness, interval).solve();
}

}  // namespace
}  // namespace rubatlas::collocation
