#include "analysis/rules/basins.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/rules/line.hpp"

namespace rubatlas::analysis {

std::vector<Basin> find_basins(const Starts& starts, const PointsOfAtlas& points) {
  std::vector<std::size_t> computed(starts.set_count(), 0);
  std::map<std::pair<std::size_t, std::uint32_t>, Basin> found;
  for (std::size_t i = 0; i < points.status.size(); ++i) {
    if (points.status[i] == 0) continue;
    const std::size_t set = starts.set_of(i);
    const std::int32_t attractor = points.attractor[i];
    ++computed[set];
    // As unsigned numbers, 0 - 1 is the last.
    const auto [place, is_new] =
        found.try_emplace({set, static_cast<std::uint32_t>(attractor) - 1U}, Basin{.set = set});
    Basin& basin = place->second;
    ++basin.points;
    if (is_new) basin.max_displacement = kNotANumber;
    if (attractor == 0) continue;
    basin.attractor = attractor;
    basin.motion = points.motion[i];
    basin.max_displacement = std::fmax(basin.max_displacement, points.max_displacement[i]);
  }
  std::vector<Basin> basins;
  for (auto& [key, basin] : found) {
    const auto all = static_cast<double>(computed[basin.set]);
    basin.share = static_cast<double>(basin.points) / all;
    basin.standard_error = std::sqrt(basin.share * (1.0 - basin.share) / all);
    basins.push_back(basin);
  }
  return basins;
}

}  // namespace rubatlas::analysis
