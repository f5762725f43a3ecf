// Eight numbers in a register.

#include "collocation/inclined_sweeps.hpp"
#include "collocation/interval_bounds.hpp"
#include "collocation/interval_sweeps.hpp"
#include "collocation/rigid_sweeps.hpp"
#include "collocation/stretch_in_lanes.hpp"

namespace rubatlas::collocation {

IntervalSolver solver_avx512() {
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
  using Limits = IntervalBounds<8>;
  return {solved<8, 4>,        inclined_solved<8>, rigid_solved<8>,
          inclined_branch<8>,  Limits::bounds,     Limits::largest_displacement,
          Limits::upper_bound, Limits::gap,        read_stretch<8>};
#else
  return solver_in_pairs();
#endif
}

}  // namespace rubatlas::collocation
