/// One contact phase: the motion while a fixed set of blades touches with fixed slip directions.
///
/// Advances in accepted Runge–Kutta steps; in each it looks for what ends the phase (lift-off, touch-down of
/// another blade, slip reversal, loss of validity) on the step's dense output, so that no step is repeated to
/// find an event. The phase survives the end of a revolution: the section is read from dense output and the
/// clock set back.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "contact/pose.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "integrate/root_between.hpp"
#include "integrate/runge_kutta.hpp"
#include "integrate/step_control.hpp"
#include "observables/motion_piece.hpp"
#include "solve/contact_system.hpp"
#include "solve/motion_listener.hpp"
#include "solve/rotor.hpp"

namespace rubatlas::solve {

/// How a phase ended; `blade` where it is an event of one.
struct PhaseEnd {
  PhaseEvent event;
  int blade = -1;
};

/// What bounds a phase and how accurate it is.
struct ContactLimits {
  double tolerance;       ///< local error of a step [m]: accuracy.tolerance × δc
  double max_shortening;  ///< of δ/L [-]
};

template <class System, class Law>
class ContactPhase final : public observables::MotionPiece {
  static constexpr bool kCarried = requires(System system) { system.last(); };

 public:
  ContactPhase(const RotorConstants& rotor, const BladeSet& blades, const Law& law,
               const ContactLimits& limits, System system)
      : rotor_(&rotor), blades_(&blades), law_(&law), limits_(limits), system_(std::move(system)) {
    watched_.resize(static_cast<std::size_t>(blades.count()));
  }

  /// Starts at time τ of the revolution. False where the system cannot start there.
  bool start(double time, const State& state, const std::vector<OpenContact>& contacts) {
    contacts_ = contacts;
    ContactState full;
    full << state, time, kCarried ? contacts_.front().bending : 0.0;
    if constexpr (kCarried) {
      if (!system_.open(contacts_.front(), full)) return false;
    } else {
      system_.open(contacts_);
    }
    step_size_ = first_step_size_;
    first_step_ = true;
    pending_ = false;
    steps_in_phase_ = 0;
    if (!step_.begin(system_, full)) return false;
    for (int k = 0; k < blades_->count(); ++k) {
      Watched& blade = watched_[static_cast<std::size_t>(k)];
      blade.open = false;
      look_at(k, full, blade.gap, blade.rate);
    }
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      Watched& blade = watched_[static_cast<std::size_t>(contacts_[i].blade)];
      blade.open = true;
      blade.slip_velocity = slip_velocity(i);
    }
    return true;
  }

  /// Goes on until something ends the phase or time reaches `until`; hands every piece of motion to the
  /// listener.
  PhaseEnd advance(double until, MotionListener& listener) {
    while (true) {
      if (pending_) {
        const bool beyond = segment_end_ > until;
        segment_limit_ = beyond ? until : segment_end_;
        if (segment_limit_ > segment_begin_) listener.piece(*this);
        segment_begin_ = segment_limit_;
        if (beyond) return {PhaseEvent::horizon};
        pending_ = false;
        if (end_.event != PhaseEvent::horizon) return end_;
        step_.accept();
        for (Watched& blade : watched_) blade.take_end();
      }
      const PhaseEnd failure = make_step();
      if (failure.event != PhaseEvent::horizon) return failure;
    }
  }

  /// Sets the clock back by a revolution.
  void shift_time(double period) {
    step_.shift(kTime, -period);
    segment_begin_ -= period;
    segment_end_ -= period;
  }

  /// State at a time of the piece that is being recorded.
  [[nodiscard]] State state_at(double time) { return full_state(time).template head<4>(); }

  // The piece of motion that is being recorded.
  [[nodiscard]] double begin() const override { return segment_begin_; }
  [[nodiscard]] double end() const override { return segment_limit_; }
  [[nodiscard]] observables::State state(double time) override { return as_array(state_at(time)); }
  [[nodiscard]] double displacement_bound() const override { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] std::size_t contact_count() const override { return contacts_.size(); }
  [[nodiscard]] int blade(std::size_t contact) const override { return contacts_[contact].blade; }
  /// The load follows the gap: it has a maximum within the piece where the gap has.
  [[nodiscard]] bool load_peaks(std::size_t contact) const override {
    const Watched& blade = watched_[static_cast<std::size_t>(contacts_[contact].blade)];
    return blade.rate > 0.0 && blade.end_rate < 0.0;
  }
  [[nodiscard]] double normal_force(std::size_t contact, double time) override {
    return force_at(contact, full_state(time)).normal;
  }
  [[nodiscard]] double root_strain(std::size_t contact, double time) override {
    return force_at(contact, full_state(time)).root_strain;
  }

  /// Full state where the phase ended.
  [[nodiscard]] ContactState end_state() { return at_fraction(end_fraction_); }
  [[nodiscard]] const std::vector<OpenContact>& contacts() const { return contacts_; }
  /// Bending parameter of an open contact at the end of the phase, as a first guess for the next one.
  [[nodiscard]] double bending(std::size_t contact) {
    if constexpr (kCarried) {
      return end_state()[kBending];
    } else {
      return system_.contacts()[contact].bending;
    }
  }

  [[nodiscard]] std::uint64_t evaluations() const { return system_.evaluations(); }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] std::uint64_t rejected() const { return rejected_; }
  /// Steps guesses start afresh, so that a point does not depend on the one computed before it.
  void forget() { first_step_size_ = kFirstStep; }

 private:
  static constexpr double kFirstStep = 0.02;      ///< in σ; only the first contact of a point starts with it
  static constexpr double kSmallestStep = 1e-15;  ///< in σ
  static constexpr int kMostStepsInPhase = 100000;  ///< bounds the work; no healthy contact takes a thousand

  /// What is followed of a blade from step to step.
  struct Watched {
    bool open = false;
    double gap = 0.0;            ///< g at the start of the step [m²]
    double rate = 0.0;           ///< dg/dτ there
    double slip_velocity = 0.0;  ///< v there, open contacts only
    double end_gap = 0.0;
    double end_rate = 0.0;
    double end_slip_velocity = 0.0;

    void take_end() {
      gap = end_gap;
      rate = end_rate;
      slip_velocity = end_slip_velocity;
    }
  };

  void look_at(int blade, const ContactState& state, double& gap, double& rate) const {
    const contact::BladeDirection er = blades_->direction(blade, blades_->first(state[kTime]));
    const contact::Pose pose = pose_of(*rotor_, law_->geometry(), er, state.head<4>());
    gap = pose.gap;
    rate = contact::gap_rate(law_->geometry(), pose, rotor_->speed_ratio);
  }
  [[nodiscard]] double gap_at(int blade, double fraction) {
    double gap = 0.0;
    double rate = 0.0;
    look_at(blade, at_fraction(fraction), gap, rate);
    return gap;
  }
  [[nodiscard]] double rate_at(int blade, double fraction) {
    double gap = 0.0;
    double rate = 0.0;
    look_at(blade, at_fraction(fraction), gap, rate);
    return rate;
  }

  /// Slip velocity of an open contact at the last evaluation of the right-hand side.
  [[nodiscard]] double slip_velocity(std::size_t contact) const {
    if constexpr (kCarried) {
      return system_.last().force.slip_velocity;
    } else {
      return system_.forces()[contact].slip_velocity;
    }
  }

  [[nodiscard]] contact::TipForce force_at(std::size_t contact, const ContactState& state) const {
    const OpenContact& open = contacts_[contact];
    const contact::BladeDirection er = blades_->direction(open.blade, blades_->first(state[kTime]));
    const contact::Pose pose = pose_of(*rotor_, law_->geometry(), er, state.head<4>());
    if constexpr (kCarried) {
      return law_->constraint(pose, open.slip, state[kBending], rotor_->speed_ratio).force;
    } else {
      contact::TipForce force{};
      double bending = system_.contacts()[contact].bending;
      law_->respond(pose, open.slip, rotor_->speed_ratio, bending, force);
      return force;
    }
  }

  [[nodiscard]] ContactState at_fraction(double fraction) {
    if (fraction == 0.0) return step_.start();
    if (fraction == 1.0) return step_.end();
    if (!step_.make_dense(system_)) return ContactState::Constant(std::numeric_limits<double>::quiet_NaN());
    return step_.interpolate(fraction);
  }

  [[nodiscard]] ContactState full_state(double time) {
    const double from = step_.start()[kTime];
    double fraction = 0.0;
    if (time == step_.end()[kTime] && end_fraction_ == 1.0) {
      fraction = 1.0;
    } else if constexpr (kCarried) {
      if (time >= segment_end_) {
        fraction = end_fraction_;
      } else if (time > from && step_.make_dense(system_)) {
        fraction = fraction_at(time);
      }
    } else {
      fraction = std::clamp((time - from) / step_.size(), 0.0, end_fraction_);
    }
    return at_fraction(fraction);
  }

  /// Fraction of the step at a time strictly within its segment: Newton, since time runs forward and
  /// smoothly, with the bracketing solver where lift-off (dτ/dσ = 0) is too near.
  [[nodiscard]] double fraction_at(double time) const {
    const double from = step_.start()[kTime];
    double fraction = end_fraction_ * (time - from) / (segment_end_ - from);
    for (int i = 0; i < 8; ++i) {
      const auto at = step_.interpolate_with_slope(fraction, kTime);
      const double move = (time - at.value) / at.slope;
      fraction += move;
      if (!(fraction > 0.0 && fraction < end_fraction_)) break;
      if (std::abs(move) <= kFractionResolution) return fraction;
    }
    return integrate::root_between([&](double part) { return step_.interpolate(part, kTime) - time; }, 0.0,
                                   end_fraction_, from - time, segment_end_ - time);
  }
  static constexpr double kFractionResolution = 1e-14;

  /// Local error of the step in units of the tolerance, in every component of the state at fixed time.
  [[nodiscard]] double scaled_error() const {
    const auto estimate = step_.error_estimate();
    const ContactState& end = step_.end();
    const std::complex<double> acceleration = system_.last_acceleration();
    const State rate(end[2], end[3], acceleration.real(), acceleration.imag());
    // An error of the time is an error of the state along its path.
    const State third = estimate.third.template head<4>() - rate * estimate.third[kTime];
    const State fifth = estimate.fifth.template head<4>() - rate * estimate.fifth[kTime];
    return integrate::combined_error(fifth.abs().maxCoeff(), third.abs().maxCoeff()) / limits_.tolerance;
  }

  /// One accepted step with its segment and event; anything but `horizon` ends the phase.
  PhaseEnd make_step() {
    if (++steps_in_phase_ > kMostStepsInPhase) return {PhaseEvent::failed};
    if constexpr (kCarried) aim_at_lift_off();
    while (true) {
      const bool evaluated = step_.attempt(system_, step_size_);
      const double error = evaluated ? scaled_error() : std::numeric_limits<double>::infinity();
      if (error <= 1.0 && holds_whole_contact()) {
        ++rejected_;
        step_size_ *= 0.5;
        continue;
      }
      if (error <= 1.0) {
        ++steps_;
        if (first_step_) first_step_size_ = step_size_;
        first_step_ = false;
        step_size_ *= integrate::step_factor(error, integrate::DormandPrince853::kOrder);
        break;
      }
      ++rejected_;
      step_size_ *= std::isfinite(error)
                        ? std::min(integrate::step_factor(error, integrate::DormandPrince853::kOrder), 0.9)
                        : 0.25;
      if (!(step_size_ > kSmallestStep)) {
        // Where no stage can find a force however short the step, the contact equation has lost its root.
        return {evaluated ? PhaseEvent::failed : PhaseEvent::left_validity};
      }
    }
    if constexpr (kCarried) project();
    find_event();
    segment_begin_ = step_.start()[kTime];
    pending_ = true;
    return {PhaseEvent::horizon};
  }

  /// A step from rising load to beyond lift-off. Its error may be small at its end, but lift-off would be
  /// read from the middle of dense output, whose order is one less.
  [[nodiscard]] bool holds_whole_contact() const {
    if constexpr (kCarried) {
      return step_.end()[kBending] <= 0.0 && step_.start_derivative()[kBending] > 0.0 &&
             step_size_ > kSmallestStep;
    }
    return false;
  }

  /// Lets the step that would pass lift-off end just behind it, and the two before share what is left evenly.
  /// A step far past u = 0 is wasted, and dense output is at its best near the ends of a step.
  void aim_at_lift_off() {
    const double bending = step_.start()[kBending];
    const double rate = step_.start_derivative()[kBending];
    if (!(rate < 0.0) || !(bending > 0.0)) return;
    const double remaining = kAimBehind * bending / -rate;
    if (remaining <= step_size_) {
      step_size_ = remaining;
    } else if (remaining < 2.0 * step_size_) {
      step_size_ = 0.5 * remaining;
    }
  }
  static constexpr double kAimBehind = 1.05;

  /// Moves the bending parameter back onto h = 0 by one Newton step, where h determines it well.
  void project() {
    const auto& last = system_.last();
    if (-last.bending_slope > std::abs(last.time_slope) * kWellDetermined) {
      step_.end()[kBending] -= last.residual / last.bending_slope;
    }
  }
  static constexpr double kWellDetermined =
      1e-2;  ///< of |∂h/∂u| against |dh/dτ|; near lift-off u carries the clock

  void find_event() {
    end_ = {PhaseEvent::horizon};
    end_fraction_ = 1.0;
    ContactState end = step_.end();
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      watched_[static_cast<std::size_t>(contacts_[i].blade)].end_slip_velocity = slip_velocity(i);
    }
    double shortening = 0.0;
    bool root_lost = false;
    if constexpr (kCarried) {
      shortening = system_.last().force.shortening;
      // Past u = 0 the even curve leads back along the same motion, time running backwards: end the step
      // there.
      if (end[kBending] <= 0.0 && step_.make_dense(system_)) {
        const bool unloaded = step_.start()[kBending] <= 0.0;
        const auto bending = [&](double part) {
          return unloaded ? step_.mean_slope(part, kBending) : step_.interpolate(part, kBending);
        };
        end_fraction_ = integrate::root_between(bending, 0.0, 1.0, bending(0.0), bending(1.0));
        end_ = {PhaseEvent::lift_off, contacts_.front().blade};
        end = at_fraction(end_fraction_);
        auto& blade = watched_[static_cast<std::size_t>(contacts_.front().blade)];
        blade.end_slip_velocity = force_at(0, end).slip_velocity;
        shortening = 0.0;
      } else {
        root_lost = system_.last().bending_slope >= 0.0;
      }
    } else {
      for (const contact::TipForce& force : system_.forces())
        shortening = std::max(shortening, force.shortening);
    }
    const double last_fraction = end_fraction_;
    for (int k = 0; k < blades_->count(); ++k) {
      Watched& blade = watched_[static_cast<std::size_t>(k)];
      look_at(k, end, blade.end_gap, blade.end_rate);
      if (blade.open) {
        if (!(kCarried && end_.event == PhaseEvent::lift_off && last_fraction == end_fraction_)) {
          look_for_lift_off(k, blade, last_fraction);
        }
      } else {
        look_for_touch_down(k, blade, last_fraction);
      }
    }
    for (std::size_t i = 0; i < contacts_.size(); ++i) look_for_slip_reversal(i, last_fraction);

    segment_end_ = end_fraction_ == 1.0 ? step_.end()[kTime] : at_fraction(end_fraction_)[kTime];
    if (!std::isfinite(segment_end_)) {
      end_ = {PhaseEvent::failed};
      segment_end_ = step_.start()[kTime];
    } else if (end_.event == PhaseEvent::horizon && (root_lost || shortening > limits_.max_shortening)) {
      end_ = {PhaseEvent::left_validity};
      segment_end_ = step_.start()[kTime];
    }
    const double radius = std::hypot(end[0], end[1] + rotor_->misalignment);
    if (radius >= law_->geometry().ring_radius) end_ = {PhaseEvent::left_validity};
  }

  void take_if_first(double fraction, PhaseEvent event, int blade) {
    if (fraction < end_fraction_ || (fraction == end_fraction_ && end_.event == PhaseEvent::horizon)) {
      end_fraction_ = fraction;
      end_ = {event, blade};
    }
  }

  void look_for_lift_off(int k, const Watched& blade, double last) {
    double high = last;
    double at_high = blade.end_gap;
    if (at_high > 0.0) {
      // The gap may close and open again within the step: then it has a minimum there.
      if (!(blade.rate < 0.0 && blade.end_rate > 0.0)) return;
      high = integrate::root_between([&](double part) { return rate_at(k, part); }, 0.0, last, blade.rate,
                                     blade.end_rate);
      at_high = gap_at(k, high);
      if (at_high > 0.0) return;
    }
    // A contact that has just opened starts at g = 0 to rounding; divided by the fraction it starts positive.
    const double origin = std::min(blade.gap, 0.0);
    const bool fresh = blade.gap <= kGapRounding;
    const auto function = [&](double part) {
      const double gap = gap_at(k, part) - origin;
      return fresh ? gap / part : gap;
    };
    at_high = fresh ? (at_high - origin) / high : at_high;
    const double at_low = fresh ? std::abs(at_high) : blade.gap;
    take_if_first(integrate::root_between(function, 0.0, high, at_low, at_high), PhaseEvent::lift_off, k);
  }

  void look_for_touch_down(int k, const Watched& blade, double last) {
    const auto gap = [&](double part) { return gap_at(k, part); };
    const auto rate = [&](double part) { return rate_at(k, part); };
    if (blade.gap >= 0.0) {
      // Just lifted off, or about to touch: rounding decides the sign of g, its slope what happens.
      if (blade.rate > 0.0) return take_if_first(0.0, PhaseEvent::touch_down, k);
      if (!(blade.end_gap > 0.0 && blade.end_rate > 0.0)) return;
      const double lowest = integrate::root_between(rate, 0.0, last, blade.rate, blade.end_rate);
      const double at_lowest = gap(lowest);
      if (at_lowest < 0.0) {
        take_if_first(integrate::root_between(gap, lowest, last, at_lowest, blade.end_gap),
                      PhaseEvent::touch_down, k);
      }
      return;
    }
    double high = last;
    double at_high = blade.end_gap;
    if (at_high <= 0.0) {
      if (!(blade.rate > 0.0 && blade.end_rate < 0.0)) return;
      high = integrate::root_between(rate, 0.0, last, blade.rate, blade.end_rate);
      at_high = gap(high);
      if (at_high <= 0.0) return;
    }
    take_if_first(integrate::root_between(gap, 0.0, high, blade.gap, at_high), PhaseEvent::touch_down, k);
  }

  void look_for_slip_reversal(std::size_t contact, double last) {
    const int k = contacts_[contact].blade;
    const Watched& blade = watched_[static_cast<std::size_t>(k)];
    const double before = blade.slip_velocity;
    const double after = blade.end_slip_velocity;
    if (before == 0.0 || (before > 0.0) == (after > 0.0)) return;
    const auto velocity = [&](double part) { return force_at(contact, at_fraction(part)).slip_velocity; };
    take_if_first(integrate::root_between(velocity, 0.0, last, before, after), PhaseEvent::slip_reversal, k);
  }

  static constexpr double kGapRounding = 1e-17;  ///< [m²]: g of a contact that has just opened

  const RotorConstants* rotor_;
  const BladeSet* blades_;
  const Law* law_;
  ContactLimits limits_;
  System system_;
  std::vector<OpenContact> contacts_;
  std::vector<Watched> watched_;
  integrate::RungeKutta<integrate::DormandPrince853, 6> step_;
  double step_size_ = kFirstStep;
  double first_step_size_ = kFirstStep;
  bool first_step_ = true;
  bool pending_ = false;        ///< a step has been made and not been recorded to its end
  PhaseEnd end_{};              ///< what happens at the end of that step's segment
  double end_fraction_ = 1.0;   ///< of the step, where the segment ends
  double segment_begin_ = 0.0;  ///< recorded up to here
  double segment_end_ = 0.0;
  double segment_limit_ = 0.0;
  int steps_in_phase_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t rejected_ = 0;
};

}  // namespace rubatlas::solve
