#include "atlas/final_states.hpp"

#include <algorithm>
#include <iterator>

#include "atlas/row_block.hpp"

namespace rubatlas::atlas {

FinalStates::FinalStates(const File& file, const Schema& schema)
    : states_(file.dataset(schema.final_state.name)) {
  for (const auto& axis : schema.axes) grid_.push_back(axis.values.size());
  for (const auto& rows : schema.memories) memories_.push_back(file.dataset(rows.name));
}

motion::PointStart FinalStates::of(std::size_t point) const {
  const PointBlock block = block_at(grid_, point, point + 1, 1);
  const auto row_in = [&](const Dataset& dataset) {
    const auto [start, count] = place_in(dataset, block);
    return dataset.read_block<double>(start, count);
  };
  motion::SectionState state{};
  std::ranges::copy(row_in(states_), state.begin());
  std::vector<double> remembered;
  for (const Dataset& memory : memories_) std::ranges::copy(row_in(memory), std::back_inserter(remembered));
  return {state, motion::Memory(remembered)};
}

void FinalStates::close() {
  states_.close();
  for (Dataset& memory : memories_) memory.close();
}

}  // namespace rubatlas::atlas
