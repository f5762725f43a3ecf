/// A point of a scene as the command line names it: name=value, one for each quantity that the scene leaves
/// open.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plan/grid.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// The parameters and, for an atlas swept in both directions, the direction.
struct Place {
  plan::PointParameters parameters;
  std::optional<plan::Direction> direction;
};

/// The point that the user means: the given values, and the values of axes with one value only. `option` is
/// where they stand, for messages. Throws UsageError.
Place place_of(const settings::Scene& scene, const std::vector<std::string>& at, std::string_view option);

/// The range of values, or all values where they are few.
std::string choices_text(const std::vector<double>& values);

}  // namespace rubatlas::mpi
