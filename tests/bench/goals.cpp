/// What was asked of `collocation`, and what has been measured.
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

/// At equal error. Measured at the common step limit, and at the best of the longer ones.
std::string ratio_to(const Comparison& comparison, const std::string& family, double goal) {
  const double ours = time_per_revolution(comparison.competitors[2]);
  std::string text;
  for (const auto* among : {&comparison.competitors, &comparison.longer_steps}) {
    const Competitor* peer = fastest(comparison, *among, family);
    if (!peer) continue;
    const double ratio = time_per_revolution(*peer) / ours;
    text += line(fmt::format("{:g} times the fastest {}", goal, family), ratio >= goal,
                 fmt::format("{:.1f} times {}, step limit {}", ratio, peer->peer->name(), step_limit(*peer)));
  }
  return text;
}

/// Against `collocation` at its default tolerance, and against `hybrid` no more accurate than that.
std::string ratio_to_paper(const Comparison& comparison) {
  constexpr double kGoal = 100.0;
  std::string text;
  for (std::size_t i = 0; i + 1 < comparison.paper.size(); i += 2) {
    const Competitor& paper = comparison.paper[i];
    const double time = time_per_revolution(paper);
    const double ratio = time / time_per_revolution(comparison.competitors[1]);
    const double as_accurate = time / time_per_revolution(comparison.paper[i + 1]);
    text += line(fmt::format("{:g} times paper at the accuracy that it reaches", kGoal), ratio >= kGoal,
                 fmt::format("{:.0f} times {}, error {:.0e}; {:.0f} times with hybrid no more accurate",
                             ratio, paper.peer->name(), paper.accuracy.typical_error, as_accurate));
  }
  return text;
}

}  // namespace

std::string goals(const Comparison& comparison) {
  const auto& [hybrid, collocation] = comparison.whole_points;
  motion::WorkCounts work;
  for (const PeerRun& run : collocation.runs) work += run.work;
  const auto touchdowns = static_cast<double>(work.touchdowns);
  const double evaluations = static_cast<double>(work.right_hand_sides) / touchdowns;
  const double rejected = 100.0 * static_cast<double>(work.rejected_steps) /
                          static_cast<double>(work.steps + work.rejected_steps);
  constexpr double kGoal = 2.7;  // 3.8 ms where `hybrid` takes 10.4
  const double ratio = time_per_revolution(hybrid) / time_per_revolution(collocation);
  const double point = 1e3 * time_per_revolution(collocation) * collocation.revolutions;
  return "| goal for collocation | measured | met |\n|---|---|---|\n" + ratio_to(comparison, "odeint", 60.0) +
         ratio_to(comparison, "ARKODE", 150.0) + ratio_to(comparison, "CVODE", 150.0) +
         ratio_to_paper(comparison) +
         line(fmt::format("{:g} times as fast as hybrid over points of 300 revolutions", kGoal),
              ratio >= kGoal, fmt::format("{:.2f}, {:.1f} ms a point", ratio, point)) +
         line("115 evaluations of a node a touch-down, eight in a sweep", evaluations <= 115.0,
              fmt::format("{:.0f}", evaluations)) +
         line("5 % of intervals rejected", rejected <= 5.0, fmt::format("{:.1f} %", rejected));
}

}  // namespace rubatlas::bench
