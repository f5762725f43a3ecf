#include "mpi/commands/orbit_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "assembly/initial_state.hpp"
#include "assembly/make_line_solver.hpp"
#include "atlas/atlas_reader.hpp"
#include "atlas/final_states.hpp"
#include "atlas/orbit_file.hpp"
#include "atlas/output.hpp"
#include "atlas/verify.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/say.hpp"
#include "mpi/version.hpp"
#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"
#include "point/line_solver.hpp"
#include "settings/nearest.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"
#include "settings/symbol.hpp"

namespace rubatlas::mpi {
namespace {

constexpr std::string_view kDirection = "direction";

/// One "name=value" of the command line, checked against the table of quantities.
struct Choice {
  std::string name;
  double value = 0.0;  ///< of `direction`: 0 up, 1 down
};

/// The point of the orbit: its parameters and, for an atlas swept in both directions, the direction.
struct Place {
  plan::PointParameters parameters;
  std::optional<plan::Direction> direction;
};

std::vector<std::string_view> parameter_names(const std::vector<settings::Axis>& axes) {
  std::vector<std::string_view> names;
  names.reserve(axes.size() + 1);
  for (const auto& axis : axes) names.push_back(axis.name);
  std::reverse(names.begin(), names.end());  // the speed ratio first
  names.push_back(kDirection);
  return names;
}

/// An axis is named by its dimension, or by the pointer of its quantity as in the scene.
Choice parse_choice(const std::string& text, const std::vector<settings::Axis>& axes) {
  const auto names = parameter_names(axes);
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    throw UsageError(
        fmt::format("--at {}: not of the form name=value; names are {}", text, fmt::join(names, ", ")));
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
        "--at {}: unknown name {}; names are {}; {}", text, choice.name, fmt::join(names, ", "),
        symbol.empty() ? fmt::format("nearest: {}", settings::nearest(choice.name, names)) : symbol));
  }
  if (choice.name == kDirection) {
    if (word != "up" && word != "down")
      throw UsageError(fmt::format("--at {}: direction is up or down", text));
    choice.value = word == "down" ? 1.0 : 0.0;
    return choice;
  }
  const auto& quantity = *axis->quantity;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), choice.value);
  if (error != std::errc{} || end != word.data() + word.size() || !quantity.range.contains(choice.value)) {
    throw UsageError(fmt::format("--at {}: {} is not a number in {}; {}", text,
                                 word.empty() ? "nothing" : word, quantity.range.text(), quantity.meaning));
  }
  return choice;
}

std::vector<Choice> parse_choices(const std::vector<std::string>& texts,
                                  const std::vector<settings::Axis>& axes) {
  std::vector<Choice> choices;
  for (const auto& text : texts) {
    auto choice = parse_choice(text, axes);
    for (const auto& earlier : choices) {
      if (earlier.name == choice.name) throw UsageError(fmt::format("--at names {} twice", choice.name));
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

/// The range of values, or all values where they are few.
std::string values_text(const std::vector<double>& values) {
  constexpr std::size_t kFew = 10;
  if (values.size() <= kFew) return fmt::format("{}", fmt::join(values, ", "));
  return fmt::format("{} values from {} to {}", values.size(), values.front(), values.back());
}

/// The point that the user means: the given values, and the values of axes with one value only.
Place place_of(const settings::Scene& scene, const OrbitCommand& command) {
  const auto axes = settings::axes_of(scene);
  const auto choices = parse_choices(command.at, axes);
  std::vector<double> values;
  for (const auto& axis : axes) {
    const auto* choice = find_choice(choices, axis.name);
    if (choice == nullptr && axis.values.size() > 1) {
      throw UsageError(fmt::format("which {}? The grid has {}; add --at {}=VALUE", axis.name,
                                   values_text(axis.values), axis.name));
    }
    values.push_back(choice != nullptr ? choice->value : axis.values.front());
  }
  Place place;
  place.parameters = plan::parameters_at(values);
  if (plan::scene_of_line(scene, place.parameters).clearance() < 0.0) {
    throw UsageError(
        "--at: the blades do not fit into the ring there; radius must be hub_radius + length at least");
  }
  if (const auto* choice = find_choice(choices, kDirection)) {
    place.direction = choice->value == 0.0 ? plan::Direction::up : plan::Direction::down;
  }
  return place;
}

/// The values of an axis next to a value that it does not have, for the message.
std::string nearest_values(const std::vector<double>& values, double wanted) {
  const auto above = std::lower_bound(values.begin(), values.end(), wanted);
  if (above == values.begin()) return fmt::format("the nearest is {}", values.front());
  if (above == values.end()) return fmt::format("the nearest is {}", values.back());
  return fmt::format("the nearest are {} and {}", *(above - 1), *above);
}

/// The sentence that names the axis without the given value, and the nearest values that it has.
std::string no_such_point(const atlas::AtlasReader& atlas, const std::filesystem::path& path,
                          const plan::PointParameters& parameters) {
  constexpr double kSame = 1e-9;
  const auto values = plan::values_of(parameters);
  auto next = values.begin();
  for (const auto& axis : atlas.axes()) {
    if (axis.name == kDirection) continue;
    const double wanted = *next++;
    const bool present = std::any_of(axis.values.begin(), axis.values.end(), [&](double value) {
      return std::abs(value - wanted) <= kSame * std::max(std::abs(value), std::abs(wanted));
    });
    if (!present) {
      return fmt::format("{} has no point at {}={}; it has {}; {}", path.string(), axis.name, wanted,
                         values_text(axis.values), nearest_values(axis.values, wanted));
    }
  }
  return fmt::format("{} has no such point", path.string());
}

/// The final state stored for a point, from which the orbit shows the attractor of the atlas.
motion::PointStart stored_end(const settings::Scene& scene, const std::filesystem::path& path,
                              const Place& place) {
  const atlas::AtlasReader atlas(path);
  const auto difference = settings::difference(atlas.scene_resolved(), settings::resolved_json(scene));
  if (!difference.empty()) {
    throw UsageError(fmt::format("{} was made from another scene: {}", path.string(), difference));
  }
  const bool both = atlas.axes().front().name == kDirection;
  if (both && !place.direction) {
    throw UsageError(
        fmt::format("{} was swept both ways; add --at direction=up or --at direction=down", path.string()));
  }
  if (!both && place.direction) {
    throw UsageError(fmt::format("{} was swept one way; it has no direction to choose", path.string()));
  }
  const auto point = atlas.find(place.parameters, place.direction.value_or(plan::Direction::up));
  if (!point) throw UsageError(no_such_point(atlas, path, place.parameters));
  const auto status = static_cast<point::PointStatus>(atlas.status()[*point]);
  if (status != point::PointStatus::done) {
    const auto detail = static_cast<point::StatusDetail>(atlas.row("/status_detail", *point).front());
    throw UsageError(fmt::format(
        "{} has no final state at this point: its status is {} ({})", path.string(), static_cast<int>(status),
        status == point::PointStatus::pending ? "not computed yet" : point::text_of(detail)));
  }
  atlas::require_sound_row(atlas, *point);
  return atlas::FinalStates(atlas.file(), atlas::schema_of(scene)).of(*point);
}

/// The path of the orbit file, which must not be a file that the command reads.
atlas::Output output_of(const OrbitCommand& command) {
  std::vector<std::filesystem::path> sources{command.scene};
  if (command.from) sources.push_back(*command.from);
  return atlas::permitted({command.output, atlas::FileKind::orbit, atlas::existing(command.overwrite)},
                          sources);
}

}  // namespace

int compute_orbit(const OrbitCommand& command) {
  const std::string text = settings::read_text(command.scene);
  const settings::Scene scene = settings::parse_scene(text, command.scene.string());
  const Place place = place_of(scene, command);
  if (place.direction && !command.from) {
    throw UsageError("--at direction means a line of an atlas; it needs --from ATLAS");
  }
  const atlas::Output output = output_of(command);
  const motion::PointStart start = command.from ? stored_end(scene, *command.from, place)
                                                : assembly::initial_state(scene, place.parameters);

  const auto solver = assembly::make_line_solver(scene, place.parameters, assembly::make_blade_tables());
  const point::Orbit orbit = solver->orbit(place.parameters.speed_ratio, start);
  atlas::write_orbit(output, scene, text, place.parameters, start.state, orbit, software());

  if (orbit.status == point::PointStatus::done) return exit_code::kDone;
  const bool left = orbit.status == point::PointStatus::left_validity;
  say_sentence(fmt::format("the motion {} in revolution {}: {}; {} holds what came before",
                           left ? "left the model's validity" : "could not be integrated",
                           orbit.failed_revolution, point::text_of(orbit.detail), command.output.string()));
  return left ? exit_code::kDone : exit_code::kSomePointsFailed;
}

}  // namespace rubatlas::mpi
