/// What a study of accuracy compares: methods, each with a ladder of its knobs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "atlas/accuracy_file.hpp"
#include "scene/scene.hpp"

namespace rubatlas::mpi {

/// The ladders; what a method does not read is not varied for it.
struct AccuracyLadders {
  std::vector<std::string> methods;      ///< empty: all
  std::vector<double> tolerances;        ///< empty: 1e-4, 1e-5, ... 1e-12
  std::vector<double> force_increments;  ///< dF [N]; empty: 1, 0.1, 0.01
  std::vector<double> steps;             ///< in τ; empty: 2e-2 ... 2e-4
};

/// The methods there are, the default first.
std::vector<std::string_view> accuracy_methods();

/// The reference (`hybrid`, ten times tighter than the tightest tolerance asked for), then each method's
/// ladder. Throws UsageError for an unknown method and for a knob outside its range.
std::vector<atlas::AccuracySetting> accuracy_settings(const AccuracyLadders& ladders,
                                                      const scene::Scene& scene);

/// The scene with the method and the knobs of a setting, and the observables that a study compares.
scene::Scene scene_with(const atlas::AccuracySetting& setting, scene::Scene scene);

}  // namespace rubatlas::mpi
