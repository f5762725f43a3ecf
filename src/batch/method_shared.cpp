// The motions of `hybrid` with shared attempts.

#include "batch/shared_attempts.hpp"
#include "plan/scene_of_line.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/typed_line_solver.hpp"

namespace rubatlas::batch {

std::unique_ptr<solve::LineSolver> make_sharing_line_solver(const scene::Scene& scene,
                                                            const plan::PointParameters& line,
                                                            solve::BladeTables& tables) {
  const scene::Scene own = plan::scene_of_line(scene, line);
  const solve::LineRequest request{own, line, tables};
  return solve::with_forcing<solve::HybridMethod<SharedDormandPrince853>>(own, line,
                                                                          solve::elastica_of(request));
}

}  // namespace rubatlas::batch
