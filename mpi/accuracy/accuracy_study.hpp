/// Runs a scene's points with every setting, and compares and times the runs.
#pragma once

#include <functional>
#include <vector>

#include "atlas/accuracy_file.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// Computes all runs one after the other, on one core, the reference first.
///
/// All settings start a point from the same state, from which the sweep of the reference starts it. Runs
/// therefore differ by the error made at this point, not by the attractor to which the points before have
/// led. Two runs of the reference method, one with a ten times larger tolerance, show for how long a point
/// can be predicted. They agree within 1000 times the looser tolerance over the whole protocol, or over a
/// number of leading sections, the horizon. The error of a trajectory is measured on the sampled sections in
/// the first case, and on the sections within the horizon in the second. A run is timed up to `repeats`
/// times, fewer where it is slow. `after_run` is called after every setting at every point.
atlas::AccuracyStudy study_accuracy(const settings::Scene& scene,
                                    const std::vector<atlas::AccuracySetting>& settings, int repeats,
                                    const std::function<void(const atlas::AccuracyRun&)>& after_run);

}  // namespace rubatlas::mpi
