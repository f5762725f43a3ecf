#include "analysis/signature_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/report_parts.hpp"
#include "analysis/rules/parameter.hpp"

namespace rubatlas::analysis {
namespace {

std::string sentence_of(const LineSignature& line, int blades) {
  const std::array<std::string, kSignNames.size()> names{fmt::format("{}× line", blades), "broad band",
                                                         "sub-harmonic"};
  const bool passes = !std::isnan(line.limit_speed_ratio);
  std::vector<std::string> standing;
  std::vector<std::string> wrong;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& sign = line.signs[i];
    if (!std::isnan(sign.speed_ratio)) {
      standing.push_back(fmt::format("{} from {:.3f} ({:.1f} % earlier)", names[i], sign.speed_ratio,
                                     100.0 * (1.0 - sign.speed_ratio / line.limit_speed_ratio)));
    }
    if (sign.false_signs > 0) wrong.push_back(fmt::format("{} {}", names[i], sign.false_signs));
  }
  auto text = fmt::format("{} {}", millimetres(line.limit),
                          line.is_kept ? "never passed" : "passed at no speed that is done; some are not");
  if (passes) {
    const bool judged = line.passing_is_seen && std::ranges::any_of(line.signs, &Announcement::is_judged);
    if (standing.empty()) standing.emplace_back(judged ? "no sign before" : "signs before are not covered");
    text = fmt::format("{} passed at Ω = {:.3f}{}: {}", millimetres(line.limit), line.limit_speed_ratio,
                       line.passing_is_seen ? "" : " at the latest", fmt::join(standing, ", "));
  }
  if (!wrong.empty()) text += fmt::format("; false signs: {}", fmt::join(wrong, ", "));
  return text + ".";
}

/// Of a line that left the model everywhere nothing is known that a sign could announce.
bool has_points(const Line& line) {
  return std::ranges::any_of(line.max_displacement, [](double value) { return !std::isnan(value); });
}

}  // namespace

std::vector<std::string> signature_sentences(const Findings& found) {
  if (found.signatures.empty()) return {};
  const int blades = found.scene.blades.count;
  std::vector<std::string> sentences{
      fmt::format("A sign is a growth to {:g} times over a thirtieth of Ω n/3: of the {}× line, of the broad "
                  "band or of the "
                  "highest line between the whole orders. It is false where it is withdrawn before the "
                  "displacement passes the "
                  "limit, or where that never happens.",
                  kSignRise, blades)};
  const std::size_t explained = sentences.size();
  for (std::size_t line = 0; line < found.signatures.size(); ++line) {
    if (has_points(found.lines[line].line))
      sentences.push_back(line_text(found, line) + sentence_of(found.signatures[line], blades));
  }
  if (sentences.size() == explained) sentences.clear();
  return sentences;
}

}  // namespace rubatlas::analysis
