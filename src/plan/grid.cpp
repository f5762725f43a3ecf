#include "plan/grid.hpp"

#include <array>

#include "settings/quantity.hpp"

namespace rubatlas::plan {
namespace {

/// Which members of a point's parameters the axes of `settings::grid_axes` set, in their order.
constexpr std::array kParameters{&PointParameters::thickness, &PointParameters::unbalance,
                                 &PointParameters::friction, &PointParameters::damping_ratio,
                                 &PointParameters::speed_ratio};

}  // namespace

std::vector<double> values_of(const PointParameters& parameters) {
  std::vector<double> values = parameters.swept;
  for (const auto member : kParameters) values.push_back(parameters.*member);
  return values;
}

PointParameters parameters_at(std::span<const double> values) {
  PointParameters result;
  const auto named = values.last(kParameters.size());
  for (std::size_t i = 0; i < kParameters.size(); ++i) result.*kParameters[i] = named[i];
  const auto swept = values.first(values.size() - kParameters.size());
  result.swept.assign(swept.begin(), swept.end());
  return result;
}

Grid::Grid(const settings::Scene& scene)
    : sweep_(scene.sweep), chained_(scene.sweep != settings::Sweep::independent) {
  if (sweep_ == settings::Sweep::both) {
    axes_.push_back({std::string(kDirectionAxis),
                     {0.0, 1.0},
                     "1",
                     "direction of the sweep along the speed ratio: 0 up, 1 down"});
  }
  for (auto& axis : settings::axes_of(scene)) {
    axes_.push_back({std::move(axis.name), std::move(axis.values), std::string(axis.quantity->unit),
                     std::string(axis.quantity->meaning)});
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
  std::vector<double> values(axes_.size());
  for (std::size_t i = axes_.size(); i-- > 0;) {  // the last axis runs fastest
    const auto& along = axes_[i].values;
    values[i] = along[point % along.size()];
    point /= along.size();
  }
  const std::size_t first = sweep_ == settings::Sweep::both ? 1 : 0;  // the direction is no parameter
  return parameters_at(std::span<const double>(values).subspan(first));
}

Direction Grid::direction(std::size_t line) const {
  switch (sweep_) {
    case settings::Sweep::down:
      return Direction::down;
    case settings::Sweep::both:  // `direction` is the slowest axis: the first half of the lines goes up
      return line < line_count() / 2 ? Direction::up : Direction::down;
    case settings::Sweep::up:
    case settings::Sweep::independent:
      break;
  }
  return Direction::up;
}

std::size_t Grid::point(std::size_t line, std::size_t visit) const {
  const std::size_t speeds = speed_count();
  return line * speeds + (direction(line) == Direction::up ? visit : speeds - 1 - visit);
}

}  // namespace rubatlas::plan
