#include "analysis/rules/parameter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "settings/quantity.hpp"

namespace rubatlas::analysis {
namespace {

Parameter parameter_of(const plan::Axis& axis) {
  Parameter parameter{.name = axis.name, .symbol = axis.name, .unit = axis.units, .values = axis.values};
  const auto* swept = settings::quantity_of_axis(axis.name);
  if (swept != nullptr && !swept->symbol.empty()) parameter.symbol = swept->symbol;
  if (parameter.unit == "1") parameter.unit.clear();
  if (parameter.unit == "m") {
    parameter.unit = "mm";
    parameter.factor = 1e3;
  }
  return parameter;
}

}  // namespace

std::string Parameter::value_text(double value) const {
  if (name == plan::kDirectionAxis) return value == 0.0 ? "up" : "down";
  const auto number = fmt::format("{:.6g}", factor * value);
  return unit.empty() ? number : number + " " + unit;
}

std::string Parameter::text(double value) const {
  return symbol + " = " + value_text(value);
}

std::string Parameter::where(std::span<const double> picked, std::span<const double> from) const {
  if (picked.size() == from.size()) return "at every " + symbol;
  if (picked.empty()) return "at no " + symbol;
  const auto starts = std::ranges::equal(picked, from.first(picked.size()));
  const auto ends = std::ranges::equal(picked, from.last(picked.size()));
  if (picked.size() > 1 && starts) return fmt::format("at {} ≤ {}", symbol, value_text(picked.back()));
  if (picked.size() > 1 && ends) return fmt::format("at {} ≥ {}", symbol, value_text(picked.front()));
  std::vector<std::string> texts;
  for (const double value : picked) texts.push_back(value_text(value));
  return fmt::format("at {} = {}", symbol, fmt::join(texts, ", "));
}

std::vector<Parameter> parameters_of(std::span<const plan::Axis> axes) {
  std::vector<Parameter> parameters;
  for (const auto& axis : axes.first(axes.size() - 1)) parameters.push_back(parameter_of(axis));
  return parameters;
}

std::string millimetres(double metres) {
  return fmt::format("{:.3g} mm", 1e3 * metres);
}

}  // namespace rubatlas::analysis
