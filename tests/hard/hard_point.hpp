/// One grid point of a hard case: a scene in, the outcome of one speed out.
#pragma once

#include "solve/line_solver.hpp"

namespace rubatlas::test {

/// MODEL 6.1, with sections and the largest displacement kept, no transient.
scene::Scene default_rotor(int revolutions);

/// MODEL 6.2.
scene::Scene test_rig(int revolutions);

/// Parameters of the scene's one line.
plan::PointParameters line_of(const scene::Scene& scene);

/// Blade tables that all cases with a few friction coefficients share.
const std::shared_ptr<solve::BladeTables>& shared_tables();

solve::PointOutcome run(const scene::Scene& scene, double speed_ratio, const solve::SectionState& start = {},
                        const std::shared_ptr<solve::BladeTables>& tables = shared_tables());

/// Largest difference of the components [m].
double largest_difference(const solve::SectionState& a, const solve::SectionState& b);

/// One section of the row `poincare`.
solve::SectionState section(const std::vector<double>& row, std::size_t index);

/// What every outcome keeps, however hard the case: done with finite numbers in every row, or a status that
/// says why not, with NaN in every row (MODEL 5). A failed assertion names what is broken.
void expect_an_honest_end(const scene::Scene& scene, const solve::PointOutcome& outcome);

}  // namespace rubatlas::test
