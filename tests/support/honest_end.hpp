/// What holds for the outcome of every point, however hard the case.
#pragma once

#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::test {

/// Asserts what holds for every outcome: the point is done and has finite numbers in every row (or NaN
/// throughout in one of what does not occur on its motion), or it has a status that says why it is not done,
/// and NaN in every row (MODEL 5).
void expect_an_honest_end(const settings::Scene& scene, const point::PointOutcome& outcome);

}  // namespace rubatlas::test
