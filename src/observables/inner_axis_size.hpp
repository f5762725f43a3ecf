/// The extents of the inner axes, without their values, which may be more than fit into memory.
#pragma once

#include <cstddef>
#include <string_view>

#include "settings/scene.hpp"

namespace rubatlas::observables {

/// How many values the inner axis of this name has (`list.hpp`).
std::size_t inner_axis_size(std::string_view name, const settings::Scene& scene);

}  // namespace rubatlas::observables
