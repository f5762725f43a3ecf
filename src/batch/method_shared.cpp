// The motions of `hybrid` with shared attempts: the paper's rotor with elastica blades.

#include "batch/shared_attempts.hpp"
#include "plan/scene_of_line.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/typed_motions.hpp"

namespace rubatlas::batch {

std::unique_ptr<solve::LineSolver> make_sharing_line_solver(const scene::Scene& scene,
                                                            const plan::PointParameters& line,
                                                            solve::BladeTables& tables) {
  const scene::Scene own = plan::scene_of_line(scene, line);
  const solve::LineRequest request{own, tables};
  return solve::on_paper_s_machine<solve::HybridMethod<SharedDormandPrince853>>(
      own, contact::ElasticaContact(solve::geometry_of(own.ring, own.blades), solve::blade_of(own.blades),
                                    solve::curve_of(request, own.blades)));
}

}  // namespace rubatlas::batch
