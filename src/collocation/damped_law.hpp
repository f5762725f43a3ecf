/// Elastic blades under an axial load, with Coulomb friction, on a ring with a damper under each tip (MODEL
/// 7.16). Under a blade that stands straight only the ring yields, as under a rigid one: its
/// p does not change, and an arc that it leads is a stretch of time.
#pragma once

#include <complex>
#include <optional>

#include "collocation/axial_law.hpp"
#include "contact/damped_ring.hpp"

namespace rubatlas::collocation {

class DampedLaw final : public LawOfBlades<DampedLaw, contact::ElasticBladeOnDampedRing, ArcsOfAxialLoads> {
 public:
  explicit DampedLaw(Blades blades);

  [[nodiscard]] Blade numbers(int blade) const override;
  [[nodiscard]] std::optional<Touch> in_equilibrium(const Touch& touch, const TipPlace& at) const override;
  [[nodiscard]] BladeStart start(const Touch& touch, const TipPlace& at) const override;
  [[nodiscard]] Tangent tangent(const Touch& touch, const TipPlace& at,
                                const std::complex<double>& acceleration) const override;
  [[nodiscard]] bool solve(const Machine& machine, const Closeness& closeness,
                           Interval& interval) const override;
  [[nodiscard]] contact::TipForce force(const Touch& touch, const TipPlace& at) const override;

  /// On the receding side a blade stands straight while the ring's load is too small to bend it.
  [[nodiscard]] bool open(const TipPlace& at, Touch& touch) const override;
  /// A blade that has unbent to the ring's circle stays in contact where the ring pushes it.
  [[nodiscard]] bool straightens(const TipPlace& at, Touch& touch) const override;

 private:
  void find_bending_left(const Machine& machine, const Interval& interval, TipInTime& tip) const;
  [[nodiscard]] double ring_opens(const Touch& touch, const TipPlace& at) const;
};

}  // namespace rubatlas::collocation
