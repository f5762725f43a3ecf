/// The grid of an atlas: which point has which parameters, and in which order points depend on each other.
///
/// Points are numbered in C order over the axes `[direction,] [axes swept by pointer,] thickness, unbalance,
/// friction, damping_ratio, speed_ratio`. A line is all points that differ in speed ratio only: points
/// [line * speeds, (line + 1) * speeds). Along a line of a sweep each point starts from the final state of
/// the one visited before it; `visit` counts along the line in the order in which the sweep goes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "settings/scene.hpp"

namespace rubatlas::plan {

/// The swept quantities at one grid point, or (all but the speed ratio) on one line.
struct PointParameters {
  double speed_ratio = 0.0;        ///< Ω [-]
  double damping_ratio = 0.0;      ///< ζ [-]
  double friction = 0.0;           ///< μ [-]
  double unbalance = 0.0;          ///< me [kg m]
  double thickness = 0.0;          ///< h [m]
  std::vector<double> swept = {};  ///< on the axes of `settings::Grid::swept`, in their order
};

/// The parameters as one value per axis, in the order of `settings::axes_of` (slowest first, speed ratio
/// last).
std::vector<double> values_of(const PointParameters& parameters);
/// The inverse; the last five values belong to the five axes that every atlas has.
PointParameters parameters_at(std::span<const double> values);

enum class Direction : std::uint8_t { up = 0, down = 1 };

/// One axis of the atlas, as its dimension scale is written.
struct Axis {
  std::string name;            ///< dataset name, for example "damping_ratio"
  std::vector<double> values;  ///< ascending; for `direction` 0 and 1
  std::string units;
  std::string long_name;
};

/// Name of the axis of an atlas that is swept both ways.
inline constexpr std::string_view kDirectionAxis = "direction";

class Grid {
 public:
  explicit Grid(const settings::Scene& scene);

  [[nodiscard]] const std::vector<Axis>& axes() const { return axes_; }
  /// One extent per axis.
  [[nodiscard]] std::vector<std::size_t> shape() const;
  [[nodiscard]] std::size_t point_count() const;
  [[nodiscard]] std::size_t line_count() const;
  /// Points of a line: the extent of `speed_ratio`.
  [[nodiscard]] std::size_t speed_count() const;

  [[nodiscard]] PointParameters parameters(std::size_t point) const;
  /// Direction in which a line is visited (`independent` counts as up).
  [[nodiscard]] Direction direction(std::size_t line) const;
  /// Point number of the `visit`-th point of a line.
  [[nodiscard]] std::size_t point(std::size_t line, std::size_t visit) const;
  /// True when a point starts from the end of the one before it: a line is then computed in order.
  [[nodiscard]] bool points_depend_on_each_other() const { return chained_; }

 private:
  std::vector<Axis> axes_;
  settings::Sweep sweep_;
  bool chained_;
};

}  // namespace rubatlas::plan
