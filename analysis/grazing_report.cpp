#include "analysis/grazing_report.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "analysis/report_parts.hpp"
#include "analysis/rules/evidence_text.hpp"

namespace rubatlas::analysis {
namespace {

std::string_view side_text(std::uint8_t side) {
  constexpr std::array<std::string_view, 4> kSides{"", " on the approaching side", " head-on",
                                                   " on the receding side"};
  return kSides.at(side);
}

std::string grazing_text(const Findings& found, const GrazingBorder& one) {
  const auto& line = found.lines[one.line].line;
  const auto& [at, error, from] = one.grazing;
  return fmt::format(
      "{}{} by grazing{} at Ω = {} (extrapolated from {:.6g}, {:.6g} and {:.6g}): {} below, {} above.",
      line_text(found, one.line), border_text(one.border.region_ends, one.border.region_begins),
      side_text(one.side), speed_text({at - error, at + error}), line.speed_ratio[from[0]],
      line.speed_ratio[from[1]], line.speed_ratio[from[2]], motion_text(line.motion[one.border.below]),
      motion_text(line.motion[one.border.above]));
}

}  // namespace

std::vector<std::string> grazing_sentences(const Findings& found) {
  constexpr std::size_t kMany = 12;
  if (!found.keeps_nearest_miss || !found.margins) return {};
  const auto& grazings = found.margins->grazings;
  std::vector<std::string> sentences;
  for (const auto& one : grazings) {
    const bool of_region = one.border.region_ends > 0 || one.border.region_begins > 0;
    if (of_region || grazings.size() <= kMany) sentences.push_back(grazing_text(found, one));
  }
  if (grazings.empty()) {
    sentences.emplace_back("At no border of periodic motions does the trend of the nearest miss reach zero.");
  } else if (sentences.size() < grazings.size()) {
    sentences.push_back(
        fmt::format("{} borders within regions are grazings too.", grazings.size() - sentences.size()));
  }
  return sentences;
}

}  // namespace rubatlas::analysis
