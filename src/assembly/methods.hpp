/// The methods of integration for the paper's rotor, one function and one file each: `method_<name>.cpp`
/// compiles the motions of its method for every law and forcing, and nothing else does. Those that only
/// comparisons ask for stand in `compared`.
#pragma once

#include <memory>

#include "point/solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::assembly {

class BladeTables;

/// What a line solver is made of.
struct LineRequest {
  const settings::Scene& line;  ///< the scene with the line's values of all that is swept
  BladeTables& tables;
};

std::unique_ptr<point::LineSolver> make_hybrid(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_hybrid_54(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_hybrid_32(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_paper(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_located(const LineRequest& request);
std::unique_ptr<point::LineSolver> make_fixed(const LineRequest& request);

}  // namespace rubatlas::assembly
