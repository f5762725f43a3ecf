/// The bound of the work in one revolution, and the place where a long revolution can be given up.
///
/// Work is counted, not timed, so that the end of a point does not depend on the speed of the machine. Its
/// unit is roughly a nanosecond of a processor core at full optimisation. Work is the sum of the counts of a
/// motion's operations (attempts of steps, evaluations of a blade's curve and of gaps, events), each times
/// its measured price.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "ending/status.hpp"

namespace rubatlas::modes {

/// Asked after each revolution, and within a long one after every few milliseconds of work: false gives the
/// point up, whose status stays `pending`. An empty function is not called. It must not throw.
using GoOn = std::function<bool()>;

enum class Work : std::uint8_t { contact, flight, events };

/// What one piece of work costs [ns]: rounded up from measurements of 271 random scenes at -O3 on one core.
struct WorkPrice {
  static constexpr std::int64_t kAttempt = 1'500;  ///< an attempt of a step, without its forces
  static constexpr std::int64_t kForce =
      1'000;  ///< the force of a contact in it, without evaluations of a curve
  static constexpr std::int64_t kCurve =
      60;  ///< an evaluation of a blade's curve from its table, under an axial load
  static constexpr std::int64_t kInclinedCurve = 500;  ///< the same by quadrature, under an inclined load
  static constexpr std::int64_t kGap = 300;      ///< the gap of a blade in flight, without the shaft's state
  static constexpr std::int64_t kState = 50;     ///< the state of an isotropic shaft in flight
  static constexpr std::int64_t kEvent = 1'200;  ///< touch-down, lift-off, slip reversal: a change of phase
};

/// How much work is allowed [ns].
struct WorkBound {
  std::int64_t revolution;          ///< one revolution
  std::int64_t point;               ///< a point, or, if that is more,
  std::int64_t of_each_revolution;  ///< so much for each revolution that it has begun
};
inline constexpr WorkBound kWorkBound{2'000'000'000, 2'000'000'000, 100'000'000};

class WorkMeter {
 public:
  explicit WorkMeter(const WorkBound& bound = kWorkBound) : bound_(&bound) {}

  void begin_revolution(const GoOn& go_on);

  /// Adds to the work done; false where the revolution is to end here.
  bool spend(Work kind, std::int64_t price) {
    spent_[static_cast<std::size_t>(kind)] += price;
    until_look_ -= price;
    return until_look_ > 0 || look();
  }
  [[nodiscard]] bool ended() const { return why_ != ending::StatusDetail::none; }
  /// What ended the revolution.
  [[nodiscard]] ending::StatusDetail why() const { return why_; }
  /// All work done, in the revolutions before, too [ns].
  [[nodiscard]] std::int64_t total() const;

 private:
  bool look();

  const WorkBound* bound_;
  std::int64_t revolutions_ = 0;               ///< begun
  std::int64_t allowed_ = bound_->revolution;  ///< in this revolution
  std::int64_t until_look_ = 0;
  std::array<std::int64_t, 3> spent_{};  ///< in this revolution
  std::int64_t spent_before_ = 0;        ///< in the revolutions before
  const GoOn* go_on_ = nullptr;
  ending::StatusDetail why_ = ending::StatusDetail::none;
};

}  // namespace rubatlas::modes
