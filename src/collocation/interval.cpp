#include "collocation/interval.hpp"

namespace rubatlas::collocation {

Solve interval_solver() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return solve_avx512;
  if (__builtin_cpu_supports("avx2")) return solve_avx2;
#endif
  return solve_in_pairs;
}

}  // namespace rubatlas::collocation
