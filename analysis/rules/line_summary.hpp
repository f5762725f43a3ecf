/// The results of the rules on one line of an atlas, with the parameters of the line.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/rules/contact.hpp"
#include "analysis/rules/doublings.hpp"
#include "analysis/rules/line.hpp"
#include "analysis/rules/regions.hpp"
#include "analysis/rules/triggers.hpp"

namespace rubatlas::analysis {

struct LineSummary {
  Line line;                       ///< the line to which the rules were applied
  std::vector<double> parameters;  ///< one per axis of the atlas without `speed_ratio`, in their order
  ContactSummary contact;
  std::array<Trigger, 2> triggers;
  std::array<Region, 4> regions;
  /// Period doublings of the map over a blade passing where the atlas has it, else over a revolution.
  std::vector<PeriodDoubling> doublings;
};

/// Applies all rules to a line. `floor` as in `find_triggers`.
LineSummary summarise(Line line, std::vector<double> parameters, SpeedScale scale, double floor);

}  // namespace rubatlas::analysis
