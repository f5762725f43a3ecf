/// The settings that a study of accuracy compares: methods, each with a series of tolerances or steps.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "atlas/accuracy_file.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// The values to be compared; each method uses those that it reads. An empty list stands for the usual
/// values.
struct AccuracyLadders {
  std::vector<std::string> methods{};  ///< all that take the scene's effects
  std::vector<double> tolerances{};    ///< 1e-4, 1e-5, ... 1e-12; of `paper` fewer, each with its increments
  std::vector<double> force_increments{};  ///< dF [N]: 1 and 0.1
  std::vector<double> steps{};             ///< in τ, of `fixed`: 2e-2 ... 1e-3
};

/// The methods that a scene may name, the default first.
std::vector<std::string_view> accuracy_methods();

/// Those of them that do not take the scene's effects: a study leaves them out where no methods are named.
std::vector<std::string_view> methods_left_out(const settings::Scene& scene);

/// The reference (`hybrid`, ten times tighter than the tightest tolerance asked for), then the series of each
/// method. Throws UsageError for an unknown method, for one that does not take the scene's effects, for a
/// value outside its range, or that no method reads, and for what is named twice.
std::vector<atlas::AccuracySetting> accuracy_settings(const AccuracyLadders& ladders,
                                                      const settings::Scene& scene);

/// The scene with the method, tolerance and steps of a setting, and the observables that a study compares.
settings::Scene scene_with(const atlas::AccuracySetting& setting, settings::Scene scene);

}  // namespace rubatlas::mpi
