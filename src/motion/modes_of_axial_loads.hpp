/// Modes of elastic blades under an axial load, which have one unknown, the bending parameter u.
#pragma once

#include <memory>

#include "collocation/axial_law.hpp"
#include "modes/carried.hpp"
#include "modes/collocated.hpp"
#include "modes/skimming.hpp"
#include "modes/solved.hpp"
#include "motion/resting_modes.hpp"

namespace rubatlas::motion {

template <class Law, class Forcing, class Pair, class Blades>
requires Law::kHasBending struct ModesOf<Law, Forcing, Pair, Blades>
    : ModesWithRest<Law, Forcing, Pair, Blades> {
  static constexpr bool kCollocates = kCollocatesOn<Forcing> &&
                                      std::is_same_v<Law, collocation::AxialLaw::Laws> &&
                                      std::is_same_v<Blades, rotor::RipplingBlades>;
  using Collocated = modes::Collocated;
  /// None of the column (μ = 0), which has no argument p, and where p has no room: friction so large, or a
  /// blade so soft, that it is shortened beyond the table by the least load.
  static std::unique_ptr<collocation::ArcLaw> arc_law(const Law& law, int blade_count,
                                                      double max_shortening) {
    for (int blade = 0; blade < blade_count; ++blade) {
      if (law.of(blade).curve().over_asinh().last_piece() < 0) return nullptr;
    }
    return std::make_unique<collocation::AxialLaw>(law, blade_count, max_shortening);
  }
  static constexpr bool kCarries = true;
  using Carried = modes::Carried<Law, Forcing, Blades>;
  using Skimming = modes::Skimming<Law, Forcing, Blades>;
  using Solved = modes::Solved<Law, Forcing, Blades>;
};

}  // namespace rubatlas::motion
