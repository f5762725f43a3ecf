/// One grid point of a hard case: a scene in, the outcome of one speed out.
#pragma once

#include "assembly/make_line_solver.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::test {

/// MODEL 6.1, with sections and the largest displacement kept, no transient.
settings::Scene default_rotor(int revolutions);

/// MODEL 6.2.
settings::Scene test_rig(int revolutions);

/// Parameters of the scene's one line.
plan::PointParameters line_of(const settings::Scene& scene);

/// Blade tables that all cases with a few friction coefficients share.
const std::shared_ptr<assembly::BladeTables>& shared_tables();

point::PointOutcome run(const settings::Scene& scene, double speed_ratio,
                        const point::SectionState& start = {},
                        const std::shared_ptr<assembly::BladeTables>& tables = shared_tables());

/// Largest difference of the components [m].
double largest_difference(const point::SectionState& a, const point::SectionState& b);

/// One section of the row `poincare`.
point::SectionState section(const std::vector<double>& row, std::size_t index);

/// What every outcome keeps, however hard the case: done with finite numbers in every row, or a status that
/// says why not, with NaN in every row (MODEL 5). A failed assertion names what is broken.
void expect_an_honest_end(const settings::Scene& scene, const point::PointOutcome& outcome);

}  // namespace rubatlas::test
