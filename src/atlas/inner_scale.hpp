/// The dimension scale of an inner axis, which follows the axes of the grid: numbers or words.
#pragma once

#include "atlas/hdf5.hpp"
#include "observables/list.hpp"

namespace rubatlas::atlas {

Dataset create_inner_scale(File& file, const observables::InnerAxis& axis);

}  // namespace rubatlas::atlas
