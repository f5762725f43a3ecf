/// How far the motions along one parameter are from a change: from the nearest border, and from grazing.
///
/// A tip that passes the ring by less and less as a parameter changes will graze it: until then the motion,
/// and with it the nearest miss, depends on the parameter smoothly, so that the place can be extrapolated
/// before anything happens there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "analysis/rules/borders.hpp"

namespace rubatlas::analysis {

/// Motions along one parameter, all others fixed. All vectors have one entry per value.
struct MotionsAlong {
  std::vector<double> values;        ///< of the parameter, ascending
  std::vector<std::uint8_t> motion;  ///< class, as `find_borders` takes it
  std::vector<double> nearest_miss;  ///< [m]; NaN where no tip passes the ring
};

/// A place at which the trend of the nearest miss reaches zero.
struct Grazing {
  double at = kNotANumber;            ///< value of the parameter
  double error = kNotANumber;         ///< difference of the trends of second and of first degree
  std::array<std::size_t, 3> from{};  ///< the points that show the trend; the one next to the grazing first
};

/// Distance of each value to the nearest border, which is taken to be in the middle between its two points.
/// NaN where the motion is not known, and everywhere if there is no border.
[[nodiscard]] std::vector<double> distances_to_borders(const MotionsAlong& motions);

/// Where the motion of a point will graze as the parameter moves away from it. The trend is the parabola
/// through the misses of the point and of its two neighbours on the other side; all three have one
/// period. There is no such place
/// - if the miss does not fall towards it, or other motions lie in between, or ones with a greater miss;
/// - if the straight line through the two nearer points leads to another place, a quarter of the way off.
/// Of two, on both sides of the point, the nearer one.
[[nodiscard]] std::optional<Grazing> predicted_grazing(const MotionsAlong& motions, std::size_t point);

/// The grazing at which the motion changes: one that is predicted, from either side, between the two points
/// of a border. Of two the one with the smaller error.
[[nodiscard]] std::optional<Grazing> grazing_at(const MotionsAlong& motions, const Border& border);

}  // namespace rubatlas::analysis
