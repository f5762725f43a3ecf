/// One accepted step of a contact phase, with everything that can be asked of it: states on dense output,
/// gaps, forces.
///
/// `System` is one of the right-hand sides of `contact_system.hpp`, `Pair` a table of Runge–Kutta
/// coefficients. What comes out of a step does not depend on what has been asked of the steps before it:
/// dense output is made on a copy of the system's first guesses.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "blade/inclined_elastica.hpp"
#include "contact/pose.hpp"
#include "integrate/cubic_range.hpp"
#include "integrate/root_between.hpp"
#include "integrate/runge_kutta.hpp"
#include "integrate/step_control.hpp"
#include "modes/contact_system.hpp"
#include "modes/work_meter.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

template <class System, class Law, class Pair, class Blades = rotor::BladeSet>
class ContactStep {
 public:
  using FullState = typename System::FullState;
  using Bodies =
      decltype(rotor::bodies(std::declval<const FullState&>()));  ///< what moves, without time and u

  /// The bending parameter is a state of the system.
  static constexpr bool kCarried = requires(System system) { system.last(); };
  /// The bends of all blades in contact are states of the system.
  static constexpr bool kBends = requires { requires System::kCarriesBends; };
  /// Time is a state, which turns back where a contact ends.
  static constexpr bool kTimeTurns = kCarried || kBends;
  /// The blade stays on g = 0 under a share of its force.
  static constexpr bool kSkims = requires(System system, FullState state) { system.share(state); };
  /// Tips stick: their slip velocities stay zero.
  static constexpr bool kSticks = requires(System system, FullState state) { system.excess(0, state); };
  /// The ring has no motion of its own.
  static constexpr bool kFollows = requires(System system, FullState state) { system.place_ring(state); };
  /// A contact ends where its force does, not where the undeformed tip leaves the ring.
  static constexpr bool kReleasesAtFold = Law::kReleasesAtFold && !kSkims;
  /// A blade may come to the end of the branch on which it stands.
  static constexpr bool kMaySnap = kMayHaveBranches<Law> && !kSkims && !kSticks;
  /// Other blades may touch besides the one that is carried.
  static constexpr bool kBesideOthers = kCarried && kMayHaveBranches<Law>;
  /// A guess holds the side to which a blade is bent, or the branch on which it stands: what a step that goes
  /// too far has made of it is no guess for a shorter one.
  static constexpr bool kRemembers =
      !kBends && (kMayHaveBranches<Law> || requires { requires Law::OfBlade::kRemembersSide; });
  /// Near a force that starts or ends like a root of the gap many steps are rejected, and their sizes hang on
  /// the last digits. Where no carried form takes that away sizes come from a coarse grid: a motion that
  /// comes to the same place goes on by the same steps, and repeats itself to rounding instead of to the
  /// tolerance.
  static constexpr bool kCoarseSizes = !Law::kHasBending && !Law::kLoadFollowsGap && !kBends;

  /// `tolerance` bounds the local error of a step [m]: accuracy.tolerance × δc.
  ContactStep(const rotor::RotorConstants& rotor, const Blades& blades, const Law& law, double tolerance,
              System system)
      : rotor_(&rotor),
        blades_(&blades),
        law_(&law),
        tolerance_(tolerance),
        system_(std::move(system)),
        control_(Pair::kOrder, kFirstSize) {}

  /// Starts a phase at time τ of the revolution. False where the system cannot start there.
  bool start(double time, const Bodies& state, const std::vector<OpenContact>& contacts) {
    contacts_ = contacts;
    paid_evaluations_ = curve_evaluations(*law_);
    FullState full;
    if constexpr (kBends) {
      if (!system_.open(contacts_, state, time, full)) return false;
      control_.begin_phase();
      if (!step_.begin(system_, full)) return false;
      stage_shortening_ = shortening();
      return true;
    } else {
      full = rotor::full_state(state, time, kCarried ? contacts_.front().bending : 0.0);
    }
    if constexpr (kCarried) {
      if (!system_.open(contacts_.front(), full)) return false;
      if constexpr (kBesideOthers) system_.stand_beside(contacts_);
      system_.anchor(time);
    } else if constexpr (!kBends) {
      system_.open(contacts_);
    }
    began_ = accepted_;
    control_.begin_phase();
    if constexpr (kCoarseSizes) control_.round_size();
    if (!step_.begin(system_, full)) return false;
    stage_shortening_ = shortening();
    return true;
  }

  enum class Outcome : std::uint8_t { accepted, no_force, too_short, stopped };

  /// Makes one step that keeps the tolerance, unless the meter ends the revolution.
  Outcome make(WorkMeter& meter) {
    if constexpr (kCarried) system_.anchor(step_.start()[rotor::kTime]);
    if constexpr (kRemembers) guesses_ = system_.contacts();
    while (true) {
      const double proposed = proposed_size();
      const double size = aimed_at_lift_off(proposed);
      if (!meter.spend(Work::contact, price_of_last_attempt())) return Outcome::stopped;
      if constexpr (kBesideOthers) system_.forget_folds();
      const bool evaluated = attempt(size, meter);
      if (meter.ended()) return Outcome::stopped;
      const double error = evaluated ? scaled_error() : std::numeric_limits<double>::infinity();
      if (integrate::StepControl::acceptable(error)) {
        if (!holds_whole_contact() && !passes_fold() && !passes_two_folds() && !time_turns() &&
            !leaves_curve()) {
          ++accepted_;
          end_shortening_ = shortening();
          control_.accept(error, size < proposed);
          if constexpr (kCarried) project();
          if constexpr (kSkims || kSticks || kBends) system_.project(step_.end());
          if constexpr (kFollows) system_.place_ring(step_.end());
          return Outcome::accepted;
        }
        control_.halve(size / proposed);
      } else {
        control_.reject(error, size / proposed);
      }
      ++rejected_;
      if constexpr (kRemembers) system_.restore(guesses_);
      if (!evaluated && blade_at_fold() >= 0 && (!kCarried || accepted_ > began_)) return Outcome::no_force;
      // Where no stage can find a force however short the step, the contact equation has lost its root.
      if (!(size > kSmallestSize)) return evaluated ? Outcome::too_short : Outcome::no_force;
    }
  }

  /// Takes back the step just made, within which no force can be found: the next attempt is half as long.
  /// False where that would be too short.
  bool take_back() {
    if (!(step_.size() > kSmallestSize)) return false;
    --accepted_;
    ++rejected_;
    control_.halve(1.0);
    if constexpr (kRemembers) system_.restore(guesses_);
    return true;
  }

  /// Goes on from the end of the step.
  void accept() {
    step_.accept();
    stage_shortening_ = end_shortening_;
  }

  [[nodiscard]] const FullState& begin() const { return step_.start(); }
  [[nodiscard]] const FullState& end() const { return step_.end(); }
  [[nodiscard]] const std::vector<OpenContact>& contacts() const { return contacts_; }
  [[nodiscard]] const System& system() const { return system_; }

  /// State at the fraction θ in [0, 1]; NaN where a stage of dense output finds no force.
  [[nodiscard]] FullState at_fraction(double fraction) {
    if (fraction == 0.0) return step_.start();
    if (fraction == 1.0) return step_.end();
    if (!make_dense()) {
      return FullState::Constant(step_.end().size(), std::numeric_limits<double>::quiet_NaN());
    }
    FullState state = step_.interpolate(fraction);
    if constexpr (kSticks) system_.project(state);
    if constexpr (kBends) system_.place(state);
    if constexpr (kFollows) system_.place_ring(state);
    return state;
  }

  /// Fraction at a time strictly between the step's start and `last`, a fraction where time is `last_time`:
  /// Newton, since time runs forward and smoothly, with the bracketing solver where lift-off (dτ/dσ = 0) is
  /// too near.
  [[nodiscard]] double fraction_at(double time, double last, double last_time) {
    const double from = step_.start()[rotor::kTime];
    double fraction = last * (time - from) / (last_time - from);
    if (!kTimeTurns || !make_dense()) return fraction;
    for (int i = 0; i < 8; ++i) {
      const auto at = step_.interpolate_with_slope(fraction, rotor::kTime);
      const double move = (time - at.value) / at.slope;
      fraction += move;
      if (!(fraction > 0.0 && fraction < last)) break;
      if (std::abs(move) <= kFractionResolution) return fraction;
    }
    return integrate::root_between([&](double part) { return step_.interpolate(part, rotor::kTime) - time; },
                                   0.0, last, from - time, last_time - time);
  }

  /// True where the step has passed lift-off: u has gone through zero, beyond which the even curve leads back
  /// along the same motion with time running backwards.
  [[nodiscard]] bool passes_lift_off() const {
    if constexpr (kCarried) return step_.end()[rotor::kBending] <= 0.0;
    return false;
  }
  /// Fraction where u = 0, in a step that has passed it.
  [[nodiscard]] double lift_off_fraction() { return crossing_of(rotor::kBending, 0.0); }

  /// Where the branch of one of several bent blades ends in the step, if one does: the first.
  struct BranchEnd {
    std::size_t contact = 0;
    double fraction = 1.0;
    bool lifts_off = false;  ///< else the blade snaps
  };
  [[nodiscard]] std::optional<BranchEnd> branch_end() {
    std::optional<BranchEnd> first;
    const auto take = [&](const BranchEnd& end) {
      if (!first || end.fraction < first->fraction) first = end;
    };
    if constexpr (kBends) {
      for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const auto amplitude = System::amplitude_of(i);
        const double at_end = step_.end()[amplitude];
        if (at_end <= 0.0) {
          take({i, crossing_of(amplitude, 0.0), true});
        } else if (system_.turns_back(i)) {
          take({i, fold_fraction(i), false});
        }
        if (at_end > blade::kLargestAmplitude)
          take({i, crossing_of(amplitude, blade::kLargestAmplitude), false});
      }
    }
    return first;
  }

  /// Whether an open contact may stand on another branch at the end of its own.
  [[nodiscard]] bool may_snap(std::size_t contact) const {
    if constexpr (kMaySnap) return law_->of(contacts_[contact].blade).has_branches();
    return false;
  }
  /// True where the step has passed the fold of the contact equation and with it the end of the contact, or
  /// of the branch on which its blade stands. Only for a carried contact that ends there: σ goes on smoothly
  /// where time turns round.
  [[nodiscard]] bool passes_release() const {
    if constexpr (kCarried && kMaySnap) {
      if (!kReleasesAtFold && !may_snap(0)) return false;
      return law_->of(contacts_.front().blade)
                 .fold_measure(step_.end()[rotor::kBending], system_.last().bending_slope) > 0.0;
    }
    return false;
  }
  /// Fraction where the fold is, in a step that has passed it.
  [[nodiscard]] double release_fraction() {
    if constexpr (kCarried && kMaySnap) {
      const auto measure = [&](double part) {
        const FullState state = at_fraction(part);
        const OpenContact& open = contacts_.front();
        const auto there = law_->of(open.blade)
                               .constraint(pose(open.blade, state), open.slip, state[rotor::kBending],
                                           blades_->speed(state[rotor::kTime]));
        return law_->of(contacts_.front().blade).fold_measure(state[rotor::kBending], there.bending_slope);
      };
      const double at_end = measure(1.0);
      // At the unloaded blade where a contact may start, h falls with the load.
      const double at_begin = step_.start()[rotor::kBending] == 0.0 ? -at_end : measure(0.0);
      if (!(at_begin < 0.0)) return 0.0;
      return integrate::root_between(measure, 0.0, 1.0, at_begin, at_end);
    }
    return 1.0;
  }
  /// The same where forces are solved for: a blade whose branch has ended somewhere within the step that
  /// could not be made. It is to be carried, since there its force ends like a square root of the time. −1
  /// where there is no such blade.
  [[nodiscard]] int blade_at_fold() const {
    if constexpr (kMaySnap) {
      if (kCarried && system_.without_force() == 0) return -1;
      const OpenContact& lost = system_.contacts()[system_.without_force()];
      const auto& law = law_->of(lost.blade);
      // A column that stands straight has no bending to carry along.
      const bool carries = law.carried() || lost.bending > 0.0;
      if (carries && (kReleasesAtFold || law.has_branches())) return lost.blade;
    }
    return -1;
  }
  /// How far a straight column is past the end of its branch, in Euler loads; negative before.
  [[nodiscard]] double beyond_straight(std::size_t contact, const FullState& state) const {
    if constexpr (kMaySnap) {
      const OpenContact& open = contacts_[contact];
      return -law_->of(open.blade)
                  .straight_reserve(pose(open.blade, state), open.slip, system_.contacts()[contact].bending);
    }
    return -1.0;
  }
  /// A tip at rest that nothing can hold beyond the start of the step; −1 where there is none.
  [[nodiscard]] int unheld_blade() const {
    if constexpr (kSticks && requires(System system) { system.without_force(); }) {
      const OpenContact& lost = contacts_[system_.without_force()];
      if (lost.slip == 0.0) return lost.blade;
    }
    return -1;
  }
  /// Whether a blade's contact ends at g = 0 where it stands.
  [[nodiscard]] bool ends_at_ring(int blade, const FullState& state) const {
    if constexpr (kReleasesAtFold) {
      if (kCarried && contacts_.front().blade == blade) return false;
      for (const OpenContact& open : system_.contacts()) {
        if (open.blade == blade)
          return law_->of(blade).ends_unloaded(pose(blade, state), open.slip, open.bending);
      }
    }
    return true;
  }

  /// Direction of blade 0 in a state.
  [[nodiscard]] contact::BladeDirection first_blade(const FullState& state) const {
    return blades_->first(state[rotor::kTime]);
  }
  /// g and dg/dτ of a blade in a state.
  struct Gap {
    double value;
    double rate;
  };
  [[nodiscard]] Gap gap(int blade, const FullState& state) const {
    return gap(blade, state, first_blade(state));
  }
  /// The same when blade 0 stands at `first`, for all blades in one state.
  [[nodiscard]] Gap gap(int blade, const FullState& state, const contact::BladeDirection& first) const {
    const contact::Pose at = pose(blade, state, first);
    return {at.gap, contact::gap_rate(law_->of(blade).geometry(), at, blades_->speed(state[rotor::kTime]))};
  }

  /// dτ/dθ.
  [[nodiscard]] double time_slope(double fraction) {
    if (fraction == 0.0) return step_.size() * step_.start_derivative()[rotor::kTime];
    if (fraction == 1.0) return step_.size() * step_.end_derivative()[rotor::kTime];
    return make_dense() ? step_.interpolate_with_slope(fraction, rotor::kTime).slope
                        : std::numeric_limits<double>::quiet_NaN();
  }

  /// How far from the ring's centre the shaft gets in the step, and how fast, as seen from the ring: bounds
  /// from the ends of the step, as `integrate::cubic_range` has them.
  struct Bounds {
    double distance;  ///< of |c| [m]
    double speed;     ///< of |c'| [m per unit τ]
  };
  [[nodiscard]] Bounds bounds() const {
    if constexpr (kFollows) {  // what the ring does next does not follow from its rate
      constexpr double kUnknown = std::numeric_limits<double>::infinity();
      return {kUnknown, kUnknown};
    }
    const rotor::State begin = rotor::from_ring(step_.start());
    const rotor::State end = rotor::from_ring(step_.end());
    const rotor::State second = begin + step_.size() / 3.0 * rotor::from_ring(step_.start_derivative());
    const rotor::State third = end - step_.size() / 3.0 * rotor::from_ring(step_.end_derivative());
    const rotor::State margin =
        0.1 * ((third - 2.0 * second + begin).abs() + (end - 2.0 * third + second).abs());
    const rotor::State least = begin.min(end).min(second.min(third)) - margin;
    const rotor::State greatest = begin.max(end).max(second.max(third)) + margin;
    rotor::State farthest = least.abs().max(greatest.abs());
    farthest[1] =
        std::max(std::abs(least[1] + rotor_->misalignment), std::abs(greatest[1] + rotor_->misalignment));
    return {std::sqrt(farthest[0] * farthest[0] + farthest[1] * farthest[1]),
            std::sqrt(farthest[2] * farthest[2] + farthest[3] * farthest[3])};
  }

  /// No tip's slip can turn round within such bounds: v = c'·t + Ω (rk − c)·n, and |rk| >= R in contact.
  [[nodiscard]] bool slip_lasts(const Bounds& bounds) const {
    return blades_->slowest() * (law_->of(0).geometry().ring_radius - bounds.distance) > bounds.speed;
  }

  /// Range of a carried contact's bending parameter in the step.
  [[nodiscard]] integrate::Range bending_range() const {
    return integrate::cubic_range(
        step_.start()[rotor::kBending], step_.size() * step_.start_derivative()[rotor::kBending],
        step_.end()[rotor::kBending], step_.size() * step_.end_derivative()[rotor::kBending]);
  }
  /// Largest δ/L that the stages of a step have met where forces are solved for.
  [[nodiscard]] double stage_shortening() const { return stage_shortening_; }

  /// The tip of a carried contact stays on the side where its force ends with u, g/Δ = 2 s ct − Δ + (terms
  /// that are not negative) > 0, so that its gap closes nowhere else.
  [[nodiscard]] bool ends_unloaded_only() const {
    const OpenContact& open = contacts_.front();
    const auto& law = law_->of(open.blade);
    const auto approach = [&](const FullState& state, const FullState& derivative) {
      const contact::Pose at = pose(open.blade, state);
      const double rate = at.tangential_velocity - blades_->speed(state[rotor::kTime]) * at.radial;
      return Gap{open.slip * at.tangential, open.slip * rate * step_.size() * derivative[rotor::kTime]};
    };
    const Gap begin = approach(step_.start(), step_.start_derivative());
    const Gap end = approach(step_.end(), step_.end_derivative());
    const double least = integrate::cubic_range(begin.value, begin.rate, end.value, end.rate).least;
    return 2.0 * least > law.length() * law.curve().at(bending_range().greatest).deflection;
  }
  /// g/Δ [m] of a carried contact by h = 0, which has no rounding down to u = 0, where both vanish.
  [[nodiscard]] double gap_per_deflection(double fraction) {
    const OpenContact& open = contacts_.front();
    const FullState state = at_fraction(fraction);
    return law_->of(open.blade)
        .gap_per_deflection(pose(open.blade, state), open.slip, state[rotor::kBending]);
  }

  /// Slip velocity of an open contact at the end of the step (or where the phase starts).
  [[nodiscard]] double slip_velocity(std::size_t contact) const {
    if constexpr (kBends) {
      return system_.last_force(contact).slip_velocity;
    } else {
      if constexpr (kCarried) {
        if (!kBesideOthers || contact == 0) return system_.last().force.slip_velocity;
      }
      return system_.forces()[contact].slip_velocity;
    }
  }

  /// What an open contact does in a state.
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    if constexpr (kSkims) return system_.force(state);
    if constexpr (kSticks || kBends) return system_.force(contact, state);
    const OpenContact& open = contacts_[contact];
    const contact::Pose at = pose(open.blade, state);
    if constexpr (kCarried) {
      if (!kBesideOthers || contact == 0) {
        return law_->of(open.blade)
            .constraint(at, open.slip, state[rotor::kBending], blades_->speed(state[rotor::kTime]))
            .force;
      }
    }
    contact::TipForce force{};
    OpenContact guess = system_.contacts()[contact];
    respond(law_->of(open.blade), at, blades_->speed(state[rotor::kTime]), guess, force);
    return force;
  }

  /// Largest δ/L of the open contacts at the end of the step.
  [[nodiscard]] double shortening() const {
    double largest = 0.0;
    if constexpr (kBends) {
      for (std::size_t i = 0; i < contacts_.size(); ++i)
        largest = std::max(largest, system_.last_force(i).shortening);
    } else {
      std::size_t solved = 0;
      if constexpr (kCarried) {
        largest = system_.last().force.shortening;
        solved = 1;
      }
      for (std::size_t i = solved; i < system_.forces().size(); ++i)
        largest = std::max(largest, system_.forces()[i].shortening);
    }
    return largest;
  }
  /// True where the root of the contact equation has been lost within the step: past it time runs backwards.
  [[nodiscard]] bool root_lost() const {
    if constexpr (kCarried) return step_.end_derivative()[rotor::kTime] <= 0.0;
    return false;
  }

  /// Whether a load may rise and fall again within the step: it follows the bending parameter where that is a
  /// state, the gap where the ring yields, and is to be looked at where it has been solved for.
  [[nodiscard]] bool load_may_peak(std::size_t contact, bool gap_peaks) const {
    if (kCarried && contact == 0)
      return step_.start_derivative()[rotor::kBending] > 0.0 && step_.end_derivative()[rotor::kBending] < 0.0;
    return !Law::kLoadFollowsGap || gap_peaks;
  }

  /// An open contact in a state, from where the next phase goes on.
  [[nodiscard]] OpenContact contact_in(std::size_t contact, const FullState& state) const {
    OpenContact open = contacts_[contact];
    if constexpr (kBends) {
      open.bending = state[System::modulus_of(contact)];
      open.amplitude = state[System::amplitude_of(contact)];
    } else {
      if constexpr (kCarried) {
        if (!kBesideOthers || contact == 0) {
          open.bending = state[rotor::kBending];
          return open;
        }
      }
      open.bending = system_.contacts()[contact].bending;
      open.amplitude = system_.contacts()[contact].amplitude;
    }
    return open;
  }

  /// Sets the clock back.
  void shift_time(double period) { step_.shift(rotor::kTime, -period); }

  [[nodiscard]] std::uint64_t evaluations() const { return system_.evaluations(); }
  [[nodiscard]] std::uint64_t accepted() const { return accepted_; }
  [[nodiscard]] std::uint64_t attempts() const { return accepted_ + rejected_; }
  [[nodiscard]] std::uint64_t rejected() const { return rejected_; }

 private:
  static constexpr double kFirstSize =
      0.1;  ///< of the scale; only the first contact of a point starts with it
  static constexpr double kSizesPerOctave = 8.0;                   ///< where they are coarse
  static constexpr double kSmallestSize = kBends ? 1e-12 : 1e-15;  ///< in σ
  static constexpr double kFoldResolution = 1e-6;                  ///< of the scale
  static constexpr double kFractionResolution = 1e-14;
  static constexpr double kFromTouchDown = 0.01;  ///< of dτ/dσ at the end of a step, that at its start
  static constexpr double kAimBehind = 1.05;      ///< of the way to lift-off
  static constexpr double kBendingWeight = 0.3;   ///< of the relative error of u against that of the state
  static constexpr double kWellDetermined =
      1e-2;  ///< of |∂h/∂u| against |dh/dτ|; near lift-off u carries the clock

  /// What the attempt before has cost, and all that was asked of its step. Attempts of a carried contact all
  /// have one price: whether they are made in lanes must not show.
  [[nodiscard]] std::int64_t price_of_last_attempt() {
    const auto contacts = static_cast<std::int64_t>(contacts_.size());
    const std::int64_t price = WorkPrice::kAttempt + contacts * WorkPrice::kForce;
    return kCarried ? price : price + price_of_curves();
  }
  /// Of the evaluations of curves that are not paid yet.
  [[nodiscard]] std::int64_t price_of_curves() {
    const std::uint64_t evaluations = curve_evaluations(*law_);
    const auto unpaid = static_cast<std::int64_t>(evaluations - paid_evaluations_);
    paid_evaluations_ = evaluations;
    return unpaid * price_of_curve<Law>();
  }

  /// Scale on which the motion varies where the blade is bent by u [in σ]: the distance of u to the curve's
  /// singularities ±iβ. Where forces are solved for, σ = τ has no scale of its own.
  [[nodiscard]] double scale(double bending) const {
    if constexpr (kCarried) {
      const double load_angle = law_->of(contacts_.front().blade).curve().load_angle();
      // The column (μ = 0) has none but ψL = π.
      const double width = load_angle > 0.0 ? load_angle : 1.0;
      return std::sqrt(width * width + bending * bending);
    }
    return 1.0;
  }

  /// The control's share of the scale, which is taken in the middle of the step, as far as the rate of u
  /// tells where that is.
  [[nodiscard]] double proposed_size() const {
    const double bending = step_.start()[rotor::kBending];
    const double rate = step_.start_derivative()[rotor::kBending];
    double size = control_.relative_size() * scale(bending);
    if constexpr (kCarried) {
      for (int i = 0; i < 2; ++i) {
        size = control_.relative_size() * scale(std::max(0.0, bending + 0.5 * size * rate));
      }
    }
    if constexpr (kCoarseSizes)
      return std::exp2(std::floor(kSizesPerOctave * std::log2(size)) / kSizesPerOctave);
    return size;
  }

  [[nodiscard]] contact::Pose pose(int blade, const FullState& state) const {
    return pose(blade, state, first_blade(state));
  }
  [[nodiscard]] contact::Pose pose(int blade, const FullState& state,
                                   const contact::BladeDirection& first) const {
    return rotor::pose_of(*rotor_, law_->of(blade).geometry(), blades_->direction(blade, first),
                          rotor::from_ring(state));
  }

  bool make_dense() {
    if constexpr (kBends) {
      system_.keep();
      const bool made = step_.make_dense(system_);
      system_.restore();
      return made;
    } else if constexpr (kCarried && !kBesideOthers) {
      return step_.make_dense(system_);
    } else {
      guesses_ = system_.contacts();
      const bool made = step_.make_dense(system_);
      system_.restore(guesses_);
      return made;
    }
  }

  /// Fraction where a component passes through a value, in a step at whose end it has come to it.
  [[nodiscard]] double crossing_of(Eigen::Index component, double value) {
    if (!make_dense()) return 1.0;
    const auto place = static_cast<int>(component);
    // The step of the touch-down starts at u = 0, too.
    const bool unloaded = value == 0.0 && step_.start()[component] <= 0.0;
    const auto excess = [&](double part) {
      return unloaded ? step_.mean_slope(part, place) : step_.interpolate(part, place) - value;
    };
    return integrate::root_between(excess, 0.0, 1.0, excess(0.0), excess(1.0));
  }
  /// Fraction where a contact's equilibrium ends in a fold, in a step that has passed it.
  [[nodiscard]] double fold_fraction(std::size_t contact) {
    if (!make_dense()) return 1.0;
    const auto determinant = [&](double part) {
      return system_.determinant(contact, step_.interpolate(part));
    };
    const double at_end = determinant(1.0);
    // D vanishes at the unloaded blade where a contact may start, too.
    const double at_begin = step_.start()[System::amplitude_of(contact)] > 0.0 ? determinant(0.0) : -at_end;
    if (!(at_begin > 0.0)) return 0.0;
    return integrate::root_between(determinant, 0.0, 1.0, at_begin, at_end);
  }

  /// False where a stage finds no force, or where the meter ends the revolution: one stage of many blades
  /// whose forces are searched for can take milliseconds.
  bool attempt(double size, WorkMeter& meter) {
    if constexpr (kCarried || Law::kLoadFollowsGap) {
      return step_.attempt(system_, size);
    } else {
      auto watched = [&, this](const FullState& state, FullState& derivative) {
        if (!meter.spend(Work::contact, price_of_curves()) || !system_(state, derivative)) return false;
        stage_shortening_ = std::max(stage_shortening_, shortening());
        return true;
      };
      return step_.attempt(watched, size);
    }
  }

  /// Local error of the step in units of the tolerance: of the state at fixed time, of the time along the
  /// path, and of the bending parameter on its own scale. Each of them passes through zero at places, the sum
  /// does not.
  [[nodiscard]] double scaled_error() const {
    const FullState& end = step_.end();
    const Bodies rate = rotor::rate_of(end, system_.last_acceleration());
    const double fastest = rate.abs().maxCoeff();
    double bending_weight = kBends ? kBendingWeight * rotor_->length_scale : 0.0;
    if constexpr (kCarried) {
      bending_weight = kBendingWeight * rotor_->length_scale /
                       std::min(scale(step_.start()[rotor::kBending]), scale(end[rotor::kBending]));
    }
    const double estimate = step_.error_estimate([&](const FullState& difference) {
      // An error of the time is an error of the state along its path.
      const double time = difference[rotor::kTime];
      const double along = fastest * time;
      const Bodies state = rotor::bodies(difference) - rate * time;
      double of_bending = 0.0;
      if constexpr (kBends) {
        of_bending = difference.tail(difference.size() - rotor::kFirstBend).square().sum();
        of_bending *= bending_weight * bending_weight;
      } else {
        const double bending = bending_weight * difference[rotor::kBending];
        of_bending = bending * bending;
      }
      return std::sqrt(state.square().sum() + along * along + of_bending);
    });
    return estimate / ((force_is_smooth() ? Pair::kEstimateExcess : 1.0) * tolerance_);
  }

  /// Whether no force starts or ends like a root of the time. One that does, as those that are solved for,
  /// has errors as large as their estimate; those of a smooth one are `kEstimateExcess` times smaller.
  [[nodiscard]] bool force_is_smooth() const {
    if constexpr (kSticks) {
      return std::ranges::all_of(contacts_, [](const OpenContact& open) { return open.slip == 0.0; });
    }
    return kTimeTurns || kSkims || Law::kLoadFollowsGap;
  }

  /// A step from rising load to beyond lift-off. Its error may be small at its end, but lift-off would be
  /// read from the middle of dense output, whose order is one less.
  [[nodiscard]] bool holds_whole_contact() const {
    if constexpr (kBends) {
      for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const auto amplitude = System::amplitude_of(i);
        if (step_.end()[amplitude] <= 0.0 && step_.start_derivative()[amplitude] > 0.0 &&
            step_.size() > kSmallestSize)
          return true;
      }
    }
    return passes_lift_off() && step_.start_derivative()[rotor::kBending] > 0.0 &&
           step_.size() > kSmallestSize;
  }

  /// A step past the fold of the contact equation, where time turns round: what ends the contact before it
  /// would be looked for on a path that leads there and back. Only a fold that short steps reach too has lost
  /// the root.
  [[nodiscard]] bool passes_fold() const {
    return !kReleasesAtFold && !may_snap(0) && root_lost() && !passes_lift_off() &&
           step_.size() > kFoldResolution * scale(step_.start()[rotor::kBending]);
  }

  /// A step that has passed the fold at which a branch ends, and the one where the next begins: its end does
  /// not tell.
  [[nodiscard]] bool passes_two_folds() const {
    if constexpr (kBesideOthers) {
      return system_.has_met_fold() && !passes_release() && !passes_lift_off() &&
             step_.size() > kSmallestSize;
    }
    return false;
  }

  /// A step in which time may turn round twice, as the cubic through its ends has it.
  [[nodiscard]] bool time_turns() const {
    if constexpr (kTimeTurns) {
      if (passes_lift_off() || !(step_.end_derivative()[rotor::kTime] > 0.0)) return false;
      const double begin = step_.size() * step_.start_derivative()[rotor::kTime];
      const double end = step_.size() * step_.end_derivative()[rotor::kTime];
      // From a touch-down time starts as a power of σ up to the fourth, which is no cubic.
      if (begin < kFromTouchDown * end) return false;
      return !(3.0 * (step_.end()[rotor::kTime] - step_.start()[rotor::kTime]) > begin + end) &&
             step_.size() > kFoldResolution * scale(step_.start()[rotor::kBending]);
    }
    return false;
  }

  /// A step beyond the end of the blade's table, far outside of the model's validity: what is continued there
  /// says nothing.
  [[nodiscard]] bool leaves_curve() const {
    if constexpr (kCarried)
      return step_.end()[rotor::kBending] > law_->of(contacts_.front().blade).curve().end();
    return false;
  }

  /// Lets the step that would pass lift-off end just behind it, and the two before share what is left evenly.
  /// A step far past u = 0 is wasted, and dense output is at its best near the ends of a step.
  [[nodiscard]] double aimed_at_lift_off(double size) const {
    if constexpr (kBends) {
      for (std::size_t i = 0; i < contacts_.size(); ++i) size = aimed_at_zero(System::amplitude_of(i), size);
    } else if constexpr (kCarried) {
      return aimed_at_zero(rotor::kBending, size);
    }
    return size;
  }
  [[nodiscard]] double aimed_at_zero(Eigen::Index component, double size) const {
    const double bending = step_.start()[component];
    const double rate = step_.start_derivative()[component];
    if (!(rate < 0.0) || !(bending > 0.0)) return size;
    const double remaining = kAimBehind * bending / -rate;
    if (remaining <= size) return remaining;
    return remaining < 2.0 * size ? 0.5 * remaining : size;
  }

  /// Moves the bending parameter back onto h = 0 by one Newton step, where h determines it well.
  void project() {
    const auto& last = system_.last();
    if (-last.bending_slope > std::abs(last.time_slope) * kWellDetermined) {
      step_.end()[rotor::kBending] -= last.residual / last.bending_slope;
    }
  }

  const rotor::RotorConstants* rotor_;
  const Blades* blades_;
  const Law* law_;
  double tolerance_;
  System system_;
  integrate::RungeKutta<Pair, FullState::RowsAtCompileTime, FullState::MaxRowsAtCompileTime> step_;
  integrate::StepControl control_;
  std::vector<OpenContact> contacts_;
  std::vector<OpenContact> guesses_;
  double end_shortening_ = 0.0;    ///< δ/L at the end of the step
  double stage_shortening_ = 0.0;  ///< and the largest of its stages
  std::uint64_t accepted_ = 0;
  std::uint64_t began_ = 0;  ///< accepted before the present phase
  std::uint64_t rejected_ = 0;
  std::uint64_t paid_evaluations_ = 0;  ///< of curves, whose price the meter knows
};

}  // namespace rubatlas::modes
