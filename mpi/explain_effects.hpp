/// The part of `explain` about effects: which are on, why, and what each costs.
#pragma once

#include "mpi/explain_text.hpp"
#include "scene/scene.hpp"

namespace rubatlas::mpi {

void describe_effects(const scene::Scene& scene, double measured_for, Text& text);

}  // namespace rubatlas::mpi
