/// Sentences and table cells that the plain text and the Markdown share, without any layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/findings.hpp"

namespace rubatlas::analysis {

/// What effects of a scene keep the rules from finding: they do not follow the stiffness of a support, are
/// those of motions at constant speed, and do not see a trigger beside a large static sag. Sentences without
/// their full stop.
std::vector<std::string> notes_on_effects(const settings::Scene& scene);

/// Short sentences on what was examined: contact law, grid, points, classes.
std::vector<std::string> facts(const Findings& found);

/// Where blades touch the ring, line by line; empty where they do at every speed of every line, which `facts`
/// say.
std::vector<std::string> contact_sentences(const Findings& found);

/// The table of regions and triggers: one row per line, a cell for the parameters and one per region and
/// trigger along Ω. A cell has two lines of text.
struct Cell {
  std::string first;
  std::string second;
};
std::vector<std::string> table_header(const Findings& found);
std::vector<std::vector<Cell>> table_rows(const Findings& found);

/// Where the initial state is an axis: at which parameters which attractors are reached, and from which share
/// of the initial states.
std::vector<std::string> basin_sentences(const Findings& found);

/// Of an atlas that was swept both ways: where the motions differ, line by line.
std::vector<std::string> hysteresis_sentences(const Findings& found);

/// Values of the swept parameters of a line, possibly without one: "ζ = 0.1, up: "; empty where the atlas has
/// one line.
std::string line_text(const Findings& found, std::size_t line, std::string_view without = "");

/// "region 2 ends and region 3 begins", from the numbers of the regions, 0 for none.
std::string border_text(std::uint8_t region_ends, std::uint8_t region_begins);

/// "As ζ grows (μ = 0.1, me = 0 kg m, h = 1 mm)".
std::string heading(const Findings& found, const Sensitivity& sensitivity);

}  // namespace rubatlas::analysis
