/// The compiled motions of rotors on which more acts than the paper's: each law of contact, with numbers of
/// its own for each blade, on the machine that the scene's effects make. One file
/// `effect_kernels_<family>.cpp` compiles the laws of a family.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "assembly/effect_families.hpp"
#include "assembly/hybrid_method.hpp"
#include "assembly/machine_with_effects.hpp"
#include "assembly/typed_motions.hpp"
#include "contact/unequal_blades.hpp"
#include "integrate/dormand_prince_853.hpp"

namespace rubatlas::assembly {

/// One law a blade: the scene's blade with the errors of each.
template <class MakeLaw>
auto blade_by_blade(const settings::Scene& line, MakeLaw make_law) {
  std::vector<effects::BladeError> errors(static_cast<std::size_t>(line.blades.count));
  if (line.unequal_blades) errors = line.unequal_blades->errors(line.blades.count);
  std::vector<decltype(make_law(line.blades))> laws;
  for (const effects::BladeError& error : errors) {
    settings::Blades blade = line.blades;
    blade.length += error.length;
    blade.thickness += error.thickness;
    laws.push_back(make_law(blade));
  }
  return contact::UnequalBlades(std::move(laws));
}

/// The line solver under one law, on the machine that the scene's effects make.
template <class MakeLaw>
std::unique_ptr<point::LineSolver> with_law(const FamilyRequest& request, MakeLaw make_law) {
  using Hybrid = HybridMethod<integrate::DormandPrince853>;
  const settings::Scene& line = request.line;
  return make_point_solver<Hybrid>(line, blade_by_blade(line, make_law),
                                   MachineWithEffects(line, request.combination.machine));
}

}  // namespace rubatlas::assembly
