/// What comes of a line's points: outcomes, orbits and section maps (`solver.hpp`).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "ending/status.hpp"
#include "motion/point_start.hpp"
#include "motion/work_counts.hpp"
#include "observables/list.hpp"
#include "point/solver.hpp"
#include "trajectory/motion_piece.hpp"
#include "variation/tangents.hpp"

namespace rubatlas::point {

struct PointOutcome {
  ending::PointStatus status = ending::PointStatus::pending;
  ending::StatusDetail detail =
      ending::StatusDetail::none;       ///< what ended the point, where its status is not `done`
  std::int32_t failed_revolution = -1;  ///< counted from 0 through the transient; −1 when done
  /// Revolutions that were run before the motion had certainly settled on a cycle, of which one period was
  /// computed then; 0: it had not within the transient, and the whole protocol was run.
  int settled = 0;
  motion::SectionState final_state{};  ///< after the last revolution; NaN when not done
  motion::Memory final_memory;         ///< memory of effects there; empty where no effect has one
  observables::Rows rows;              ///< as `observables::descriptions(scene)`
  motion::WorkCounts work;
};

/// The forces of contacts over time, sampled more closely than on a uniform grid of time: contact after
/// contact in the order in which they begin, each with its two ends, every peak, and samples between them.
struct ContactSamples {
  std::vector<std::int32_t> number;  ///< of the contact, from 0
  std::vector<std::int32_t> blade;   ///< from 0
  std::vector<double> time;  ///< τ [-] as in the orbit; ascends within a contact, with a time twice at a jump
  std::vector<double> force;  ///< normal force F [N]
  std::vector<motion::SectionState> state;
};

/// One point's motion on a uniform grid of time over the sampled revolutions, and its contacts.
struct Orbit {
  ending::PointStatus status = ending::PointStatus::pending;
  ending::StatusDetail detail = ending::StatusDetail::none;
  std::int32_t failed_revolution = -1;
  std::vector<double> time;                    ///< τ [-] from the start of the sampled revolutions
  std::vector<motion::SectionState> state;     ///< one per time
  std::vector<double> force;                   ///< [time][blade], normal force F on each blade [N]
  std::vector<motion::SectionState> sections;  ///< Poincaré sections, one per sampled revolution
  ContactSamples contacts;
  motion::Memory final_memory;  ///< of effects, after the last revolution
};

/// A tip that touches down, or passes the ring.
struct TipAtRing {
  int blade;                   ///< from 0
  int revolution;              ///< from 0, of the map
  double time;                 ///< τ of that revolution
  motion::SectionState state;  ///< of the shaft there
};

/// Some revolutions of a motion and how they depend on its start: what shooting for periodic orbits needs.
struct SectionMap {
  ending::PointStatus status = ending::PointStatus::pending;
  ending::StatusDetail detail = ending::StatusDetail::none;
  std::vector<motion::SectionState> sections;  ///< after each revolution
  bool differentiable = false;                 ///< every part of the motion has a linearisation
  variation::Tangents jacobian;                ///< of the last section by the start
  /// ln|det| of the jacobian is this and the phase volume's rate times the duration.
  double log_volume = 0.0;
  std::optional<trajectory::Pass> nearest_pass;  ///< of the tips that do not touch
  std::optional<TipAtRing> nearest_place;        ///< where it passes
  /// Touch-downs (blade + 1) and lift-offs −(blade + 1), in order of time.
  std::vector<std::int32_t> events;
  /// Of the contacts that begin and end within these revolutions the smallest depth [m]; infinity: none does.
  double lightest_touch = std::numeric_limits<double>::infinity();
  double lightest_side = 0.0;               ///< s ct there [m]
  std::optional<TipAtRing> lightest_place;  ///< where it touches down
};

/// The blade that stands, after so many passings of blades, where `blade` has stood.
inline int in_place_of(int blade, int passings, int count, double speed_ratio) {
  const int turned = (speed_ratio > 0.0 ? blade - passings : blade + passings) % count;
  return turned < 0 ? turned + count : turned;
}

/// The motion from a touch-down to the time of the same touch-down some passings of blades later, smooth
/// through grazing: the flight that leads there goes on in closed form, whether or not a tip touches in it.
struct TouchdownMap {
  /// `jacobian`: of `end` by the state at the start, at fixed times, that at the start in contact already.
  SectionMap map;
  bool complete = false;                  ///< there is such a flight
  bool admissible = false;                ///< no tip touches in it before
  motion::SectionState end{};             ///< of the shaft at its end
  std::array<double, 4> rate_at_start{};  ///< d/dτ of the state at the start, in contact
  std::array<double, 4> rate_at_end{};    ///< d/dτ of `end`, in flight
};

}  // namespace rubatlas::point
