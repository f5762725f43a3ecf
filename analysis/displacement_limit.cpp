#include "analysis/displacement_limit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "analysis/rules/scene_tolerances.hpp"

namespace rubatlas::analysis {

double DisplacementLimit::metres(const settings::Scene& scene) const {
  return number * (unit > 0.0 ? unit : length_scale(scene));
}

std::optional<DisplacementLimit> parse_limit(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, double>, 5> kUnits{
      {{"m", 1.0}, {"mm", 1e-3}, {"um", 1e-6}, {"µm", 1e-6}, {"clearances", 0.0}}};
  DisplacementLimit limit;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), limit.number);
  if (error != std::errc{} || !std::isfinite(limit.number) || limit.number <= 0.0) return std::nullopt;
  auto name = text.substr(static_cast<std::size_t>(rest - text.data()));
  name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
  const auto* unit = std::ranges::find(kUnits, name, [](const auto& entry) { return entry.first; });
  if (unit == kUnits.end()) return std::nullopt;
  limit.unit = unit->second;
  return limit;
}

}  // namespace rubatlas::analysis
