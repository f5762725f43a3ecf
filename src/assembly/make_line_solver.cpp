#include "assembly/make_line_solver.hpp"

#include <memory>
#include <stdexcept>

#include "assembly/blade_tables.hpp"
#include "assembly/machine.hpp"
#include "assembly/methods.hpp"
#include "plan/scene_of_line.hpp"

namespace rubatlas::assembly {

namespace {

/// Whether contacts have arcs; where they have none the method is `hybrid`.
bool collocates(const LineRequest& request) {
  constexpr double kAnySpeed = 1.0;
  const rotor::Machine machine = machine_of(request.line, request.combination.machine, kAnySpeed);
  return law_of(request)->arcs(machine, request.line.validity.max_shortening) != nullptr;
}

std::unique_ptr<point::LineSolver> make(const LineRequest& request) {
  switch (request.line.accuracy.method) {
    case settings::Method::collocation:
      return hybrid_solver(request, collocates(request) ? modes::phases_on_arcs : phases_in_steps);
    case settings::Method::hybrid:
      return hybrid_solver(request, phases_in_steps);
    case settings::Method::hybrid_54:
      return make_hybrid_54(request);
    case settings::Method::hybrid_32:
      return make_hybrid_32(request);
    case settings::Method::paper:
      return make_paper(request);
    case settings::Method::located:
      return make_located(request);
    case settings::Method::fixed:
      return make_fixed(request);
  }
  throw std::logic_error("a method of integration that is none");
}

}  // namespace

std::shared_ptr<BladeTables> make_blade_tables() {
  return std::make_shared<BladeTables>();
}

bool collocates(const settings::Scene& line) {
  const std::shared_ptr<BladeTables> tables = make_blade_tables();
  return collocates(LineRequest{line, *tables, settings::combination_of(line)});
}

std::unique_ptr<point::LineSolver> make_line_solver(const settings::Scene& scene,
                                                    const plan::PointParameters& line,
                                                    const std::shared_ptr<BladeTables>& tables) {
  const settings::Scene own = plan::scene_of_line(scene, line);
  return make({own, *tables, settings::combination_of(own)});
}

}  // namespace rubatlas::assembly
