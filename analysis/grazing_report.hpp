/// Where motions are predicted to graze, in sentences.
#pragma once

#include <string>
#include <vector>

#include "analysis/findings.hpp"

namespace rubatlas::analysis {

/// One sentence for each border along Ω that is a grazing, line after line, borders of regions only where
/// there are many; and one that counts them. Empty where the atlas keeps no nearest misses.
std::vector<std::string> grazing_sentences(const Findings& found);

}  // namespace rubatlas::analysis
