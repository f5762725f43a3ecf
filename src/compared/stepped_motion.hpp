/// The motion of the rotor in steps over flight and contact alike: what people write first, what a general
/// library does, and what was published. The hybrid method (`motion.hpp`) is compared with these.
///
/// A scheme says which Runge–Kutta coefficients (`Table`), how a blade's force is found (`Search`), whether
/// steps follow an error estimate (`kAdaptive`) and whether they end at events (`kLocated`). Without,
/// contacts open, close and reverse at the ends of steps, and within a step the sign of g decides where it is
/// asked for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "compared/stepped_events.hpp"
#include "compared/stepped_system.hpp"
#include "ending/status.hpp"
#include "integrate/runge_kutta.hpp"
#include "integrate/step_factor.hpp"
#include "modes/motion_listener.hpp"
#include "modes/seen_tip.hpp"
#include "modes/work_meter.hpp"
#include "motion/point_motion.hpp"
#include "motion/work_counts.hpp"
#include "rotor/machine.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::compared {

struct SteppedLimits {
  double tolerance;       ///< local error of a step [m]; not read by fixed steps
  double longest_step;    ///< in τ; the step itself where steps are fixed
  double max_shortening;  ///< of δ/L [-]
};

/// Its blades are alike.
template <class Scheme>
class SteppedMotion final : public motion::PointMotion, public trajectory::MotionPiece {
 public:
  SteppedMotion(rotor::Machine machine, std::unique_ptr<collocation::Law> law, typename Scheme::Search search,
                const SteppedLimits& limits)
      : machine_(std::move(machine)),
        law_(std::move(law)),
        limits_(limits),
        steps_in_revolution_(std::ceil(machine_.constants.period() / limits.longest_step)),
        system_(machine_, *law_, std::move(search)),
        size_(machine_.constants.period() / steps_in_revolution_) {}
  SteppedMotion(const SteppedMotion&) = delete;  // parts point at each other
  SteppedMotion& operator=(const SteppedMotion&) = delete;

  /// Starts at phase 0; blades with g > 0 are in contact (MODEL 4.4).
  ending::StatusDetail start(const motion::PointStart& start) override {
    if (start.blade >= 0) throw std::logic_error("this motion does not start at a touch-down");
    SteppedState full;
    full << rotor::as_state(start.state), 0.0;
    if (!full.isFinite().all()) return ending::StatusDetail::beyond_precision;
    for (std::size_t k = 0; k < system_.blades().size(); ++k) {
      const contact::Pose at = system_.pose(k, full);
      system_.blades()[k] = {at.gap > 0.0, system_.opening_slip(at)};
    }
    return begin(full);
  }

  /// One revolution.
  ending::StatusDetail revolution(modes::MotionListener& listener, const modes::GoOn& go_on,
                                  int /*number*/) override {
    const double period = machine_.constants.period();
    meter_.begin_revolution(go_on);
    for (std::int64_t step = 1;; ++step) {
      ending::StatusDetail why = make_step(static_cast<double>(step), period);
      if (why == ending::StatusDetail::none) why = finish_step(listener);
      if (why != ending::StatusDetail::none) return why;
      if (step_.start()[kSteppedTime] >= period) {
        step_.shift(kSteppedTime, -period);
        ++work_.revolutions;
        return ending::StatusDetail::none;
      }
    }
  }

  [[nodiscard]] rotor::ShaftAndRing state() const override {
    return rotor::shaft_and_ring(step_.start().template head<4>());
  }

  [[nodiscard]] motion::WorkCounts work() const override {
    motion::WorkCounts result = work_;
    result.right_hand_sides = system_.evaluations();
    result.elastica_evaluations = law_->evaluations();
    result.price = meter_.total();
    return result;
  }

  // The piece of motion that is being recorded: the step, up to its event. Its contacts are those of its
  // start.
  [[nodiscard]] double begin() const override { return step_.start()[kSteppedTime]; }
  [[nodiscard]] double end() const override { return end_time_; }
  [[nodiscard]] trajectory::State state(double time) override {
    return rotor::as_array(rotor::State(state_at((time - begin()) / step_.size()).template head<4>()));
  }
  [[nodiscard]] double displacement_bound() const override { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] std::size_t contact_count() const override { return open_.size(); }
  [[nodiscard]] int blade(std::size_t contact) const override { return static_cast<int>(open_[contact]); }
  /// Without located events a peak is what the ends of steps have seen.
  [[nodiscard]] bool load_peaks(std::size_t /*contact*/) const override { return Scheme::kLocated; }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, double time) override {
    const std::size_t k = open_[contact];
    const SteppedState full = state_at((time - begin()) / step_.size());
    const contact::TipForce force = system_.force(k, full);
    const contact::BladeDirection er =
        machine_.blades.direction(blade(contact), machine_.blades.first(full[kSteppedTime]));
    const double slip = before_[k].slip;
    return modes::contact_force(force, slip, law_->friction().coefficient(force.slip_velocity, slip), er,
                                system_.pose(k, full), machine_.constants.speed_ratio);
  }
  [[nodiscard]] trajectory::Tip tip(int blade, double time) override {
    const SteppedState full = state_at((time - begin()) / step_.size());
    return modes::tip_of(law_->geometry(blade), system_.pose(static_cast<std::size_t>(blade), full),
                         machine_.constants.speed_ratio);
  }

 private:
  using System = SteppedSystem<typename Scheme::Search, Scheme::kLocated>;

  static constexpr double kSmallestSize = 1e-15;  ///< in τ
  static constexpr modes::WorkBound kWorkBound{10'000'000'000, 40'000'000'000, 2'000'000'000};

  /// Counts what the attempt before has cost; false where the revolution is to end here.
  bool spend() {
    const std::uint64_t evaluations = law_->evaluations();
    const auto blades = static_cast<std::int64_t>(system_.blades().size());
    const std::int64_t price =
        modes::WorkPrice::kAttempt + blades * modes::WorkPrice::kGap +
        static_cast<std::int64_t>(evaluations - paid_evaluations_) * modes::WorkPrice::kCurve;
    paid_evaluations_ = evaluations;
    return meter_.spend(modes::Work::contact, price);
  }

  /// Goes on from a state whose right-hand side has not been evaluated yet, unless something stands against
  /// it: contacts that have just changed may bend a blade too far at once.
  ending::StatusDetail begin(const SteppedState& state) {
    if (!step_.begin(system_, state)) return ending::StatusDetail::no_equilibrium;
    if (system_.shortening() > limits_.max_shortening) return ending::StatusDetail::shortening_limit;
    look_around();
    return ending::StatusDetail::none;
  }

  /// Takes down how the blades stand at the start of a step.
  void look_around() {
    before_ = system_.blades();
    open_.clear();
    for (std::size_t k = 0; k < before_.size(); ++k) {
      if (before_[k].open) open_.push_back(k);
      // A tip whose slip has just reversed may stand at v = 0 to rounding: it has no sign yet.
      const double rounding =
          contact::kSlipRounding * machine_.constants.speed_ratio * law_->geometry(0).ring_radius;
      if (std::abs(before_[k].slip_velocity) <= rounding) before_[k].slip_velocity = 0.0;
    }
  }

  /// The `number`-th step of a revolution, counted from 1.
  ending::StatusDetail make_step(double number, double period) {
    if constexpr (!Scheme::kAdaptive) {
      if (!spend()) return meter_.why();
      if (!step_.attempt(system_, size_)) return why_not();
      step_.end()[kSteppedTime] = number == steps_in_revolution_ ? period : size_ * number;
      return ending::StatusDetail::none;
    } else {
      const double remaining = period - step_.start()[kSteppedTime];
      while (true) {
        // The last steps of a revolution share what remains and end with it.
        const double wanted = std::min(size_, limits_.longest_step);
        double size = wanted;
        const bool last = remaining <= size;
        if (last) {
          size = remaining;
        } else if (remaining < 2.0 * size) {
          size = 0.5 * remaining;
        }
        if (!spend()) return meter_.why();
        const bool evaluated = step_.attempt(system_, size);
        const double error = evaluated ? scaled_error() : std::numeric_limits<double>::infinity();
        const double proposed = size * integrate::step_factor(error, Scheme::Table::kEstimatePower);
        if (error <= 1.0) {
          // A step that was cut short does not make the next one shorter.
          size_ = size < wanted ? std::max(proposed, wanted) : proposed;
          if (last) step_.end()[kSteppedTime] = period;
          return ending::StatusDetail::none;
        }
        ++work_.rejected_steps;
        system_.blades() = before_;
        size_ = proposed;
        if (!(size_ > kSmallestSize)) return evaluated ? ending::StatusDetail::step_too_short : why_not();
      }
    }
  }

  /// Why the last step could not be made.
  ending::StatusDetail why_not() {
    return step_.start().isFinite().all() ? ending::StatusDetail::no_equilibrium
                                          : ending::StatusDetail::beyond_precision;
  }

  [[nodiscard]] double scaled_error() const {
    const double estimate = step_.error_estimate(
        [](const SteppedState& difference) { return difference.template head<4>().abs().maxCoeff(); });
    return estimate / limits_.tolerance;
  }

  [[nodiscard]] SteppedState state_at(double fraction) {
    if (fraction <= 0.0) return step_.start();
    if (fraction >= 1.0) return step_.end();
    step_.make_dense(system_);  // needs no evaluation in any of the schemes
    return step_.interpolate(fraction);
  }

  /// Looks at what happened in the step, hands it over, and goes on from its end or its event.
  ending::StatusDetail finish_step(modes::MotionListener& listener) {
    ++work_.steps;
    SteppedEvent event;
    if (Scheme::kLocated)
      event = first_event(system_, before_, [this](double part) { return state_at(part); });
    const bool cut = event.fraction < 1.0;
    const SteppedState end = state_at(event.fraction);
    if (!end.isFinite().all()) return ending::StatusDetail::beyond_precision;
    if (std::hypot(end[0], end[1] + machine_.constants.misalignment) >= law_->geometry(0).ring_radius)
      return ending::StatusDetail::shaft_at_ring;
    if (!cut && system_.shortening() > limits_.max_shortening) return ending::StatusDetail::shortening_limit;
    end_time_ = end[kSteppedTime];
    if (end_time_ > begin()) listener.piece(*this);
    bool changed = cut;
    if (Scheme::kLocated) {
      if (event.kind != modes::Guard::horizon) {
        if (!meter_.spend(modes::Work::events, modes::WorkPrice::kEvent)) return meter_.why();
        change(event.kind, event.blade, end, listener);
        changed = true;
      }
    } else {
      changed = change_at_end(end, listener);
    }
    if (changed) return begin(end);
    step_.accept();
    look_around();
    return ending::StatusDetail::none;
  }

  /// Opens, closes and reverses contacts by what the end of a step shows. True where that changes the force
  /// there.
  bool change_at_end(const SteppedState& end, modes::MotionListener& listener) {
    bool changed = false;
    for (std::size_t k = 0; k < before_.size(); ++k) {
      const SteppedBlade after = system_.blades()[k];
      const bool touches = after.gap > 0.0;
      if (touches != after.open) {
        change(touches ? modes::Guard::touch_down : modes::Guard::lift_off, k, end, listener);
      } else if (touches && before_[k].slip_velocity * after.slip_velocity < 0.0) {
        change(modes::Guard::slip_reversal, k, end, listener);
        changed = true;
      }
    }
    return changed;
  }

  void change(modes::Guard kind, std::size_t k, const SteppedState& at, modes::MotionListener& listener) {
    SteppedBlade& blade = system_.blades()[k];
    const double slip_before = blade.slip;
    if (kind == modes::Guard::slip_reversal) {
      ++work_.slip_reversals;
      blade.slip = -blade.slip;
    } else if (kind == modes::Guard::lift_off) {
      ++work_.liftoffs;
      blade = {};
    } else {
      ++work_.touchdowns;
      blade.open = true;
      blade.slip = system_.opening_slip(system_.pose(k, at));
    }
    listener.event(modes::Event{kind, static_cast<int>(k), at[kSteppedTime],
                                kind == modes::Guard::lift_off ? slip_before : blade.slip,
                                at.template head<4>()});
  }

  rotor::Machine machine_;
  std::unique_ptr<collocation::Law> law_;
  SteppedLimits limits_;
  double steps_in_revolution_;  ///< of the longest step, a whole number
  System system_;
  integrate::RungeKutta<typename Scheme::Table, 5> step_;
  double size_;                       ///< of the next step
  double end_time_ = 0.0;             ///< of the piece
  std::vector<SteppedBlade> before_;  ///< at the start of the step
  std::vector<std::size_t> open_;     ///< blades in contact there
  modes::WorkMeter meter_{kWorkBound};
  std::uint64_t paid_evaluations_ = 0;  ///< of curves, whose price the meter knows
  motion::WorkCounts work_;
};

}  // namespace rubatlas::compared
