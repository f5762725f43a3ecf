/// The protocol of a point (MODEL 6), the same for every motion: transient, sampled revolutions, and what is
/// kept of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "modes/motion_listener.hpp"
#include "motion/point_motion.hpp"
#include "observables/recorder.hpp"
#include "point/line_solver.hpp"
#include "point/settling.hpp"
#include "settings/scene.hpp"
#include "variation/tangent_flow.hpp"

namespace rubatlas::point {

class PointSolver final : public LineSolver {
 public:
  /// `line`: the scene with the line's values of all that is swept; `make` makes its motions.
  PointSolver(const settings::Scene& line, motion::MakeMotion make);

  PointOutcome run(double speed_ratio, const motion::PointStart& start, const modes::GoOn& go_on) override;
  ending::PointStatus listen(double speed_ratio, const motion::PointStart& start,
                             modes::MotionListener& listener) override;
  Orbit orbit(double speed_ratio, const motion::PointStart& start) override;
  SectionMap section_map(double speed_ratio, const motion::PointStart& start, int revolutions) override;
  TouchdownMap touchdown_map(double speed_ratio, const motion::PointStart& start, int passings) override;

 private:
  /// How a motion ended.
  struct Ending {
    ending::StatusDetail detail = ending::StatusDetail::none;
    std::int32_t failed_revolution = -1;
  };
  /// A point's motion behind its transient.
  struct AfterTransient {
    std::unique_ptr<motion::PointMotion> motion;  ///< about to begin the first sampled revolution
    Ending ending;
    int settled = 0;             ///< revolutions that were run before it had settled; 0: it has not
    std::vector<Section> cycle;  ///< on which it has, from the first sampled revolution on
    motion::WorkCounts work;     ///< of what is not `motion`
  };

  /// The linearised flow, at the start of a motion.
  variation::TangentFlow& tangents_at(double speed_ratio);
  [[nodiscard]] trajectory::PointConstants point_of(double speed_ratio) const;
  /// So many revolutions of a motion that has started with this status.
  static ending::StatusDetail follow(motion::PointMotion& motion, ending::StatusDetail why,
                                     modes::MotionListener& listener, int revolutions);
  [[nodiscard]] std::unique_ptr<motion::PointMotion> motion_of(double speed_ratio,
                                                               const motion::PointStart& start) const;
  std::optional<Return> return_from(motion::PointMotion& motion, double speed_ratio, const Section& from,
                                    int revolutions, bool derivative, const modes::GoOn& go_on);
  AfterTransient transient(double speed_ratio, const motion::PointStart& start, const modes::GoOn& go_on);
  /// So many sampled revolutions.
  Ending sampled(motion::PointMotion& motion, int revolutions, modes::MotionListener& listener,
                 const modes::GoOn& go_on) const;
  /// Those of the whole protocol.
  Ending whole(AfterTransient& begun, modes::MotionListener& listener) const;

  settings::Scene scene_;
  motion::MakeMotion make_;
  observables::Recorder recorder_;
  bool settles_;                                        ///< transients end on the cycles that they approach
  std::optional<variation::TangentFlow> tangent_flow_;  ///< made where it is asked for
};

}  // namespace rubatlas::point
