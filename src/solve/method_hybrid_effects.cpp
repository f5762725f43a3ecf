// `hybrid` for rotors on which more acts than the paper's: 2 laws, with numbers of their own for each blade,
// at constant and at rippling speed.

#include <optional>
#include <utility>
#include <vector>

#include "contact/unequal_blades.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "solve/hybrid_method.hpp"
#include "solve/typed_line_solver.hpp"

namespace rubatlas::solve {
namespace {

using Hybrid = HybridMethod<integrate::DormandPrince853>;

/// One law a blade: the scene's blade with the errors of each.
template <class MakeLaw>
auto blade_by_blade(const scene::Scene& line, MakeLaw make_law) {
  std::vector<effects::BladeError> errors(static_cast<std::size_t>(line.blades.count));
  if (line.unequal_blades) errors = line.unequal_blades->errors(line.blades.count);
  std::vector<decltype(make_law(line.blades))> laws;
  for (const effects::BladeError& error : errors) {
    scene::Blades blade = line.blades;
    blade.length += error.length;
    blade.thickness += error.thickness;
    laws.push_back(make_law(blade));
  }
  return contact::UnequalBlades(std::move(laws));
}

template <class Law>
std::unique_ptr<LineSolver> on_machine(const scene::Scene& line, Law law) {
  if (effects::acts<&effects::Effects::speed_ripple>(line)) {
    return std::make_unique<TypedLineSolver<Hybrid, Law, RipplingMachine>>(line, std::move(law),
                                                                           RipplingMachine(line));
  }
  return std::make_unique<TypedLineSolver<Hybrid, Law, MachineWithEffects>>(line, std::move(law),
                                                                            MachineWithEffects(line));
}

}  // namespace

std::unique_ptr<LineSolver> make_hybrid_with_effects(const LineRequest& request) {
  const scene::Scene& line = request.line;
  const auto friction = line.contact.friction;
  if (line.contact.law == scene::ContactLaw::elastic_ring) {
    return on_machine(line, blade_by_blade(line, [&](const scene::Blades& blade) {
                        return elastic_ring_law(line.ring, blade, friction);
                      }));
  }
  return on_machine(line, blade_by_blade(line, [&](const scene::Blades& blade) {
                      return elastica_law(line.ring, blade, request.tables.curve(friction));
                    }));
}

}  // namespace rubatlas::solve
