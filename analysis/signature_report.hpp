/// Where rubbing announces itself in the spectrum, in sentences.
#pragma once

#include <string>
#include <vector>

#include "analysis/findings.hpp"

namespace rubatlas::analysis {

/// What a sign is, and one sentence for each line that has a point; empty where there is none, or where the
/// spectra of the atlas show no signs.
std::vector<std::string> signature_sentences(const Findings& found);

}  // namespace rubatlas::analysis
