#include "mpi/accuracy/accuracy_map.hpp"

#include <cmath>

#include "analysis/rules/line_summary.hpp"
#include "analysis/rules/scene_tolerances.hpp"
#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"

namespace rubatlas::mpi {
namespace {

using atlas::AccuracyRun;
using atlas::AccuracyStudy;
using atlas::MapChanges;

/// The region, 1 to 4, in which a speed lies; 0 for none.
std::uint8_t region_at(const analysis::LineSummary& summary, double speed_ratio) {
  for (std::size_t i = 0; i < summary.regions.size(); ++i) {
    const auto& region = summary.regions[i];
    if (region.present() && speed_ratio >= region.from && speed_ratio <= region.to) {
      return static_cast<std::uint8_t>(i + 1);
    }
  }
  return 0;
}

/// The line as `analysis` sees it; points of a line follow each other in the order of the grid.
analysis::Line line_of(const plan::Grid& grid, const AccuracyStudy& study, std::size_t setting,
                       std::size_t line) {
  analysis::Line points;
  points.speed_ratio = grid.axes().back().values;
  for (std::size_t i = 0; i < grid.speed_count(); ++i) {
    const AccuracyRun& run = study.run(setting, line * grid.speed_count() + i);
    points.motion.push_back(run.motion);
    points.max_displacement.push_back(run.max_displacement);
  }
  return points;
}

/// Displacement [m] that is negligible on each line: lengths may be swept.
std::vector<double> negligible_on_lines(const settings::Scene& scene, const plan::Grid& grid) {
  std::vector<double> negligible;
  for (std::size_t line = 0; line < grid.line_count(); ++line) {
    const auto own = plan::scene_of_line(scene, grid.parameters(line * grid.speed_count()));
    negligible.push_back(analysis::negligible_displacement(own));
  }
  return negligible;
}

void find_regions(const settings::Scene& scene, const plan::Grid& grid, const std::vector<double>& negligible,
                  AccuracyStudy& study) {
  const analysis::SpeedScale scale(scene.blades.count);
  for (std::size_t setting = 0; setting < study.settings.size(); ++setting) {
    for (std::size_t line = 0; line < grid.line_count(); ++line) {
      const auto summary =
          analysis::summarise(line_of(grid, study, setting, line), {}, scale, negligible[line]);
      for (std::size_t i = 0; i < grid.speed_count(); ++i) {
        const std::size_t point = line * grid.speed_count() + i;
        study.runs[setting * study.points.size() + point].region =
            region_at(summary, grid.parameters(point).speed_ratio);
      }
    }
  }
}

/// Two negligible displacements are equal. A missing displacement differs from every known one.
bool displacement_changed(double found, double reference, double negligible) {
  if (std::isnan(found) || std::isnan(reference)) return std::isnan(found) != std::isnan(reference);
  if (found <= negligible && reference <= negligible) return false;
  return !(std::abs(found - reference) <= kDisplacementTolerance * reference);
}

MapChanges changes_of(const AccuracyStudy& study, std::size_t setting, int revolutions,
                      const std::vector<double>& negligible) {
  const std::size_t speeds = study.points.size() / negligible.size();
  MapChanges changes;
  for (std::size_t point = 0; point < study.points.size(); ++point) {
    const AccuracyRun& run = study.run(setting, point);
    const AccuracyRun& reference = study.run(0, point);
    const bool motion = run.status != reference.status || run.motion != reference.motion;
    const bool region = run.region != reference.region;
    const bool displacement =
        displacement_changed(run.max_displacement, reference.max_displacement, negligible[point / speeds]);
    const bool any = motion || region || displacement;
    changes.motion += motion ? 1.0 : 0.0;
    changes.region += region ? 1.0 : 0.0;
    changes.max_displacement += displacement ? 1.0 : 0.0;
    changes.any += any ? 1.0 : 0.0;
    const bool predictable = study.points[point].horizon == revolutions;
    changes.beyond_chaos += motion || region || (displacement && predictable) ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(study.points.size());
  changes.motion /= count;
  changes.region /= count;
  changes.max_displacement /= count;
  changes.any /= count;
  changes.beyond_chaos /= count;
  return changes;
}

}  // namespace

void judge_maps(const settings::Scene& scene, AccuracyStudy& study) {
  const plan::Grid grid(scene);
  const auto negligible = negligible_on_lines(scene, grid);
  find_regions(scene, grid, negligible, study);
  const int revolutions = scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions;
  study.displacement_tolerance = kDisplacementTolerance;
  study.changes.clear();
  for (std::size_t setting = 0; setting < study.settings.size(); ++setting) {
    study.changes.push_back(changes_of(study, setting, revolutions, negligible));
  }
}

}  // namespace rubatlas::mpi
