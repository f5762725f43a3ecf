// `hybrid` for rotors on which more acts than the paper's: picks the family of motions.

#include "assembly/effect_kernels.hpp"
#include "settings/effects/list.hpp"

namespace rubatlas::assembly {

std::unique_ptr<point::LineSolver> make_hybrid_with_effects(const LineRequest& request) {
  using effects::acts;
  using effects::Effects;
  const settings::Scene& line = request.line;
  if (acts<&Effects::ring_body>(line)) return blades_in_ring_body(request);
  if (line.contact.law == settings::ContactLaw::elastic_ring) {
    return acts<&Effects::stick>(line) ? sticking_blades_with_effects(request)
                                       : rigid_blades_with_effects(request);
  }
  // Without friction no tip is held, and none is turned round: the blade is the column of the plain law.
  const bool rubs = line.contact.friction > 0.0;
  if (rubs && acts<&Effects::stick>(line)) return sticking_elastic_blades_with_effects(request);
  if (acts<&Effects::load_direction>(line) || (rubs && acts<&Effects::regularised_friction>(line)) ||
      acts<&Effects::stribeck>(line)) {
    return directed_blades_with_effects(request);
  }
  return acts<&Effects::release>(line) ? held_blades_with_effects(request)
                                       : elastic_blades_with_effects(request);
}

}  // namespace rubatlas::assembly
