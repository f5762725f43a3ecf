/// Groups of MAPS.h5 on how far the motions of an atlas are from a change.
#pragma once

#include <span>

#include "analysis/findings.hpp"
#include "atlas/hdf5.hpp"

namespace rubatlas::analysis {

/// `/margins`: distances in each swept parameter to the nearest border and to the predicted grazing; and
/// `/grazings`: the borders along Ω at which motions graze. `found.margins` is there.
void create_margins(atlas::File& file, const Findings& found, const atlas::Shape& shape,
                    std::span<const atlas::Dataset> axes);

/// `/exponent_check`: whether class and largest exponent of each motion agree.
void create_exponent_check(atlas::File& file, const Findings& found, const atlas::Shape& shape,
                           std::span<const atlas::Dataset> axes);

}  // namespace rubatlas::analysis
