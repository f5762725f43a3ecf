#include "analysis/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/edges_report.hpp"
#include "analysis/grazing_report.hpp"
#include "analysis/report_parts.hpp"
#include "analysis/signature_report.hpp"
#include "analysis/text_layout.hpp"
#include "atlas/output.hpp"
#include "settings/printable.hpp"

namespace rubatlas::analysis {
namespace {

constexpr std::string_view kTableKey =
    "Regions: first and last Ω, aperiodic share, peak displacement; beyond an Ω in parentheses a region may "
    "go on, since points are not done there or the grid ends, and digits in parentheses are the uncertainty "
    "of an edge. Triggers: Ω, rise of the displacement in mm and as a ratio. Not covered: too few points are "
    "done there.";
constexpr std::string_view kBasinsKey =
    "Share of the initial states, with its standard error, that leads to each attractor. No attractor: the "
    "motion is not resolved, or the point is not done. Regions and triggers are about lines from one "
    "initial state.";

std::string plain_table(const Findings& found) {
  const auto header = table_header(found);
  const auto rows = table_rows(found);
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < header.size(); ++i) {
    std::size_t width = character_count(header[i]);
    for (const auto& row : rows) {
      width = std::max({width, character_count(row[i].first), character_count(row[i].second)});
    }
    widths.push_back(width == 0 ? 0 : width + 2);
  }
  std::string text;
  const auto add_line = [&](const auto& cell_text) {
    std::string line;
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (widths[i] > 0) line += padded(cell_text(i), widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  add_line([&](std::size_t i) { return std::string_view(header[i]); });
  for (const auto& row : rows) {
    add_line([&](std::size_t i) { return std::string_view(row[i].first); });
    add_line([&](std::size_t i) { return std::string_view(row[i].second); });
  }
  return text;
}

}  // namespace

std::string plain_report(const Findings& found) {
  std::string text =
      found.scene.title.empty() ? std::string{} : settings::printable(found.scene.title) + "\n\n";
  for (const auto& fact : facts(found)) text += paragraph("", fact, 2, kColumns);
  if (found.sweeps_initial_state) {
    text += "\nBASINS OF ATTRACTION\n" + paragraph("", kBasinsKey, 2, kColumns) + "\n";
    for (const auto& sentence : basin_sentences(found)) text += paragraph("  ", sentence, 4, kColumns);
    return text;
  }
  if (const auto sentences = contact_sentences(found); !sentences.empty()) {
    text += "\nCONTACT\n";
    for (const auto& sentence : sentences) text += paragraph("  ", sentence, 4, kColumns);
  }
  text += "\nREGIONS AND TRIGGERS\n" + paragraph("", kTableKey, 2, kColumns) + "\n" + plain_table(found);
  if (found.scene.sweep == settings::Sweep::both) {
    text += "\nWHERE UP AND DOWN DIFFER\n";
    for (const auto& sentence : hysteresis_sentences(found)) text += paragraph("  ", sentence, 4, kColumns);
  }
  if (const auto sentences = grazing_sentences(found); !sentences.empty()) {
    text += "\nHOW FAR FROM GRAZING\n";
    for (const auto& sentence : sentences) text += paragraph("  ", sentence, 4, kColumns);
  }
  if (const auto sentences = signature_sentences(found); !sentences.empty()) {
    text += "\nSIGNS BEFORE THE LIMIT\n";
    for (const auto& sentence : sentences) text += paragraph("  ", sentence, 4, kColumns);
  }
  if (found.edges) text += "\nEDGES\n" + edges_report(found);
  for (const auto& sensitivity : found.sensitivities) {
    text += fmt::format("\n{}\n", heading(found, sensitivity));
    for (const auto& effect : sensitivity.effects) {
      text += paragraph(fmt::format("  {}", effect.subject), effect.text, 13, kColumns);
    }
  }
  return text;
}

std::string markdown_report(const Findings& found) {
  std::string text = fmt::format(
      "{}\n# {}\n\n", atlas::kTableMark,
      found.scene.title.empty() ? "Regions and triggers" : settings::printable(found.scene.title));
  for (const auto& fact : facts(found)) text += fmt::format("- {}\n", fact);
  if (found.sweeps_initial_state) {
    text += fmt::format("\n## Basins of attraction\n\n{}\n\n", kBasinsKey);
    for (const auto& sentence : basin_sentences(found)) text += fmt::format("- {}\n", sentence);
    return text;
  }
  if (const auto sentences = contact_sentences(found); !sentences.empty()) {
    text += "\n## Contact\n\n";
    for (const auto& sentence : sentences) text += fmt::format("- {}\n", sentence);
  }
  text += fmt::format("\n## Regions and triggers\n\n{}\n\n", kTableKey);
  const auto header = table_header(found);
  text += fmt::format("| {} |\n|", fmt::join(header, " | "));
  for (std::size_t i = 0; i < header.size(); ++i) text += "---|";
  text += "\n";
  for (const auto& row : table_rows(found)) {
    text += "|";
    for (const auto& cell : row) {
      text += fmt::format(" {}{}{} |", cell.first, cell.second.empty() ? "" : "<br>", cell.second);
    }
    text += "\n";
  }
  if (found.scene.sweep == settings::Sweep::both) {
    text += "\n## Where up and down differ\n\n";
    for (const auto& sentence : hysteresis_sentences(found)) text += fmt::format("- {}\n", sentence);
  }
  if (const auto sentences = grazing_sentences(found); !sentences.empty()) {
    text += "\n## How far from grazing\n\n";
    for (const auto& sentence : sentences) text += fmt::format("- {}\n", sentence);
  }
  if (const auto sentences = signature_sentences(found); !sentences.empty()) {
    text += "\n## Signs before the limit\n\n";
    for (const auto& sentence : sentences) text += fmt::format("- {}\n", sentence);
  }
  if (found.edges) {
    text += "\n## Edges\n\n";
    for (const auto& sentence : edge_sentences(found)) text += fmt::format("- {}\n", sentence);
  }
  for (const auto& sensitivity : found.sensitivities) {
    text += fmt::format("\n## {}\n\n| | what happens |\n|---|---|\n", heading(found, sensitivity));
    for (const auto& effect : sensitivity.effects) {
      text += fmt::format("| {} | {} |\n", effect.subject, effect.text);
    }
  }
  return text;
}

}  // namespace rubatlas::analysis
