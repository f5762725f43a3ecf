#include "plan/grid.hpp"

#include <array>
#include <string_view>

#include "scene/quantity.hpp"

namespace rubatlas::plan {
namespace {

/// Which member of a point's parameters an axis of the scene sets.
struct AxisParameter {
  std::string_view name;
  double PointParameters::*value;
};

constexpr std::array kParameters{
    AxisParameter{"thickness", &PointParameters::thickness},
    AxisParameter{"unbalance", &PointParameters::unbalance},
    AxisParameter{"friction", &PointParameters::friction},
    AxisParameter{"damping_ratio", &PointParameters::damping_ratio},
    AxisParameter{"speed_ratio", &PointParameters::speed_ratio},
};

}  // namespace

Grid::Grid(const scene::Scene& scene)
    : sweep_(scene.sweep), chained_(scene.sweep != scene::Sweep::independent) {
  if (sweep_ == scene::Sweep::both) {
    axes_.push_back(
        {"direction", {0.0, 1.0}, "1", "direction of the sweep along the speed ratio: 0 up, 1 down"});
  }
  for (const auto& axis : scene::grid_axes()) {
    const auto& quantity = scene::quantity(axis.quantity);
    axes_.push_back({std::string(axis.name), scene.grid.*axis.values, std::string(quantity.unit),
                     std::string(quantity.meaning)});
  }
}

std::vector<std::size_t> Grid::shape() const {
  std::vector<std::size_t> extents;
  for (const auto& axis : axes_) extents.push_back(axis.values.size());
  return extents;
}

std::size_t Grid::point_count() const {
  return line_count() * speed_count();
}

std::size_t Grid::line_count() const {
  std::size_t lines = 1;
  for (std::size_t i = 0; i + 1 < axes_.size(); ++i) lines *= axes_[i].values.size();
  return lines;
}

std::size_t Grid::speed_count() const {
  return axes_.back().values.size();
}

PointParameters Grid::parameters(std::size_t point) const {
  PointParameters result;
  for (std::size_t i = axes_.size(); i-- > 0;) {  // the last axis runs fastest
    const Axis& axis = axes_[i];
    const std::size_t extent = axis.values.size();
    for (const auto& parameter : kParameters) {
      if (parameter.name == axis.name) result.*parameter.value = axis.values[point % extent];
    }
    point /= extent;
  }
  return result;
}

Direction Grid::direction(std::size_t line) const {
  switch (sweep_) {
    case scene::Sweep::down:
      return Direction::down;
    case scene::Sweep::both:  // `direction` is the slowest axis: the first half of the lines goes up
      return line < line_count() / 2 ? Direction::up : Direction::down;
    case scene::Sweep::up:
    case scene::Sweep::independent:
      break;
  }
  return Direction::up;
}

std::size_t Grid::point(std::size_t line, std::size_t visit) const {
  const std::size_t speeds = speed_count();
  return line * speeds + (direction(line) == Direction::up ? visit : speeds - 1 - visit);
}

}  // namespace rubatlas::plan
