/// The dimension scale of an axis behind the grid's: numbers or words.
#pragma once

#include "atlas/hdf5.hpp"
#include "observables/list.hpp"

namespace rubatlas::atlas {

Dataset create_inner_scale(File& file, const observables::InnerAxis& axis);

}  // namespace rubatlas::atlas
