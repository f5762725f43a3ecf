/// Elastic blades under an axial load, with Coulomb friction, as an arc's law (MODEL 3, 4). Columns, μ = 0,
/// are among them. One that something gives way in series with stands straight up to its Euler load: its p
/// does not change then, and an arc that it leads is a stretch of time.
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "collocation/arc_law.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::collocation {

class AxialLaw : public ArcLaw {
 public:
  using Blades = std::vector<const contact::ElasticaContact*>;
  /// `blades` outlive it. `max_shortening`: of δ/L.
  AxialLaw(Blades blades, double max_shortening)
      : ArcLaw(blades.front()->friction()), blades_(std::move(blades)), max_shortening_(max_shortening) {}

  [[nodiscard]] Blade numbers(int blade) const override;
  [[nodiscard]] contact::Geometry geometry(int blade) const override { return of(blade).geometry(); }
  [[nodiscard]] bool may_slip_back() const override { return true; }
  [[nodiscard]] bool releases_at_fold(int blade) const override { return of(blade).releases_at_fold(); }
  [[nodiscard]] bool has_branches(int blade) const override { return of(blade).has_branches(); }
  [[nodiscard]] bool starts_unloaded(int blade, double slip, const contact::Pose& at) const override {
    return of(blade).starts_unloaded(at, slip);
  }
  [[nodiscard]] double valid_shortening(int blade) const override {
    return std::min(max_shortening_, table(blade).knots().back().shortening);
  }
  [[nodiscard]] bool may_stand_straight(int blade) const override { return of(blade).may_stand_straight(); }
  /// The motion has found where a blade stands that is bent.
  [[nodiscard]] std::optional<Touch> open(const Touch& touch, const contact::Pose& at,
                                          double speed) const override;
  Bending lead(const Touch& touch) override;
  [[nodiscard]] BladeStart start(const Touch& touch, const contact::Pose& at, double speed) const override;
  [[nodiscard]] Tangent tangent(const Touch& touch, const contact::Pose& at, double speed,
                                const std::complex<double>& acceleration) const override;
  [[nodiscard]] std::span<const blade::BendingTable::Knot> knots() const override {
    return table(leader_).knots();
  }
  [[nodiscard]] double deflection_per_square() const override {
    return collocation::deflection_per_square(of(leader_));
  }
  void set_course(const Touch& touch, const contact::Pose& at, double speed,
                  BladeStart& start) const override;
  [[nodiscard]] bool solve(const Machine& machine, const Closeness& closeness,
                           Interval& interval) const override {
    return solver_.solve(machine, closeness, interval);
  }
  [[nodiscard]] Touch touch(const TipStart& tip, const Bending& bending) const override;
  [[nodiscard]] contact::TipForce force(const Touch& touch, const contact::Pose& at,
                                        double speed) const override;
  [[nodiscard]] Rates rates(const Bending& bending, const Tangent& along) const override {
    return {along.argument * table(leader_).bending_slope(bending.argument)};
  }

 protected:
  static constexpr double kStraight = 1e-6;  ///< p: not 0, from where a blade would begin to bend
  [[nodiscard]] const contact::ElasticaContact& of(int blade) const {
    return *blades_[static_cast<std::size_t>(blade)];
  }
  [[nodiscard]] const blade::BendingTable& table(int blade) const { return of(blade).curve().over_asinh(); }

 private:
  [[nodiscard]] double gap_measure(const Touch& touch, const contact::Pose& at) const;

  Blades blades_;
  double max_shortening_;
  int leader_ = 0;
};

}  // namespace rubatlas::collocation
