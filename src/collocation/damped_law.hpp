/// Elastic blades under an axial load, with Coulomb friction, on a ring with a damper under each tip, as an
/// arc's law (MODEL 7.16). Under a blade that stands straight only the ring yields, as under a rigid one: its
/// p does not change, and an arc that it leads is a stretch of time.
#pragma once

#include <complex>
#include <optional>

#include "collocation/axial_law.hpp"
#include "contact/damped_ring.hpp"
#include "contact/unequal_blades.hpp"

namespace rubatlas::collocation {

class DampedLaw final : public AxialLaw {
 public:
  using Laws = contact::UnequalBlades<contact::ElasticBladeOnDampedRing>;
  /// `laws` outlive it. `max_shortening`: of δ/L.
  DampedLaw(const Laws& laws, int blade_count, double max_shortening);

  [[nodiscard]] Blade numbers(int blade) const override;
  [[nodiscard]] bool ends_at_ring() const override { return false; }
  [[nodiscard]] std::optional<Touch> open(const Touch& touch, const contact::Pose& at,
                                          double speed) const override;
  [[nodiscard]] BladeStart start(const Touch& touch, const contact::Pose& at, double speed) const override;
  [[nodiscard]] Tangent tangent(const Touch& touch, const contact::Pose& at, double speed,
                                const std::complex<double>& acceleration) const override;
  [[nodiscard]] bool solve(const Machine& machine, const Closeness& closeness,
                           Interval& interval) const override;
  [[nodiscard]] contact::TipForce force(const Touch& touch, const contact::Pose& at,
                                        double speed) const override;

 private:
  void find_bending_left(const Machine& machine, const Interval& interval, TipInTime& tip) const;
  [[nodiscard]] double ring_opens(const Touch& touch, const contact::Pose& at, double speed) const;

  const Laws* laws_;
};

}  // namespace rubatlas::collocation
