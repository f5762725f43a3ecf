/// The result of an analysis as a text for the terminal, and as Markdown.
#pragma once

#include <string>

#include "analysis/findings.hpp"

namespace rubatlas::analysis {

/// For a terminal of 110 columns.
std::string plain_report(const Findings& found);
std::string markdown_report(const Findings& found);

}  // namespace rubatlas::analysis
