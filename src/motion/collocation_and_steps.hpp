/// The pair of methods of `collocation`: contacts of few blades by collocation, all else in steps of the
/// order-8 pair.
#pragma once

#include "integrate/dormand_prince_853.hpp"
#include "modes/collocated.hpp"
#include "motion/modes_of.hpp"

namespace rubatlas::motion {

struct CollocationAndSteps : integrate::DormandPrince853 {};

template <>
struct CollocationOf<CollocationAndSteps> {
  static constexpr bool kOccurs = true;
  using Mode = modes::Collocated;
};

}  // namespace rubatlas::motion
