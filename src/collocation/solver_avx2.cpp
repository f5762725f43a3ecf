// Four numbers in a register.

#include "collocation/inclined_sweeps.hpp"
#include "collocation/interval_bounds.hpp"
#include "collocation/interval_sweeps.hpp"
#include "collocation/rigid_sweeps.hpp"
#include "collocation/stretch_in_lanes.hpp"

namespace rubatlas::collocation {

IntervalSolver solver_avx2() {
#ifdef __AVX2__
  using Limits = IntervalBounds<4>;
  return {solved<4>,           inclined_solved<4>, rigid_solved<4>,
          inclined_branch<4>,  Limits::bounds,     Limits::largest_displacement,
          Limits::upper_bound, Limits::gap,        read_stretch<4>};
#else
  return solver_in_pairs();
#endif
}

}  // namespace rubatlas::collocation
