// P10 and P14 (MODEL 6.3): the test rig as computed and as measured, on the line of its own parameters.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/paper/findings_along.hpp"
#include "analysis/paper/statements.hpp"
#include "analysis/rules/evidence_text.hpp"

namespace rubatlas::analysis {
namespace {

/// A single speed of the paper stands for all points within this distance, because the paper gives some
/// speeds to two digits, and aperiodic motion has windows of single points.
constexpr double kAround = 0.005;

/// Borders of the ranges of Ω into which P14 divides the rig's speeds.
struct Range {
  double from;
  double to;
};
constexpr Range kRegion1{0.137, 0.333};
constexpr Range kRegion2{0.35, 0.55};
constexpr Range kAperiodicInRegion3{0.55, 0.58};
constexpr Range kRestOfRegion3{0.58, 0.65};
constexpr Range kRegion4{0.65, 0.80};
constexpr double kAperiodicInRegion1 = 0.181;

/// Aperiodic motion, or its absence, in most of a range of speeds.
Finding mostly(const LineSummary& line, Range range, bool aperiodic, std::string claim) {
  const double share = aperiodic_share(line.line, range.from, range.to);
  if (std::isnan(share)) {
    return not_covered(fmt::format("no point is done in {:.3f}-{:.3f}", range.from, range.to),
                       std::move(claim));
  }
  return {(share >= kAperiodicMajority) == aperiodic,
          fmt::format("{:.0f} % aperiodic in {:.3f}-{:.3f}", 100.0 * share, range.from, range.to),
          std::move(claim), fmt::format("{:.0f} %", 100.0 * share)};
}

Finding at_speed(const LineSummary& line, double speed, bool aperiodic) {
  return mostly(line, {speed - kAround, speed + kAround}, aperiodic,
                fmt::format("{} at {:.3f}", aperiodic ? "aperiodic" : "periodic", speed));
}

/// Whether a border of a region lies within one running window of the measured one.
Finding border(int number, const Region& region, double Region::*end, std::string_view which,
               double measured) {
  auto claim = fmt::format("region {} {} {:.3f}", number, which, measured);
  if (region.presence == Presence::not_covered)
    return not_covered(region_text(number, region), std::move(claim));
  if (!region.present()) return {false, region_text(number, region), std::move(claim)};
  return {std::abs(region.*end - measured) <= kNextTo, region_text(number, region), std::move(claim),
          fmt::format("{:.3f}", region.*end)};
}

/// Median of the maximum displacement [m] over a range of speeds; NaN where no point is done.
double median_displacement(const Line& line, Range range) {
  std::vector<double> values;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool inside = line.speed_ratio[i] >= range.from && line.speed_ratio[i] <= range.to;
    if (inside && std::isfinite(line.max_displacement[i])) values.push_back(line.max_displacement[i]);
  }
  if (values.empty()) return kNotANumber;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

Finding displacement_grows(const Line& line) {
  const std::string claim = "the displacement grows with Ω";
  std::vector<double> medians;
  std::vector<std::string> texts;
  for (const auto& range :
       {kRegion1, kRegion2, Range{kAperiodicInRegion3.from, kRestOfRegion3.to}, kRegion4}) {
    medians.push_back(median_displacement(line, range));
    texts.push_back(fmt::format("{} in {:.3f}-{:.3f}", millimetres(medians.back()), range.from, range.to));
  }
  const auto text = fmt::format("median displacement {}", fmt::join(texts, ", "));
  if (std::ranges::any_of(medians, [](double median) { return std::isnan(median); })) {
    return not_covered(text, claim);
  }
  return {std::ranges::adjacent_find(medians, std::ranges::greater_equal{}) == medians.end(), text, claim};
}

}  // namespace

std::vector<Statement> judge_test_rig(const Evidence& evidence) {
  std::vector<Statement> statements{{"P10", {}}, {"P14", {}}};
  const auto* line = evidence.own_line();
  if (line == nullptr) {
    const auto reason = evidence.other_rotor().empty() ? "the grid has no line of " + evidence.rotor().name
                                                       : evidence.other_rotor();
    for (auto& statement : statements) statement.findings.push_back(not_covered(reason));
    return statements;
  }
  const auto& [region_1, region_2, region_3, region_4] = line->regions;
  statements[0].findings = {at_speed(*line, 0.304, false), at_speed(*line, 0.4, true),
                            at_speed(*line, 0.605, false), at_speed(*line, 0.74, true)};
  statements[1].findings = {mostly(*line, kRegion1, false, "region 1 is mostly periodic"),
                            border(1, region_1, &Region::to, "ends at", kRegion1.to),
                            at_speed(*line, kAperiodicInRegion1, true),
                            border(2, region_2, &Region::from, "begins at", kRegion2.from),
                            border(2, region_2, &Region::to, "ends at", kRegion2.to),
                            mostly(*line, kAperiodicInRegion3, true, "aperiodic in 0.55-0.58"),
                            mostly(*line, kRestOfRegion3, false, "periodic in 0.58-0.65"),
                            border(4, region_4, &Region::from, "begins at", kRegion4.from),
                            mostly(*line, kRegion4, true, "aperiodic in most of 0.65-0.80"),
                            displacement_grows(line->line)};
  return statements;
}

}  // namespace rubatlas::analysis
