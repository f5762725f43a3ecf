#include "atlas/final_states.hpp"

#include <algorithm>

#include "observables/list.hpp"

namespace rubatlas::atlas {

FinalStates::FinalStates(const AtlasReader& atlas, const settings::Scene& scene)
    : states_(atlas.rows("/final_state")) {
  for (const auto& remembered : observables::memories(scene)) {
    memories_.push_back({remembered.row_size, atlas.rows("/" + remembered.name)});
  }
}

motion::PointStart FinalStates::of(std::size_t point) const {
  const auto row = [point](const std::vector<double>& values, std::size_t size) {
    return values.begin() + static_cast<std::ptrdiff_t>(size * point);
  };
  motion::SectionState state{};
  std::copy_n(row(states_, state.size()), state.size(), state.begin());
  std::vector<double> remembered;
  for (const Rows& memory : memories_) {
    const auto from = row(memory.values, memory.size);
    remembered.insert(remembered.end(), from, from + static_cast<std::ptrdiff_t>(memory.size));
  }
  return {state, motion::Memory(remembered)};
}

}  // namespace rubatlas::atlas
