/// One contact phase: the motion while a fixed set of blades touches with fixed slip directions.
///
/// Advances in accepted Runge–Kutta steps; in each it looks for the first of the guards that end the phase
/// (lift-off, touch-down of another blade, slip reversal, loss of validity) on the step's dense output, so
/// that no step is repeated to find an event. A guard is asked for by a bound from the ends of the step
/// first, which mostly says that it cannot be met; only then is dense output made and searched (README). The
/// phase survives the end of a revolution: the section is read from dense output and the clock set back.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "blade/elastica_curve.hpp"
#include "contact/friction_law.hpp"
#include "integrate/cubic_range.hpp"
#include "integrate/first_crossing.hpp"
#include "integrate/root_between.hpp"
#include "modes/contact_step.hpp"
#include "modes/contact_system.hpp"
#include "modes/friction_power.hpp"
#include "modes/motion_listener.hpp"
#include "observables/motion_piece.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

/// How a phase ended; `blade` where it is an event of one.
struct PhaseEnd {
  PhaseEvent event;
  int blade = -1;
  point::StatusDetail why = point::StatusDetail::none;  ///< where the motion ends
};

/// What bounds a phase and how accurate it is.
struct ContactLimits {
  double tolerance;       ///< local error of a step [m]: accuracy.tolerance × δc
  double max_shortening;  ///< of δ/L [-]
};

template <class System, class Law, class Pair, class Blades = rotor::BladeSet>
class ContactPhase final : public observables::MotionPiece {
 public:
  using FullState = typename System::FullState;
  using Bodies = typename ContactStep<System, Law, Pair, Blades>::Bodies;

  ContactPhase(const rotor::RotorConstants& rotor, const Blades& blades, const Law& law,
               const ContactLimits& limits, System system)
      : limits_(limits),
        misalignment_(rotor.misalignment),
        ring_radius_(law.of(0).geometry().ring_radius),
        tip_speed_(std::abs(rotor.speed_ratio) * ring_radius_),
        law_(&law),
        step_(rotor, blades, law, limits.tolerance, std::move(system)),
        watched_(static_cast<std::size_t>(blades.count())) {
    if constexpr (kCarried) {
      for (int k = 0; k < blades.count(); ++k) {
        watched_[static_cast<std::size_t>(k)].valid_bending = valid_bending(law.of(k).curve());
      }
    }
  }

  /// Starts at time τ of the revolution. False where the system cannot start there, or outside of the model's
  /// validity: contacts that have just changed may bend a blade too far at once.
  bool start(double time, const Bodies& state, const std::vector<OpenContact>& contacts) {
    pending_ = false;
    refusal_ = point::StatusDetail::no_equilibrium;
    if (!step_.start(time, state, contacts)) return false;
    refusal_ = point::StatusDetail::none;
    if (step_.shortening() > limits_.max_shortening) refusal_ = point::StatusDetail::shortening_limit;
    if (beyond_ring(step_.begin()) > 0.0) refusal_ = point::StatusDetail::shaft_at_ring;
    if (refusal_ != point::StatusDetail::none) return false;
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

  /// Why it could not start.
  [[nodiscard]] point::StatusDetail refusal() const { return refusal_; }

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
          return {PhaseEvent::failed, -1, point::StatusDetail::step_too_short};
        case ContactStep<System, Law, Pair, Blades>::Outcome::no_force:
          end_fraction_ = 0.0;
          if (const int blade = step_.blade_at_fold(); blade >= 0) return {PhaseEvent::nears_fold, blade};
          if (const int unheld = step_.unheld_blade(); unheld >= 0) return {PhaseEvent::comes_loose, unheld};
          return {PhaseEvent::left_validity, -1, point::StatusDetail::no_equilibrium};
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
  [[nodiscard]] Bodies state_at(double time) { return rotor::bodies(full_state_at(time)); }
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
  [[nodiscard]] observables::State state(double time) override {
    return rotor::as_array(rotor::shaft(state_at(time)));
  }
  [[nodiscard]] double displacement_bound() const override { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] std::size_t contact_count() const override { return step_.contacts().size(); }
  [[nodiscard]] int blade(std::size_t contact) const override { return step_.contacts()[contact].blade; }
  [[nodiscard]] bool load_peaks(std::size_t contact) const override {
    const Watched& watched = watched_[static_cast<std::size_t>(blade(contact))];
    return step_.load_may_peak(contact, watched.at_begin.rate > 0.0 && watched.at_end.rate < 0.0);
  }
  [[nodiscard]] double normal_force(std::size_t contact, double time) override {
    return step_.force(contact, full_state_at(time)).normal;
  }
  [[nodiscard]] double root_strain(std::size_t contact, double time) override {
    return step_.force(contact, full_state_at(time)).root_strain;
  }
  [[nodiscard]] double friction_power(std::size_t contact, double time) override {
    return modes::friction_power(law_->of(blade(contact)), step_.force(contact, full_state_at(time)));
  }

  [[nodiscard]] const System& system() const { return step_.system(); }
  [[nodiscard]] std::uint64_t evaluations() const { return step_.evaluations(); }
  [[nodiscard]] std::uint64_t steps() const { return step_.accepted(); }
  [[nodiscard]] std::uint64_t rejected() const { return step_.rejected(); }

 private:
  static constexpr double kGapRounding = 1e-17;  ///< [m²]: g of a contact that has just opened

  static constexpr double kShareBeyond = 1e-9;  ///< of λ past 0 or 1 where a tip ceases to skim

  /// Of the limit of δ/L: what no stage of a step has met is not met between them.
  static constexpr double kFarFromLimit = 0.75;

  static constexpr bool kCarried = ContactStep<System, Law, Pair, Blades>::kCarried;

  using Gap = typename ContactStep<System, Law, Pair, Blades>::Gap;

  /// What is followed of a blade from step to step.
  struct Watched {
    bool open = false;
    Gap at_begin{};              ///< of the step
    Gap at_end{};                ///< of what is looked at of the step
    double slip_velocity = 0.0;  ///< v at its begin, open contacts only
    double end_slip_velocity = 0.0;
    double valid_bending = 0.0;  ///< u up to which δ/L is within its limit, carried contacts only

    /// So lightly in contact, and leaving, that rounding decides whether there is a force.
    [[nodiscard]] bool ends_by_rounding() const { return at_end.value <= kGapRounding && at_end.rate < 0.0; }

    void take_end() {
      at_begin = at_end;
      slip_velocity = end_slip_velocity;
    }
  };

  [[nodiscard]] FullState full_state_at(double time) {
    if (time >= segment_end_) return step_.at_fraction(end_fraction_);
    if (time <= step_.begin()[rotor::kTime]) return step_.begin();
    return step_.at_fraction(step_.fraction_at(time, end_fraction_, segment_end_));
  }

  /// Finds what ends the phase in the step just made, if anything, and where; or takes the step back.
  void find_end() {
    end_ = {PhaseEvent::horizon};
    end_fraction_ = 1.0;
    for (std::size_t i = 0; i < contact_count(); ++i)
      watched_of(i).end_slip_velocity = step_.slip_velocity(i);
    // Nothing beyond lift-off is looked at: there time runs backwards.
    bool past_fold = step_.passes_release();
    // A fold where another branch may follow; what does is for the motion to find.
    const bool snaps = past_fold && step_.may_snap(0);
    if (past_fold) {
      end_fraction_ = step_.release_fraction();
      // A column has a fold on the other side of u = 0 too.
      if (step_.passes_lift_off()) past_fold = end_fraction_ < step_.lift_off_fraction();
    }
    // Where the undeformed tip is still in the ring at the fold, it could not be free.
    const bool caught =
        past_fold && !snaps && step_.gap(blade(0), step_.at_fraction(end_fraction_)).value >= 0.0;
    const bool ends = past_fold ? !caught : step_.passes_lift_off();
    const bool lifts_off = ends && !(snaps && past_fold);
    const bool lost = !ends && (caught || step_.root_lost());
    if (ends) {
      if (!past_fold) end_fraction_ = step_.lift_off_fraction();
      end_ = {lifts_off ? PhaseEvent::lift_off : PhaseEvent::snap, blade(0)};
      // Where the force ends from a finite value it does so before its fold, and that before u = 0.
      if constexpr (kCarried && !Law::kReleasesAtFold) look_for_lift_off_under_load(end_fraction_);
    }
    const auto branch_end = step_.branch_end();
    if (branch_end) {
      end_fraction_ = branch_end->fraction;
      end_ = {branch_end->lifts_off ? PhaseEvent::lift_off : PhaseEvent::snap, blade(branch_end->contact)};
    }
    const double last = end_fraction_;
    const FullState end = step_.at_fraction(last);
    if (ends) watched_of(0).end_slip_velocity = step_.force(0, end).slip_velocity;
    for (std::size_t i = 0; branch_end && i < contact_count(); ++i)
      watched_of(i).end_slip_velocity = step_.force(i, end).slip_velocity;

    const contact::BladeDirection first = step_.first_blade(end);
    const TimeSlopes slopes{last * step_.time_slope(0.0), last * step_.time_slope(last)};
    for (int k = 0; k < static_cast<int>(watched_.size()); ++k) {
      Watched& watched = watched_[static_cast<std::size_t>(k)];
      watched.at_end = step_.gap(k, end, first);
      if (!watched.open) {
        look_for_touch_down(k, watched, last, slopes);
      } else if constexpr (ContactStep<System, Law, Pair, Blades>::kSkims) {
        look_for_end_of_skimming(k, last);
      } else if (branch_end && branch_end->lifts_off && k == blade(branch_end->contact)) {
        // A blade that comes to φ = 0 from outside the ring has left it before; g = 0 there to rounding.
        Watched unloaded = watched;
        unloaded.at_end.value = kGapRounding;
        look_for_lift_off(k, unloaded, last, slopes);
      } else if (!lifts_off && step_.ends_at_ring(k, end)) {
        look_for_lift_off(k, watched, last, slopes);
      }
    }
    const auto bounds = step_.bounds();
    if constexpr (Law::kHasSlipState) {
      for (std::size_t i = 0; i < contact_count(); ++i) {
        if constexpr (contact::Sticks<Law>) {
          if (step_.contacts()[i].slip == 0.0) {
            look_for_loosening(i, last);
            continue;
          }
        }
        look_for_slip_reversal(i, last, bounds);
      }
    }
    look_for_loss_of_validity(last, bounds);
    if constexpr (ContactStep<System, Law, Pair, Blades>::kMaySnap) {
      for (std::size_t i = 0; i < contact_count(); ++i) {
        if (step_.may_snap(i)) look_for_buckling(i, last);
      }
    }
    if (step_.root_lost() && watched_of(0).ends_by_rounding())
      take_if_first(last, PhaseEvent::lift_off, blade(0));

    segment_begin_ = step_.begin()[rotor::kTime];
    segment_end_ = step_.at_fraction(end_fraction_)[rotor::kTime];
    if (!std::isfinite(segment_end_) && step_.take_back()) return;
    pending_ = true;
    if (!std::isfinite(segment_end_)) {
      end_ = {PhaseEvent::failed, -1, point::StatusDetail::beyond_precision};
      segment_end_ = segment_begin_;
    } else if (end_.event == PhaseEvent::horizon && lost) {
      end_ = {PhaseEvent::left_validity, -1, point::StatusDetail::no_equilibrium};
      segment_end_ = segment_begin_;
    }
  }

  /// |c|² − R² [m²]: the shaft's centre reaches the ring where it is positive (MODEL 5).
  [[nodiscard]] double beyond_ring(const FullState& state) const {
    const rotor::State seen = rotor::from_ring(state);
    const double y = seen[1] + misalignment_;
    return seen[0] * seen[0] + y * y - ring_radius_ * ring_radius_;
  }

  /// A bending parameter up to which δ/L, which grows with it, is within its limit.
  [[nodiscard]] double valid_bending(const blade::ElasticaCurve& curve) const {
    const auto& knots = curve.knots();
    const auto beyond = std::find_if(knots.begin(), knots.end(), [&](const auto& knot) {
      return knot.shortening > limits_.max_shortening;
    });
    return beyond == knots.begin() ? 0.0 : std::prev(beyond)->bending;
  }

  /// dτ/dθ at both ends of what is looked at of a step.
  struct TimeSlopes {
    double begin;
    double end;
  };

  [[nodiscard]] Watched& watched_of(std::size_t contact) {
    return watched_[static_cast<std::size_t>(blade(contact))];
  }

  void take_if_first(double fraction, const PhaseEnd& end) {
    if (fraction < end_fraction_ || (fraction == end_fraction_ && end_.event == PhaseEvent::horizon)) {
      end_fraction_ = fraction;
      end_ = end;
    }
  }
  void take_if_first(double fraction, PhaseEvent event, int blade) {
    take_if_first(fraction, PhaseEnd{event, blade});
  }

  /// The first crossing of a guard, which is asked for at both ends too, ends the phase.
  template <class Guard>
  void look_for(const Guard& guard, double last, const PhaseEnd& end) {
    look_between(guard, last, {guard(0.0), guard(last)}, end);
  }
  struct GuardEnds {
    double begin;
    double end;
  };
  template <class Guard>
  void look_between(const Guard& guard, double last, const GuardEnds& ends, const PhaseEnd& end,
                    double rounding = 0.0) {
    const auto found = integrate::first_crossing(guard, 0.0, last, ends.begin, ends.end, rounding);
    if (found) take_if_first(*found, end);
  }

  /// Looks where a gap comes back to zero that starts there, but for rounding, and is negative at first. It
  /// is divided by the fraction of the step, so that the start is no root. Near the start that makes rounding
  /// large: only a gap of more than kGapRounding is taken for a crossing, and one secant step leads from
  /// there back to where the gap is zero.
  template <class Value>
  void look_from_zero(const Value& gap, double last, double at_last, const PhaseEnd& end) {
    constexpr double kJustBefore = 1.0 / 1024;
    const auto beyond = [&](double part) { return (gap(part) - kGapRounding) / part; };
    const double at_end = (at_last - kGapRounding) / last;
    const auto found = integrate::first_crossing(beyond, 0.0, last, -std::abs(at_end), at_end);
    if (!found) return;
    const double rise = gap(*found) - gap((1.0 - kJustBefore) * *found);
    const double back = kJustBefore * *found * kGapRounding / rise;
    take_if_first(back > 0.0 && back < *found ? *found - back : *found, end);
  }

  /// g = 0 of a carried contact in a step where it is unloaded, u = 0, at one end.
  void look_for_lift_off_under_load(double last) {
    if (step_.ends_unloaded_only()) return;
    const auto guard = [&](double part) { return -step_.gap_per_deflection(part); };
    const double begin = guard(0.0);
    if (step_.begin()[rotor::kBending] > 0.0 && watched_of(0).at_begin.value <= kGapRounding) {
      // A contact that has just opened under load starts at g = 0 to rounding, and is pressed in.
      const double at_end = (guard(last) - begin) / last;
      return look_between([&](double part) { return (guard(part) - begin) / part; }, last,
                          {-std::abs(at_end), at_end}, {PhaseEvent::lift_off, blade(0)});
    }
    // A tip that touches head-on, ct = 0 to rounding, is pressed in.
    const bool touches = step_.begin()[rotor::kBending] == 0.0;
    look_between(guard, last, {touches ? -std::abs(begin) : begin, guard(last)},
                 {PhaseEvent::lift_off, blade(0)});
  }

  void look_for_lift_off(int k, const Watched& watched, double last, const TimeSlopes& slopes) {
    const Gap& begin = watched.at_begin;
    const Gap& end = watched.at_end;
    // A contact that has just opened starts at g = 0 to rounding; divided by the fraction it starts positive.
    const bool fresh = begin.value <= kGapRounding;
    const double origin = std::min(begin.value, 0.0);
    if (end.value > 0.0) {
      const integrate::Range range =
          fresh ? integrate::cubic_range_of_mean_slope(begin.rate * slopes.begin, end.value - origin,
                                                       end.rate * slopes.end)
                : integrate::cubic_range(begin.value, begin.rate * slopes.begin, end.value,
                                         end.rate * slopes.end);
      if (range.least > 0.0) return;
      if constexpr (kCarried) {
        if (k == blade(0) && step_.begin()[rotor::kBending] == 0.0) return look_for_lift_off_under_load(last);
      }
    }
    const auto excess = [&](double part) { return origin - step_.gap(k, step_.at_fraction(part)).value; };
    if (fresh) {
      look_from_zero(excess, last, origin - end.value, {PhaseEvent::lift_off, k});
    } else {
      look_between(excess, last, {-begin.value, -end.value}, {PhaseEvent::lift_off, k}, kGapRounding);
    }
  }

  /// λ has left [0, 1], by so much that rounding does not lead it back.
  void look_for_end_of_skimming(int k, double last) {
    const auto share = [&](double part) { return step_.system().share(step_.at_fraction(part)); };
    look_for([&](double part) { return -kShareBeyond - share(part); }, last, {PhaseEvent::lift_off, k});
    look_for([&](double part) { return share(part) - (1.0 + kShareBeyond); }, last,
             {PhaseEvent::pressed_in, k});
  }

  void look_for_touch_down(int k, const Watched& watched, double last, const TimeSlopes& slopes) {
    const Gap& begin = watched.at_begin;
    const Gap& end = watched.at_end;
    const auto gap = [&](double part) { return step_.gap(k, step_.at_fraction(part)).value; };
    if (begin.value >= 0.0) {
      // Just lifted off, or about to touch: rounding decides the sign of g, its slope what happens.
      if (begin.rate > 0.0) return take_if_first(0.0, PhaseEvent::touch_down, k);
      // It leaves the ring, and may return. Divided by the fraction g starts negative.
      const double more = end.value - begin.value;
      const auto range =
          integrate::cubic_range_of_mean_slope(begin.rate * slopes.begin, more, end.rate * slopes.end);
      if (range.greatest < 0.0) return;
      return look_from_zero([&](double part) { return gap(part) - begin.value; }, last, more,
                            {PhaseEvent::touch_down, k});
    }
    const auto range =
        integrate::cubic_range(begin.value, begin.rate * slopes.begin, end.value, end.rate * slopes.end);
    if (range.greatest < 0.0) return;
    look_between(gap, last, {begin.value, end.value}, {PhaseEvent::touch_down, k}, kGapRounding);
  }

  /// The friction that holds a tip passes what it can be.
  void look_for_loosening(std::size_t contact, double last) {
    if constexpr (ContactStep<System, Law, Pair, Blades>::kSticks) {
      look_for([&](double part) { return step_.system().excess(contact, step_.at_fraction(part)); }, last,
               {PhaseEvent::comes_loose, blade(contact)});
    }
  }

  /// A straight column reaches its Euler load on the receding side, from where it snaps.
  void look_for_buckling(std::size_t contact, double last) {
    const auto beyond = [&](double part) { return step_.beyond_straight(contact, step_.at_fraction(part)); };
    const double at_begin = beyond(0.0);
    const double at_end = beyond(last);
    // Where it does not stand straight, there is nothing to look for.
    if (at_begin == -1.0 && at_end == -1.0) return;
    if (const auto part = integrate::first_crossing(beyond, 0.0, last, at_begin, at_end))
      take_if_first(*part, PhaseEvent::snap, blade(contact));
  }

  void look_for_slip_reversal(std::size_t contact, double last,
                              const typename ContactStep<System, Law, Pair, Blades>::Bounds& bounds) {
    const double before = watched_of(contact).slip_velocity;
    const double after = watched_of(contact).end_slip_velocity;
    if (before * after > 0.0 && step_.slip_lasts(bounds)) return;
    const auto velocity = [&](double part) {
      return step_.force(contact, step_.at_fraction(part)).slip_velocity;
    };
    const auto mean = [&](double part) { return velocity(part) / part; };
    if constexpr (contact::Sticks<Law>) {
      // From rest a tip slips the way it is pulled, and may be at rest again within the step.
      const double slip = step_.contacts()[contact].slip;
      if (before == 0.0) {
        return look_between([&](double part) { return -slip * mean(part); }, last,
                            {-std::abs(after / last), -slip * after / last},
                            {PhaseEvent::slip_reversal, blade(contact)});
      }
      // An elastic blade's v may be against s where its contact begins; it is asked for anew where it stays
      // so.
      if constexpr (contact::SticksByLaw<Law>) {
        if (slip * before < 0.0 && slip * after < 0.0)
          return take_if_first(last, PhaseEvent::slip_reversal, blade(contact));
        if (slip * before < 0.0) return;
      }
    }
    if (before == 0.0) {
      const auto next = integrate::first_sign_change(mean, 0.0, last, after / last);
      if (next) take_if_first(*next, PhaseEvent::slip_reversal, blade(contact));
      return;
    }
    const double against = before > 0.0 ? -1.0 : 1.0;
    look_between([&](double part) { return against * velocity(part); }, last,
                 {-std::abs(before), against * after}, {PhaseEvent::slip_reversal, blade(contact)});
  }

  /// δ/L passes its limit, or the shaft's centre the ring (MODEL 5).
  void look_for_loss_of_validity(double last,
                                 const typename ContactStep<System, Law, Pair, Blades>::Bounds& bounds) {
    if (!(bounds.distance < ring_radius_)) {
      look_for([&](double part) { return beyond_ring(step_.at_fraction(part)); }, last,
               {PhaseEvent::left_validity, -1, point::StatusDetail::shaft_at_ring});
    }
    if (shortening_is_valid()) return;
    for (std::size_t i = 0; i < contact_count(); ++i) {
      look_for(
          [&](double part) {
            return step_.force(i, step_.at_fraction(part)).shortening - limits_.max_shortening;
          },
          last, {PhaseEvent::left_validity, blade(i), point::StatusDetail::shortening_limit});
    }
  }
  /// Of all blades all through the step, as far as its ends and stages tell.
  [[nodiscard]] bool shortening_is_valid() {
    if constexpr (Law::kLoadFollowsGap) {
      return true;
    } else if constexpr (kCarried) {
      return contact_count() == 1 && step_.bending_range().greatest < watched_of(0).valid_bending;
    } else {
      return step_.stage_shortening() < kFarFromLimit * limits_.max_shortening;
    }
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
  point::StatusDetail refusal_ = point::StatusDetail::none;
  double end_fraction_ = 1.0;   ///< of the step, where the segment ends
  double segment_begin_ = 0.0;  ///< recorded up to here
  double segment_end_ = 0.0;
  double segment_limit_ = 0.0;
};

}  // namespace rubatlas::modes
