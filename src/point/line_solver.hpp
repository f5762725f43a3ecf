/// The interface to the physics: computes one line of the atlas, point by point.
///
/// A scene's choices (contact law, effects, observables) become types once, in `make_line_solver`; from there
/// to the end of a point nothing is looked up by name. One virtual call per point.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "modes/work_meter.hpp"
#include "motion/point_start.hpp"
#include "motion/work_counts.hpp"
#include "observables/list.hpp"
#include "point/status.hpp"

namespace rubatlas::point {

struct PointOutcome {
  PointStatus status = PointStatus::pending;
  StatusDetail detail = StatusDetail::none;  ///< what ended the point, where its status is not `done`
  std::int32_t failed_revolution = -1;       ///< counted from 0 through the transient; −1 when done
  motion::SectionState final_state{};        ///< after the last revolution; NaN when not done
  motion::Memory final_memory;               ///< memory of effects there; empty where no effect has one
  observables::Rows rows;                    ///< as `observables::descriptions(scene)`
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
  PointStatus status = PointStatus::pending;
  StatusDetail detail = StatusDetail::none;
  std::int32_t failed_revolution = -1;
  std::vector<double> time;                    ///< τ [-] from the start of the sampled revolutions
  std::vector<motion::SectionState> state;     ///< one per time
  std::vector<double> force;                   ///< [time][blade], normal force F on each blade [N]
  std::vector<motion::SectionState> sections;  ///< Poincaré sections, one per sampled revolution
  ContactSamples contacts;
};

class LineSolver {
 public:
  virtual ~LineSolver() = default;

  /// Runs transient and sampled revolutions at one speed ratio from `start`. `go_on` is asked after each
  /// revolution and every few milliseconds within (a rank answers its messages there): false gives the point
  /// up, whose status is then `pending`. An empty function is not called.
  virtual PointOutcome run(double speed_ratio, const motion::PointStart& start,
                           const modes::GoOn& go_on = {}) = 0;

  /// The same motion, kept as `samples_per_revolution` samples over the sampled revolutions.
  virtual Orbit orbit(double speed_ratio, const motion::PointStart& start) = 0;
};

}  // namespace rubatlas::point
