// Eight numbers in a register.

#ifdef __AVX512DQ__
#include "collocation/interval_sweeps.hpp"

namespace rubatlas::collocation {

bool solve_avx512(const Contact& contact, const blade::BendingTable& table, const Closeness& closeness,
                  Interval& interval) {
  return Sweeps<8>(contact, table, closeness, interval).solve();
}

}  // namespace rubatlas::collocation

#else
#include "collocation/interval.hpp"

namespace rubatlas::collocation {
bool solve_avx512(const Contact& contact, const blade::BendingTable& table, const Closeness& closeness,
                  Interval& interval) {
  return solve_in_pairs(contact, table, closeness, interval);
}
}  // namespace rubatlas::collocation
#endif
