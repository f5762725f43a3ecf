#include "mpi/commands/explain_effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "mpi/commands/effect_cost.hpp"
#include "plan/grid.hpp"
#include "settings/combinations.hpp"
#include "settings/methods.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::mpi {
namespace {

void effect(Text& text, std::string_view name, bool on, const std::string& why) {
  text.line(name, fmt::format("{:<4} {}", on ? "on" : "off", why));
}

void more(Text& text, const std::string& content) {
  text.line("", fmt::format("     {}", content));
}

std::string ring_text(const settings::Scene& scene) {
  const auto stiffness = settings::values_in(scene, "/ring/stiffness");
  const double shaft = scene.rotor.mass * scene.rotor.natural_frequency * scene.rotor.natural_frequency;
  return fmt::format("kr = {}, {}", between(stiffness.front(), stiffness.back(), "N/m"),
                     between(stiffness.front() / shaft, stiffness.back() / shaft, "shaft stiffnesses"));
}

// --- effects of the list ---

/// On how many lines of the grid an effect acts.
struct ActingLines {
  std::size_t count = 0;
  bool counted =
      true;  ///< false: its own axes have too many values to look at all; `count` is then 1 or more
};

/// Whether an effect acts is a matter of its own quantities, and of friction where it needs that: only their
/// axes are walked along.
ActingLines lines_where_it_acts(std::size_t place, const settings::Scene& scene, const plan::Grid& grid) {
  constexpr std::size_t kMostLooks = 200'000;
  const effects::Listed& listed = effects::listed()[place];
  const bool is_in = listed.is_in(scene);
  std::vector<settings::Axis> own;
  for (auto& axis : settings::axes_of(scene)) {
    const bool friction =
        settings::kNeedFriction.contains(place) && axis.quantity->pointer == "/contact/friction";
    if (axis.quantity->section() == listed.description.section || friction) own.push_back(std::move(axis));
  }
  settings::Scene trial = scene;
  trial.grid = {};
  std::size_t looks = 1;
  for (const auto& axis : own) looks *= axis.values.size();
  const std::size_t lines_of_look = grid.line_count() / looks;
  ActingLines result;
  result.counted = looks <= kMostLooks;
  for (std::size_t look = 0; look < std::min(looks, kMostLooks); ++look) {
    std::size_t rest = look;
    for (const auto& axis : own) {
      const double value = axis.values[rest % axis.values.size()];
      rest /= axis.values.size();
      // The axis of an effect that is absent has the value 0: naming it would switch the effect on.
      if (is_in || value != 0.0) axis.quantity->write(trial, value);
    }
    if (settings::acting(trial).contains(place)) result.count += lines_of_look;
  }
  if (!result.counted && is_in) result.count = std::max<std::size_t>(result.count, 1);
  return result;
}

/// The scene as if nobody had named the effect.
settings::Scene without(const effects::Listed& listed, settings::Scene scene) {
  const std::string_view section = listed.description.section;
  listed.remove(scene);
  std::erase_if(scene.grid.swept,
                [&](const auto& swept) { return settings::quantity(swept.pointer).section() == section; });
  for (const auto& axis : settings::grid_axes()) {
    if (settings::quantity(axis.quantity).section() == section) scene.grid.*axis.values = {0.0};
  }
  return scene;
}

/// All quantities of a section, with every value that they take.
std::string quantities_text(const settings::Scene& scene, std::string_view section) {
  std::vector<std::string> parts;
  for (const auto& entry : settings::quantities()) {
    if (entry.section() != section) continue;
    const auto value = entry.read(scene);
    if (!value) continue;
    std::string shown;
    if (entry.kind == settings::Kind::number) {
      shown = values_text(settings::values_in(scene, entry.pointer));
    } else if (entry.kind == settings::Kind::numbers) {
      shown = values_text(std::get<std::vector<double>>(*value));
    } else if (entry.kind == settings::Kind::whole_number) {
      shown = fmt::format("{}", std::get<int>(*value));
    } else if (entry.kind == settings::Kind::flag) {
      shown = std::get<bool>(*value) ? "true" : "false";
    } else {
      shown = std::get<std::string>(*value);
    }
    if (shown.empty()) continue;  // a list without numbers
    const bool with_unit = !entry.unit.empty() && entry.unit != "1";
    parts.push_back(fmt::format("{} = {}{}{}", entry.symbol.empty() ? entry.key() : entry.symbol, shown,
                                with_unit ? " " : "", with_unit ? entry.unit : ""));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

bool has_axis_of_its_own(std::string_view section) {
  return std::ranges::any_of(settings::grid_axes(), [&](const auto& axis) {
    return settings::quantity(axis.quantity).section() == section;
  });
}

std::string cost_text(std::optional<double> with, std::optional<double> without, bool in_time) {
  if (!in_time) return "not measured: its motions take too long for that here";
  if (!with || !without) return "no blade comes into contact where it was to be measured";
  return fmt::format(
      "measured: {:.0f} ns a right-hand side with its share of flight, {:.0f} without it ({:+.0f} %)",
      1e9 * *with, 1e9 * *without, 100.0 * (*with / *without - 1.0));
}

void describe(std::size_t place, const settings::Scene& scene, const plan::Grid& grid,
              const modes::GoOn& go_on, Text& text) {
  const effects::Listed& listed = effects::listed()[place];
  const effects::Description& description = listed.description;
  const std::string name = settings::axis_name(description.section);
  const ActingLines acting = lines_where_it_acts(place, scene, grid);
  if (!listed.is_in(scene) && acting.count == 0) {
    effect(text, name, false,
           fmt::format("no section `{}`{}: no term in the equations", name,
                       has_axis_of_its_own(description.section) ? " and no grid axis of that name" : ""));
    return;
  }
  const std::string quantities = quantities_text(scene, description.section);
  if (acting.count == 0) {
    const bool has_strength = listed.acts(scene);
    effect(text, name, false,
           fmt::format("{}: {}, no term in the equations", quantities,
                       has_strength ? "nothing to act on without friction" : "of zero strength"));
    return;
  }
  std::string where;
  if (!acting.counted) {
    where = fmt::format("; on how many of the {} lines was not counted", grid.line_count());
  } else if (acting.count < grid.line_count()) {
    where = fmt::format("; no term on {} of {} lines", grid.line_count() - acting.count, grid.line_count());
  }
  effect(text, name, true, quantities + where);
  more(text, fmt::format("{} ({})", description.equation, description.source));
  const auto with = seconds_per_right_hand_side(scene, go_on);
  const auto plain = seconds_per_right_hand_side(without(listed, scene), go_on);
  more(text, cost_text(with, plain, go_on()));
  more(text, fmt::format("flight: {}", settings::method_of(scene).flies_in_closed_form
                                           ? description.flight
                                           : "in the steps of the method, as all of the motion"));
}

}  // namespace

namespace {

std::string blades_text(settings::ContactLaw law) {
  switch (law) {
    case settings::ContactLaw::elastica:
      return "contact.law is elastica: large deflection, closed form";
    case settings::ContactLaw::beam_column:
      return "contact.law is beam_column: small deflection, closed form";
    default:
      return "contact.law is elastic_ring: the blades are rigid";
  }
}

/// The law of friction itself may be an effect of the list, which then says so.
std::string friction_text(const settings::Scene& scene) {
  const auto& friction = scene.grid.friction;
  if (friction.back() == 0.0) {
    return scene.contact.law == settings::ContactLaw::elastic_ring
               ? "μ = 0: the force is normal to the ring"
               : "μ = 0: a blade is a column, its force jumps to the Euler load";
  }
  return fmt::format("Coulomb, μ = {}; its direction turns with the slip{}", values_text(friction),
                     friction.front() == 0.0 ? "; none on the lines with μ = 0" : "");
}

}  // namespace

void describe_effects(const settings::Scene& scene, const modes::GoOn& go_on, Text& text) {
  const bool rigid = scene.contact.law == settings::ContactLaw::elastic_ring;
  text.heading("Effects");
  effect(text, "elastic blades", !rigid, blades_text(scene.contact.law));
  effect(text, "elastic ring", rigid,
         rigid ? fmt::format("contact.law is elastic_ring: {}", ring_text(scene))
               : fmt::format("contact.law is {}: rigid but for what is on below",
                             std::get<std::string>(*settings::quantity("/contact/law").read(scene))));
  effect(text, "friction", scene.grid.friction.back() > 0.0, friction_text(scene));
  effect(text, "yield flag", scene.validity.yield_strain.has_value(),
         scene.validity.yield_strain ? fmt::format("root strain above {}", *scene.validity.yield_strain)
                                     : std::string("no `validity.yield_strain`"));
  const plan::Grid grid(scene);
  for (std::size_t place = 0; place < effects::listed().size(); ++place)
    describe(place, scene, grid, go_on, text);
}

}  // namespace rubatlas::mpi
