#include "analysis/statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/findings_along.hpp"
#include "scene/quantity.hpp"

namespace rubatlas::analysis {
namespace {

/// Decimals as binary64: nine digits tell values apart and forgive rounding.
bool same(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

/// Quantities that the default rotor fixes and that are no axis of every atlas (MODEL 6.1).
constexpr std::array kFixed{
    "/rotor/mass",   "/rotor/natural_frequency", "/rotor/misalignment", "/blades/count", "/blades/length",
    "/blades/width", "/blades/youngs_modulus",   "/blades/hub_radius",  "/ring/radius"};

bool is_swept(const scene::Scene& scene, std::string_view pointer) {
  return std::ranges::any_of(
      scene.grid.swept, [&](const auto& axis) { return axis.pointer == pointer && axis.values.size() > 1; });
}

std::string difference_from_default(const scene::Scene& scene) {
  const scene::Scene usual;
  const auto number = [](const scene::Value& value) {
    return std::holds_alternative<int>(value) ? std::get<int>(value) : std::get<double>(value);
  };
  for (const auto* pointer : kFixed) {
    if (is_swept(scene, pointer)) continue;  // its lines are told apart by the value on the axis
    const auto& quantity = scene::quantity(pointer);
    const double here = number(quantity.read(scene).value());
    const double there = number(quantity.read(usual).value());
    if (!same(here, there)) {
      return fmt::format("the rotor is not the paper's default one: {} is {:g}, not {:g}", pointer, here,
                         there);
    }
  }
  return {};
}

/// Value of a parameter in the default rotor (MODEL 6.1).
double default_value(std::string_view name) {
  const auto* quantity = scene::quantity_of_axis(name);
  if (quantity == nullptr) return 0.0;  // direction: up
  scene::Scene usual;
  if (!quantity->chooser.empty()) {
    scene::quantity(quantity->chooser).write(usual, std::string(quantity->readers.front()));
  }
  const auto value = quantity->read(usual);
  return value ? std::get<double>(*value) : 0.0;  // an absent effect, the unbalance, is none
}

/// Whether a value of a parameter is the default rotor's. An axis of one value that only some scenes have is
/// the scene's own value, which `difference_from_default` has looked at.
bool is_usual(const Parameter& parameter, double value) {
  const bool in_every_atlas =
      std::ranges::count(scene::grid_axes(), parameter.name, &scene::GridAxis::name) > 0;
  const bool own_value = !in_every_atlas && parameter.name != "direction" && parameter.values.size() == 1;
  return own_value || same(value, default_value(parameter.name));
}

}  // namespace

std::string_view text_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::partly:
      return "partly";
    case Verdict::disagrees:
      return "disagrees";
    case Verdict::not_covered:
      break;
  }
  return "not covered";
}

Verdict Statement::verdict() const {
  const auto count = [&](bool value) {
    return std::ranges::count_if(findings, [=](const Finding& f) { return f.holds && *f.holds == value; });
  };
  const auto yes = count(true);
  const auto no = count(false);
  if (yes + no == 0) return Verdict::not_covered;
  if (no == 0) return Verdict::agrees;
  return yes == 0 ? Verdict::disagrees : Verdict::partly;
}

Evidence::Evidence(const scene::Scene& scene, std::span<const Parameter> parameters,
                   std::span<const LineSummary> lines, bool per_passing)
    : parameters_(parameters),
      lines_(lines),
      scale_(scene.blades.count),
      per_passing_(per_passing),
      other_rotor_(difference_from_default(scene)) {}

std::size_t Evidence::position(std::string_view name) const {
  const auto found = std::ranges::find(parameters_, name, &Parameter::name);
  return static_cast<std::size_t>(found - parameters_.begin());
}

std::vector<const LineSummary*> Evidence::lines_along(std::string_view name) const {
  std::vector<const LineSummary*> result;
  if (!other_rotor_.empty()) return result;
  for (const auto& line : lines_) {
    bool fits = true;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      fits = fits && (parameters_[i].name == name || is_usual(parameters_[i], line.parameters[i]));
    }
    if (fits) result.push_back(&line);
  }
  std::ranges::stable_sort(result, {}, [&](const LineSummary* line) { return value(*line, name); });
  return result;
}

const LineSummary* Evidence::default_line() const {
  const auto lines = lines_along("");
  return lines.empty() ? nullptr : lines.front();
}

double Evidence::value(const LineSummary& line, std::string_view name) const {
  const auto i = position(name);
  return i < line.parameters.size() ? line.parameters[i] : 0.0;
}

std::string Evidence::value_text(const LineSummary& line, std::string_view name) const {
  const auto i = position(name);
  return parameters_[i].text(line.parameters[i]);
}

std::vector<Statement> judge_parameters(const Evidence& evidence) {
  return {
      {"P5",
       "the global picture holds for ζ ≤ 0.15; low damping widens region 2, shortens region 3 and opens "
       "small "
       "chaotic areas in region 1",
       low_damping_findings(evidence)},
      {"P6", "high damping attenuates regions 2 and 4 until they disappear", high_damping_findings(evidence)},
      {"P7", "friction changes things only locally; chaos appears in region 1 for 0.01 ≤ μ ≤ 0.2",
       friction_findings(evidence)},
      {"P8",
       "small unbalance keeps the four regions; growing it (up to 1e-4 kg m) removes the trigger at 2/3, "
       "makes "
       "region 3 chaotic and merges 2, 3 and 4; the trigger at 1/3 always stays",
       unbalance_findings(evidence)}};
}

std::vector<Statement> judge_statements(const Evidence& evidence) {
  auto statements = judge_default_rotor(evidence);
  std::ranges::move(judge_parameters(evidence), std::back_inserter(statements));
  return statements;
}

}  // namespace rubatlas::analysis
