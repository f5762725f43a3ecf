#include "plan/scene_of_line.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "settings/quantity.hpp"

namespace rubatlas::plan {

settings::Scene scene_of_line(const settings::Scene& scene, const PointParameters& line) {
  const auto axes = settings::axes_of(scene);
  const auto values = values_of(line);
  if (axes.size() != values.size()) {
    throw std::invalid_argument(
        fmt::format("a line with {} swept values, of a scene with {} axes", values.size(), axes.size()));
  }
  settings::Scene own = scene;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].quantity->write != nullptr) axes[i].quantity->write(own, values[i]);
  }
  if (line.unbalance == 0.0) own.unbalance.reset();
  return own;
}

settings::Scene with_short_axes(settings::Scene scene) {
  for (const auto& axis : settings::grid_axes()) (scene.grid.*axis.values).resize(1);
  for (auto& axis : scene.grid.swept) axis.values.resize(1);
  return scene;
}

}  // namespace rubatlas::plan
