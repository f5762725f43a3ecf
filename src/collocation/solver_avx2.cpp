// Four numbers in a register.

#include "collocation/inclined_sweeps.hpp"
#include "collocation/interval_bounds.hpp"
#include "collocation/interval_sweeps.hpp"
#include "collocation/rigid_sweeps.hpp"
#include "collocation/stretch_in_lanes.hpp"

namespace rubatlas::collocation {

IntervalSolver solver_avx2() {
#ifdef __AVX2__
  return {solved<4>,          inclined_solved<4>, rigid_solved<4>,
          inclined_branch<4>, bounds_of<4>,       largest_displacement_of<4>,
          upper_bound_of<4>,  largest_gap_of<4>,  read_stretch<4>};
#else
  return solver_in_pairs();
#endif
}

}  // namespace rubatlas::collocation
