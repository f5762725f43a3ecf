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
  std::size_t count = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line.motion[i] == motion_class::kNone) continue;
    if (count++ == 0) summary.first_speed = line.speed_ratio[i];
    summary.last_speed = line.speed_ratio[i];
  }
  if (count > 1)
    summary.speed_step = (summary.last_speed - summary.first_speed) / static_cast<double>(count - 1);
  summary.line = std::move(line);
  return summary;
}

}  // namespace rubatlas::analysis
