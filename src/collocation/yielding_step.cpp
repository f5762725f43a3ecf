#include "collocation/yielding_step.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "integrate/decompositions.hpp"

namespace rubatlas::collocation {

/// y = y0 + ∫ y' dτ/dθ dθ at the nodes, with the changes of y' and of dτ/dθ that belong to the step.
AtNodes yielding_step(const Blade& blade, double start, const AtNodes& yielding, const AtNodes& load,
                      const AtNodes& time_rate, const ChangeWithYielding& load_changes,
                      const ChangeWithYielding& time_changes) {
  constexpr auto kSize = static_cast<Eigen::Index>(kNodes);
  using Vector = Eigen::Array<double, kSize, 1>;
  using Coupling = Eigen::Matrix<double, kSize, kSize>;
  const auto vector = [](const AtNodes& at) { return Eigen::Map<const Vector>(at.value.data()); };
  const auto matrix = [](const std::array<AtNodes, kNodes>& columns) {
    return Eigen::Map<const Coupling>(columns.front().value.data());
  };
  const auto integral = matrix(kNodeTables.integral);
  const Vector rate = (vector(load) - blade.ring_stiffness * vector(yielding)) / blade.ring_damping;
  const Vector weight = vector(time_rate) / blade.ring_damping;
  const Coupling of_time = integral * rate.matrix().asDiagonal() * matrix(kNodeTables.slope);
  const Vector stiffness = weight * (blade.ring_stiffness - vector(load_changes.slope));
  const Coupling whole = Coupling::Identity() + integral * stiffness.matrix().asDiagonal() -
                         of_time * vector(time_changes.slope).matrix().asDiagonal();
  const Vector given = vector(time_rate) * rate + weight * vector(load_changes.change);
  const Vector right = start - vector(yielding) + (integral * given.matrix()).array() +
                       (of_time * vector(time_changes.change).matrix()).array();
  const Vector solution = integrate::solve(whole, right.matrix()).array();
  AtNodes step;
  std::copy_n(solution.data(), kNodes, step.value.begin());
  return step;
}

}  // namespace rubatlas::collocation
