/// Steps of a Runge–Kutta pair that keep a tolerance, of any system that says how its steps are judged.
///
/// This class knows states, error control and dense output, and no rotor. A `System` writes derivatives
/// (`bool system(const State&, State&)`; false: there is none, and the attempt is rejected) and answers these
/// questions about its steps:
///
///     kSmallestSize                     the shortest step
///     has_coarse_sizes()                whether sizes start from a power of four
///     begins_step(state)                a step starts there
///     takes_back()                      the attempt is rejected: first guesses as at the start of the step
///     begins_attempt(), is_stopped()    whether there is work left to spend on an attempt
///     proposed_size(step, relative)     the size, from the share of the system's own scale that is allowed
///     scaled_error(step)                local error in units of the tolerance
///     accepted(), goes_on()             the step counts; the next one starts at its end
///     project(state)                    moves the end of a step onto the system's constraints
///     place(state)                      the same for a state of dense output
///     keep(), restore()                 called around dense output, which must not change the system
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

#include "integrate/runge_kutta.hpp"
#include "integrate/step_control.hpp"

namespace rubatlas::integrate {

template <class System>
class ControlledStep {
 public:
  using State = typename System::FullState;

  /// `system`, and what the tableau of the pair points at, must outlive the steps.
  ControlledStep(System& system, const Tableau& pair)
      : system_(&system), step_(pair), control_(pair.order, kFirstSize) {}

  /// Starts a series of steps from a state. False where it has no derivative.
  bool begin(const State& state) {
    control_.begin_phase();
    if (system_->has_coarse_sizes()) control_.round_size();
    return step_.begin(*system_, state);
  }

  enum class Outcome : std::uint8_t { accepted, no_derivative, too_short, stopped };

  /// Makes one step that keeps the tolerance, unless the system stops it.
  Outcome make() {
    system_->begins_step(step_.start());
    while (true) {
      const double size = system_->proposed_size(step_, control_.relative_size());
      if (!system_->begins_attempt()) return Outcome::stopped;
      const bool evaluated = step_.attempt(*system_, size);
      if (system_->is_stopped()) return Outcome::stopped;
      const double error = evaluated ? system_->scaled_error(step_) : std::numeric_limits<double>::infinity();
      if (StepControl::acceptable(error)) {
        ++accepted_;
        control_.accept(error);
        system_->accepted();
        system_->project(step_.end());
        return Outcome::accepted;
      }
      control_.reject(error);
      ++rejected_;
      system_->takes_back();
      if (!(size > System::kSmallestSize)) return evaluated ? Outcome::too_short : Outcome::no_derivative;
    }
  }

  /// Takes back the step just made, within which dense output cannot be evaluated: the next attempt is half
  /// as long. False where half the step would be too short.
  bool take_back() {
    if (!(step_.size() > System::kSmallestSize)) return false;
    --accepted_;
    ++rejected_;
    control_.halve();
    system_->takes_back();
    return true;
  }

  /// Goes on from the end of the step.
  void accept() {
    step_.accept();
    system_->goes_on();
  }

  [[nodiscard]] const State& start() const { return step_.start(); }
  [[nodiscard]] const State& end() const { return step_.end(); }
  [[nodiscard]] const State& start_derivative() const { return step_.start_derivative(); }
  [[nodiscard]] const State& end_derivative() const { return step_.end_derivative(); }
  [[nodiscard]] double size() const { return step_.size(); }

  /// State at the fraction θ in [0, 1]; NaN where a stage of dense output has no derivative.
  [[nodiscard]] State at_fraction(double fraction) {
    if (fraction == 0.0) return step_.start();
    if (fraction == 1.0) return step_.end();
    if (!make_dense()) {
      return State::Constant(step_.end().size(), std::numeric_limits<double>::quiet_NaN());
    }
    State state = step_.interpolate(fraction);
    system_->place(state);
    return state;
  }
  /// d/dθ of a component.
  [[nodiscard]] double slope(double fraction, int component) {
    if (fraction == 0.0) return step_.size() * step_.start_derivative()[component];
    if (fraction == 1.0) return step_.size() * step_.end_derivative()[component];
    return make_dense() ? step_.slope(fraction, component) : std::numeric_limits<double>::quiet_NaN();
  }

  /// Moves the origin of a component.
  void shift(int component, double amount) { step_.shift(component, amount); }

  [[nodiscard]] std::uint64_t accepted() const { return accepted_; }
  [[nodiscard]] std::uint64_t rejected() const { return rejected_; }

 private:
  static constexpr double kFirstSize = 0.1;  ///< of the scale; only the first step of a point starts with it

  bool make_dense() {
    if (step_.is_dense()) return true;
    system_->keep();
    const bool made = step_.make_dense(*system_);
    system_->restore();
    return made;
  }

  System* system_;
  RungeKuttaStep<State::RowsAtCompileTime, State::MaxRowsAtCompileTime> step_;
  StepControl control_;
  std::uint64_t accepted_ = 0;
  std::uint64_t rejected_ = 0;
};

}  // namespace rubatlas::integrate
