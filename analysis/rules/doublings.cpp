#include "analysis/rules/doublings.hpp"

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {
namespace {

struct Run {
  std::uint8_t motion;
  std::size_t first;
  std::size_t last;
};

/// Runs of points with the same class; unresolved points and points without a class belong to no run.
std::vector<Run> runs_of(std::span<const std::uint8_t> motion) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (motion[i] == motion_class::kNone || motion[i] == motion_class::kUnresolved) continue;
    const bool goes_on = !runs.empty() && runs.back().motion == motion[i] && runs.back().last + 1 == i;
    if (goes_on) {
      runs.back().last = i;
    } else {
      runs.push_back({motion[i], i, i});
    }
  }
  return runs;
}

/// Whether the motion after a run of a doubled period shows that the run is no isolated window.
bool goes_on(const Run& run, std::span<const std::uint8_t> motion) {
  if (run.last + 1 >= motion.size()) return false;
  const auto next = motion[run.last + 1];
  return next == motion_class::kAperiodic || next == motion_class::kUnresolved || next == 2 * run.motion;
}

bool is_steady(const Run& run) {
  return is_periodic(run.motion) && run.last - run.first + 1 >= kShortestRun;
}

}  // namespace

std::vector<PeriodDoubling> period_doublings(std::span<const double> speed_ratio,
                                             std::span<const std::uint8_t> motion) {
  std::vector<PeriodDoubling> doublings;
  const auto runs = runs_of(motion);
  for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
    const Run& below = runs[i];
    const Run& above = runs[i + 1];
    if (!is_steady(below) || above.motion != 2 * below.motion) continue;
    if (!is_steady(above) && !goes_on(above, motion)) continue;
    if (above.first - below.last - 1 > kLongestDoubt) continue;
    doublings.push_back({0.5 * (speed_ratio[below.last] + speed_ratio[above.first]), below.motion});
  }
  return doublings;
}

}  // namespace rubatlas::analysis
