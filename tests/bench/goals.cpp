/// What was asked of `hybrid`, and what has been measured.
#include <fmt/core.h>

#include <algorithm>

#include "comparison.hpp"

namespace rubatlas::bench {
namespace {

std::string line(const std::string& goal, bool met, const std::string& measured) {
  return fmt::format("| {} | {} | {} |\n", goal, measured, met ? "yes" : "no");
}

/// The fastest of a family that is as accurate as hybrid and finds every touch-down. Null where there is
/// none.
const Competitor* fastest(const Comparison& comparison, const std::vector<Competitor>& among,
                          const std::string& family) {
  const Competitor& hybrid = comparison.competitors.front();
  const Competitor* result = nullptr;
  for (const Competitor& competitor : among) {
    if (competitor.peer->family() == family && competitor.accuracy.typical_error <= comparison.target &&
        found_touchdowns(competitor, hybrid) == found_touchdowns(hybrid, hybrid) &&
        (!result || time_per_revolution(competitor) < time_per_revolution(*result)))
      result = &competitor;
  }
  return result;
}

/// Measured at the common step limit, and at the best of the longer ones.
std::string ratio_to(const Comparison& comparison, const std::string& family, double goal) {
  const double hybrid = time_per_revolution(comparison.competitors.front());
  std::string text;
  for (const auto* among : {&comparison.competitors, &comparison.longer_steps}) {
    const Competitor* peer = fastest(comparison, *among, family);
    if (!peer) continue;
    const double ratio = time_per_revolution(*peer) / hybrid;
    text += line(fmt::format("{:g} times the fastest {}", goal, family), ratio >= goal,
                 fmt::format("{:.1f} times {}, step limit {}", ratio, peer->peer->name(), step_limit(*peer)));
  }
  return text;
}

/// Against hybrid at its default tolerance, and against hybrid no more accurate than that.
std::string ratio_to_paper(const Comparison& comparison) {
  constexpr double kGoal = 100.0;
  std::string text;
  for (std::size_t i = 0; i + 1 < comparison.paper.size(); i += 2) {
    const Competitor& paper = comparison.paper[i];
    const double time = time_per_revolution(paper);
    const double ratio = time / time_per_revolution(comparison.competitors.front());
    const double as_accurate = time / time_per_revolution(comparison.paper[i + 1]);
    text += line(fmt::format("{:g} times paper at the accuracy that it reaches", kGoal), ratio >= kGoal,
                 fmt::format("{:.0f} times {}, error {:.0e}; {:.0f} times with hybrid no more accurate",
                             ratio, paper.peer->name(), paper.accuracy.typical_error, as_accurate));
  }
  return text;
}

}  // namespace

std::string goals(const Comparison& comparison) {
  motion::WorkCounts work;
  for (const PeerRun& run : comparison.whole_points.runs) work += run.work;
  const auto touchdowns = static_cast<double>(work.touchdowns);
  const double right_hand_sides = static_cast<double>(work.right_hand_sides) / touchdowns;
  const double gaps = static_cast<double>(work.gap_evaluations) / touchdowns;
  const double rejected = 100.0 * static_cast<double>(work.rejected_steps) /
                          static_cast<double>(work.steps + work.rejected_steps);
  const double point =
      1e3 * time_per_revolution(comparison.whole_points) * comparison.whole_points.revolutions;
  return "| goal for hybrid | measured | met |\n|---|---|---|\n" + ratio_to(comparison, "odeint", 30.0) +
         ratio_to(comparison, "ARKODE", 100.0) + ratio_to(comparison, "CVODE", 100.0) +
         ratio_to_paper(comparison) +
         line("a point of 300 revolutions in 6 ms", point <= 6.0, fmt::format("{:.1f} ms", point)) +
         line("120 right-hand sides a touch-down", right_hand_sides <= 120.0,
              fmt::format("{:.0f}", right_hand_sides)) +
         line("12 evaluations of the gap between touch-downs", gaps <= 12.0, fmt::format("{:.1f}", gaps)) +
         line("5 % of steps rejected", rejected <= 5.0, fmt::format("{:.1f} %", rejected));
}

}  // namespace rubatlas::bench
