/// Groups of MAPS.h5 on the signs of rubbing in the spectrum.
#pragma once

#include <span>

#include "analysis/findings.hpp"
#include "atlas/hdf5.hpp"

namespace rubatlas::analysis {

/// `/signature`: per line, where signs announce that the displacement passes the limit; `/signs`: the heights
/// from which they were found, per point. `found.signatures` is not empty.
void create_signature(atlas::File& file, const Findings& found, const atlas::Shape& shape,
                      std::span<const atlas::Dataset> axes);

}  // namespace rubatlas::analysis
