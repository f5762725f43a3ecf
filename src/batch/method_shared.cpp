// The motions of `hybrid` with shared attempts: the paper's rotor with elastica blades.

#include "batch/shared_attempts.hpp"
#include "plan/scene_of_line.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/typed_line_solver.hpp"

namespace rubatlas::batch {

std::unique_ptr<solve::LineSolver> make_sharing_line_solver(const scene::Scene& scene,
                                                            const plan::PointParameters& line,
                                                            solve::BladeTables& tables) {
  const scene::Scene own = plan::scene_of_line(scene, line);
  return solve::on_paper_s_machine<solve::HybridMethod<SharedDormandPrince853>>(
      own, solve::elastica_law(own.ring, own.blades, tables.curve(own.contact.friction)));
}

}  // namespace rubatlas::batch
