/// The observables of a scene: what an atlas keeps of a point, and the shape of each row.
///
/// The atlas makes its datasets from this list, the solver fills rows in its order. The words for scenes are
/// in `settings/observable_names.hpp`, for the reader below this folder; a test holds the two lists equal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "settings/scene.hpp"

namespace rubatlas::observables {

/// An inner axis: it follows the axes of the grid; its dimension scale holds these values.
struct InnerAxis {
  std::string name;  ///< section, component, order, passing
  std::variant<std::vector<std::int32_t>, std::vector<double>, std::vector<std::string>> values;
  std::string units;
  std::string long_name;

  [[nodiscard]] std::size_t size() const {
    return std::visit([](const auto& list) { return list.size(); }, values);
  }
};

/// One dataset of the atlas: float64, or u8 where its values are flags; shape axes × inner axes.
struct Description {
  std::string name;                     ///< dataset name and the word in the scene
  std::vector<std::string> inner_axes;  ///< names, outermost first; empty: one number per point
  std::string units;
  std::string long_name;
  std::size_t row_size = 1;  ///< product of the inner extents
  std::string flags{};       ///< what the values 0, 1, … mean, one word each; empty: they are numbers
};

/// The observables that the scene asks for, in the order of the list.
std::vector<Description> descriptions(const settings::Scene& scene);

/// What the scene's effects remember from point to point besides the state, one dataset
/// `final_state_<effect>` each; a point's numbers stand one after the other in this order (`motion::Memory`).
/// Empty for most scenes.
std::vector<Description> memories(const settings::Scene& scene);

/// The inner axes that observables, memories and `final_state` (component) need, each once.
std::vector<InnerAxis> inner_axes(const settings::Scene& scene);

/// One row per description, in the same order; NaN throughout when the point did not end as done.
using Rows = std::vector<std::vector<double>>;

}  // namespace rubatlas::observables
