/// How errors change a map: points whose class, region or maximum displacement changes.
///
/// Classes and regions are those of `analysis`, found by the same rules as those of an atlas.
#pragma once

#include "atlas/accuracy_file.hpp"
#include "settings/scene.hpp"

namespace rubatlas::mpi {

/// A maximum displacement that differs by more than this share has changed.
constexpr double kDisplacementTolerance = 0.01;

/// Fills in the regions of all runs, whose classes and displacements are known, and the shares of changed
/// points.
void judge_maps(const settings::Scene& scene, atlas::AccuracyStudy& study);

}  // namespace rubatlas::mpi
