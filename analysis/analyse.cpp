#include "analysis/analyse.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "analysis/edges_file.hpp"
#include "analysis/maps_file.hpp"
#include "analysis/report.hpp"
#include "analysis/rules/attractors.hpp"
#include "analysis/rules/scene_tolerances.hpp"
#include "analysis/rules/starts.hpp"
#include "atlas/output.hpp"
#include "atlas/publish.hpp"
#include "atlas/verify.hpp"
#include "plan/scene_of_line.hpp"
#include "settings/reader.hpp"

namespace rubatlas::analysis {
namespace {

constexpr std::uint8_t kDone = 1;

/// The row of one point of a line.
std::span<const double> row_of(std::span<const double> rows, std::size_t points, std::size_t point) {
  const std::size_t row_size = rows.size() / points;
  return rows.subspan(point * row_size, row_size);
}

/// Class of every point of a line from the rows of one of its datasets of sections.
std::vector<std::uint8_t> classes_of_line(std::span<const double> rows, std::span<const std::uint8_t> status,
                                          const ClosingTolerance& tolerance) {
  std::vector<std::uint8_t> classes(status.size(), motion_class::kNone);
  for (std::size_t i = 0; i < status.size(); ++i) {
    if (status[i] == kDone) classes[i] = classify(row_of(rows, status.size(), i), tolerance);
  }
  return classes;
}

/// The attractors of an atlas, found from its motions in the order of the points.
class AttractorsOfAtlas {
 public:
  explicit AttractorsOfAtlas(const Starts& starts) : starts_(starts) {}

  void add(const Line& line, std::span<const double> rows, const ClosingTolerance& tolerance) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::size_t set = starts_.set_of(sets_.size());
      const auto sections = row_of(rows, line.size(), i);
      sets_.push_back(set);
      attractors_.try_emplace(set, tolerance)
          .first->second.add(trace_of(line.motion[i], sections, line.max_displacement[i]), sections);
    }
  }
  [[nodiscard]] std::vector<std::int32_t> numbers() const {
    std::map<std::size_t, std::vector<std::int32_t>> left;  // of each set, in the reverse order
    for (const auto& [set, attractors] : attractors_) {
      left[set] = attractors.numbers();
      std::ranges::reverse(left[set]);
    }
    std::vector<std::int32_t> result;
    for (const std::size_t set : sets_) {
      result.push_back(left[set].back());
      left[set].pop_back();
    }
    return result;
  }

 private:
  const Starts& starts_;
  std::vector<std::size_t> sets_;  ///< of each point
  std::map<std::size_t, Attractors> attractors_;
};

std::vector<double> displacements_of_line(const atlas::AtlasReader& atlas,
                                          std::span<const std::uint8_t> status, std::size_t line) {
  std::vector<double> unknown(status.size(), kNotANumber);
  if (!atlas.has("max_displacement")) return unknown;
  auto rows = atlas.line_rows("max_displacement", line);
  for (std::size_t i = 0; i < status.size(); ++i) {
    if (status[i] != kDone) rows[i] = kNotANumber;
  }
  return rows;
}

/// Contact at each point of a line, whose sections are `rows`.
std::vector<PointContact> contacts_of_line(const atlas::AtlasReader& atlas, const settings::Scene& own,
                                           std::span<const std::uint8_t> status, std::size_t line,
                                           std::span<const double> displacements,
                                           std::span<const double> rows, const ClosingTolerance& tolerance) {
  const auto kept = [&](std::initializer_list<const char*> names) {
    const auto* name = std::ranges::find_if(names, [&](const char* one) { return atlas.has(one); });
    return name == names.end() ? std::vector(status.size(), kNotANumber) : atlas.line_rows(*name, line);
  };
  const auto figures = kept({"contact_fraction", "max_contact_force"});
  const auto misses = kept({"nearest_miss"});
  const auto& speeds = atlas.axes().back().values;
  std::vector<PointContact> contacts(status.size());
  for (std::size_t i = 0; i < status.size(); ++i) {
    if (status[i] != kDone) continue;
    const ContactEvidence evidence{.figure = figures[i],
                                   .nearest_miss = misses[i],
                                   .max_displacement = displacements[i],
                                   .sections = rows.empty() ? rows : row_of(rows, status.size(), i)};
    contacts[i] = contact_at(own, speeds[i], evidence, tolerance);
  }
  return contacts;
}

/// Parameters of a line, one for each axis except the last.
std::vector<double> parameters_of_line(std::span<const plan::Axis> axes, std::size_t line) {
  std::vector<double> values(axes.size() - 1);
  for (std::size_t i = axes.size() - 1; i-- > 0;) {
    const auto extent = axes[i].values.size();
    values[i] = axes[i].values[line % extent];
    line /= extent;
  }
  return values;
}

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Side of the nearest miss of each point; 0 where a touch is nearer to grazing, since `/grazing_side` is
/// then that of the touch.
std::vector<std::uint8_t> miss_sides(const atlas::AtlasReader& atlas, std::span<const double> nearest_miss) {
  if (!atlas.has("grazing_side") || !atlas.has("lightest_touch")) return {};
  const auto sides = atlas.rows("grazing_side");
  const auto touches = atlas.rows("lightest_touch");
  std::vector<std::uint8_t> result(sides.size(), 0);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (nearest_miss[i] <= touches[i] || std::isnan(touches[i]))
      result[i] = static_cast<std::uint8_t>(sides[i]);
  }
  return result;
}

Margins margins_of(const atlas::AtlasReader& atlas, const Findings& found,
                   std::span<const std::uint8_t> status) {
  MarginRows rows{.motion = border_motions(found.motion, status), .nearest_miss = {}, .miss_side = {}};
  if (atlas.has("nearest_miss")) {
    rows.nearest_miss = atlas.rows("nearest_miss");
    rows.miss_side = miss_sides(atlas, rows.nearest_miss);
  }
  return find_margins(found.axes, rows, found.lines);
}

/// Adds the signs of rubbing in the spectra of a line to those of the lines before it.
void add_signs(const atlas::AtlasReader& atlas, std::span<const std::uint8_t> status, const Line& line,
               double limit, Findings& found) {
  constexpr std::uint8_t kLeftValidity = 2;
  const auto orders = atlas.inner_axis("order");
  const int blades = found.scene.blades.count;
  if (!shows_signs(orders, blades)) return;
  const auto rows = atlas.line_rows("spectrum", found.signatures.size());
  std::vector<SignHeights> heights(status.size(), {kNotANumber, kNotANumber, kNotANumber});
  auto displacement = line.max_displacement;
  for (std::size_t i = 0; i < status.size(); ++i) {
    // A motion that leaves the model is larger than any that is allowed.
    if (status[i] == kLeftValidity) displacement[i] = std::numeric_limits<double>::infinity();
    if (status[i] == kDone) heights[i] = sign_heights(orders, row_of(rows, status.size(), i), blades);
  }
  found.signatures.push_back(
      find_signs({line.speed_ratio, displacement, heights}, limit, SpeedScale(blades)));
  found.sign_heights.insert(found.sign_heights.end(), heights.begin(), heights.end());
}

std::vector<ExponentCheck> check_exponents(const atlas::AtlasReader& atlas,
                                           std::span<const std::uint8_t> motion) {
  const auto exponents = atlas.rows("lyapunov");
  const auto errors = atlas.rows("lyapunov_error");
  const std::size_t per_point = exponents.size() / motion.size();
  std::vector<ExponentCheck> checks;
  checks.reserve(motion.size());
  for (std::size_t i = 0; i < motion.size(); ++i)
    checks.push_back(check_exponent(motion[i], exponents[i * per_point], errors[i * per_point]));
  return checks;
}

}  // namespace

Findings examine(const atlas::AtlasReader& atlas, const DisplacementLimit& limit) {
  Findings found;
  found.scene = settings::parse_scene(atlas.scene_resolved(), "scene_resolved");
  found.axes = atlas.axes();
  found.parameters = parameters_of(found.axes);
  found.sweeps_initial_state = std::ranges::any_of(found.axes, [](const plan::Axis& axis) {
    return is_initial_axis(axis.name) && axis.values.size() > 1;
  });
  found.has_sections = atlas.has("poincare");
  found.keeps_nearest_miss = atlas.has("nearest_miss");
  const bool per_passing = atlas.has("poincare_blade_passing");
  const bool signs = !found.sweeps_initial_state && atlas.has("spectrum") && atlas.has("max_displacement");
  const SpeedScale scale(found.scene.blades.count);
  const plan::Grid grid(found.scene);
  const settings::Scene scene = plan::with_short_axes(found.scene);

  const Starts starts(found.axes);
  const bool matched = starts.several() && found.has_sections && atlas.has("max_displacement");
  AttractorsOfAtlas attractors(starts);
  const auto status = atlas.status();
  for (const auto value : status) ++found.status_count.at(value);
  const std::size_t speeds = atlas.speed_count();
  for (std::size_t line = 0; line * speeds < status.size(); ++line) {
    const auto own = plan::scene_of_line(scene, grid.parameters(line * speeds));
    const auto tolerance = closing_tolerance(own);
    found.tolerance.push_back(tolerance);
    const auto line_status = std::span(status).subspan(line * speeds, speeds);
    Line points{.speed_ratio = found.axes.back().values,
                .motion = std::vector<std::uint8_t>(speeds, motion_class::kNone),
                .motion_per_passing = {},
                .max_displacement = displacements_of_line(atlas, line_status, line)};
    std::vector<double> rows;
    if (found.has_sections) {
      rows = atlas.line_rows("poincare", line);
      points.motion = classes_of_line(rows, line_status, tolerance);
      if (matched) attractors.add(points, rows, tolerance);
    }
    if (per_passing) {
      points.motion_per_passing =
          classes_of_line(atlas.line_rows("poincare_blade_passing", line), line_status, tolerance);
    }
    points.contact =
        contacts_of_line(atlas, own, line_status, line, points.max_displacement, rows, tolerance);
    if (signs) add_signs(atlas, line_status, points, limit.metres(own), found);
    append(found.motion, points.motion);
    append(found.motion_per_passing, points.motion_per_passing);
    if (atlas.has("max_displacement")) append(found.max_displacement, points.max_displacement);
    found.lines.push_back(summarise(std::move(points), parameters_of_line(found.axes, line), scale,
                                    negligible_displacement(own)));
  }
  if (matched) {
    found.attractor = attractors.numbers();
    if (found.scene.sweep == settings::Sweep::both) {
      found.hysteresis =
          find_hysteresis(found.axes.back().values, found.motion, found.attractor, found.max_displacement);
    } else {
      found.basins = find_basins(starts, {status, found.motion, found.attractor, found.max_displacement});
    }
  }
  if (found.has_sections) found.margins = margins_of(atlas, found, status);
  if (found.has_sections && atlas.has("lyapunov"))
    found.exponent_check = check_exponents(atlas, found.motion);
  if (!found.sweeps_initial_state) found.sensitivities = sensitivities(found.parameters, found.lines, scale);
  return found;
}

void enter_edges(Findings& found, EdgeTable edges) {
  for (const auto& edge : edges.edges) narrow_ends(found.lines.at(edge.line).regions, edge);
  found.edges = std::move(edges);
}

std::string analyse(const std::filesystem::path& atlas, const std::filesystem::path& maps,
                    const std::optional<std::filesystem::path>& table, bool overwrite,
                    const std::optional<std::filesystem::path>& edges, const DisplacementLimit& limit) {
  const auto existing = atlas::existing(overwrite);
  std::vector<std::filesystem::path> others{atlas};
  if (edges) others.push_back(*edges);
  const auto maps_output = atlas::permitted({maps, atlas::FileKind::maps, existing}, others);
  others.push_back(maps_output.path);
  std::optional<atlas::Output> table_output;
  if (table) table_output = atlas::permitted({*table, atlas::FileKind::table, existing}, others);
  const atlas::AtlasReader reader(atlas);
  atlas::require_sound_rows(reader);
  auto found = examine(reader, limit);
  if (edges) enter_edges(found, read_edges(*edges, found, reader));
  write_maps(maps_output, found, reader, atlas.filename().string());
  if (table_output) atlas::publish_text(*table_output, markdown_report(found));
  return plain_report(found);
}

}  // namespace rubatlas::analysis
