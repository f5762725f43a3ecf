// Two numbers in a register, which every x86-64 and ARM processor has, and which solver suits this one.

#include "collocation/inclined_sweeps.hpp"
#include "collocation/interval_bounds.hpp"
#include "collocation/interval_sweeps.hpp"
#include "collocation/rigid_sweeps.hpp"
#include "collocation/stretch_in_lanes.hpp"

namespace rubatlas::collocation {

IntervalSolver solver_in_pairs() {
  using Limits = IntervalBounds<2>;
  return {solved<2>,           inclined_solved<2>, rigid_solved<2>,
          inclined_branch<2>,  Limits::bounds,     Limits::largest_displacement,
          Limits::upper_bound, Limits::gap,        read_stretch<2>};
}

IntervalSolver interval_solver() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) return solver_avx512();
  if (__builtin_cpu_supports("avx2")) return solver_avx2();
#endif
  return solver_in_pairs();
}

}  // namespace rubatlas::collocation
