/// Elastic blades under an axial load, with Coulomb friction (MODEL 3, 4). Columns, μ = 0, are among them.
/// One that something gives way in series with stands straight up to its Euler load: its p does not change
/// then, and an arc that it leads is a stretch of time.
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "collocation/law.hpp"
#include "contact/elastica_contact.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::collocation {

/// Their arcs, in any ring.
class ArcsOfAxialLoads : public Law {
 public:
  using Law::Law;

  [[nodiscard]] Blade numbers(int blade) const override {
    const contact::ElasticaContact& law = elastica(blade);
    return {.table = &table(blade),
            .reach = law.geometry().reach,
            .closing = law.geometry().closing(),
            .length = law.length(),
            .load_unit = law.load_unit(),
            .strain_unit = law.strain_unit(),
            .friction = law.curve().friction(),
            .yield_unit = law.yield_unit(),
            .first_shortening = law.first_shortening(),
            .first_yielding = law.first_yielding(),
            .axial_unit = law.may_stand_straight() ? law.axial_unit() : 0.0,
            .buckling_load = law.may_stand_straight() ? blade::kEulerLoad * law.load_unit() : 0.0,
            .held_beyond_ring = law.releases_at_fold()};
  }
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
  [[nodiscard]] std::optional<Touch> in_equilibrium(const Touch& touch, const TipPlace& at) const override {
    const contact::ElasticaContact& law = elastica(touch.blade);
    Touch found = touch;
    // One that has just buckled, or straightened, has its Euler load to rounding.
    constexpr double kClearlyLess = 1.0 - 1e-9;
    if (law.may_stand_straight() && touch.bending == 0.0)
      found.straight = touch.straight || law.straight_load(at.pose) < kClearlyLess * blade::kEulerLoad;
    // Another arc has left it off its equilibrium by what sweeps leave.
    if (touch.bending > 0.0)
      found.bending = law.solve_near(at.pose, touch.slip, touch.bending).value_or(touch.bending);
    return found;
  }
  Bending lead(const Touch& touch) override {
    return {.argument = touch.straight ? kStraight : table(touch.blade).argument(touch.bending),
            .yielding = touch.yielding};
  }
  [[nodiscard]] BladeStart start(const Touch& touch, const TipPlace& at) const override {
    const contact::ElasticaContact& law = elastica(touch.blade);
    // g/Δ, or g/2R of a column that bends from above the ring, where g/Δ has no limit.
    const double measure = law.may_stand_straight()
                               ? at.pose.gap / (2.0 * law.geometry().ring_radius)
                               : law.gap_per_deflection(at.pose, touch.slip, touch.bending);
    BladeStart there = starts(touch, force(touch, at), measure);
    if (touch.skims) {
      there.start_gap_measure = touch.share + kShareBeyond;
      there.start_cone_left = 1.0 + kShareBeyond - touch.share;
    }
    if (!touch.straight) return there;
    // Of a column that has just straightened no load is left, to rounding.
    constexpr double kLeast = 1e-12;
    const double buckling = numbers(touch.blade).buckling_load;
    there.start_cone_left = std::max(buckling - there.at_start.normal, kLeast * buckling);
    return there;
  }
  [[nodiscard]] Tangent tangent(const Touch& touch, const TipPlace& at,
                                const std::complex<double>& /*acceleration*/) const override {
    if (touch.straight) return {1.0, 0.0, 0.0};
    const contact::ElasticaContact& law = elastica(touch.blade);
    const auto there = law.constraint(at.pose, touch.slip, touch.bending, at.speed);
    // dh = h_u du/dp dp + h_τ dτ
    const double slope = there.bending_slope * table(touch.blade).bending_slope_at(touch.bending);
    return {-slope, there.time_slope, 0.0};
  }
  [[nodiscard]] std::span<const blade::BendingTable::Knot> knots(int blade) const override {
    return table(blade).knots();
  }
  [[nodiscard]] double deflection_per_square(const Touch& touch) const override {
    constexpr double kUnbent = 0.01;  // p at which Δ ~ p² holds
    const contact::ElasticaContact& law = elastica(touch.blade);
    const double bending = table(touch.blade).bending(kUnbent);
    return law.length() * law.curve().at(bending).deflection / (kUnbent * kUnbent);
  }
  void set_course(const Touch& touch, const TipPlace& at, BladeStart& start) const override {
    const contact::ElasticaContact& law = elastica(touch.blade);
    if (touch.straight) {
      start.square = {start.start_gap_measure};
    } else if (touch.bending > 0.0) {
      start.square = square_of_bent(table(touch.blade).argument(touch.bending), tangent(touch, at, {}));
    } else {
      // Where the blade begins to bend, g = 2 s ct Δ, with Δ ~ p².
      const double rate = contact::gap_rate(law.geometry(), at.pose, at.speed) - start.ring_opens;
      const double gap_measure = law.gap_per_deflection(at.pose, touch.slip, 0.0);
      start.square.rate = rate / (gap_measure * deflection_per_square(touch));
    }
  }
  [[nodiscard]] bool solve(const Machine& machine, const Closeness& closeness,
                           Interval& interval) const override {
    return solver_.solve(machine, closeness, interval);
  }
  [[nodiscard]] Touch touch(const TipStart& tip, const Bending& bending) const override {
    return {.blade = tip.number,
            .slip = tip.slip,
            .bending = tip.straight ? 0.0 : table(tip.number).bending(bending.argument),
            .yielding = bending.yielding,
            .straight = tip.straight,
            .skims = tip.skims,
            .share = bending.share};
  }
  [[nodiscard]] contact::TipForce force(const Touch& touch, const TipPlace& at) const override {
    const contact::ElasticaContact& law = elastica(touch.blade);
    if (touch.straight) return law.straight_force(at.pose, touch.slip, at.speed);
    const contact::TipForce force = law.constraint(at.pose, touch.slip, touch.bending, at.speed).force;
    return touch.skims ? rotor::share_of(force, touch.share) : force;
  }
  [[nodiscard]] Rates rates(int blade, const Bending& bending, const Tangent& along) const override {
    return {along.argument * table(blade).bending_slope(bending.argument)};
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
};

/// In a ring without dampers. At a reset the root of h is looked for (MODEL 4.1 and 4.2).
class AxialLaw final : public LawOfBlades<AxialLaw, contact::ElasticaContact, ArcsOfAxialLoads> {
 public:
  explicit AxialLaw(Blades blades) : LawOfBlades(std::move(blades)) {
    for (int k = 0; k < count(); ++k) elastica_.push_back(&of(k));
  }

  [[nodiscard]] bool releases_at_fold(int blade) const override { return of(blade).releases_at_fold(); }
  /// A blade released at the fold returns from a finite distance, and the force of a compressed column starts
  /// from zero: neither hops without end.
  [[nodiscard]] bool may_skim() const override { return !releases_at_fold(0) && !may_stand_straight(0); }

  /// A contact opens on the approaching side from zero force, on the receding side from a finite one (MODEL
  /// 4.2).
  [[nodiscard]] bool open(const TipPlace& at, Touch& touch) const override {
    const auto& blade = of(touch.blade);
    if (at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose) &&
        blade.starts_unloaded(at.pose, touch.slip))
      return true;
    return takes(blade.solve(at.pose, touch.slip), touch);
  }
  [[nodiscard]] Standing keep(const TipPlace& at, Touch& touch) const override {
    const auto& blade = of(touch.blade);
    const bool outside = at.pose.gap <= 0.0;
    if (at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose) &&
        blade.ends_unloaded(at.pose, touch.slip, touch.bending)) {
      takes(0.0, touch);
      return outside ? Standing::free : Standing::stands;
    }
    if (outside && !blade.releases_at_fold()) return Standing::free;
    if (!(touch.bending > 0.0)) {
      if (takes(blade.solve(at.pose, touch.slip), touch)) return Standing::stands;
    } else {
      // On its branch, or on the next one where the change has taken it past the end.
      auto root = blade.solve_near(at.pose, touch.slip, touch.bending);
      if (!root && blade.has_branches()) root = blade.snap(at.pose, touch.slip, touch.bending, at.speed);
      if (takes(root, touch)) return Standing::stands;
    }
    return outside ? Standing::free : Standing::lost;
  }
  /// In the direction in which the blade moves. Where there is no next equilibrium, the blade is free if the
  /// ring opens and the undeformed tip is outside it.
  [[nodiscard]] Standing snap(const TipPlace& at, Touch& touch) const override {
    const auto& blade = of(touch.blade);
    touch.straight = false;
    if (takes(blade.snap(at.pose, touch.slip, touch.bending, at.speed), touch)) return Standing::stands;
    const bool free = at.pose.gap <= 0.0 && !blade.closes_in(at.pose, touch.slip, touch.bending, at.speed);
    return free ? Standing::free : Standing::lost;
  }
  [[nodiscard]] bool bend_anew(const TipPlace& at, Touch& touch) const override {
    takes(0.0, touch);
    return open(at, touch);
  }
  /// A column whose u has come to 0 while its tip is still in the ring (g > 0) stands straight from there on.
  [[nodiscard]] bool straightens(const TipPlace& at, Touch& touch) const override {
    const auto& blade = of(touch.blade);
    if (!blade.may_stand_straight() || at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose))
      return false;
    touch.bending = 0.0;
    touch.straight = true;
    return true;
  }
  bool respond(const TipPlace& at, Touch& touch, contact::TipForce& force) const override {
    return of(touch.blade).respond(at.pose, touch.slip, at.speed, touch.bending, force);
  }
  /// None for small slopes, and where axial compliance or a ring that yields gives way besides: there the
  /// place of the tip is not a function of κ and φ. Nor for blades that are released at the fold.
  [[nodiscard]] std::optional<contact::DirectedElastica> law_of_rest(int blade) const override {
    const contact::ElasticaContact& law = of(blade);
    if (law.curve().theory() != blade::Theory::elastica || law.has_branches() || law.releases_at_fold())
      return std::nullopt;
    const double friction = law.curve().friction();
    return contact::DirectedElastica(contact::LoadDirection::axial, law.geometry(), law.blade(),
                                     contact::Friction::sticking(friction, friction));
  }

 private:
  /// A blade that slips is bent by u alone: κ and φ of its tip at rest are past.
  static bool takes(const std::optional<double>& root, Touch& touch) {
    if (!root) return false;
    touch.bending = *root;
    touch.bend = {};
    return true;
  }
};

}  // namespace rubatlas::collocation
