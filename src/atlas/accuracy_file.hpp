/// ACCURACY.h5: what accuracy costs. One row per setting (a method with its tolerance and steps) and point:
/// error, time, work.
///
/// Self-describing in the manner of an atlas; the layout is in datasets.md, "ACCURACY.h5".
/// Everything in it is a function of scene, options and build, except the two CPU times.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "atlas/output.hpp"
#include "atlas/software.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

/// A method with its tolerance and steps. A number that the method does not read is NaN.
struct AccuracySetting {
  static constexpr double kNotRead = std::numeric_limits<double>::quiet_NaN();

  std::string method;                 ///< as `accuracy.method`
  double tolerance = kNotRead;        ///< local error of a step relative to the clearance
  double force_increment = kNotRead;  ///< dF [N]
  double max_step = kNotRead;         ///< longest step in τ
  double step = kNotRead;             ///< fixed step in τ
};

/// One setting at one point.
struct AccuracyRun {
  ending::PointStatus status = ending::PointStatus::pending;
  std::int32_t failed_revolution = -1;  ///< of a run that did not end as done
  /// Largest distance of the compared sections from those of the reference run, over the clearance [-]; NaN
  /// where either run did not end as done.
  double trajectory_error = std::numeric_limits<double>::quiet_NaN();
  double cpu_time_min = 0.0;     ///< [s] over the repeats
  double cpu_time_median = 0.0;  ///< [s]
  motion::WorkCounts work;
  std::uint8_t motion = 0;  ///< class of the motion per revolution, as in MAPS.h5
  std::uint8_t region = 0;  ///< 1 to 4; 0 in none of them
  double max_displacement = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  std::vector<motion::SectionState> first_sections;                    ///< after revolutions 1, 2, ...
  std::vector<motion::SectionState> last_sections;                     ///< the last of the sampled ones
};

/// What is common to all settings at a point.
struct AccuracyPoint {
  motion::PointStart start;  ///< state from which all runs start: that from which the sweep of the reference
                             ///< starts this point
  /// Number of leading sections over which the two tightest runs agree; the point is predictable to the end
  /// where these are all revolutions of the protocol.
  std::int32_t horizon = 0;
};

/// Shares of the points at which a result differs from that of the reference run [-].
struct MapChanges {
  double motion = 0.0;            ///< class, or status
  double region = 0.0;            ///< the point lies in another region
  double max_displacement = 0.0;  ///< by more than the stated share
  double any = 0.0;               ///< at least one of them
  /// Class or region at any point, displacement only where the motion is predictable to the end: a maximum
  /// over finite time of a chaotic motion differs between any two runs.
  double beyond_chaos = 0.0;
};

struct AccuracyStudy {
  std::vector<AccuracySetting> settings;  ///< the first is the reference
  std::vector<AccuracyPoint> points;      ///< in the order of the grid
  std::vector<AccuracyRun> runs;          ///< [setting][point]
  std::vector<MapChanges> changes;        ///< one per setting
  int repeats = 1;                        ///< timed runs of each setting at each point, fewer of slow ones
  double horizon_tolerance = 0.0;         ///< two sections agree within this, relative to the clearance
  double displacement_tolerance = 0.0;    ///< a change of maximum displacement beyond this share counts

  [[nodiscard]] const AccuracyRun& run(std::size_t setting, std::size_t point) const {
    return runs[setting * points.size() + point];
  }
};

/// The file appears when it is complete. Throws EnvironmentError.
void write_accuracy(const Output& output, const settings::Scene& scene, const std::string& scene_text,
                    const AccuracyStudy& study, const Software& software);

}  // namespace rubatlas::atlas
