/// A phase in steps of a Runge–Kutta pair.
///
/// Advances in steps that keep the tolerance. In each step the first guard is looked for on dense output, so
/// that no step is repeated to find one. A phase goes on across the end of a revolution: the section is read
/// from dense output, and the time is set back.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "compared/contact_mode.hpp"
#include "compared/guard_search.hpp"
#include "integrate/controlled_step.hpp"
#include "integrate/cubic_range.hpp"
#include "modes/motion_listener.hpp"
#include "modes/phase.hpp"
#include "rotor/bodies.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::compared {

template <class Mode>
class ContactPhase final : public Phase {
 public:
  using FullState = typename Mode::FullState;

  ContactPhase(const ContactSetup& setup, const integrate::Tableau& pair)
      : mode_(setup),
        step_(mode_, pair),
        search_(mode_, step_, setup.machine->blades.count()),
        meter_(setup.meter) {}
  ContactPhase(const ContactPhase&) = delete;  // members hold pointers to each other
  ContactPhase& operator=(const ContactPhase&) = delete;

  ending::StatusDetail start(double time, const rotor::ShaftAndRing& state,
                             const std::vector<OpenContact>& contacts) override {
    using ending::StatusDetail;
    pending_ = false;
    FullState full;
    if (!mode_.open(time, state, contacts, full) || !step_.begin(full)) return StatusDetail::no_equilibrium;
    mode_.begun();
    if (mode_.beyond_ring(step_.start()) > 0.0) return StatusDetail::shaft_at_ring;
    if (mode_.shortening() > mode_.limits().max_shortening) return StatusDetail::shortening_limit;
    search_.begin(mode_.slip_rounding(full));
    return StatusDetail::none;
  }

  ModeEnd advance(double until, MotionListener& listener) override {
    using Outcome = typename integrate::ControlledStep<Mode>::Outcome;
    while (true) {
      if (pending_) {
        const bool beyond = segment_end_ > until;
        segment_limit_ = beyond ? until : segment_end_;
        if (segment_limit_ > segment_begin_) listener.piece(*this);
        if (meter_->ended()) return {Guard::failed, -1, meter_->why()};
        segment_begin_ = segment_limit_;
        if (beyond) return {Guard::horizon};
        pending_ = false;
        if (end_.guard != Guard::horizon) return end_;
        step_.accept();
        search_.go_on();
      }
      switch (step_.make()) {
        case Outcome::stopped:
          return {Guard::failed, -1, meter_->why()};
        case Outcome::too_short:
          return {Guard::failed, -1, ending::StatusDetail::step_too_short};
        case Outcome::no_derivative:
          end_fraction_ = 0.0;
          return mode_.without_force();
        default:
          find_end();
          if (meter_->ended()) return {Guard::failed, -1, meter_->why()};
      }
    }
  }

  void shift_time(double period) override {
    step_.shift(rotor::kTime, -period);
    segment_begin_ -= period;
    segment_end_ -= period;
  }

  void hand_over(double& time, rotor::ShaftAndRing& bodies, std::vector<OpenContact>& contacts) override {
    const FullState full = pending_ ? full_state_at(segment_limit_) : end_state();
    time = pending_ ? segment_limit_ : full[rotor::kTime];
    bodies = rotor::bodies(full);
    contacts = mode_.contacts();
    for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i] = mode_.contact_in(i, full);
  }

  // The piece of motion that is being recorded.
  [[nodiscard]] double begin() const override { return segment_begin_; }
  [[nodiscard]] double end() const override { return segment_limit_; }
  [[nodiscard]] trajectory::State state(double time) override {
    return rotor::as_array(rotor::shaft(rotor::bodies(full_state_at(time))));
  }
  [[nodiscard]] double displacement_bound() const override { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] std::size_t contact_count() const override { return mode_.contacts().size(); }
  [[nodiscard]] int blade(std::size_t contact) const override { return mode_.contacts()[contact].blade; }
  [[nodiscard]] bool load_peaks(std::size_t contact) const override {
    const WatchedBlade& watched = search_.of_contact(contact);
    const double size = step_.size();
    // A load that has been solved for is to be looked at; where the ring yields it follows the gap.
    return !mode_.load_follows_gap() ||
           integrate::cubic_may_peak(watched.at_start.rate * size,
                                     watched.at_end.value - watched.at_start.value,
                                     watched.at_end.rate * size);
  }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, double time) override {
    return contact_force(contact, full_state_at(time));
  }
  [[nodiscard]] trajectory::Tip tip(int blade, double time) override {
    return mode_.tip(blade, full_state_at(time));
  }
  void path(double share, trajectory::PathPoint& point,
            std::vector<trajectory::ContactForce>* forces) override {
    const double from = fraction_at(segment_begin_);
    const double length = fraction_at(segment_limit_) - from;
    const double fraction = from + share * share * (3.0 - 2.0 * share) * length;
    const FullState full = step_.at_fraction(fraction);
    point.time = full[rotor::kTime];
    point.time_rate = 6.0 * share * (1.0 - share) * length * step_.size();
    point.state = rotor::as_array(full.template head<4>());
    point.ring = rotor::as_array(rotor::ring(full));
    point.contacts.clear();
    if (forces != nullptr) forces->clear();
    for (std::size_t i = 0; i < mode_.contacts().size(); ++i) {
      if (forces != nullptr) forces->push_back(contact_force(i, full));
      if (!Mode::kBendsFollowPath) continue;
      const OpenContact open = mode_.contact_in(i, full);
      point.contacts.push_back({open.blade, open.slip, open.bending, 0.0, false, open.bend.modulus,
                                open.bend.amplitude, 0.0, 0.0});
    }
  }

  [[nodiscard]] std::uint64_t evaluations() const override { return mode_.evaluations(); }
  [[nodiscard]] std::uint64_t steps() const override { return step_.accepted(); }
  [[nodiscard]] std::uint64_t rejected() const override { return step_.rejected(); }

 private:
  /// Full state where the phase ended.
  [[nodiscard]] FullState end_state() { return step_.at_fraction(end_fraction_); }
  /// Fraction of the step where it has reached a time.
  [[nodiscard]] double fraction_at(double time) {
    if (time >= segment_end_) return end_fraction_;
    const double from = step_.start()[rotor::kTime];
    if (time <= from) return 0.0;
    return end_fraction_ * (time - from) / (segment_end_ - from);
  }
  [[nodiscard]] FullState full_state_at(double time) { return step_.at_fraction(fraction_at(time)); }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, const FullState& full) const {
    const contact::TipForce force = mode_.force(contact, full);
    return mode_.on_rotor(contact, force, mode_.friction_of(contact, force, full), full);
  }
  /// A force that starts or ends like a root of the time: lift-off would be read from the middle of dense
  /// output, whose error the estimate at the end of the step does not tell.
  [[nodiscard]] bool holds_whole_contact() const {
    if (mode_.load_follows_gap() || end_.guard != Guard::lift_off) return false;
    const BladeGap& start = search_.blade(end_.blade).at_start;
    return start.value <= mode_.gap_rounding() && start.rate > 0.0;
  }

  /// Finds what ends the phase in the step just made, if anything does, and where; or takes the step back.
  void find_end() {
    search_.find();
    end_ = search_.end();
    if (holds_whole_contact() && step_.take_back()) return;
    end_fraction_ = search_.fraction();
    segment_begin_ = step_.start()[rotor::kTime];
    segment_end_ = end_state()[rotor::kTime];
    if (!std::isfinite(segment_end_) && step_.take_back()) return;
    pending_ = true;
    if (!std::isfinite(segment_end_)) {
      // There is no force so close to the start of the step that a tip at rest comes loose there.
      end_ = mode_.without_force();
      if (end_.guard != Guard::comes_loose)
        end_ = {Guard::failed, -1, ending::StatusDetail::beyond_precision};
      end_fraction_ = 0.0;
      segment_end_ = segment_begin_;
    }
  }

  Mode mode_;
  integrate::ControlledStep<Mode> step_;
  GuardSearch<Mode> search_;
  WorkMeter* meter_;
  bool pending_ = false;         ///< a step has been made and not been recorded to its end
  ModeEnd end_{Guard::horizon};  ///< what happens at the end of that step's segment
  double end_fraction_ = 1.0;    ///< of the step, where the segment ends
  double segment_begin_ = 0.0;   ///< recorded up to here
  double segment_end_ = 0.0;
  double segment_limit_ = 0.0;
};

}  // namespace rubatlas::compared
