/// The list of observables: what an atlas can keep of a point, and the shape of each row.
///
/// This is the one place that names them. The scene reader checks `observables` against it, the atlas creates
/// its datasets from it, the solver fills rows in its order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "settings/scene.hpp"

namespace rubatlas::observables {

/// An axis behind the grid's axes; its dimension scale carries these values.
struct InnerAxis {
  std::string name;  ///< section, component, order, passing
  std::variant<std::vector<std::int32_t>, std::vector<double>, std::vector<std::string>> values;
  std::string units;
  std::string long_name;

  [[nodiscard]] std::size_t size() const {
    return std::visit([](const auto& list) { return list.size(); }, values);
  }
};

/// One dataset of the atlas: float64, shape axes × inner axes.
struct Description {
  std::string name;                     ///< dataset name and the word in the scene
  std::vector<std::string> inner_axes;  ///< names, outermost first; empty: one number per point
  std::string units;
  std::string long_name;
  std::size_t row_size = 1;  ///< product of the inner extents
};

/// The observables that the scene asks for, in the order of the list.
std::vector<Description> descriptions(const settings::Scene& scene);

/// What the scene's effects remember from point to point besides the state, one dataset
/// `final_state_<effect>` each; a point's numbers stand one after the other in this order (`solve::Memory`).
/// Empty for most scenes.
std::vector<Description> memories(const settings::Scene& scene);

/// The inner axes that observables, memories and `final_state` (component) need, each once.
std::vector<InnerAxis> inner_axes(const settings::Scene& scene);

/// One row per description, in the same order; NaN throughout when the point did not end as done.
using Rows = std::vector<std::vector<double>>;

}  // namespace rubatlas::observables
