#include "analysis/rules/margins.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {
namespace {

constexpr double kMostError = 0.25;  ///< of the distance to a grazing

enum class Towards : std::uint8_t { lower_values, higher_values };

/// The smallest u > 0 with m + a u + b u² = 0; NaN if there is none.
double first_zero(double m, double a, double b) {
  const double root = std::sqrt(a * a - 4.0 * m * b);   // NaN where the parabola does not reach zero
  return a < 0.0 ? 2.0 * m / (root - a) : kNotANumber;  // the form without cancellation
}

/// Points from `point` on, in steps towards the grazing (`ahead` = +1) or away from it (-1).
std::optional<std::size_t> step(const MotionsAlong& motions, std::size_t point, Towards towards, int ahead) {
  const bool up = (towards == Towards::higher_values) == (ahead > 0);
  if (up) return point + 1 < motions.values.size() ? std::optional(point + 1) : std::nullopt;
  return point > 0 ? std::optional(point - 1) : std::nullopt;
}

std::optional<Grazing> predicted(const MotionsAlong& motions, std::size_t point, Towards towards) {
  const auto& miss = motions.nearest_miss;
  const auto same = [&](std::size_t other) {
    return motions.motion[other] == motions.motion[point] && std::isfinite(miss[other]);
  };
  if (!is_periodic(motions.motion[point]) || !same(point)) return std::nullopt;
  const auto behind = step(motions, point, towards, -1);
  const auto second = behind ? step(motions, *behind, towards, -1) : std::nullopt;
  if (!second || !same(*behind) || !same(*second)) return std::nullopt;

  // Newton's divided differences in u, which grows from the point towards the grazing.
  const double u_1 = -std::abs(motions.values[*behind] - motions.values[point]);
  const double u_2 = -std::abs(motions.values[*second] - motions.values[point]);
  const double slope = (miss[*behind] - miss[point]) / u_1;
  const double bend = ((miss[*second] - miss[*behind]) / (u_2 - u_1) - slope) / u_2;
  const double straight = -miss[point] / slope;
  const double distance = first_zero(miss[point], slope - bend * u_1, bend);
  const double error = std::abs(distance - straight);
  if (!(slope < 0.0 && error <= kMostError * distance)) return std::nullopt;

  const double at = motions.values[point] + (towards == Towards::higher_values ? distance : -distance);
  const auto is_before = [&](double value) {
    return towards == Towards::higher_values ? value < at : value > at;
  };
  for (auto next = step(motions, point, towards, 1); next && is_before(motions.values[*next]);
       next = step(motions, *next, towards, 1)) {
    if (!same(*next) || miss[*next] > miss[point]) return std::nullopt;
  }
  return Grazing{.at = at, .error = error, .from = {point, *behind, *second}};
}

}  // namespace

std::vector<double> distances_to_borders(const MotionsAlong& motions) {
  std::vector<double> distances(motions.values.size(), kNotANumber);
  for (const auto& border : find_borders(motions.motion)) {
    const double middle = 0.5 * (motions.values[border.below] + motions.values[border.above]);
    for (std::size_t i = 0; i < distances.size(); ++i) {
      if (motions.motion[i] == motion_class::kNone) continue;
      distances[i] = std::fmin(distances[i], std::abs(motions.values[i] - middle));
    }
  }
  return distances;
}

std::optional<Grazing> predicted_grazing(const MotionsAlong& motions, std::size_t point) {
  const auto above = predicted(motions, point, Towards::higher_values);
  const auto below = predicted(motions, point, Towards::lower_values);
  if (!above || !below) return above ? above : below;
  const double value = motions.values[point];
  return above->at - value < value - below->at ? above : below;
}

std::optional<Grazing> grazing_at(const MotionsAlong& motions, const Border& border) {
  const auto between = [&](const std::optional<Grazing>& grazing) {
    return grazing && grazing->at + grazing->error >= motions.values[border.below] &&
           grazing->at - grazing->error <= motions.values[border.above];
  };
  const auto below = predicted(motions, border.below, Towards::higher_values);
  const auto above = predicted(motions, border.above, Towards::lower_values);
  if (between(below) && between(above)) return below->error < above->error ? below : above;
  if (between(below)) return below;
  return between(above) ? above : std::nullopt;
}

}  // namespace rubatlas::analysis
