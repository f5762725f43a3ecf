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
#include <utility>
#include <vector>

#include "contact/friction_law.hpp"
#include "integrate/root_between.hpp"
#include "observables/motion_piece.hpp"
#include "solve/blade_set.hpp"
#include "solve/contact_step.hpp"
#include "solve/contact_system.hpp"
#include "solve/friction_power.hpp"
#include "solve/motion_listener.hpp"
#include "solve/rotor.hpp"

namespace rubatlas::solve {

/// How a phase ended; `blade` where it is an event of one.
struct PhaseEnd {
  PhaseEvent event;
  int blade = -1;
  StatusDetail why = StatusDetail::none;  ///< where the motion ends
};

/// What bounds a phase and how accurate it is.
struct ContactLimits {
  double tolerance;       ///< local error of a step [m]: accuracy.tolerance × δc
  double max_shortening;  ///< of δ/L [-]
};

template <class System, class Law, class Pair, class Blades = BladeSet>
class ContactPhase final : public observables::MotionPiece {
 public:
  using FullState = typename System::FullState;
  using Bodies = typename ContactStep<System, Law, Pair, Blades>::Bodies;

  ContactPhase(const RotorConstants& rotor, const Blades& blades, const Law& law, const ContactLimits& limits,
               System system)
      : limits_(limits),
        misalignment_(rotor.misalignment),
        ring_radius_(law.of(0).geometry().ring_radius),
        tip_speed_(std::abs(rotor.speed_ratio) * ring_radius_),
        law_(&law),
        step_(rotor, blades, law, limits.tolerance, std::move(system)),
        watched_(static_cast<std::size_t>(blades.count())) {}

  /// Starts at time τ of the revolution. False where the system cannot start there.
  bool start(double time, const Bodies& state, const std::vector<OpenContact>& contacts) {
    pending_ = false;
    if (!step_.start(time, state, contacts)) return false;
    const contact::BladeDirection first = step_.first_blade(step_.begin());
    for (std::size_t k = 0; k < watched_.size(); ++k) {
      watched_[k].open = false;
      watched_[k].at_begin = step_.gap(static_cast<int>(k), step_.begin(), first);
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      Watched& blade = watched_[static_cast<std::size_t>(contacts[i].blade)];
      blade.open = true;
      // A tip whose slip has just reversed starts at v = 0 to rounding: its sign is that at the end of the
      // first step.
      const double velocity = step_.slip_velocity(i);
      blade.slip_velocity = std::abs(velocity) > kSlipRounding * tip_speed_ ? velocity : 0.0;
    }
    return true;
  }

  /// Goes on until something ends the phase, time reaches `until` or the meter ends the revolution; hands
  /// every piece of motion to the listener.
  PhaseEnd advance(double until, WorkMeter& meter, MotionListener& listener) {
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
      switch (step_.make(meter)) {
        case ContactStep<System, Law, Pair, Blades>::Outcome::stopped:
          return {PhaseEvent::failed, -1, meter.why()};
        case ContactStep<System, Law, Pair, Blades>::Outcome::too_short:
          return {PhaseEvent::failed, -1, StatusDetail::step_too_short};
        case ContactStep<System, Law, Pair, Blades>::Outcome::no_force:
          end_fraction_ = 0.0;
          if (const int released = step_.released_blade(); released >= 0)
            return {PhaseEvent::lift_off, released};
          if (const int unheld = step_.unheld_blade(); unheld >= 0) return {PhaseEvent::comes_loose, unheld};
          return {PhaseEvent::left_validity, -1, StatusDetail::no_equilibrium};
        default:
          find_end();
      }
    }
  }

  /// Sets the clock back by a revolution.
  void shift_time(double period) {
    step_.shift_time(period);
    segment_begin_ -= period;
    segment_end_ -= period;
  }

  /// State at a time of the piece that is being recorded.
  [[nodiscard]] Bodies state_at(double time) { return bodies(full_state_at(time)); }
  /// Full state where the phase ended.
  [[nodiscard]] FullState end_state() { return step_.at_fraction(end_fraction_); }
  /// An open contact where the phase ended, from where the next one goes on.
  [[nodiscard]] OpenContact contact_at_end(std::size_t contact) {
    return step_.contact_in(contact, step_.at_fraction(end_fraction_));
  }
  /// The same at a time of the piece that is being recorded, for another motion.
  [[nodiscard]] OpenContact contact_at(std::size_t contact, double time) {
    return step_.contact_in(contact, full_state_at(time));
  }

  // The piece of motion that is being recorded.
  [[nodiscard]] double begin() const override { return segment_begin_; }
  [[nodiscard]] double end() const override { return segment_limit_; }
  [[nodiscard]] observables::State state(double time) override { return as_array(shaft(state_at(time))); }
  [[nodiscard]] double displacement_bound() const override { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] std::size_t contact_count() const override { return step_.contacts().size(); }
  [[nodiscard]] int blade(std::size_t contact) const override { return step_.contacts()[contact].blade; }
  [[nodiscard]] bool load_peaks(std::size_t contact) const override {
    const Watched& watched = watched_[static_cast<std::size_t>(blade(contact))];
    return step_.load_may_peak(watched.at_begin.rate > 0.0 && watched.at_end.rate < 0.0);
  }
  [[nodiscard]] double normal_force(std::size_t contact, double time) override {
    return step_.force(contact, full_state_at(time)).normal;
  }
  [[nodiscard]] double root_strain(std::size_t contact, double time) override {
    return step_.force(contact, full_state_at(time)).root_strain;
  }
  [[nodiscard]] double friction_power(std::size_t contact, double time) override {
    return solve::friction_power(law_->of(blade(contact)), step_.force(contact, full_state_at(time)));
  }

  [[nodiscard]] const System& system() const { return step_.system(); }
  [[nodiscard]] std::uint64_t evaluations() const { return step_.evaluations(); }
  [[nodiscard]] std::uint64_t steps() const { return step_.accepted(); }
  [[nodiscard]] std::uint64_t rejected() const { return step_.rejected(); }

 private:
  static constexpr double kGapRounding = 1e-17;  ///< [m²]: g of a contact that has just opened

  static constexpr double kShareBeyond = 1e-9;  ///< of λ past 0 or 1 where a tip ceases to skim

  static constexpr int kLooks = 4;  ///< in a step, for a tip that comes loose

  using Gap = typename ContactStep<System, Law, Pair, Blades>::Gap;

  /// What is followed of a blade from step to step.
  struct Watched {
    bool open = false;
    Gap at_begin{};              ///< of the step
    Gap at_end{};                ///< of what is looked at of the step
    double slip_velocity = 0.0;  ///< v at its begin, open contacts only
    double end_slip_velocity = 0.0;

    /// So lightly in contact, and leaving, that rounding decides whether there is a force.
    [[nodiscard]] bool ends_by_rounding() const { return at_end.value <= kGapRounding && at_end.rate < 0.0; }

    void take_end() {
      at_begin = at_end;
      slip_velocity = end_slip_velocity;
    }
  };

  [[nodiscard]] FullState full_state_at(double time) {
    if (time >= segment_end_) return step_.at_fraction(end_fraction_);
    if (time <= step_.begin()[kTime]) return step_.begin();
    return step_.at_fraction(step_.fraction_at(time, end_fraction_, segment_end_));
  }

  /// Finds what ends the phase in the step just made, if anything, and where.
  void find_end() {
    end_ = {PhaseEvent::horizon};
    end_fraction_ = 1.0;
    for (std::size_t i = 0; i < contact_count(); ++i)
      watched_of(i).end_slip_velocity = step_.slip_velocity(i);
    // Nothing beyond lift-off is looked at: there time runs backwards.
    bool past_fold = step_.passes_release();
    if (past_fold) {
      end_fraction_ = step_.release_fraction();
      // A column has a fold on the other side of u = 0 too.
      if (step_.passes_lift_off()) past_fold = end_fraction_ < step_.lift_off_fraction();
    }
    // Where the undeformed tip is still in the ring at the fold, it could not be free.
    const bool caught = past_fold && step_.gap(blade(0), step_.at_fraction(end_fraction_)).value >= 0.0;
    const bool lifts_off = past_fold ? !caught : step_.passes_lift_off();
    const bool lost = !lifts_off && (caught || step_.root_lost());
    const bool left_validity = lost || (!lifts_off && step_.shortening() > limits_.max_shortening);
    if (lifts_off) {
      if (!past_fold) end_fraction_ = step_.lift_off_fraction();
      end_ = {PhaseEvent::lift_off, blade(0)};
    }
    const auto turning_point = step_.turning_point();
    if (turning_point) {
      end_fraction_ = turning_point->fraction;
      end_ = {turning_point->is_fold ? PhaseEvent::snap : PhaseEvent::lift_off,
              blade(turning_point->contact)};
    }
    const double last = end_fraction_;
    const FullState end = step_.at_fraction(last);
    if (lifts_off) watched_of(0).end_slip_velocity = step_.force(0, end).slip_velocity;
    for (std::size_t i = 0; turning_point && i < contact_count(); ++i)
      watched_of(i).end_slip_velocity = step_.force(i, end).slip_velocity;

    const contact::BladeDirection first = step_.first_blade(end);
    for (int k = 0; k < static_cast<int>(watched_.size()); ++k) {
      Watched& watched = watched_[static_cast<std::size_t>(k)];
      watched.at_end = step_.gap(k, end, first);
      if (!watched.open) {
        look_for_touch_down(k, watched, last);
      } else if constexpr (ContactStep<System, Law, Pair, Blades>::kSkims) {
        look_for_end_of_skimming(k, last);
      } else if (turning_point && !turning_point->is_fold && k == blade(turning_point->contact)) {
        // A blade that comes to φ = 0 from outside the ring has left it before; g = 0 there to rounding.
        Watched unloaded = watched;
        unloaded.at_end.value = kGapRounding;
        look_for_lift_off(k, unloaded, last);
      } else if (!lifts_off && step_.ends_at_ring(k, end)) {
        look_for_lift_off(k, watched, last);
      }
    }
    if constexpr (Law::kHasSlipState) {
      for (std::size_t i = 0; i < contact_count(); ++i) {
        if constexpr (contact::Sticks<Law>) {
          if (step_.contacts()[i].slip == 0.0) {
            look_for_loosening(i, last);
            continue;
          }
        }
        look_for_slip_reversal(i, last);
      }
    }
    if (step_.root_lost() && watched_of(0).ends_by_rounding())
      take_if_first(last, PhaseEvent::lift_off, blade(0));

    segment_begin_ = step_.begin()[kTime];
    segment_end_ = step_.at_fraction(end_fraction_)[kTime];
    pending_ = true;
    if (!std::isfinite(segment_end_)) {
      end_ = {PhaseEvent::failed, -1, StatusDetail::beyond_precision};
      segment_end_ = segment_begin_;
    } else if ((end_.event == PhaseEvent::horizon && left_validity) || outside(end)) {
      const StatusDetail within = lost ? StatusDetail::no_equilibrium : StatusDetail::shortening_limit;
      end_ = {PhaseEvent::left_validity, -1, outside(end) ? StatusDetail::shaft_at_ring : within};
      segment_end_ = segment_begin_;
    }
  }

  /// The shaft's centre has reached the ring (MODEL 5).
  [[nodiscard]] bool outside(const FullState& state) const {
    const State seen = from_ring(state);
    const double y = seen[1] + misalignment_;
    return seen[0] * seen[0] + y * y >= ring_radius_ * ring_radius_;
  }

  [[nodiscard]] Watched& watched_of(std::size_t contact) {
    return watched_[static_cast<std::size_t>(blade(contact))];
  }

  void take_if_first(double fraction, PhaseEvent event, int blade) {
    if (fraction < end_fraction_ || (fraction == end_fraction_ && end_.event == PhaseEvent::horizon)) {
      end_fraction_ = fraction;
      end_ = {event, blade};
    }
  }

  void look_for_lift_off(int k, const Watched& watched, double last) {
    const auto rate = [&](double part) { return step_.gap(k, step_.at_fraction(part)).rate; };
    const auto gap = [&](double part) { return step_.gap(k, step_.at_fraction(part)).value; };
    double high = last;
    double at_high = watched.at_end.value;
    if (at_high > 0.0) {
      // The gap may close and open again within the step: then it has a minimum there.
      if (!(watched.at_begin.rate < 0.0 && watched.at_end.rate > 0.0)) return;
      high = integrate::root_between(rate, 0.0, last, watched.at_begin.rate, watched.at_end.rate);
      at_high = gap(high);
      if (at_high > 0.0) return;
    }
    // A contact that has just opened starts at g = 0 to rounding; divided by the fraction it starts positive.
    const double origin = std::min(watched.at_begin.value, 0.0);
    const bool fresh = watched.at_begin.value <= kGapRounding;
    const auto function = [&](double part) {
      const double excess = gap(part) - origin;
      return fresh ? excess / part : excess;
    };
    at_high = fresh ? (at_high - origin) / high : at_high;
    const double at_low = fresh ? std::abs(at_high) : watched.at_begin.value;
    take_if_first(integrate::root_between(function, 0.0, high, at_low, at_high), PhaseEvent::lift_off, k);
  }

  /// λ has left [0, 1], by so much that rounding does not lead it back.
  void look_for_end_of_skimming(int k, double last) {
    const auto share = [&](double part) { return step_.system().share(step_.at_fraction(part)); };
    const double before = share(0.0);
    const double after = share(last);
    const auto end_at = [&](double bound, PhaseEvent event) {
      take_if_first(integrate::root_between([&](double part) { return share(part) - bound; }, 0.0, last,
                                            before - bound, after - bound),
                    event, k);
    };
    if (after < -kShareBeyond) end_at(-kShareBeyond, PhaseEvent::lift_off);
    if (after > 1.0 + kShareBeyond) end_at(1.0 + kShareBeyond, PhaseEvent::pressed_in);
  }

  void look_for_touch_down(int k, const Watched& watched, double last) {
    const auto rate = [&](double part) { return step_.gap(k, step_.at_fraction(part)).rate; };
    const auto gap = [&](double part) { return step_.gap(k, step_.at_fraction(part)).value; };
    if (watched.at_begin.value >= 0.0) {
      // Just lifted off, or about to touch: rounding decides the sign of g, its slope what happens.
      if (watched.at_begin.rate > 0.0) return take_if_first(0.0, PhaseEvent::touch_down, k);
      if (!(watched.at_end.value > 0.0 && watched.at_end.rate > 0.0)) return;
      const double lowest =
          integrate::root_between(rate, 0.0, last, watched.at_begin.rate, watched.at_end.rate);
      const double at_lowest = gap(lowest);
      if (at_lowest < 0.0) {
        take_if_first(integrate::root_between(gap, lowest, last, at_lowest, watched.at_end.value),
                      PhaseEvent::touch_down, k);
      }
      return;
    }
    double high = last;
    double at_high = watched.at_end.value;
    if (at_high <= 0.0) {
      if (!(watched.at_begin.rate > 0.0 && watched.at_end.rate < 0.0)) return;
      high = integrate::root_between(rate, 0.0, last, watched.at_begin.rate, watched.at_end.rate);
      at_high = gap(high);
      if (at_high <= 0.0) return;
    }
    take_if_first(integrate::root_between(gap, 0.0, high, watched.at_begin.value, at_high),
                  PhaseEvent::touch_down, k);
  }

  /// The friction that holds a tip passes what it can be.
  void look_for_loosening(std::size_t contact, double last) {
    if constexpr (ContactStep<System, Law, Pair, Blades>::kSticks) {
      const auto excess = [&](double part) {
        return step_.system().excess(contact, step_.at_fraction(part));
      };
      double low = 0.0;
      double at_low = excess(0.0);
      if (at_low > 0.0) return take_if_first(0.0, PhaseEvent::comes_loose, blade(contact));
      for (int look = 1; look <= kLooks; ++look) {
        const double high = last * look / kLooks;
        const double at_high = excess(high);
        if (at_high > 0.0) {
          return take_if_first(integrate::root_between(excess, low, high, at_low, at_high),
                               PhaseEvent::comes_loose, blade(contact));
        }
        low = high;
        at_low = at_high;
      }
    }
  }

  void look_for_slip_reversal(std::size_t contact, double last) {
    const double before = watched_of(contact).slip_velocity;
    const double after = watched_of(contact).end_slip_velocity;
    const auto velocity = [&](double part) {
      return step_.force(contact, step_.at_fraction(part)).slip_velocity;
    };
    if constexpr (contact::Sticks<Law>) {
      // From rest a tip slips the way it is pulled, and may be at rest again within the step.
      const double slip = step_.contacts()[contact].slip;
      if (before == 0.0 && slip * after < 0.0) {
        const auto mean = [&](double part) { return velocity(part) / part; };
        return take_if_first(integrate::root_between(mean, 0.0, last, -after / last, after / last),
                             PhaseEvent::slip_reversal, blade(contact));
      }
      // An elastic blade's v may be against s where its contact begins; it is asked for anew where it stays
      // so.
      if constexpr (contact::SticksByLaw<Law>) {
        if (slip * before < 0.0 && slip * after < 0.0)
          return take_if_first(last, PhaseEvent::slip_reversal, blade(contact));
        if (slip * before < 0.0) return;
      }
    }
    if (before == 0.0 || (before > 0.0) == (after > 0.0)) return;
    take_if_first(integrate::root_between(velocity, 0.0, last, before, after), PhaseEvent::slip_reversal,
                  blade(contact));
  }

  ContactLimits limits_;
  double misalignment_;  ///< y0 [m]
  double ring_radius_;   ///< R [m]
  double tip_speed_;     ///< Ω R [m per unit τ]
  const Law* law_;
  ContactStep<System, Law, Pair, Blades> step_;
  std::vector<Watched> watched_;  ///< one per blade
  bool pending_ = false;          ///< a step has been made and not been recorded to its end
  PhaseEnd end_{};                ///< what happens at the end of that step's segment
  double end_fraction_ = 1.0;     ///< of the step, where the segment ends
  double segment_begin_ = 0.0;    ///< recorded up to here
  double segment_end_ = 0.0;
  double segment_limit_ = 0.0;
};

}  // namespace rubatlas::solve
