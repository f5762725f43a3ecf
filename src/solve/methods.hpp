/// The methods of integration, one function and one file each: `method_<name>.cpp` compiles the motions of
/// its method for every law and forcing, and nothing else does.
#pragma once

#include <memory>

#include "solve/line_solver.hpp"

namespace rubatlas::solve {

/// What a line solver is made of.
struct LineRequest {
  const scene::Scene& scene;
  const plan::PointParameters& line;
  BladeTables& tables;
};

std::unique_ptr<LineSolver> make_hybrid(const LineRequest& request);

}  // namespace rubatlas::solve
