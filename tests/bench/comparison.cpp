#include "comparison.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rubatlas::bench {
namespace {

constexpr int kRevolutionsOfAPoint = 300;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::uint64_t sum(const std::vector<std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// Errors above `target` are marked.
std::string time_table(const Comparison& comparison, const std::vector<Competitor>& competitors,
                       double target) {
  const Competitor& hybrid = comparison.competitors.front();
  std::string text =
      "| solver | step limit (τ) | tolerance | error (δc) | largest | touch-downs found | right-hand sides a "
      "revolution | … a touch-down | µs a revolution | ms a point | times hybrid |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const Competitor& competitor : competitors) {
    double right_hand_sides = 0.0;
    double touchdowns = 0.0;
    for (const PeerRun& run : competitor.runs) {
      right_hand_sides += static_cast<double>(run.work.right_hand_sides);
      touchdowns += static_cast<double>(run.work.touchdowns);
    }
    const double time = time_per_revolution(competitor);
    const double revolutions = static_cast<double>(competitor.runs.size()) * competitor.revolutions;
    text += fmt::format(
        "| {} | {} | {:.0e} | {:.1e}{} | {:.1e} | {} of {} | {:.0f} | {:.0f} | {:.1f} | {:.2f} | {:.2g} |\n",
        competitor.peer->name(), is_own(competitor) ? "–" : step_limit(competitor),
        competitor.settings.tolerance, competitor.accuracy.typical_error,
        competitor.accuracy.typical_error > target ? " (missed)" : "", competitor.accuracy.largest_error,
        found_touchdowns(competitor, hybrid), sum(hybrid.touchdowns), right_hand_sides / revolutions,
        right_hand_sides / touchdowns, 1e6 * time, 1e3 * kRevolutionsOfAPoint * time,
        time / time_per_revolution(hybrid));
  }
  return text;
}

std::string table_by_speed(const Comparison& comparison) {
  std::string header = "| µs a revolution at Ω = |";
  std::string rule = "|---|";
  const std::size_t stride = std::max<std::size_t>(1, comparison.speed_ratios.size() / 7);
  for (std::size_t i = 0; i < comparison.speed_ratios.size(); i += stride) {
    header += fmt::format(" {:.2f} |", comparison.speed_ratios[i]);
    rule += "--:|";
  }
  std::string text = header + "\n" + rule + "\n";
  for (const Competitor& competitor : comparison.competitors) {
    text += is_own(competitor)
                ? fmt::format("| {}, {:.0e} |", competitor.peer->name(), competitor.settings.tolerance)
                : fmt::format("| {}, {} |", competitor.peer->name(), step_limit(competitor));
    for (std::size_t i = 0; i < comparison.speed_ratios.size(); i += stride) {
      const double time = time_per_revolution(competitor, i);
      text += fmt::format(" {:.1f} ({:.1f}×) |", 1e6 * time,
                          time / time_per_revolution(comparison.competitors.front(), i));
    }
    text += "\n";
  }
  return text;
}

std::string table_without_limit(const Comparison& comparison) {
  const Competitor& hybrid = comparison.competitors.front();
  std::string text =
      "| error control alone, 1e-9 | right-hand sides a revolution | touch-downs found | largest "
      "displacement "
      "at a section | the true one |\n|---|--:|--:|--:|--:|\n";
  const double revolutions = static_cast<double>(reference_speed_ratios().size()) * kComparedRevolutions;
  for (const Competitor& competitor : comparison.without_limit) {
    const Accuracy& accuracy = competitor.accuracy;
    text += fmt::format("| {} | {:.1f} | {} of {} | {:.3g} m{} | {:.3g} m |\n", competitor.peer->name(),
                        static_cast<double>(accuracy.right_hand_sides) / revolutions,
                        found_touchdowns(competitor, hybrid), sum(hybrid.touchdowns),
                        accuracy.largest_displacement, accuracy.completed ? "" : " (broke off)",
                        reference_displacement());
  }
  return text;
}

}  // namespace

bool is_own(const Competitor& competitor) {
  return competitor.peer->family() == "hybrid" || competitor.peer->family() == "collocation";
}

std::string step_limit(const Competitor& competitor) {
  const double limit = competitor.settings.max_step;
  return std::isfinite(limit) ? fmt::format("{:g}", limit) : "none";
}

std::uint64_t found_touchdowns(const Competitor& competitor, const Competitor& hybrid) {
  std::uint64_t result = 0;
  for (std::size_t i = 0; i < competitor.touchdowns.size(); ++i)
    result += std::min(competitor.touchdowns[i], hybrid.touchdowns[i]);
  return result;
}

double time_per_revolution(const Competitor& competitor, std::size_t speed) {
  return median(competitor.times[speed]) / competitor.revolutions;
}

double time_per_revolution(const Competitor& competitor) {
  double total = 0.0;
  for (std::size_t i = 0; i < competitor.times.size(); ++i) total += time_per_revolution(competitor, i);
  return total / static_cast<double>(competitor.times.size());
}

std::string tables(const Comparison& comparison) {
  return fmt::format("Error to reach: {:.1e} of the clearance.\n\n", comparison.target) +
         time_table(comparison, comparison.competitors, comparison.target) + "\nGoals:\n\n" +
         goals(comparison) + "\nSpeed by speed:\n\n" + table_by_speed(comparison) +
         "\nThe published scheme, and `hybrid` as accurate as that:\n\n" +
         time_table(comparison, comparison.paper, std::numeric_limits<double>::infinity()) +
         "\nWith longer step limits:\n\n" +
         time_table(comparison, comparison.longer_steps, comparison.target) + "\nWithout any:\n" + "\n" +
         table_without_limit(comparison);
}

}  // namespace rubatlas::bench
