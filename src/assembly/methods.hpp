/// The laws of contact and the methods of integration, as what makes the solver of a line. Methods that only
/// comparisons ask for stand in `compared`.
#pragma once

#include <memory>
#include <vector>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "modes/contact_modes.hpp"
#include "point/solver.hpp"
#include "settings/combinations.hpp"
#include "settings/scene.hpp"

namespace rubatlas::assembly {

class BladeTables;

/// What a line solver is made of.
struct LineRequest {
  const settings::Scene& line;  ///< the scene with the line's values of all that is swept
  BladeTables& tables;
  settings::Combination combination;  ///< how the line is computed
};

/// The scene's blade, with the errors of each.
std::vector<settings::Blades> each_blade(const settings::Scene& line);

// The laws of contact, each by a source of its own (`law_of_<kind>.cpp`).

modes::MakeModes law_of_rigid_blades(const LineRequest& request);
modes::MakeModes law_of_axial_loads(const LineRequest& request);
modes::MakeModes law_of_inclined_loads(const LineRequest& request);
modes::MakeModes law_of_damped_ring(const LineRequest& request);

/// Of each blade under an axial load.
std::vector<contact::ElasticaContact> elastica_of_blades(const LineRequest& request);
/// Of each rigid blade under Coulomb's law.
std::vector<contact::ElasticRingContact> elastic_ring_of_blades(const settings::Scene& line);
/// Of an elastic blade: elastica or beam-column, and its axial compliance.
std::shared_ptr<const blade::ElasticaCurve> curve_of(const LineRequest& request,
                                                     const settings::Blades& blade);

// Methods.

/// Closed-form flight, located events; contacts by collocation where the scene's method asks for that, else
/// in steps.
std::unique_ptr<point::LineSolver> hybrid_solver(const LineRequest& request, modes::MakeModes make_modes);

std::unique_ptr<point::LineSolver> make_hybrid_54(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_hybrid_32(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_paper(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_located(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_fixed(const LineRequest& request);

}  // namespace rubatlas::assembly
