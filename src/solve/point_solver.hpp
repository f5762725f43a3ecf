/// The protocol of a point (MODEL 6), the same for every motion: transient, sampled revolutions, and what is
/// kept of them.
#pragma once

#include <cstdint>
#include <memory>

#include "observables/recorder.hpp"
#include "scene/scene.hpp"
#include "solve/line_solver.hpp"
#include "solve/motion_listener.hpp"
#include "solve/point_motion.hpp"
#include "solve/rotor.hpp"

namespace rubatlas::solve {

/// The constants of a line's point.
RotorConstants constants_of(const scene::Scene& line, double speed_ratio);

class PointSolver final : public LineSolver {
 public:
  /// `line`: the scene with the line's values of all that is swept; `make` makes its motions.
  PointSolver(const scene::Scene& line, MakeMotion make);

  PointOutcome run(double speed_ratio, const PointStart& start, const GoOn& go_on) override;
  Orbit orbit(double speed_ratio, const PointStart& start) override;

 private:
  /// How a motion ended.
  struct Ending {
    PointStatus status;
    StatusDetail detail = StatusDetail::none;
    std::int32_t failed_revolution = -1;
  };

  [[nodiscard]] std::unique_ptr<PointMotion> motion_of(double speed_ratio, const PointStart& start) const;
  Ending integrate(PointMotion& motion, const PointStart& start, MotionListener& sampling,
                   const GoOn& go_on) const;

  scene::Scene scene_;
  MakeMotion make_;
  observables::Recorder recorder_;
};

}  // namespace rubatlas::solve
