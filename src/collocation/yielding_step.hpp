/// How far a ring with dampers yields under an elastic blade, cr y' = F − kr y, at the nodes of an interval
/// (MODEL 7.16).
#pragma once

#include "collocation/interval.hpp"
#include "collocation/nodes.hpp"

namespace rubatlas::collocation {

/// A quantity at the nodes, and how it changes in a step of Newton's method in which y changes by dy:
/// `change` + `slope` dy.
struct ChangeWithYielding {
  AtNodes change, slope;
};

/// dy of that step, in which F and τ change so. `load`: F [N]; `time_rate`: dτ/dθ.
AtNodes yielding_step(const Blade& blade, double start, const AtNodes& yielding, const AtNodes& load,
                      const AtNodes& time_rate, const ChangeWithYielding& load_changes,
                      const ChangeWithYielding& time_changes);

}  // namespace rubatlas::collocation
