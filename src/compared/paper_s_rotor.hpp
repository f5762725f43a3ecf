/// The paper's rotor by a method that only comparisons ask for: with an unbalance or without, one compiled
/// motion.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "assembly/machine.hpp"
#include "assembly/typed_motions.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::compared {

/// Equal blades at constant speed; the list of forcings is empty where the scene has no unbalance.
struct MachineWithList {
  static constexpr bool kMayChange = false;
  assembly::UnbalancedMachine machine;
  [[nodiscard]] rotor::Harmonics forcing(double speed_ratio) const {
    if (machine.specific_moment == 0.0) return rotor::Harmonics({});
    return rotor::Harmonics({machine.forcing(speed_ratio)});
  }
  [[nodiscard]] rotor::BladeSet blades(double speed_ratio) const { return machine.blades(speed_ratio); }
};

template <class Method>
std::unique_ptr<point::LineSolver> make_paper_s_rotor(const assembly::LineRequest& request) {
  const settings::Scene& line = request.line;
  const bool unbalanced = effects::acts<&effects::Effects::unbalance>(line);
  const MachineWithList machine{{line.blades.count,
                                 unbalanced ? line.unbalance->moment / line.rotor.mass : 0.0,
                                 unbalanced ? line.unbalance->phase : 0.0, line.rotor.damping_ratio}};
  return assembly::with_paper_s_law(
      request, [&](auto law) { return assembly::make_point_solver<Method>(line, std::move(law), machine); });
}

}  // namespace rubatlas::compared
