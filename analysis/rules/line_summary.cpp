#include "analysis/rules/line_summary.hpp"

#include <cstddef>
#include <utility>

namespace rubatlas::analysis {

LineSummary summarise(Line line, std::vector<double> parameters, SpeedScale scale, double floor) {
  LineSummary summary;
  summary.parameters = std::move(parameters);
  summary.contact = summarise_contact(line);
  summary.triggers = find_triggers(line, scale, floor);
  summary.regions = find_regions(line, scale, summary.triggers);
  const auto& motion = line.motion_per_passing.empty() ? line.motion : line.motion_per_passing;
  summary.doublings = period_doublings(line.speed_ratio, motion);
  summary.line = std::move(line);
  return summary;
}

}  // namespace rubatlas::analysis
