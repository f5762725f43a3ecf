/// Atlases in the real format whose motions are prescribed instead of integrated.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/rules/class.hpp"
#include "atlas/atlas_writer.hpp"
#include "atlas/create.hpp"
#include "observables/list.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/reader.hpp"

namespace rubatlas::analysis {

/// What a point is to be: a period (in sections), or `kAperiodic`; `kNone` leaves it pending.
struct PrescribedPoint {
  std::uint8_t motion = 1;
  double displacement = 1e-3;  ///< [m]
  ending::PointStatus status = ending::PointStatus::done;
};

/// Sections of a motion of the given class, as large as the displacement.
inline std::vector<double> sections_of(const PrescribedPoint& point, std::size_t sections) {
  std::vector<double> states;
  double chaos = 0.3141;
  for (std::size_t i = 0; i < sections; ++i) {
    chaos = 4.0 * chaos * (1.0 - chaos);
    const double cycle = point.motion == motion_class::kAperiodic
                             ? chaos
                             : static_cast<double>(i % point.motion) / static_cast<double>(point.motion);
    states.insert(states.end(), {point.displacement * cycle, 0.5 * point.displacement, 0.0, 0.0});
  }
  return states;
}

/// Writes an atlas of the scene (JSON text), each point as `prescribe` says.
inline void write_atlas(const std::filesystem::path& path, const std::string& text,
                        const std::function<PrescribedPoint(const plan::PointParameters&)>& prescribe) {
  const auto scene = settings::parse_scene(text);
  const plan::Grid grid(scene);
  atlas::create_atlas(path, {scene, text, {"rubatlas", "1.0", "none", "none"}});
  atlas::AtlasWriter writer(path, scene);
  for (std::size_t point = 0; point < grid.point_count(); ++point) {
    const auto prescribed = prescribe(grid.parameters(point));
    if (prescribed.motion == motion_class::kNone) continue;
    point::PointOutcome outcome;
    outcome.status = prescribed.status;
    outcome.failed_revolution = prescribed.status == ending::PointStatus::done ? -1 : 7;
    for (const auto& description : observables::descriptions(scene)) {
      if (description.name.starts_with("poincare")) {
        outcome.rows.push_back(sections_of(prescribed, description.row_size / kStateSize));
      } else {
        outcome.rows.emplace_back(description.row_size, prescribed.displacement);
      }
    }
    writer.add_point(point, {.restarted = false}, outcome);
  }
  writer.close();
}

/// The paper's picture over the speed ratio.
inline PrescribedPoint papers_point(const plan::PointParameters& at) {
  if (at.speed_ratio < 1.0 / 3.0) return {1, 1e-4};
  if (at.speed_ratio < 0.545) return {motion_class::kAperiodic, 1e-2};
  if (at.speed_ratio < 0.655) return {1, 5e-3};
  if (at.speed_ratio < 2.0 / 3.0) return {2, 5e-3};
  return {motion_class::kAperiodic, 2e-2};
}

}  // namespace rubatlas::analysis
