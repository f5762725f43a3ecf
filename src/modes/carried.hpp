/// Mode: one elastic blade in contact whose bending parameter u is a state.
///
/// The contact equation h = 0 carries itself, and no root is solved: with a new independent variable σ
///     dτ/dσ = −∂h/∂u,   du/dσ = dh/dτ at fixed u,   dz/dσ = z' dτ/dσ,
/// which is regular at a head-on touch-down and at lift-off, where ∂h/∂u = 0 and the force is not Lipschitz
/// in τ. All rates are times one constant, which gives σ a sensible unit.
///
/// The contact ends at u = 0, where the blade lifts off; behind it the even curve leads back along the same
/// motion with time running backwards. It also ends under load, at g = 0 on the receding side (MODEL 4.2), or
/// at a fold of h = 0, where it is released or snaps to the next branch. Other blades may touch besides the
/// one that is carried: their forces are found where they stand.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "blade/elastica_curve.hpp"
#include "contact/pose.hpp"
#include "integrate/cubic_range.hpp"
#include "integrate/root_between.hpp"
#include "modes/contact_mode.hpp"
#include "modes/guards.hpp"
#include "modes/open_contact.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

template <class Law>
class Carried : public ContactMode<Law> {
 public:
  using Base = ContactMode<Law>;
  using typename Base::Bodies;
  using typename Base::FullState;
  using typename Base::Setup;
  static constexpr bool kTimeTurns = true;
  static constexpr bool kHasPath = true;
  static constexpr bool kCoarseSizes = false;

  explicit Carried(const Setup& setup) : Base(setup) {
    for (int k = 0; k < this->blades().count(); ++k)
      valid_bending_.push_back(valid_bending(this->law_->of(k).curve()));
  }

  /// The first contact is carried, from its bending on. The unit of σ is set so that it is the arc in the
  /// plane (τ, u) there: u where the blade touches, τ where it bends most. False where both rates vanish, a
  /// tip at rest on the ring, from which this form cannot start.
  bool open(double time, const Bodies& bodies, const std::vector<OpenContact>& contacts, FullState& state) {
    state = rotor::full_state(bodies, time, contacts.front().bending);
    this->stand(contacts);
    accepted_ = 0;
    carried_law_ = &this->law_->of(carried().blade);
    slip_ = carried().slip;
    const auto there = constraint(state);
    const double rate = std::hypot(there.bending_slope, there.time_slope);
    scale_ = 1.0 / rate;
    begins_step(state);
    return rate > kRestingRate * this->ring_radius() * this->ring_radius();
  }

  bool operator()(const FullState& state, FullState& derivative) {
    ++this->evaluations_;
    const contact::BladeDirection er = this->blades().direction_near(anchor_, state[rotor::kTime]);
    const contact::Pose pose =
        rotor::pose_of(this->rotor(), carried_law_->geometry(), er, rotor::from_ring(state));
    last_ = carried_law_->constraint(pose, slip_, state[rotor::kBending],
                                     this->blades().angular_speed(state[rotor::kTime]));
    std::complex<double> force = contact::on_rotor(last_.force, er);
    if (carried_law_->fold_measure(state[rotor::kBending], last_.bending_slope) > 0.0) met_fold_ = true;
    if (!add_others(state, force)) return false;
    this->acceleration_ = this->machine().acceleration(state, force);
    const double time_rate = -scale_ * last_.bending_slope;
    derivative = rotor::full_state(Bodies(time_rate * rotor::rate_of(state, this->acceleration_)), time_rate,
                                   scale_ * last_.time_slope);
    return true;
  }

  // How a step is judged.

  /// Takes the blade's direction at the start of a step, from which those of the stages are turned.
  void begins_step(const FullState& state) {
    anchor_ = this->blades().anchor(carried().blade, state[rotor::kTime]);
    Base::begins_step(state);
  }
  /// All attempts have one price.
  bool begins_attempt() {
    met_fold_ = false;
    const auto touching = static_cast<std::int64_t>(this->contacts_.size());
    return this->meter_->spend(Work::contact, WorkPrice::kAttempt + touching * WorkPrice::kForce);
  }
  /// The control's share of the scale, which is taken in the middle of the step, as far as the rate of u
  /// tells where that is.
  template <class Step>
  [[nodiscard]] double proposed_size(const Step& step, double relative) const {
    const double bending = step.start()[rotor::kBending];
    const double rate = step.start_derivative()[rotor::kBending];
    double size = relative * scale(bending);
    for (int i = 0; i < 2; ++i) size = relative * scale(std::max(0.0, bending + 0.5 * size * rate));
    return size;
  }
  template <class Step>
  [[nodiscard]] double aimed(const Step& step, double size) const {
    return Base::aimed_at_zero(step, rotor::kBending, size);
  }
  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    const double weight = kBendingWeight * this->rotor().length_scale /
                          std::min(scale(step.start()[rotor::kBending]), scale(step.end()[rotor::kBending]));
    return this->error_of(step, this->acceleration_, true, [&](const FullState& difference) {
      const double bending = weight * difference[rotor::kBending];
      return bending * bending;
    });
  }
  template <class Step>
  [[nodiscard]] bool trusts(const Step& step) const {
    return !holds_whole_contact(step) && !passes_fold(step) && !passes_two_folds(step) && !time_turns(step) &&
           !(step.end()[rotor::kBending] > carried_law_->curve().end());
  }
  /// Another blade has lost its force where its branch ends, and is to be carried from the last step on.
  [[nodiscard]] bool gives_up() const { return other_at_fold() >= 0 && accepted_ > 0; }
  [[nodiscard]] ModeEnd without_force() const {
    if (const int blade = other_at_fold(); blade >= 0) return {Guard::nears_fold, blade};
    return Base::without_force();
  }
  void accepted() { ++accepted_; }
  void goes_on() {}
  /// Moves the bending parameter back onto h = 0 by one Newton step, where h determines it well: near
  /// lift-off u carries the clock.
  void project(FullState& state) const {
    if (-last_.bending_slope > std::abs(last_.time_slope) * kWellDetermined)
      state[rotor::kBending] -= last_.residual / last_.bending_slope;
  }

  // What is asked of the mode.

  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    return contact == 0 ? constraint(state).force : Base::force(contact, state);
  }
  [[nodiscard]] double slip_velocity(std::size_t contact) const {
    return contact == 0 ? last_.force.slip_velocity : Base::slip_velocity(contact);
  }
  [[nodiscard]] double shortening() const {
    double largest = last_.force.shortening;
    for (std::size_t i = 1; i < this->forces_.size(); ++i)
      largest = std::max(largest, this->forces_[i].shortening);
    return largest;
  }
  template <class Step>
  [[nodiscard]] bool load_may_peak(const Step& step, std::size_t contact, bool gap_peaks) const {
    if (contact == 0) {
      constexpr int kBending = rotor::kBending;
      return integrate::cubic_may_peak(step.size() * step.start_derivative()[kBending],
                                       step.end()[kBending] - step.start()[kBending],
                                       step.size() * step.end_derivative()[kBending]);
    }
    return Base::load_may_peak(step, contact, gap_peaks);
  }
  [[nodiscard]] OpenContact contact_in(std::size_t contact, const FullState& state) const {
    OpenContact open = this->contacts_[contact];
    if (contact == 0) open.bending = state[rotor::kBending];
    return open;
  }

  // Guards.

  /// Where the carried contact ends by itself: at u = 0, or at a fold of h = 0 before.
  template <class Search>
  void end_of_branch(Search& search) {
    auto& step = search.step();
    // Nothing beyond lift-off is looked at: there time runs backwards.
    bool past_fold = passes_release(step);
    // A fold where another branch may follow; what does is for the motion to find.
    const bool snaps = past_fold && may_snap();
    double fraction = 1.0;
    if (past_fold) {
      fraction = release_fraction(step);
      // A column has a fold on the other side of u = 0 too.
      if (passes_lift_off(step)) past_fold = fraction < step.crossing_of(rotor::kBending, 0.0);
    }
    // Where the undeformed tip is still in the ring at the fold, it could not be free.
    const bool caught = past_fold && !snaps && stands_in_ring(step.at_fraction(fraction));
    const bool ends = past_fold ? !caught : passes_lift_off(step);
    lifts_off_ = ends && !(snaps && past_fold);
    root_lost_ = step.end_derivative()[rotor::kTime] <= 0.0;
    lost_ = !ends && (caught || root_lost_);
    if (ends && !past_fold) fraction = step.crossing_of(rotor::kBending, 0.0);
    if (fraction < 1.0 || ends)
      search.ends_latest(
          fraction, {ends ? (lifts_off_ ? Guard::lift_off : Guard::snap) : Guard::horizon, carried().blade});
    // Where the force ends from a finite value it does so before its fold, and that before u = 0.
    if (ends && !carried_law_->releases_at_fold()) lift_off_under_load(search);
    search.looks_no_further();
    if (ends)
      search.of_contact(0).end_slip_velocity = force(0, step.at_fraction(search.last())).slip_velocity;
  }

  template <class Search>
  void guards(Search& search) {
    auto& step = search.step();
    for (int k = 0; k < search.blades(); ++k) {
      const WatchedBlade& blade = search.blade(k);
      if (!blade.open) {
        touch_down(*this, search, k);
      } else if (k == carried().blade) {
        if (!lifts_off_ && !carried_law_->releases_at_fold()) lift_off(search);
      } else if (!lifts_off_ && this->ends_at_ring(k, step.at_fraction(search.last()))) {
        lift_off_at_ring(*this, search, k);
      }
    }
    const auto bounds = this->bounds(step);
    for (std::size_t i = 0; i < this->contacts_.size(); ++i)
      this->slip_guard(*this, search, i, this->slip_lasts(bounds));
    shaft_at_ring(*this, search, bounds.distance);
    if (this->contacts_.size() != 1 || !(bending_range(step).greatest < valid_bending_of_carried()))
      shortening_limit(*this, search);
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) {
      if (this->law_->of(this->contacts_[i].blade).has_branches()) buckling(*this, search, i);
    }
    if (root_lost_ && leaves_by_rounding(search.of_contact(0)))
      search.take_if_first(search.last(), {Guard::lift_off, carried().blade});
    if (lost_ && search.end().guard == Guard::horizon)
      search.ends_at_start({Guard::left_validity, -1, ending::StatusDetail::no_equilibrium});
  }

 private:
  static constexpr double kRestingRate = 1e-15;    ///< of R²: rounding of the rates of h
  static constexpr double kBendingWeight = 0.3;    ///< of the relative error of u against that of the state
  static constexpr double kWellDetermined = 1e-2;  ///< of |∂h/∂u| against |dh/dτ|

  [[nodiscard]] const OpenContact& carried() const { return this->contacts_.front(); }
  [[nodiscard]] bool may_snap() const { return carried_law_->has_branches(); }
  /// g >= 0 of the carried blade as its bending has it: what h has gone astray by, which may be more than g
  /// next to head-on, is no gap.
  [[nodiscard]] bool stands_in_ring(const FullState& state) const {
    return this->gap(carried().blade, state).value - constraint(state).residual >= 0.0;
  }
  [[nodiscard]] auto constraint(const FullState& state) const {
    return carried_law_->constraint(this->pose(carried().blade, state), carried().slip,
                                    state[rotor::kBending],
                                    this->blades().angular_speed(state[rotor::kTime]));
  }

  /// Adds the forces of the blades that touch besides to that on the rotor [N]. False where one has none.
  bool add_others(const FullState& state, std::complex<double>& sum) {
    if (this->contacts_.size() == 1) return true;
    const contact::BladeDirection first = this->first_blade(state);
    for (std::size_t i = 1; i < this->contacts_.size(); ++i) {
      OpenContact& open = this->contacts_[i];
      const auto& law = this->law_->of(open.blade);
      const contact::BladeDirection er = this->blades().direction(open.blade, first);
      const contact::Pose pose = rotor::pose_of(this->rotor(), law.geometry(), er, rotor::from_ring(state));
      without_force_ = i;
      if (!respond(law, pose, this->blades().angular_speed(state[rotor::kTime]), open, this->forces_[i]))
        return false;
      sum += contact::on_rotor(this->forces_[i], er);
    }
    without_force_ = 0;
    return true;
  }
  /// A blade beside the carried one that has lost its force where its branch ends; −1 where there is none.
  [[nodiscard]] int other_at_fold() const {
    return without_force_ == 0 ? -1 : this->blade_at_fold(without_force_);
  }

  /// Scale on which the motion varies where the blade is bent by u [in σ]: the distance of u to the curve's
  /// singularities ±iβ.
  [[nodiscard]] double scale(double bending) const {
    const double load_angle = carried_law_->curve().load_angle();
    // The column (μ = 0) has none but ψL = π.
    const double width = load_angle > 0.0 ? load_angle : 1.0;
    return std::sqrt(width * width + bending * bending);
  }

  /// A bending parameter up to which δ/L, which grows with it, is within its limit.
  [[nodiscard]] double valid_bending(const blade::ElasticaCurve& curve) const {
    const auto& knots = curve.knots();
    const auto beyond = std::find_if(knots.begin(), knots.end(), [&](const auto& knot) {
      return knot.shortening > this->limits_.max_shortening;
    });
    return beyond == knots.begin() ? 0.0 : std::prev(beyond)->bending;
  }
  [[nodiscard]] double valid_bending_of_carried() const {
    return valid_bending_[static_cast<std::size_t>(carried().blade)];
  }
  /// Range of u in the step.
  template <class Step>
  [[nodiscard]] static integrate::Range bending_range(const Step& step) {
    return integrate::cubic_range(
        step.start()[rotor::kBending], step.size() * step.start_derivative()[rotor::kBending],
        step.end()[rotor::kBending], step.size() * step.end_derivative()[rotor::kBending]);
  }

  /// The step has passed lift-off: u has gone through zero.
  template <class Step>
  [[nodiscard]] static bool passes_lift_off(const Step& step) {
    return step.end()[rotor::kBending] <= 0.0;
  }
  /// The root of the contact equation has been lost within the step: past it time runs backwards.
  template <class Step>
  [[nodiscard]] static bool root_lost(const Step& step) {
    return step.end_derivative()[rotor::kTime] <= 0.0;
  }
  /// The step has passed the fold of the contact equation and with it the end of the contact, or of the
  /// branch on which its blade stands. Only for a contact that ends there: σ goes on smoothly where time
  /// turns round.
  template <class Step>
  [[nodiscard]] bool passes_release(const Step& step) const {
    if (!carried_law_->releases_at_fold() && !may_snap()) return false;
    return carried_law_->fold_measure(step.end()[rotor::kBending], last_.bending_slope) > 0.0;
  }
  /// Fraction where the fold is, in a step that has passed it.
  template <class Step>
  [[nodiscard]] double release_fraction(Step& step) const {
    const auto measure = [&](double part) {
      const FullState state = step.at_fraction(part);
      return carried_law_->fold_measure(state[rotor::kBending], constraint(state).bending_slope);
    };
    const double at_end = measure(1.0);
    // At the unloaded blade where a contact may start, h falls with the load.
    const double at_start = step.start()[rotor::kBending] == 0.0 ? -at_end : measure(0.0);
    if (!(at_start < 0.0)) return 0.0;
    return integrate::root_between(measure, 0.0, 1.0, at_start, at_end);
  }

  /// A step from rising load to beyond lift-off. Its error may be small at its end, but lift-off would be
  /// read from the middle of dense output, whose order is one less.
  template <class Step>
  [[nodiscard]] bool holds_whole_contact(const Step& step) const {
    return passes_lift_off(step) && step.start_derivative()[rotor::kBending] > 0.0 &&
           step.size() > this->kSmallestSize;
  }
  /// A step past the fold of the contact equation, where time turns round: what ends the contact before it
  /// would be looked for on a path that leads there and back. Only a fold that short steps reach too has lost
  /// the root.
  template <class Step>
  [[nodiscard]] bool passes_fold(const Step& step) const {
    return !carried_law_->releases_at_fold() && !may_snap() && root_lost(step) && !passes_lift_off(step) &&
           step.size() > Base::kFoldResolution * scale(step.start()[rotor::kBending]);
  }
  /// A step that has passed the fold at which a branch ends, and the one where the next begins: its end does
  /// not tell.
  template <class Step>
  [[nodiscard]] bool passes_two_folds(const Step& step) const {
    return met_fold_ && !passes_release(step) && !passes_lift_off(step) && step.size() > this->kSmallestSize;
  }
  /// A step in which time may turn round twice, as the cubic through its ends has it.
  template <class Step>
  [[nodiscard]] bool time_turns(const Step& step) const {
    return !passes_lift_off(step) && Base::time_may_turn_twice(step) &&
           step.size() > Base::kFoldResolution * scale(step.start()[rotor::kBending]);
  }

  /// The tip is leaving, and so lightly in contact that rounding decides whether it has a force.
  [[nodiscard]] bool leaves_by_rounding(const WatchedBlade& blade) const {
    return blade.at_end.value <= this->gap_rounding() && blade.at_end.rate < 0.0;
  }
  /// g = 0 of the carried contact, at a finite force.
  template <class Search>
  void lift_off(Search& search) {
    const WatchedBlade& blade = search.of_contact(0);
    if (stays_in_ring(*this, search, blade)) return;
    const bool from_unloaded = search.step().start()[rotor::kBending] == 0.0;
    if (blade.at_end.value > 0.0 && from_unloaded) return lift_off_under_load(search);
    leaves_ring(*this, search, carried().blade, blade);
  }
  /// The same in a step where the contact is unloaded, u = 0, at one end. There g vanishes too, and h = 0
  /// gives g/Δ without rounding.
  template <class Search>
  void lift_off_under_load(Search& search) {
    auto& step = search.step();
    if (ends_unloaded_only(step)) return;
    const ModeEnd end{Guard::lift_off, carried().blade};
    const auto guard = [&](double part) {
      const FullState state = step.at_fraction(part);
      return -carried_law_->gap_per_deflection(this->pose(carried().blade, state), carried().slip,
                                               state[rotor::kBending]);
    };
    const double last = search.last();
    const double start = guard(0.0);
    if (step.start()[rotor::kBending] > 0.0 && has_just_opened(*this, search.of_contact(0))) {
      // A contact that has just opened under load starts at g = 0 to rounding, and is pressed in.
      const double at_end = (guard(last) - start) / last;
      return search.look_between([&](double part) { return (guard(part) - start) / part; },
                                 {-std::abs(at_end), at_end}, end);
    }
    // A tip that touches head-on, ct = 0 to rounding, is pressed in.
    const bool touches = step.start()[rotor::kBending] == 0.0;
    search.look_between(guard, {touches ? -std::abs(start) : start, guard(last)}, end);
  }
  /// The tip stays on the side where its force ends with u, g/Δ = 2 s ct − Δ + (terms that are not negative)
  /// > 0, so that its gap closes nowhere else.
  template <class Step>
  [[nodiscard]] bool ends_unloaded_only(const Step& step) const {
    const auto approach = [&](const FullState& state, const FullState& derivative) {
      const contact::Pose at = this->pose(carried().blade, state);
      const double rate =
          at.tangential_velocity - this->blades().angular_speed(state[rotor::kTime]) * at.radial;
      return BladeGap{carried().slip * at.tangential,
                      carried().slip * rate * step.size() * derivative[rotor::kTime]};
    };
    const BladeGap start = approach(step.start(), step.start_derivative());
    const BladeGap end = approach(step.end(), step.end_derivative());
    const double least = integrate::cubic_range(start.value, start.rate, end.value, end.rate).least;
    return 2.0 * least >
           carried_law_->length() * carried_law_->curve().at(bending_range(step).greatest).deflection;
  }

  const typename Law::OfBlade* carried_law_ = nullptr;  ///< of the carried blade
  double slip_ = 1.0;                                   ///< s of the carried contact
  double scale_ = 1.0;                                  ///< unit of σ against the rates of h [1/m²]
  rotor::RipplingBlades::Anchor anchor_{};              ///< where the blade stood when the step began
  std::vector<double> valid_bending_;  ///< u up to which δ/L is within its limit, one per blade
  typename Law::OfBlade::Constraint last_{};
  std::uint64_t accepted_ = 0;     ///< steps since the mode began
  std::size_t without_force_ = 0;  ///< the contact that found none in the last evaluation; 0: all did
  bool met_fold_ = false;          ///< an evaluation of the attempt has been past a fold
  bool lifts_off_ = false;         ///< the step ends by lift-off at u = 0, or at the fold
  bool root_lost_ = false;
  bool lost_ = false;  ///< the step leads to where no force is
};

}  // namespace rubatlas::modes
