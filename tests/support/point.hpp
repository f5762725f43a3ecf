/// The default rotor as a scene, and one way to run a point of a scene. The suites share both.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::test {

/// The paper's default rotor (MODEL 6.1). Sections and the largest displacement are kept, without a
/// transient.
settings::Scene default_rotor(int revolutions);

/// The paper's test rig (MODEL 6.2), with the same protocol.
settings::Scene test_rig(int revolutions);

/// Every observable that a rotor without `/wear` may keep.
std::vector<std::string> observables_without_wear();

/// Blade tables that the tests of a suite share, since a table takes longer than a short motion.
const std::shared_ptr<assembly::BladeTables>& shared_tables();

/// The solver of a scene whose quantities are not swept: the scene's own values, at any speed ratio.
std::unique_ptr<point::LineSolver> solver_of(
    const settings::Scene& scene, const std::shared_ptr<assembly::BladeTables>& tables = shared_tables());

/// One point of such a scene.
point::PointOutcome run(const settings::Scene& scene, double speed_ratio,
                        const motion::SectionState& start = {},
                        const std::shared_ptr<assembly::BladeTables>& tables = shared_tables());

/// The solver of the first line of a scene's grid.
std::unique_ptr<point::LineSolver> solver_of_first_line(const settings::Scene& scene);

/// The first point of a scene's grid, from a state, or from a state and what effects remember.
point::PointOutcome run(const settings::Scene& scene, const motion::SectionState& start = {});
point::PointOutcome run(const settings::Scene& scene, const motion::PointStart& start);

/// Largest difference of the components [m].
double largest_difference(const motion::SectionState& a, const motion::SectionState& b);

/// One section of the row `poincare`.
motion::SectionState section(const std::vector<double>& row, std::size_t index);

}  // namespace rubatlas::test
