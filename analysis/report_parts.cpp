#include "analysis/report_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "analysis/rules/attractors.hpp"
#include "analysis/rules/evidence_text.hpp"
#include "analysis/rules/free_shaft.hpp"
#include "analysis/rules/scene_tolerances.hpp"
#include "analysis/rules/starts.hpp"
#include "settings/effects/list.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::analysis {
namespace {

std::string axis_text(const Parameter& parameter) {
  constexpr std::size_t kMostValues = 12;
  if (parameter.values.size() == 1) return parameter.text(parameter.values.front());
  if (parameter.values.size() > kMostValues) {
    return fmt::format("{} from {} to {} ({} values)", parameter.symbol,
                       parameter.value_text(parameter.values.front()),
                       parameter.value_text(parameter.values.back()), parameter.values.size());
  }
  std::vector<std::string> values;
  for (const double value : parameter.values) values.push_back(parameter.value_text(value));
  return fmt::format("{} = {}", parameter.symbol, fmt::join(values, ", "));
}

std::string grid_text(const Findings& found) {
  const auto& speeds = found.axes.back().values;
  std::vector<std::string> parts{
      speeds.size() == 1
          ? fmt::format("Ω = {:g}", speeds.front())
          : fmt::format("Ω from {:g} to {:g} ({} values)", speeds.front(), speeds.back(), speeds.size())};
  for (const auto& parameter : found.parameters) parts.push_back(axis_text(parameter));
  return fmt::format("Grid: {}.", fmt::join(parts, "; "));
}

std::string points_text(const Findings& found) {
  const auto& [pending, done, left, failed] = found.status_count;
  std::vector<std::string> parts{fmt::format("{} of {} done", done, pending + done + left + failed)};
  if (pending > 0) parts.push_back(fmt::format("{} pending", pending));
  if (left > 0) parts.push_back(fmt::format("{} left the model's validity", left));
  if (failed > 0) parts.push_back(fmt::format("{} failed in the integrator", failed));
  return fmt::format("Points: {}.", fmt::join(parts, ", "));
}

/// "Contact: at 85 of 91 points, none at 6."; empty where no point is done.
std::string contacts_text(const Findings& found) {
  std::size_t touching = 0;
  std::size_t free = 0;
  std::size_t not_known = 0;
  for (const auto& line : found.lines) {
    touching += line.contact.touching;
    free += line.contact.free;
    not_known += line.contact.not_known;
  }
  if (touching + free + not_known == 0) return {};
  std::vector<std::string> parts;
  if (touching > 0 || not_known == 0)
    parts.push_back(fmt::format("at {} of {} points", touching, touching + free + not_known));
  if (free > 0) parts.push_back(fmt::format("none at {}", free));
  if (not_known > 0)
    parts.push_back(fmt::format("not known at {}, since the atlas has no `contact_fraction`", not_known));
  return fmt::format("Contact: {}.", fmt::join(parts, ", "));
}

std::string class_name(std::uint8_t motion) {
  if (motion == motion_class::kAperiodic) return "aperiodic";
  if (motion == motion_class::kUnresolved) return "unresolved";
  return fmt::format("period {}", motion);
}

std::string classes_text(std::span<const std::uint8_t> motion, std::string_view sections) {
  std::map<std::uint8_t, std::size_t> counts;
  for (const auto value : motion) {
    if (value != motion_class::kNone) ++counts[value];
  }
  std::size_t total = 0;
  for (const auto& [value, count] : counts) total += count;
  std::vector<std::string> parts;
  std::size_t rare = 0;
  for (const auto& [value, count] : counts) {
    const double percent = 100.0 * static_cast<double>(count) / static_cast<double>(total);
    if (percent < 1.0 && is_periodic(value)) {
      rare += count;
      continue;
    }
    parts.push_back(fmt::format("{} {:.1f} %", class_name(value), percent));
  }
  if (rare > 0) {
    parts.push_back(fmt::format("other periods {:.1f} %",
                                100.0 * static_cast<double>(rare) / static_cast<double>(total)));
  }
  return fmt::format("Motion per {}: {}.", sections,
                     parts.empty() ? "no classes" : fmt::format("{}", fmt::join(parts, ", ")));
}

std::string_view absence(Presence presence) {
  switch (presence) {
    case Presence::absent:
      return "absent";
    case Presence::merged:
      return "merged with 2";
    default:
      return "not covered";
  }
}

std::string class_names(std::span<const std::uint8_t> motions) {
  std::vector<std::string> names;
  for (const auto motion : motions) names.push_back(class_name(motion));
  return fmt::format("{}", fmt::join(names, " and "));
}

/// "period 11 from 24.1 % ± 1.1 % of the initial states, up to 11.4 mm".
std::string basin_text(const Basin& basin) {
  const auto share = fmt::format("{:.1f} % ± {:.1f} %", 100.0 * basin.share, 100.0 * basin.standard_error);
  if (basin.attractor == 0) return fmt::format("no attractor from {}", share);
  return fmt::format("attractor {}, {}, from {}, up to {}", basin.attractor, class_name(basin.motion), share,
                     millimetres(basin.max_displacement));
}

/// "1 and 3 may be one motion ...", for the attractors of one set of points.
void append_shifted(std::span<const Basin> basins, std::vector<std::string>& parts) {
  std::vector<std::int32_t> named;
  for (const Basin& basin : basins) {
    std::vector<std::int32_t> alike;
    for (const Basin& other : basins) {
      if (may_be_shifted(basin.motion, basin.max_displacement, other.motion, other.max_displacement)) {
        alike.push_back(other.attractor);
      }
    }
    if (alike.size() < 2 || std::ranges::count(named, alike.front()) > 0) continue;
    named.push_back(alike.front());
    parts.push_back(fmt::format("{} are of one size, and may be one motion in which other blades touch",
                                fmt::join(alike, ", ")));
  }
}

/// Parameters in which the lines of the atlas differ.
std::vector<std::size_t> swept(const Findings& found) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < found.parameters.size(); ++i) {
    if (found.parameters[i].values.size() > 1) result.push_back(i);
  }
  return result;
}

/// "ζ = 0.05, μ = 0.2": what tells the parameters of a line, or of a point of it, from others of the atlas.
/// `left_out` selects parameters that are not named.
template <typename LeftOut>
std::string place_text(const Findings& found, std::size_t line, LeftOut left_out) {
  std::vector<std::string> parts;
  for (const auto i : swept(found)) {
    const auto& parameter = found.parameters[i];
    if (!left_out(parameter.name)) parts.push_back(parameter.text(found.lines[line].parameters[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

Cell region_cell(const Region& region) {
  if (!region.present()) return {std::string(absence(region.presence)), {}};
  return {extent_text(region),
          fmt::format("{:.0f} %, {}", 100.0 * region.aperiodic_share, millimetres(region.peak_displacement))};
}

Cell trigger_cell(const Trigger& trigger) {
  if (trigger.presence != Presence::present) return {std::string(absence(trigger.presence)), {}};
  return {fmt::format("{:.3f}", trigger.speed_ratio),
          fmt::format("+{} ×{:.3g}", millimetres(trigger.rise()), trigger.ratio())};
}

/// How class and largest exponent agree, with the first speeds at which they do not.
std::string exponents_text(const Findings& found) {
  std::map<ExponentCheck, std::size_t> counts;
  std::vector<std::string> places;
  constexpr std::size_t kMostPlaces = 5;
  const auto& speeds = found.axes.back().values;
  for (std::size_t point = 0; point < found.exponent_check.size(); ++point) {
    ++counts[found.exponent_check[point]];
    if (found.exponent_check[point] != ExponentCheck::disagrees || places.size() == kMostPlaces) continue;
    const auto line = place_text(found, point / speeds.size(), [](std::string_view) { return false; });
    places.push_back(
        fmt::format("Ω = {:.6g}{}{}", speeds[point % speeds.size()], line.empty() ? "" : " at ", line));
  }
  const std::size_t disagree = counts[ExponentCheck::disagrees];
  return fmt::format(
      "Largest exponent: agrees with the class at {} points, zero within two standard errors at {}, "
      "disagrees at {}{}{}{}.",
      counts[ExponentCheck::agrees], counts[ExponentCheck::undecided], disagree, disagree > 0 ? ": " : "",
      fmt::join(places, "; "), disagree > places.size() ? "; …" : "");
}

std::string contact_law_text(const settings::Scene& scene) {
  if (scene.contact.law != settings::ContactLaw::elastic_ring) {
    const bool small = scene.contact.law == settings::ContactLaw::beam_column;
    const bool yields = effects::acts<&effects::Effects::yielding_ring>(scene);
    return fmt::format("{} (elastic blades{}, {} ring)", small ? "beam_column" : "elastica",
                       small ? " of small slopes" : "", yields ? "yielding" : "stiff");
  }
  const auto stiffness = settings::values_in(scene, "/ring/stiffness");
  const std::string range = stiffness.size() == 1 ? "" : fmt::format(" to {:g}", stiffness.back());
  return fmt::format("elastic_ring, {:g}{} N/m (rigid blades, yielding ring)", stiffness.front(), range);
}

}  // namespace

std::vector<std::string> notes_on_effects(const settings::Scene& scene) {
  std::vector<std::string> notes;
  const effects::Support support = scene.support.value_or(effects::Support{});
  if (support.stiffness_xx != 0.0 || support.stiffness_yy != 0.0)
    notes.emplace_back(
        "Ω is the speed over /rotor/natural_frequency, and regions and triggers are looked for as if "
        "/support had no stiffness");
  if (effects::acts<&effects::Effects::speed_ramp>(scene))
    notes.emplace_back(
        "Ω ramps, so that no motion repeats itself: aperiodic and unresolved points, and their regions, are "
        "run-ups, and tell nothing of motions at constant speed");
  constexpr double kSmall = 0.1;  // beside the clearance
  if (const double sag = largest_sag(scene, kSmall); sag > 0.0)
    notes.push_back(fmt::format(
        "f, the static sag, is up to {} and part of the displacement from the unloaded equilibrium, in which "
        "regions and triggers are sought: a trigger, and region 1 below it, that is said to be absent may be "
        "there",
        millimetres(sag)));
  return notes;
}

std::vector<std::string> facts(const Findings& found) {
  std::vector<std::string> sentences;
  sentences.push_back(
      fmt::format("Contact law: {}; {} blades.", contact_law_text(found.scene), found.scene.blades.count));
  sentences.push_back(grid_text(found));
  sentences.push_back(points_text(found));
  if (found.has_sections) {
    sentences.push_back(classes_text(found.motion, "revolution"));
  } else {
    sentences.emplace_back("The atlas has no `poincare`: no classes, and no regions.");
  }
  if (!found.motion_per_passing.empty()) {
    sentences.push_back(classes_text(found.motion_per_passing, "blade passing"));
  }
  if (auto contacts = contacts_text(found); !contacts.empty()) sentences.push_back(std::move(contacts));
  if (!found.exponent_check.empty()) sentences.push_back(exponents_text(found));
  for (const std::string& note : notes_on_effects(found.scene)) sentences.push_back(note + ".");
  if (found.max_displacement.empty()) {
    sentences.emplace_back("The atlas has no `max_displacement`: no triggers, and no displacements.");
  }
  return sentences;
}

std::vector<std::string> basin_sentences(const Findings& found) {
  std::vector<std::string> sentences;
  if (found.attractor.empty()) {
    return {"The atlas has not both `poincare` and `max_displacement`: no attractors."};
  }
  const Starts starts(found.axes);
  const auto& speeds = found.axes.back().values;
  // The first point of each set, from which its parameters are read.
  std::vector<std::size_t> first(starts.set_count());
  for (std::size_t point = found.attractor.size(); point-- > 0;) first[starts.set_of(point)] = point;
  std::size_t alone = 0;
  for (auto basin = found.basins.begin(); basin != found.basins.end();) {
    const auto end =
        std::find_if(basin, found.basins.end(), [&](const Basin& other) { return other.set != basin->set; });
    const std::size_t point = first[basin->set];
    auto place = place_text(found, point / speeds.size(), is_start_axis);
    if (!place.empty()) place.insert(0, ", ");
    std::vector<std::string> parts;
    std::transform(basin, end, std::back_inserter(parts), basin_text);
    if (found.scene.blades.count > 1) append_shifted({basin, end}, parts);
    if (parts.size() == 1 && basin->attractor != 0) {
      ++alone;
    } else {
      sentences.push_back(
          fmt::format("Ω = {:.6g}{}: {}.", speeds[point % speeds.size()], place, fmt::join(parts, "; ")));
    }
    basin = end;
  }
  if (alone > 0) {
    sentences.push_back(fmt::format(
        "All initial states lead to one attractor at {} of the {} combinations of the other parameters.",
        alone, starts.set_count()));
  }
  return sentences;
}

std::vector<std::string> hysteresis_sentences(const Findings& found) {
  if (!found.hysteresis) {
    return {"The atlas has not both `poincare` and `max_displacement`: the motions are not compared."};
  }
  const auto& hysteresis = *found.hysteresis;
  std::vector<std::string> sentences{fmt::format("The same motion at {} of {} points compared.",
                                                 hysteresis.compared - hysteresis.different,
                                                 hysteresis.compared)};
  for (const auto& range : hysteresis.ranges) {
    if (range.is_aperiodic()) continue;
    auto place = place_text(found, range.line, is_start_axis);
    if (!place.empty()) place += ", ";
    const auto speeds = range.speeds == 1 ? fmt::format("Ω = {:.6g}", range.from)
                                          : fmt::format("Ω from {:.6g} to {:.6g} ({} points)", range.from,
                                                        range.to, range.speeds);
    const bool shifted = range.may_be_shifted && found.scene.blades.count > 1;
    sentences.push_back(
        fmt::format("{}{}: up {}, down {}{}.", place, speeds, class_names(range.up), class_names(range.down),
                    shifted ? ", of one size: it may be one motion in which other blades touch" : ""));
  }
  if (hysteresis.compared_aperiodic > 0) {
    sentences.push_back(
        fmt::format("Of {} pairs of aperiodic motions {} have maximum displacements that differ by more than "
                    "{:g} standard "
                    "errors; of pairs of one and the same motion one in twenty does.",
                    hysteresis.compared_aperiodic, hysteresis.different_aperiodic, kStandardErrors));
  }
  return sentences;
}

std::vector<std::string> contact_sentences(const Findings& found) {
  const auto everywhere = [](const LineSummary& line) {
    return line.contact.free + line.contact.not_known == 0;
  };
  if (std::ranges::all_of(found.lines, everywhere)) return {};
  const auto& first = found.lines.front().contact.text;
  const auto is_first = [&](const LineSummary& line) { return line.contact.text == first; };
  if (found.lines.size() > 1 && std::ranges::all_of(found.lines, is_first))
    return {fmt::format("On every line: {}.", first)};
  std::vector<std::string> sentences;
  for (std::size_t line = 0; line < found.lines.size(); ++line) {
    const auto& text = found.lines[line].contact.text;
    if (!text.empty()) sentences.push_back(line_text(found, line) + text + ".");
  }
  return sentences;
}

std::vector<std::string> table_header(const Findings& found) {
  std::vector<std::string> symbols;
  for (const auto i : swept(found)) symbols.push_back(found.parameters[i].symbol);
  return {fmt::format("{}", fmt::join(symbols, ", ")),
          "region 1",
          "trigger 1",
          "region 2",
          "region 3",
          "trigger 2",
          "region 4"};
}

std::vector<std::vector<Cell>> table_rows(const Findings& found) {
  std::vector<std::vector<Cell>> rows;
  for (const auto& line : found.lines) {
    std::vector<std::string> values;
    for (const auto i : swept(found)) values.push_back(found.parameters[i].value_text(line.parameters[i]));
    rows.push_back({{fmt::format("{}", fmt::join(values, ", ")), {}},
                    region_cell(line.regions[0]),
                    trigger_cell(line.triggers[0]),
                    region_cell(line.regions[1]),
                    region_cell(line.regions[2]),
                    trigger_cell(line.triggers[1]),
                    region_cell(line.regions[3])});
  }
  return rows;
}

std::string line_text(const Findings& found, std::size_t line, std::string_view without) {
  const auto place = place_text(found, line, [&](std::string_view name) { return name == without; });
  return place.empty() ? place : place + ": ";
}

std::string border_text(std::uint8_t region_ends, std::uint8_t region_begins) {
  std::vector<std::string> texts;
  if (region_ends > 0) texts.push_back(fmt::format("region {} ends", region_ends));
  if (region_begins > 0) texts.push_back(fmt::format("region {} begins", region_begins));
  if (texts.empty()) texts.emplace_back("the motion changes");
  return fmt::format("{}", fmt::join(texts, " and "));
}

std::string heading(const Findings& found, const Sensitivity& sensitivity) {
  return fmt::format("As {} grows ({})", found.parameters[sensitivity.parameter].symbol, sensitivity.fixed);
}

}  // namespace rubatlas::analysis
