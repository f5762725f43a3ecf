/// Runs a scene's points with every setting, and compares and times the runs.
#pragma once

#include <functional>
#include <vector>

#include "atlas/accuracy_file.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// One after the other, on one core, the reference first.
///
/// All settings start a point from the same state, the one from which the reference run's sweep starts it:
/// what differs is the error of this point, and not which attractor the points before have led to. Two runs
/// of the reference method, one ten times less tight than the other, say how far a point can be predicted:
/// they agree within 1000 times the looser tolerance over the whole protocol, or over a number of leading
/// sections, the horizon. A trajectory's error is looked for in the sampled sections of the former, and
/// within the horizon of the latter. A run is timed up to `repeats` times, fewer where it is slow.
/// `after_run` hears of every setting at every point once it is done.
atlas::AccuracyStudy study_accuracy(const settings::Scene& scene,
                                    const std::vector<atlas::AccuracySetting>& settings, int repeats,
                                    const std::function<void(const atlas::AccuracyRun&)>& after_run);

}  // namespace rubatlas::mpi
