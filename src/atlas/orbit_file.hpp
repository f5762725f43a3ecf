/// ORBIT.h5: one point's motion over the sampled revolutions, self-describing in the manner of an atlas.
#pragma once

#include <string>

#include "atlas/output.hpp"
#include "atlas/software.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

/// Writes `/time`, `/state` (time × component), `/force` (time × blade), `/sections` (section × component),
/// the contacts sampled closely (`/contact_…`), their scales, `/scene` and `/scene_resolved`; parameters,
/// start and status are root attributes (datasets.md). The file appears when it is complete. Throws
/// EnvironmentError.
void write_orbit(const Output& output, const settings::Scene& scene, const std::string& scene_text,
                 const plan::PointParameters& parameters, const motion::SectionState& start,
                 const point::Orbit& orbit, const Software& software);

}  // namespace rubatlas::atlas
