#include "mpi/commands/orbit_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/make_line_solver.hpp"
#include "atlas/atlas_reader.hpp"
#include "atlas/final_states.hpp"
#include "atlas/orbit_file.hpp"
#include "atlas/output.hpp"
#include "atlas/verify.hpp"
#include "mpi/commands/explain_text.hpp"
#include "mpi/commands/place.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/say.hpp"
#include "mpi/version.hpp"
#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"
#include "point/line_solver.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::mpi {
namespace {

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
    if (axis.name == plan::kDirectionAxis) continue;
    const double wanted = *next++;
    const bool present = std::any_of(axis.values.begin(), axis.values.end(), [&](double value) {
      return std::abs(value - wanted) <= kSame * std::max(std::abs(value), std::abs(wanted));
    });
    if (!present) {
      return fmt::format("{} has no point at {}={}; it has {}; {}", path.string(), axis.name, wanted,
                         choices_text(axis.values), nearest_values(axis.values, wanted));
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
  const bool both = atlas.axes().front().name == plan::kDirectionAxis;
  if (both && !place.direction) {
    throw UsageError(
        fmt::format("{} was swept both ways; add --at direction=up or --at direction=down", path.string()));
  }
  if (!both && place.direction) {
    throw UsageError(fmt::format("{} was swept one way; it has no direction to choose", path.string()));
  }
  const auto point = atlas.find(place.parameters, place.direction.value_or(plan::Direction::up));
  if (!point) throw UsageError(no_such_point(atlas, path, place.parameters));
  const auto status = static_cast<ending::PointStatus>(atlas.status()[*point]);
  if (status != ending::PointStatus::done) {
    const auto detail = static_cast<ending::StatusDetail>(atlas.row("/status_detail", *point).front());
    throw UsageError(fmt::format(
        "{} has no final state at this point: its status is {} ({})", path.string(), static_cast<int>(status),
        status == ending::PointStatus::pending ? "not computed yet" : ending::text_of(detail)));
  }
  atlas::require_sound_row(atlas, *point);
  return atlas::FinalStates(atlas.file(), atlas::schema_of(scene)).of(*point);
}

/// ", from a start 3.2 mm beyond the ring": where the shaft is so far from the ring's centre that a blade
/// pointing there reaches beyond the ring, and the motion has not come through its first revolution. Else
/// empty.
std::string start_beyond_ring(const settings::Scene& line, const motion::PointStart& start,
                              const point::Orbit& orbit) {
  const double beyond =
      std::hypot(start.state[0], start.state[1] + line.rotor.misalignment) - line.clearance();
  if (orbit.failed_revolution > 0 || beyond <= 0.0) return {};
  return fmt::format(", from a start {} beyond the ring", length(beyond));
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
  const Place place = place_of(scene, command.at, "--at");
  if (place.direction && !command.from) {
    throw UsageError("--at direction means a line of an atlas; it needs --from ATLAS");
  }
  const atlas::Output output = output_of(command);
  const motion::PointStart start = command.from ? stored_end(scene, *command.from, place)
                                                : assembly::initial_state(scene, place.parameters);

  const auto solver = assembly::make_line_solver(scene, place.parameters, assembly::make_blade_tables());
  const point::Orbit orbit = solver->orbit(place.parameters.speed_ratio, start);
  atlas::write_orbit(output, scene, text, place.parameters, start.state, orbit, software());

  if (orbit.status == ending::PointStatus::done) {
    say_sentence(fmt::format("{} holds the orbit at Ω = {}: {} revolutions, after {}",
                             command.output.string(), place.parameters.speed_ratio,
                             scene.protocol.sampled_revolutions, scene.protocol.transient_revolutions));
    return exit_code::kDone;
  }
  const bool left = orbit.status == ending::PointStatus::left_validity;
  say_sentence(fmt::format("the motion {} in revolution {}{}: {}; {} holds what came before",
                           left ? "left the model's validity" : "could not be integrated",
                           orbit.failed_revolution,
                           start_beyond_ring(plan::scene_of_line(scene, place.parameters), start, orbit),
                           ending::text_of(orbit.detail), command.output.string()));
  return left ? exit_code::kDone : exit_code::kSomePointsFailed;
}

}  // namespace rubatlas::mpi
