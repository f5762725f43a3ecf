/// Elastic blades under an axial load, with Coulomb friction (MODEL 3, 4). Columns, μ = 0, are among them.
/// One that something gives way in series with stands straight up to its Euler load: its p does not change
/// then, and an arc that it leads is a stretch of time.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "collocation/law.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::collocation {

/// Their arcs, in any ring.
class ArcsOfAxialLoads : public Law {
 public:
  using Law::Law;

  [[nodiscard]] Blade numbers(int blade) const override;
  [[nodiscard]] bool may_slip_back() const override { return true; }
  [[nodiscard]] bool has_branches(int blade) const override { return elastica(blade).has_branches(); }
  [[nodiscard]] bool starts_unloaded(int blade, double slip, const contact::Pose& at) const override {
    return elastica(blade).starts_unloaded(at, slip);
  }
  [[nodiscard]] double largest_shortening(int blade) const override {
    return table(blade).knots().back().shortening;
  }
  [[nodiscard]] bool may_stand_straight(int blade) const override {
    return elastica(blade).may_stand_straight();
  }
  [[nodiscard]] std::optional<Touch> in_equilibrium(const Touch& touch, const TipPlace& at) const override;
  Bending lead(const Touch& touch) override;
  [[nodiscard]] BladeStart start(const Touch& touch, const TipPlace& at) const override;
  [[nodiscard]] Tangent tangent(const Touch& touch, const TipPlace& at,
                                const std::complex<double>& acceleration) const override;
  [[nodiscard]] std::span<const blade::BendingTable::Knot> knots() const override {
    return table(leader_).knots();
  }
  [[nodiscard]] double deflection_per_square() const override { return deflection_per_square(leader_); }
  void set_course(const Touch& touch, const TipPlace& at, BladeStart& start) const override;
  [[nodiscard]] bool solve(const Machine& machine, const Closeness& closeness,
                           Interval& interval) const override {
    return solver_.solve(machine, closeness, interval);
  }
  [[nodiscard]] Touch touch(const TipStart& tip, const Bending& bending) const override;
  [[nodiscard]] contact::TipForce force(const Touch& touch, const TipPlace& at) const override;
  [[nodiscard]] Rates rates(const Bending& bending, const Tangent& along) const override {
    return {along.argument * table(leader_).bending_slope(bending.argument)};
  }

 protected:
  [[nodiscard]] const contact::ElasticaContact& elastica(int blade) const {
    return *elastica_[static_cast<std::size_t>(blade)];
  }

  std::vector<const contact::ElasticaContact*> elastica_;  ///< the blades in a ring without dampers

 private:
  static constexpr double kStraight = 1e-6;  ///< p: not 0, from where a blade would begin to bend
  [[nodiscard]] const blade::BendingTable& table(int blade) const {
    return elastica(blade).curve().over_asinh();
  }
  [[nodiscard]] double deflection_per_square(int blade) const;

  int leader_ = 0;
};

/// In a ring without dampers. At a reset the root of h is looked for (MODEL 4.1 and 4.2).
class AxialLaw final : public LawOfBlades<AxialLaw, contact::ElasticaContact, ArcsOfAxialLoads> {
 public:
  explicit AxialLaw(Blades blades);

  [[nodiscard]] bool releases_at_fold(int blade) const override { return of(blade).releases_at_fold(); }
  /// A blade released at the fold returns from a finite distance, and the force of a compressed column starts
  /// from zero: neither hops without end.
  [[nodiscard]] bool may_skim() const override { return !releases_at_fold(0) && !may_stand_straight(0); }

  /// A contact opens on the approaching side from zero force, on the receding side from a finite one (MODEL
  /// 4.2).
  [[nodiscard]] bool open(const TipPlace& at, Touch& touch) const override;
  [[nodiscard]] Standing keep(const TipPlace& at, Touch& touch) const override;
  /// In the direction in which the blade moves. Where there is no next equilibrium, the blade is free if the
  /// ring opens and the undeformed tip is outside it.
  [[nodiscard]] Standing snap(const TipPlace& at, Touch& touch) const override;
  [[nodiscard]] bool bend_anew(const TipPlace& at, Touch& touch) const override;
  /// A column whose u has come to 0 while its tip is still in the ring (g > 0) stands straight from there on.
  [[nodiscard]] bool straightens(const TipPlace& at, Touch& touch) const override;
  bool respond(const TipPlace& at, Touch& touch, contact::TipForce& force) const override {
    return of(touch.blade).respond(at.pose, touch.slip, at.speed, touch.bending, force);
  }
  [[nodiscard]] std::optional<contact::DirectedElastica> law_of_rest(int blade) const override;
};

}  // namespace rubatlas::collocation
