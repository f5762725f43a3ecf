#include "accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/point.hpp"
#include "reference_case.hpp"

namespace rubatlas::bench {
namespace {

constexpr double kTightestTolerance = 1e-13;

/// Of these the first ten sections are known to 1e-17 m and better.
const std::vector<const test::ReferenceCase*>& reference_points() {
  static const std::vector<const test::ReferenceCase*> kPoints = [] {
    std::vector<const test::ReferenceCase*> points;
    for (const char* name :
         {"default_Om0.15", "default_Om0.25", "default_Om0.30", "default_Om0.40", "default_Om0.62"})
      points.push_back(&test::reference_case(name));
    return points;
  }();
  return kPoints;
}

}  // namespace

Accuracy accuracy_of(const Peer& peer, const PeerSettings& settings) {
  Accuracy result;
  double sum_of_logarithms = 0.0;
  for (const test::ReferenceCase* point : reference_points()) {
    const PeerRun run = peer.run(point->speed_ratio, kComparedRevolutions, settings);
    result.completed = result.completed && run.completed;
    result.right_hand_sides += run.work.right_hand_sides;
    double error = 0.0;
    for (std::size_t i = 0; i < run.sections.size(); ++i) {
      const motion::SectionState& section = run.sections[i];
      error = std::max(
          error, test::largest_difference(section, point->first_sections[i]) / point->scene.clearance());
      result.largest_displacement = std::max(result.largest_displacement, std::hypot(section[0], section[1]));
    }
    sum_of_logarithms += std::log(error);
    result.largest_error = std::max(result.largest_error, error);
  }
  result.typical_error = std::exp(sum_of_logarithms / static_cast<double>(reference_points().size()));
  return result;
}

std::vector<double> reference_speed_ratios() {
  std::vector<double> result;
  for (const test::ReferenceCase* point : reference_points()) result.push_back(point->speed_ratio);
  return result;
}

double reference_displacement() {
  double largest = 0.0;
  for (const test::ReferenceCase* point : reference_points()) {
    for (const motion::SectionState& section : point->first_sections)
      largest = std::max(largest, std::hypot(section[0], section[1]));
  }
  return largest;
}

PeerSettings match_accuracy(const Peer& peer, PeerSettings settings, double target) {
  PeerSettings best = settings;
  double least = std::numeric_limits<double>::infinity();
  const double loosest = settings.tolerance;
  for (int half_decade = 0; settings.tolerance >= kTightestTolerance; ++half_decade) {
    const Accuracy accuracy = accuracy_of(peer, settings);
    if (accuracy.completed && accuracy.typical_error < least) {
      best = settings;
      least = accuracy.typical_error;
    }
    if (least <= target) break;
    settings.tolerance = loosest * std::pow(10.0, -0.5 * (half_decade + 1));
  }
  return best;
}

std::vector<std::uint64_t> touchdowns_of(const Peer& peer, const PeerSettings& settings,
                                         std::span<const double> speed_ratios) {
  std::vector<std::uint64_t> result;
  for (const double speed_ratio : speed_ratios)
    result.push_back(peer.run(speed_ratio, kComparedRevolutions, settings).work.touchdowns);
  return result;
}

}  // namespace rubatlas::bench
