// The motions of `hybrid` with shared attempts: the paper's rotor with elastica blades.

#include "assembly/hybrid_method.hpp"
#include "assembly/make_line_solver.hpp"
#include "assembly/typed_motions.hpp"
#include "batch/shared_attempts.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "plan/scene_of_line.hpp"

namespace rubatlas::batch {

std::unique_ptr<point::LineSolver> make_sharing_line_solver(const settings::Scene& scene,
                                                            const plan::PointParameters& line,
                                                            assembly::BladeTables& tables) {
  const settings::Scene own = plan::scene_of_line(scene, line);
  const assembly::LineRequest request{own, tables};
  return assembly::on_paper_s_machine<assembly::HybridMethod<SharedDormandPrince853>>(
      own, contact::ElasticaContact(assembly::geometry_of(own.ring, own.blades),
                                    assembly::blade_of(own.blades), assembly::curve_of(request, own.blades)));
}

}  // namespace rubatlas::batch
