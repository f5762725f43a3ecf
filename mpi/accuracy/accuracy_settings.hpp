/// What a study of accuracy compares: methods, each with a ladder of its knobs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "atlas/accuracy_file.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// What is varied; a knob that a method does not read is not varied for it. Empty: the usual values.
struct AccuracyLadders {
  std::vector<std::string> methods{};  ///< all
  std::vector<double> tolerances{};    ///< 1e-4, 1e-5, ... 1e-12; of `paper` fewer, each with its increments
  std::vector<double> force_increments{};  ///< dF [N]: 1 and 0.1
  std::vector<double> steps{};             ///< in τ, of `fixed`: 2e-2 ... 1e-3
};

/// The methods that a scene may name, the default first.
std::vector<std::string_view> accuracy_methods();

/// The reference (`hybrid`, ten times tighter than the tightest tolerance asked for), then each method's
/// ladder. Throws UsageError for an unknown method and for a knob outside its range.
std::vector<atlas::AccuracySetting> accuracy_settings(const AccuracyLadders& ladders,
                                                      const settings::Scene& scene);

/// The scene with the method and the knobs of a setting, and the observables that a study compares.
settings::Scene scene_with(const atlas::AccuracySetting& setting, settings::Scene scene);

}  // namespace rubatlas::mpi
