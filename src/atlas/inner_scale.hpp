/// The dimension scale of an inner axis, which follows the axes of the grid: numbers or words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "atlas/hdf5.hpp"
#include "observables/list.hpp"

namespace rubatlas::atlas {

/// So many consecutive numbers from `first` on, as the values of a scale.
std::vector<std::int32_t> counted(std::size_t count, std::int32_t first);

Dataset create_inner_scale(File& file, const observables::InnerAxis& axis);

}  // namespace rubatlas::atlas
