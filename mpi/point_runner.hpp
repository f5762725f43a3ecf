/// Computes pieces and writes their rows: what every rank does, the master too.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>

#include "atlas/atlas_writer.hpp"
#include "mpi/messages.hpp"
#include "plan/grid.hpp"
#include "scene/scene.hpp"
#include "solve/line_solver.hpp"

namespace rubatlas::mpi {

class PointRunner {
 public:
  PointRunner(const scene::Scene& scene, const plan::Grid& grid, atlas::AtlasWriter& writer);

  struct Callbacks {
    std::function<void()> between_revolutions;
    std::function<void(const PointReport&)> after_point;
    std::function<bool()> stop;  ///< asked before each point: true gives up the rest of the piece
  };

  /// Computes a piece's points in order. Each starts from the end of the one before it; after one that did
  /// not end as done, and always where points are independent, from the scene's `initial`.
  void run(const Piece& piece, const Callbacks& callbacks);

 private:
  struct CachedSolver {
    std::size_t line = 0;
    std::unique_ptr<solve::LineSolver> solver;
  };

  solve::LineSolver& solver_of(std::size_t line);

  const scene::Scene& scene_;
  const plan::Grid& grid_;
  atlas::AtlasWriter& writer_;
  std::shared_ptr<solve::BladeTables> tables_ = solve::make_blade_tables();
  std::list<CachedSolver> solvers_;  ///< most recently used first
};

}  // namespace rubatlas::mpi
