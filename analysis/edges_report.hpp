/// The edges of an atlas in sentences: where regions begin and end, and how the other edges came out.
#pragma once

#include <string>
#include <vector>

#include "analysis/findings.hpp"

namespace rubatlas::analysis {

/// One sentence for each edge of a region, line after line; where the atlas is swept up and down, what the
/// two sweeps say of it; and one that counts all edges. `found.edges` is there.
std::vector<std::string> edge_sentences(const Findings& found);

/// The same for a terminal of 110 columns.
std::string edges_report(const Findings& found);

}  // namespace rubatlas::analysis
