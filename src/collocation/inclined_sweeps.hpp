/// The sweeps that solve an interval of blades under an inclined load. As those of the paper's law
/// (`interval_sweeps.hpp`), with the lean of the load as a second unknown at each node and its direction as a
/// second equation (`inclined_tip.hpp`).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "collocation/arc_sweeps.hpp"
#include "collocation/inclined_load.hpp"
#include "collocation/inclined_tip.hpp"
#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"

namespace rubatlas::collocation {
namespace {

template <std::size_t kWidth>
class InclinedSweeps : public ArcSweeps<kWidth, false> {
  using Base = ArcSweeps<kWidth, false>;
  friend Base;
  using Base::deviation_;
  using Base::er_;
  using Base::interval_;
  using Base::largest_step_;
  using Base::machine_;
  using Base::nodes_;
  using Base::on_shaft;
  using Base::ring_;
  using Base::ring_moves;
  using Base::seen_velocity;
  using Base::shaft_;
  using Base::time_rate_;

 public:
  using Number = Lanes<kWidth>;

  InclinedSweeps(const Machine& machine, const Closeness& closeness, Interval& interval)
      : Base(machine, closeness, interval),
        lean_(interval.leader().lean),
        lead_(interval.leader(), machine.ring_radius) {
    further_.reserve(interval.further().size());
    for (TipInTime& further : interval.further()) further_.emplace_back(further, machine.ring_radius);
    // Newton's first step has to know how v changes with the nodes' times.
    this->take_time_rate();
    shaft_.differentiate(interval.shaft, nodes_, time_rate_);
    if (ring_moves()) ring_.differentiate(interval.ring, nodes_, time_rate_);
  }

  bool solve() { return this->converge(*this, kMostSweeps, kFullSweeps); }

 private:
  using Direction = typename Base::Direction;
  using Vector = typename Base::Vector;
  using Pose = typename Base::Pose;
  using Tip = InclinedTip<kWidth>;
  static constexpr int kMostSweeps = 12;
  static constexpr int kFullSweeps = 3;  ///< with slopes of their own
  /// An interval may be so short that its velocities hardly change, whatever its ends are.
  [[nodiscard]] double largest_step_allowed() const {
    constexpr double kShareOfInterval = 1e-3;
    const double length = std::max(std::abs(interval_.chord.argument), interval_.chord.time);
    return std::min(Base::kLargestStep, kShareOfInterval * length);
  }

  /// A further blade. Newton's steps for p² and l at the times that the leading one has.
  struct FurtherTip {
    FurtherTip(TipInTime& further, double ring_radius)
        : in_time(&further), tip(further, ring_radius), square(further.square), lean(further.lean) {}

    TipInTime* in_time;
    Tip tip;
    Number square, lean;   ///< p², l
    Number bending_slope;  ///< du/dp
    Number e_rate;         ///< de/dτ
    Number inverse;        ///< of the determinant of h and e by u and l
    typename Tip::InBlade push;
  };

  /// The shaft seen from a blade in the direction er.
  Pose pose_from(const TipStart& start, const Direction& er) const {
    return this->pose_of(this->straight_tip(start, er), start.blade->reach, er);
  }
  /// The shaft's, as seen from the ring.
  Vector seen_acceleration() const {
    return ring_moves() ? shaft_.acceleration - ring_.acceleration : shaft_.acceleration;
  }
  Number e_rate_of(const Tip& tip, const Pose& at, const Vector& er) const {
    return tip.e_rate(at, this->angular_speed_, Base::in_blade(seen_acceleration(), er));
  }
  /// |v| that a tip at rest had before the step. The shaft's velocity shows only what steps change.
  double slip_left(const Tip& tip) const {
    return tip.start.load->rests ? magnitude(tip.e).largest() * machine_.ring_radius : 0.0;
  }

  double sweep(bool light) { return light ? sweep<true>() : sweep<false>(); }
  /// Returns the largest change of a velocity [m per unit τ]; not a number where there is no blade.
  ///
  /// A `light` sweep keeps the slopes of the sweep before.
  template <bool kLight>
  RUBATLAS_IN_ONE_FUNCTION double sweep() {
    const Interval& in = interval_;
    if (!this->direction_holds_) this->take_direction();
    const Number argument = this->chord_argument_ + deviation_ * in.normal.argument;
    const Number square = argument * argument;
    const Pose at = pose_from(in.leader(), er_);
    if (!lead_.template stand<!kLight>(bending_of(*lead_.start.load, argument, square), lean_, at,
                                       this->angular_speed_))
      return std::numeric_limits<double>::quiet_NaN();
    if (!kLight) {
      bending_slope_ = lead_.start.load->bending_slope(square);
      const Number bending_by_deviation = bending_slope_ * in.normal.argument;
      const Number h_by_deviation =
          lead_.h_by_bending * bending_by_deviation + lead_.h_rate() * in.normal.time;
      const Number e_by_deviation =
          lead_.e_by_bending * bending_by_deviation + e_rate_of(lead_, at, er_) * in.normal.time;
      const Number inverse =
          Number(-1.0) / (h_by_deviation * lead_.e_by_lean - lead_.h_by_lean * e_by_deviation);
      deviation_per_h_ = lead_.e_by_lean * inverse;
      deviation_per_e_ = lead_.h_by_lean * inverse;
      lean_per_h_ = e_by_deviation * inverse;
      lean_per_e_ = h_by_deviation * inverse;
    }

    slip_left_ = slip_left(lead_);
    // One Newton step; what follows is taken at its end.
    const Number step = lead_.h * deviation_per_h_ - lead_.e * deviation_per_e_;
    const Number lean_step = lead_.e * lean_per_e_ - lead_.h * lean_per_h_;
    deviation_ = deviation_ + step;
    lean_ = lean_ + lean_step;
    largest_step_ = std::max(magnitude(step).largest(), magnitude(lean_step).largest());
    const Number time_step = step * in.normal.time;
    const Number bending_step = bending_slope_ * (step * in.normal.argument);
    const Direction er_before = er_;
    this->turn_on(time_step);
    Vector push = on_shaft(lead_.move_on(bending_step, lean_step, time_step, machine_.force_unit), er_);
    for (FurtherTip& further : further_) {
      const std::array<double, 2>& offset = further.in_time->offset;
      if (!step_further<kLight>(further, Base::direction_at(er_before, offset), time_step))
        return std::numeric_limits<double>::quiet_NaN();
      push = push + on_shaft(further.push, Base::offset_by(er_, offset));
    }
    const Vector expected = seen_velocity() + seen_acceleration() * time_step;
    this->move(push);
    const bool rests = lead_.start.load->rests;
    const Number slip = rests ? follow_slip<kLight>(expected) : Number(0.0);
    const double change = (seen_velocity() - expected).largest();
    if (rests) bend_to(slip);
    return std::max(change, slip_left_);  // in this order: not a number where `change` is none
  }

  /// Newton's step for the slip velocity of the leading tip: while it rests its load follows the shaft's
  /// velocity at once, which in turn is its integral, so that sweeps alone hardly converge. `expected`: the
  /// velocity with which the tip was brought to rest. Returns the slip velocity that the load has followed.
  template <bool kLight>
  Number follow_slip(const Vector& expected) {
    const double per_radius = 1.0 / machine_.ring_radius;
    const auto& [a, b] = lead_.place;
    const Vector along_ring{(b * er_.x + a * er_.y) * -per_radius, (a * er_.x - b * er_.y) * per_radius};
    if (!kLight) {
      push_by_slip_ = on_shaft(lead_.push_by_slip(machine_.force_unit), er_);
      set_slip_coupling(along_ring);
    }
    AtNodes slips;
    dot(along_ring, seen_velocity() - expected).store(slips);
    for (std::size_t k = 0; k < kNodes; ++k) eliminate(k, slips);
    const Number slip(slips);
    this->add_push(push_by_slip_ * slip);
    return slip;
  }
  /// Bends the blade, at rest, to the load that has followed a slip velocity. Where the blade all but stands
  /// still this moves the nodes far in time, and all that depends on it has to follow: the next interval
  /// begins with what is kept.
  void bend_to(const Number& slip) {
    const Number e = lead_.e_by_velocity() * slip;
    const Number step = e * deviation_per_e_ * -1.0;
    const Number lean_step = e * lean_per_e_;
    deviation_ = deviation_ + step;
    lean_ = lean_ + lean_step;
    const Number time_step = step * interval_.normal.time;
    shaft_.go_on(time_step);
    if (ring_moves()) ring_.go_on(time_step);
    this->take_direction();
    const Number bending_step = bending_slope_ * (step * interval_.normal.argument);
    lead_.move_on(bending_step, lean_step, time_step, machine_.force_unit);
  }
  /// Gauss's elimination of 1 − ∂v/∂v by the way of the load, [j][i]: what a change at node j makes at node
  /// i.
  [[gnu::noinline]] void set_slip_coupling(const Vector& along_ring) {
    const double closing = 1.0 + this->ring_share();
    std::array<AtNodes, kNodes> matrix;
    AtNodes rate_x, rate_y;
    (push_by_slip_.x * time_rate_).store(rate_x);
    (push_by_slip_.y * time_rate_).store(rate_y);
    for (std::size_t j = 0; j < kNodes; ++j) {
      const Number rate = along_ring.x * rate_x[j] + along_ring.y * rate_y[j];
      (Number(nodes_.integral[j]) * rate * -closing).store(matrix[j]);
      matrix[j][j] += 1.0;
    }
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double per_pivot = 1.0 / matrix[k][k];
      (Number(matrix[k]) * per_pivot).store(elimination_[k]);
      elimination_[k][k] = 1.0 - per_pivot;
      for (std::size_t j = k + 1; j < kNodes; ++j) eliminate(k, matrix[j]);
    }
  }
  /// Of all rows but one at a time.
  void eliminate(std::size_t k, AtNodes& column) const {
    (Number(column) - Number(elimination_[k]) * column[k]).store(column);
  }

  /// False where there is no such blade. `er`: its direction before the step in time. A function of its own:
  /// compilers keep more of the leading blade in registers.
  template <bool kLight>
  [[gnu::noinline]] bool step_further(FurtherTip& further, const Direction& er, const Number& time_step) {
    Tip& tip = further.tip;
    const Number argument = root(further.square);
    const Pose at = pose_from(*further.in_time, er);
    if (!tip.template stand<!kLight>(bending_of(*tip.start.load, argument, further.square), further.lean, at,
                                     this->angular_speed_))
      return false;
    if (!kLight) {
      further.bending_slope = tip.start.load->bending_slope(further.square);
      further.e_rate = e_rate_of(tip, at, er);
      further.inverse = Number(1.0) / (tip.h_by_bending * tip.e_by_lean - tip.h_by_lean * tip.e_by_bending);
    }
    slip_left_ = std::max(slip_left_, slip_left(tip));
    const Number h = tip.h + tip.h_rate() * time_step;
    const Number e = tip.e + further.e_rate * time_step;
    const Number bending_step = (e * tip.h_by_lean - h * tip.e_by_lean) * further.inverse;
    const Number lean_step = (h * tip.e_by_bending - e * tip.h_by_bending) * further.inverse;
    const Number step = argument * 2.0 * (bending_step / further.bending_slope);
    further.square = this->stepped(further.square, step, further.in_time->lifts_off);
    further.lean = further.lean + lean_step;
    largest_step_ = std::max(largest_step_, magnitude(lean_step).largest());
    further.push = tip.move_on((root(further.square) - argument) * further.bending_slope, lean_step,
                               time_step, machine_.force_unit);
    return true;
  }

  void store_tip(const Tip& tip, const Direction& er, TipInTime& kept) const {
    const double radius = machine_.ring_radius;
    this->straight_tip(kept, er).gap.store(kept.gap);
    tip.store(kept);
    Base::gap_per_deflection(tip, kept.load->side, kept.blade->length, 0.0).store(kept.gap_measure);
    this->slip_velocity_of(tip, er, kept.blade->reach, 1.0 / radius, radius).store(kept.slip_velocity);
  }
  void store() const {
    this->store_motion();
    store_tip(lead_, er_, interval_.leader());
    for (const FurtherTip& further : further_) {
      TipInTime& kept = *further.in_time;
      store_tip(further.tip, Base::direction_at(er_, kept.offset), kept);
      further.square.store(kept.square);
      // The determinant by p² and l: positive where a slipping tip's branch goes on from the unbent blade.
      (further.bending_slope / (further.inverse * root(further.square)) * -kept.load->side)
          .store(kept.firmness);
      if (kept.slip == 0.0 && kept.firmness[0] < 0.0) {
        for (double& value : kept.firmness.value) value = -value;
      }
    }
  }

  Number lean_;
  Tip lead_;
  Number bending_slope_;                                                ///< du/dp
  Number deviation_per_h_, deviation_per_e_, lean_per_h_, lean_per_e_;  ///< Newton's steps
  Vector push_by_slip_;                      ///< `Tip::push_by_slip` of the leading tip at rest
  std::array<AtNodes, kNodes> elimination_;  ///< of its coupling, [k][i]: factors of row k in row i
  std::vector<FurtherTip> further_;
  double slip_left_ = 0.0;  ///< of tips at rest [m per unit τ]
};

/// `IntervalSolver::inclined_branch`.
template <std::size_t kWidth>
bool inclined_branch(const TipStart& start, double ring_radius, const contact::Pose& pose,
                     double angular_speed, BranchPoints& points) {
  const InclinedLoad& load = *start.load;
  using Number = Lanes<kWidth>;
  constexpr int kMost = 8;
  constexpr double kClosest = 1e-6;  // of l: h is for Newton's method to go on from
  constexpr double kFarthest = 0.7;  // of l: no load leans more
  const contact::PoseOf<Number> at{pose.radial, pose.tangential, pose.radial_velocity,
                                   pose.tangential_velocity, pose.gap};
  const Number argument(points.argument);
  const Number square = argument * argument;
  const Number bending = bending_of(load, argument, square);
  Number lean(points.lean);
  InclinedTip<kWidth> tip(start, ring_radius);
  for (int i = 0; i < kMost; ++i) {
    if (!tip.template stand<true>(bending, lean, at, angular_speed)) return false;
    if (!((tip.e_by_lean * load.side).least() > 0.0)) return false;
    const Number step = tip.e / tip.e_by_lean;
    lean = lean - step;
    const double largest = magnitude(step).largest();
    if (!(magnitude(lean).largest() < kFarthest)) return false;
    if (largest < kClosest) {
      lean.store(points.lean);
      (tip.h - tip.h_by_lean * step).store(points.residual);
      return true;
    }
  }
  return false;
}

template <std::size_t kWidth>
bool inclined_solved(const Machine& machine, const Closeness& closeness, Interval& interval) {
  return InclinedSweeps<kWidth>(machine, closeness, interval).solve();
}

}  // namespace
}  // namespace rubatlas::collocation
