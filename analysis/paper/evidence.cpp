#include "analysis/paper/evidence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "settings/quantity.hpp"

namespace rubatlas::analysis {

std::vector<Setting> settings(const ReferenceRotor& rotor, const settings::Scene& scene,
                              std::span<const Parameter> parameters, std::string_view without) {
  std::vector<Setting> result(1);
  if (!rotor.difference(scene).empty()) return result;
  for (const auto& parameter : parameters) {
    if (parameter.name == without || std::ranges::count(rotor.open, parameter.name) == 0) continue;
    std::vector<Setting> longer;
    for (const auto& setting : result) {
      for (const double value : parameter.values) {
        auto next = setting;
        next.values.emplace_back(parameter.name, value);
        next.text += (next.text.empty() ? "" : ", ") + parameter.text(value);
        longer.push_back(std::move(next));
      }
    }
    result = std::move(longer);
  }
  return result;
}

Evidence::Evidence(const settings::Scene& scene, std::span<const Parameter> parameters,
                   std::span<const LineSummary> lines, bool per_passing, ReferenceRotor rotor,
                   Setting setting)
    : scene_(scene),
      parameters_(parameters),
      lines_(lines),
      scale_(scene.blades.count),
      per_passing_(per_passing),
      rotor_(std::move(rotor)),
      setting_(std::move(setting)),
      other_rotor_(rotor_.difference(scene)) {}

std::size_t Evidence::position(std::string_view name) const {
  const auto found = std::ranges::find(parameters_, name, &Parameter::name);
  return static_cast<std::size_t>(found - parameters_.begin());
}

bool Evidence::fits(const Parameter& parameter, double value) const {
  for (const auto& [name, set] : setting_.values) {
    if (name == parameter.name) return value == set;
  }
  // An optional axis with one value is the scene's own value, which has already been compared with the rotor.
  const bool in_every_atlas =
      std::ranges::count(settings::grid_axes(), parameter.name, &settings::GridAxis::name) > 0;
  const bool own_value =
      !in_every_atlas && parameter.name != plan::kDirectionAxis && parameter.values.size() == 1;
  const auto* quantity = settings::quantity_of_axis(parameter.name);
  const std::string_view pointer = quantity == nullptr ? std::string_view{} : quantity->pointer;
  return own_value || rotor_.agrees(pointer, value, rotor_.usual(parameter.name));
}

std::vector<const LineSummary*> Evidence::lines_over(std::initializer_list<std::string_view> names) const {
  std::vector<const LineSummary*> result;
  if (!other_rotor_.empty()) return result;
  for (const auto& line : lines_) {
    bool all = true;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      const bool free = std::ranges::find(names, parameters_[i].name) != names.end();
      all = all && (free || fits(parameters_[i], line.parameters[i]));
    }
    if (all) result.push_back(&line);
  }
  std::ranges::stable_sort(result, {}, [&](const LineSummary* line) {
    std::vector<double> values;
    for (const auto name : names) values.push_back(value(*line, name));
    return values;
  });
  return result;
}

const LineSummary* Evidence::own_line() const {
  const auto lines = lines_over({});
  return lines.empty() ? nullptr : lines.front();
}

double Evidence::value(const LineSummary& line, std::string_view name) const {
  const auto i = position(name);
  return i < line.parameters.size() ? line.parameters[i] : rotor_.usual(name);
}

std::string Evidence::value_text(const LineSummary& line, std::string_view name) const {
  const auto i = position(name);
  return parameters_[i].text(line.parameters[i]);
}

double Evidence::friction() const {
  for (const auto& [name, set] : setting_.values) {
    if (name == "friction") return set;
  }
  return rotor_.usual("friction");
}

}  // namespace rubatlas::analysis
