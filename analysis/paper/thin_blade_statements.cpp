// P9 and P15 (MODEL 6.3): the test rig with thinner blades, other clearances and other misalignments.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "analysis/paper/findings_along.hpp"
#include "analysis/paper/statements.hpp"
#include "analysis/rules/evidence_text.hpp"

namespace rubatlas::analysis {
namespace {

constexpr double kThin = 0.4e-3;  ///< h [m]: blades below this are thin
constexpr std::string_view kThickness = "thickness";
constexpr std::string_view kMisalignment = "rotor_misalignment";
constexpr std::string_view kRadius = "ring_radius";

bool is_thin(const Evidence& evidence, const LineSummary& line) {
  return evidence.value(line, kThickness) < kThin / kRounding;
}

/// The reason why P9 and P15 are not covered; empty where blades can bend.
std::string no_thin_blades(const Evidence& evidence) {
  if (!evidence.other_rotor().empty()) return evidence.other_rotor();
  if (evidence.scene().contact.law != settings::ContactLaw::elastica) return "rigid blades have no thickness";
  return {};
}

/// Whether an aperiodic region is absent on every line.
Finding gone(const Evidence& evidence, const Lines& lines, std::size_t which) {
  auto claim = fmt::format("h < 0.4 mm: no region {}", which + 1);
  std::vector<std::string> there;
  std::size_t absent = 0;
  for (const auto* line : lines) {
    const auto& region = line->regions.at(which);
    if (region.presence == Presence::absent) ++absent;
    if (region.present()) {
      there.push_back(fmt::format("{} at {}", region_text(static_cast<int>(which) + 1, region),
                                  evidence.value_text(*line, kThickness)));
    } else if (region.presence == Presence::merged) {
      there.push_back(fmt::format("merged with region 2 at {}", evidence.value_text(*line, kThickness)));
    }
  }
  const auto brief = fmt::format("{}/{}", absent, lines.size());
  if (!there.empty()) return {false, fmt::format("{}", fmt::join(there, "; ")), std::move(claim), brief};
  const auto range = fmt::format("from {} to {}", evidence.value_text(*lines.front(), kThickness),
                                 evidence.value_text(*lines.back(), kThickness));
  if (absent < lines.size()) {
    return not_covered(fmt::format("region {} is not covered {}", which + 1, range), std::move(claim));
  }
  return {true, fmt::format("region {} absent {}", which + 1, range), std::move(claim), brief};
}

std::vector<Finding> thin_blade_findings(const Evidence& evidence) {
  if (const auto reason = no_thin_blades(evidence); !reason.empty()) return {not_covered(reason)};
  Lines thin;
  Lines thick;
  for (const auto* line : evidence.lines_along(kThickness)) {
    (is_thin(evidence, *line) ? thin : thick).push_back(line);
  }
  if (thin.empty() || thick.empty()) {
    return {not_covered("the grid has no blades of the test rig under 0.4 mm and from there on")};
  }
  std::vector<Finding> findings;
  for (const std::size_t which : {1U, 3U}) {  // a region can disappear only if it exists for thick blades
    const auto& region = evidence.own_line() != nullptr ? evidence.own_line()->regions.at(which)
                                                        : thick.front()->regions.at(which);
    const auto text =
        fmt::format("{} at {}", region_text(static_cast<int>(which) + 1, region),
                    evidence.value_text(
                        evidence.own_line() != nullptr ? *evidence.own_line() : *thick.front(), kThickness));
    auto claim = fmt::format("0.5 mm: region {} is there", which + 1);
    if (region.presence == Presence::not_covered) {
      findings.push_back(not_covered(text, std::move(claim)));
    } else {
      findings.push_back({region.present() || region.presence == Presence::merged, text, std::move(claim)});
    }
    findings.push_back(gone(evidence, thin, which));
  }
  for (const std::size_t which : {0U, 1U}) {
    findings.push_back(trigger_on_every(evidence, thin, kThickness, which, "h < 0.4 mm"));
  }
  return findings;
}

/// The regions and triggers that a line has: "1 2 3 4, triggers 1 2".
std::string picture(const LineSummary& line) {
  std::string text = "regions";
  for (std::size_t i = 0; i < line.regions.size(); ++i) {
    if (line.regions[i].present()) text += fmt::format(" {}", i + 1);
  }
  text += ", triggers";
  for (std::size_t i = 0; i < line.triggers.size(); ++i) {
    if (line.triggers[i].presence == Presence::present) text += fmt::format(" {}", i + 1);
  }
  return text;
}

/// Whether lines of the same thickness have the same regions and triggers along one length. The statement
/// requires it for all thick blades, and the contrary for some thin ones.
Finding matters(const Evidence& evidence, const Lines& lines, bool thin, std::string_view length,
                const std::function<double(const LineSummary&)>& value) {
  auto claim =
      fmt::format("h {} 0.4 mm: {} {}", thin ? "<" : "≥", length, thin ? "matters" : "does not matter");
  std::vector<std::string> texts;
  std::size_t compared = 0;
  std::size_t changed = 0;
  for (auto first = lines.begin(); first != lines.end();) {
    const double thickness = evidence.value(**first, kThickness);
    const auto last = std::find_if(
        first, lines.end(), [&](const auto* line) { return evidence.value(*line, kThickness) != thickness; });
    if (is_thin(evidence, **first) == thin && last - first >= 2) {
      std::vector<std::string> pictures;
      std::string before;
      for (auto line = first; line != last; ++line) {
        const auto now = picture(**line);
        if (now != before) pictures.push_back(fmt::format("{} from {}", now, millimetres(value(**line))));
        before = now;
      }
      ++compared;
      if (pictures.size() > 1) ++changed;
      texts.push_back(
          fmt::format("{}: {}", evidence.value_text(**first, kThickness), fmt::join(pictures, "; ")));
    }
    first = last;
  }
  if (compared == 0)
    return not_covered(fmt::format("no two values of {} on the grid", length), std::move(claim));
  return {thin ? changed > 0 : changed == 0, fmt::format("{}: {}", length, fmt::join(texts, ". ")),
          std::move(claim), fmt::format("{}/{} change", changed, compared)};
}

std::vector<Finding> clearance_findings(const Evidence& evidence) {
  if (const auto reason = no_thin_blades(evidence); !reason.empty()) return {not_covered(reason)};
  const auto& blades = evidence.rotor().scene.blades;
  const auto clearance = [&](const LineSummary& line) {
    return evidence.value(line, kRadius) - blades.hub_radius - blades.length;
  };
  const auto misalignment = [&](const LineSummary& line) { return evidence.value(line, kMisalignment); };
  const auto& rig = evidence.rotor().scene;
  const double interference = rig.rotor.misalignment - rig.clearance();

  auto moved = evidence.lines_over({kThickness, kMisalignment});
  // A blade that does not reach the ring never touches it from rest, so that there is nothing to compare.
  std::erase_if(moved, [&](const LineSummary* line) { return misalignment(*line) <= clearance(*line); });
  Lines widened;  // radius and misalignment of the ring grow by the same amount, so that the blades overlap
                  // the ring as before
  for (const auto* line : evidence.lines_over({kThickness, kRadius, kMisalignment})) {
    const double reach = misalignment(*line) - clearance(*line);
    if (std::abs(reach - interference) <= 1e-3 * interference) widened.push_back(line);
  }
  std::vector<Finding> findings;
  for (const bool thin : {false, true}) {
    findings.push_back(matters(evidence, moved, thin, "y0", misalignment));
    findings.push_back(matters(evidence, widened, thin, "δc with y0 = δc + 0.01 mm", clearance));
  }
  return findings;
}

}  // namespace

std::vector<Statement> judge_thin_blades(const Evidence& evidence) {
  return {{"P9", thin_blade_findings(evidence)}, {"P15", clearance_findings(evidence)}};
}

}  // namespace rubatlas::analysis
