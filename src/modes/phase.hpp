/// One phase in contact: the motion in one mode, from a reset to the next guard. Who makes the phases of a
/// motion, and from what.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "ending/status.hpp"
#include "modes/motion_listener.hpp"
#include "modes/rest_judge.hpp"
#include "modes/work_meter.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

/// How a mode ended; `blade` is −1 where the end is no event of a single blade.
struct ModeEnd {
  Guard guard;
  int blade = -1;
  ending::StatusDetail why = ending::StatusDetail::none;  ///< where the motion ends
};

/// Also the piece of motion that is being recorded.
class Phase : public trajectory::MotionPiece {
 public:
  /// Starts at time τ of the revolution, or says why the mode cannot start there: contacts that have just
  /// changed may bend a blade too far at once.
  virtual ending::StatusDetail start(double time, const rotor::ShaftAndRing& state,
                                     const std::vector<OpenContact>& contacts) = 0;
  /// Goes on until a guard ends the mode, time reaches `until` or the work of the revolution is spent; hands
  /// every piece of motion to the listener.
  virtual ModeEnd advance(double until, MotionListener& listener) = 0;
  /// Sets the time back by a revolution.
  virtual void shift_time(double period) = 0;

  /// Where it has advanced to, with the contacts that it has started with: from there another phase or motion
  /// goes on.
  virtual void hand_over(double& time, rotor::ShaftAndRing& bodies, std::vector<OpenContact>& contacts) = 0;

  /// Right-hand sides and steps since the phase was made.
  [[nodiscard]] virtual std::uint64_t evaluations() const = 0;
  [[nodiscard]] virtual std::uint64_t steps() const = 0;
  [[nodiscard]] virtual std::uint64_t rejected() const = 0;
};

/// The phases of a motion under one law.
class ContactPhases {
 public:
  virtual ~ContactPhases() = default;

  /// The one for contacts that slip, rest or skim like these.
  [[nodiscard]] virtual Phase& of(const std::vector<OpenContact>& contacts) = 0;
  /// Calls `use` with each phase that has been asked for.
  virtual void each(const std::function<void(const Phase&)>& use) const = 0;
};

/// Price of all searches for equilibria under a law up to now; nothing where they are short [ns].
inline std::int64_t price_of_searches(const Law& law) {
  return law.leans() ? static_cast<std::int64_t>(law.evaluations()) * WorkPrice::kInclinedCurve : 0;
}

/// What bounds a mode in contact and how accurate it is.
struct ContactLimits {
  double tolerance;       ///< local error of a step [m]: accuracy.tolerance × δc
  double max_shortening;  ///< of δ/L [-]
};

/// What the modes of one motion share; all of it outlives them.
struct ContactSetup {
  const rotor::Machine* machine;
  Law* law;
  ContactLimits limits;
  WorkMeter* meter;
};

using MakePhases = std::unique_ptr<ContactPhases>(const ContactSetup&);
/// By collocation (`Collocated`), which has one phase for all contacts.
MakePhases phases_on_arcs;

}  // namespace rubatlas::modes
