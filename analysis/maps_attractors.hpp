/// The attractors in MAPS.h5: /attractor, and the groups /basins and /hysteresis.
#pragma once

#include <span>

#include "analysis/findings.hpp"
#include "atlas/hdf5.hpp"

namespace rubatlas::analysis {

/// Creates /attractor, /basins where the initial state is an axis, and /hysteresis of a sweep both ways.
void create_attractors(atlas::File& file, const Findings& found, const atlas::Shape& shape,
                       std::span<const atlas::Dataset> axes);

}  // namespace rubatlas::analysis
