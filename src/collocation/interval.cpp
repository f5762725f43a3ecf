#include "collocation/interval.hpp"

namespace rubatlas::collocation {

IntervalSolver interval_solver() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) return solver_avx512();
  if (__builtin_cpu_supports("avx2")) return solver_avx2();
#endif
  return solver_in_pairs();
}

}  // namespace rubatlas::collocation
