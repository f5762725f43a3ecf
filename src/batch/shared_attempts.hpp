/// The method `hybrid` for lines in a batch: its pair, with attempts of steps that are shared with others.
#pragma once

#include <memory>

#include "assembly/make_line_solver.hpp"
#include "batch/lane_request.hpp"
#include "batch/line_fibers.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::batch {

/// `DormandPrince853` in everything but in who makes an attempt.
struct SharedDormandPrince853 : integrate::DormandPrince853 {};

/// The line solver of a scene of `width_of(scene).seats` > 1. Alone, or out of a batch, it computes the same.
std::unique_ptr<point::LineSolver> make_sharing_line_solver(const settings::Scene& scene,
                                                            const plan::PointParameters& line,
                                                            assembly::BladeTables& tables);

}  // namespace rubatlas::batch

/// One step as `RungeKutta<DormandPrince853, 6>`, which may be attempted in a lane.
template <>
class rubatlas::integrate::RungeKutta<rubatlas::batch::SharedDormandPrince853, 6>
    : public rubatlas::batch::LaneStep {
 public:
  template <class System>
  bool attempt(System& system, double size) {
    if constexpr (rubatlas::batch::kFitsLanes<System>) {
      if (auto* const others = rubatlas::batch::LineFibers::running()) {
        rubatlas::batch::LaneRequest request(system, *this, size);
        if (others->attempt(request)) {
          system.adopt(request.last, request.acceleration, rubatlas::batch::kEvaluationsOfAttempt);
          return request.finite;
        }
      }
    }
    return rubatlas::batch::LaneStep::attempt(system, size);
  }
};
