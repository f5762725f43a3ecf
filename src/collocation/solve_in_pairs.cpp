// Two numbers in a register, which every x86-64 and ARM processor has.

#include "collocation/interval_sweeps.hpp"

namespace rubatlas::collocation {

bool solve_in_pairs(const Contact& contact, const blade::BendingTable& table, const Closeness& closeness,
                    Interval& interval) {
  return Sweeps<2>(contact, table, closeness, interval).solve();
}

}  // namespace rubatlas::collocation
