/// The search for the first guard of a mode within a step.
///
/// A guard is a function of the state that is negative while the mode lasts and passes through zero where the
/// mode ends. Each mode knows its guards (`guards.hpp` has those that several modes share). This search finds
/// the first of them in time, on the step's dense output, so that no step is repeated to find one.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "contact/pose.hpp"
#include "integrate/controlled_step.hpp"
#include "integrate/cubic_range.hpp"
#include "integrate/first_crossing.hpp"
#include "modes/phase.hpp"

namespace rubatlas::compared {

using namespace modes;  // phases in steps are phases of a motion

/// g and dg/dτ of a blade.
struct BladeGap {
  double value;  ///< [m²]
  double rate;   ///< [m² per unit τ]
};

/// Values of one blade that are kept from step to step.
struct WatchedBlade {
  bool open = false;    ///< in contact
  BladeGap at_start{};  ///< of the step
  BladeGap at_end{};
  double slip_velocity = 0.0;  ///< v at the start of the step, of open contacts [m per unit τ]
  double end_slip_velocity = 0.0;
};

template <class Mode>
class GuardSearch {
 public:
  using Step = integrate::ControlledStep<Mode>;
  using FullState = typename Mode::FullState;

  GuardSearch(Mode& mode, Step& step, int blades)
      : mode_(&mode), step_(&step), watched_(static_cast<std::size_t>(blades)) {}

  /// A mode begins where the step starts. `slip_rounding`: |v| below it is zero; the sign of such a tip's
  /// slip is that at the end of the first step.
  void begin(double slip_rounding) {
    for (int k = 0; k < static_cast<int>(watched_.size()); ++k) {
      blade(k).open = false;
      blade(k).at_start = mode_->gap(k, step_->start());
    }
    for (std::size_t i = 0; i < mode_->contacts().size(); ++i) {
      const double velocity = mode_->slip_velocity(i);
      of_contact(i).open = true;
      of_contact(i).slip_velocity = std::abs(velocity) > slip_rounding ? velocity : 0.0;
    }
  }
  /// The next step starts at the end of this one.
  void go_on() {
    for (WatchedBlade& watched : watched_) {
      watched.at_start = watched.at_end;
      watched.slip_velocity = watched.end_slip_velocity;
    }
  }

  /// Finds what ends the mode in the step just made: `Guard::horizon` at fraction 1 where nothing does.
  void find() {
    end_ = {Guard::horizon};
    fraction_ = 1.0;
    for (std::size_t i = 0; i < mode_->contacts().size(); ++i)
      of_contact(i).end_slip_velocity = mode_->slip_velocity(i);
    const FullState& end = step_->end();
    for (int k = 0; k < static_cast<int>(watched_.size()); ++k) blade(k).at_end = mode_->gap(k, end);
    mode_->guards(*this);
  }

  /// What has been found, and where.
  [[nodiscard]] const ModeEnd& end() const { return end_; }
  [[nodiscard]] double fraction() const { return fraction_; }

  // For the modes.

  [[nodiscard]] Step& step() { return *step_; }
  [[nodiscard]] WatchedBlade& blade(int k) { return watched_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] const WatchedBlade& blade(int k) const { return watched_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] WatchedBlade& of_contact(std::size_t contact) {
    return blade(mode_->contacts()[contact].blade);
  }
  [[nodiscard]] const WatchedBlade& of_contact(std::size_t contact) const {
    return watched_[static_cast<std::size_t>(mode_->contacts()[contact].blade)];
  }
  [[nodiscard]] int blades() const { return static_cast<int>(watched_.size()); }
  void take_if_first(double fraction, const ModeEnd& end) {
    if (fraction < fraction_ || (fraction == fraction_ && end_.guard == Guard::horizon)) {
      fraction_ = fraction;
      end_ = end;
    }
  }

  /// The first crossing of a function of the fraction ends the mode. The function is evaluated at both ends
  /// of the search, too.
  template <class Function>
  void look_for(const Function& function, const ModeEnd& end) {
    look_between(function, {function(0.0), function(1.0)}, end);
  }
  struct Ends {
    double start;
    double end;
  };
  /// The same where its values at the ends are known.
  template <class Function>
  void look_between(const Function& function, const Ends& ends, const ModeEnd& end, double rounding = 0.0) {
    if (const auto found = integrate::first_crossing(function, 0.0, 1.0, ends.start, ends.end, rounding))
      take_if_first(*found, end);
  }

  /// Looks for the return to zero of a gap that starts at zero, up to rounding, and is negative at first. The
  /// gap is divided by the fraction of the step, so that the start is no root. Near the start this division
  /// magnifies rounding. So only a gap of more than its rounding is taken for a crossing, and one secant step
  /// leads back from there to the zero of the gap.
  template <class Function>
  void look_from_zero(const Function& gap, double at_end, const ModeEnd& end) {
    constexpr double kJustBefore = 1.0 / 1024;
    const double rounding = mode_->gap_rounding();
    const auto beyond = [&](double part) { return (gap(part) - rounding) / part; };
    const double end_value = at_end - rounding;
    const auto found = integrate::first_crossing(beyond, 0.0, 1.0, -std::abs(end_value), end_value);
    if (!found) return;
    const double rise = gap(*found) - gap((1.0 - kJustBefore) * *found);
    const double back = kJustBefore * *found * rounding / rise;
    take_if_first(back > 0.0 && back < *found ? *found - back : *found, end);
  }

 private:
  Mode* mode_;
  Step* step_;
  std::vector<WatchedBlade> watched_;  ///< one per blade
  ModeEnd end_{Guard::horizon};
  double fraction_ = 1.0;
};

}  // namespace rubatlas::compared
