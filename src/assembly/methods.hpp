/// The laws of contact, the machines and the methods of integration, as what makes the solver of a line.
/// Methods that only comparisons ask for stand in `compared`.
#pragma once

#include <memory>

#include "modes/phase.hpp"
#include "modes/rest_judge.hpp"
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

/// The law of contact of a line.
std::unique_ptr<collocation::Law> law_of(const LineRequest& request);

// Methods.

/// Closed-form flight, located events; contacts in the phases of `make_phases`.
std::unique_ptr<point::LineSolver> hybrid_solver(const LineRequest& request, modes::MakePhases* make_phases);
/// Phases in steps of order 8(5,3).
modes::MakePhases phases_in_steps;

std::unique_ptr<point::LineSolver> make_hybrid_54(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_hybrid_32(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_paper(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_located(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_fixed(const LineRequest& request);

}  // namespace rubatlas::assembly
