#include "solve/line_solver.hpp"

#include "solve/blade_tables.hpp"
#include "solve/methods.hpp"

namespace rubatlas::solve {

std::shared_ptr<BladeTables> make_blade_tables() {
  return std::make_shared<BladeTables>();
}

std::unique_ptr<LineSolver> make_line_solver(const scene::Scene& scene, const plan::PointParameters& line,
                                             const std::shared_ptr<BladeTables>& tables) {
  return make_hybrid({scene, line, *tables});
}

}  // namespace rubatlas::solve
