// Two numbers in a register, which every x86-64 and ARM processor has.

#include "collocation/inclined_sweeps.hpp"
#include "collocation/interval_bounds.hpp"
#include "collocation/interval_sweeps.hpp"
#include "collocation/rigid_sweeps.hpp"
#include "collocation/stretch_in_lanes.hpp"

namespace rubatlas::collocation {

IntervalSolver solver_in_pairs() {
  return {solved<2>,    inclined_solved<2>, rigid_solved<2>, inclined_branch<2>,
          bounds_of<2>, largest_gap_of<2>,  read_stretch<2>};
}

}  // namespace rubatlas::collocation
