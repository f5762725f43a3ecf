/// BRANCH.h5: periodic orbits along one quantity, or a curve of bifurcations in two, self-describing in the
/// manner of an atlas.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atlas/output.hpp"
#include "atlas/software.hpp"
#include "branch/branch.hpp"
#include "settings/quantity.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

/// What a branch file holds: branches one after the other; of a curve one, without events.
struct BranchContents {
  std::vector<const settings::Quantity*> quantities;  ///< that vary: one, or two of a curve
  std::vector<branch::Branch> branches;
  std::optional<branch::EventKind> curve_of;
  double tolerance;            ///< `accuracy.tolerance` of the motions
  std::vector<double> values;  ///< of all axes of the scene; of what varies, where the branch has started
};

/// Writes over the axis `point` `/parameter`, `/second_parameter` (curves), `/section` (point × component),
/// `/period`, `/passings`, `/multipliers` (point × multiplier × part), `/stability`, `/admissible`,
/// `/nearest_miss`, `/branch`; in the group `/events` the same of the bifurcations, with `kind`
/// (datasets.md). The file appears when it is complete. Throws EnvironmentError.
void write_branch(const Output& output, const settings::Scene& scene, const std::string& scene_text,
                  const BranchContents& contents, const Software& software);

}  // namespace rubatlas::atlas
