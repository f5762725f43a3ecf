/// From the number of a point to its index along each axis (C order: the last axis runs fastest).
#pragma once

#include <cstddef>

#include "atlas/hdf5.hpp"

namespace rubatlas::atlas {

inline Shape point_index(const Shape& shape, std::size_t point) {
  Shape index(shape.size());
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    index[axis] = point % shape[axis];
    point /= shape[axis];
  }
  return index;
}

}  // namespace rubatlas::atlas
