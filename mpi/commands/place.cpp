#include "mpi/commands/place.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "mpi/exit_code.hpp"
#include "plan/scene_of_line.hpp"
#include "settings/nearest.hpp"
#include "settings/quantity.hpp"
#include "settings/symbol.hpp"

namespace rubatlas::mpi {
namespace {

/// One "name=value" of the command line, checked against the table of quantities.
struct Choice {
  std::string name;
  double value = 0.0;  ///< of `direction`: 0 up, 1 down
};

std::vector<std::string_view> parameter_names(const std::vector<settings::Axis>& axes) {
  std::vector<std::string_view> names;
  names.reserve(axes.size() + 1);
  for (const auto& axis : axes) names.push_back(axis.name);
  std::reverse(names.begin(), names.end());  // the speed ratio first
  names.push_back(plan::kDirectionAxis);
  return names;
}

/// An axis is named by its dimension, or by the pointer of its quantity as in the scene.
Choice parse_choice(const std::string& text, const std::vector<settings::Axis>& axes,
                    std::string_view option) {
  const auto names = parameter_names(axes);
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    throw UsageError(
        fmt::format("{} {}: not of the form name=value; names are {}", option, text, fmt::join(names, ", ")));
  }
  Choice choice{text.substr(0, equals)};
  const std::string word = text.substr(equals + 1);
  const auto axis = std::ranges::find_if(axes, [&](const auto& entry) {
    return entry.name == choice.name || entry.quantity->pointer == choice.name;
  });
  if (axis != axes.end()) choice.name = axis->name;
  if (std::find(names.begin(), names.end(), choice.name) == names.end()) {
    const auto symbol = settings::meaning_of_symbol(choice.name);
    throw UsageError(fmt::format(
        "{} {}: unknown name {}; names are {}; {}", option, text, choice.name, fmt::join(names, ", "),
        symbol.empty() ? fmt::format("nearest: {}", settings::nearest(choice.name, names)) : symbol));
  }
  if (choice.name == plan::kDirectionAxis) {
    if (word != "up" && word != "down")
      throw UsageError(fmt::format("{} {}: direction is up or down", option, text));
    choice.value = word == "down" ? 1.0 : 0.0;
    return choice;
  }
  const auto& quantity = *axis->quantity;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), choice.value);
  if (error != std::errc{} || end != word.data() + word.size() || !quantity.range.contains(choice.value)) {
    throw UsageError(fmt::format("{} {}: {} is not a number in {}; {}", option, text,
                                 word.empty() ? "nothing" : word, quantity.range.text(), quantity.meaning));
  }
  return choice;
}

std::vector<Choice> parse_choices(const std::vector<std::string>& texts,
                                  const std::vector<settings::Axis>& axes, std::string_view option) {
  std::vector<Choice> choices;
  for (const auto& text : texts) {
    auto choice = parse_choice(text, axes, option);
    for (const auto& earlier : choices) {
      if (earlier.name == choice.name)
        throw UsageError(fmt::format("{} names {} twice", option, choice.name));
    }
    choices.push_back(std::move(choice));
  }
  return choices;
}

const Choice* find_choice(const std::vector<Choice>& choices, std::string_view name) {
  const auto found =
      std::find_if(choices.begin(), choices.end(), [&](const auto& entry) { return entry.name == name; });
  return found == choices.end() ? nullptr : &*found;
}

}  // namespace

std::string choices_text(const std::vector<double>& values) {
  constexpr std::size_t kFew = 10;
  if (values.size() <= kFew) return fmt::format("{}", fmt::join(values, ", "));
  return fmt::format("{} values from {} to {}", values.size(), values.front(), values.back());
}

Place place_of(const settings::Scene& scene, const std::vector<std::string>& at, std::string_view option) {
  const auto axes = settings::axes_of(scene);
  const auto choices = parse_choices(at, axes, option);
  std::vector<double> values;
  for (const auto& axis : axes) {
    const auto* choice = find_choice(choices, axis.name);
    if (choice == nullptr && axis.values.size() > 1) {
      throw UsageError(fmt::format("which {}? The grid has {}; add {} {}=VALUE", axis.name,
                                   choices_text(axis.values), option, axis.name));
    }
    values.push_back(choice != nullptr ? choice->value : axis.values.front());
  }
  Place place;
  place.parameters = plan::parameters_at(values);
  if (plan::scene_of_line(scene, place.parameters).clearance() < 0.0) {
    throw UsageError(fmt::format(
        "{}: the blades do not fit into the ring there; radius must be hub_radius + length at least",
        option));
  }
  if (const auto* choice = find_choice(choices, plan::kDirectionAxis)) {
    place.direction = choice->value == 0.0 ? plan::Direction::up : plan::Direction::down;
  }
  return place;
}

}  // namespace rubatlas::mpi
