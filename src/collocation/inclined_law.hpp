/// Elastic blades under an inclined load, with any friction law. They have two unknowns, κ and φ, and the arc
/// that begins finds both where a contact opens.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "collocation/inclined_load.hpp"
#include "collocation/law.hpp"
#include "contact/directed_elastica.hpp"

namespace rubatlas::collocation {

class InclinedLaw final : public LawOfBlades<InclinedLaw, contact::DirectedElastica> {
 public:
  /// `rests_at_once`: a tip that can rest does so where its slip velocity comes to zero, else only where its
  /// reversals accumulate (MODEL 4.4).
  explicit InclinedLaw(Blades blades, bool rests_at_once = true)
      : LawOfBlades(std::move(blades)), rests_at_once_(rests_at_once) {
    leans_ = true;
    const InclinedLoad load{.along_normal = of(0).direction() == contact::LoadDirection::normal,
                            .friction = friction_};
    loads_.assign(static_cast<std::size_t>(count()), load);
  }

  [[nodiscard]] Blade numbers(int blade) const override {
    const auto& law = of(blade);
    return {.reach = law.geometry().reach,
            .closing = law.geometry().closing(),
            .length = law.length(),
            .load_unit = law.load_unit(),
            .strain_unit = law.strain_unit()};
  }
  [[nodiscard]] bool may_slip_back() const override { return has_slip_state() && !sticks(); }
  [[nodiscard]] bool sticks() const override { return friction_.sticks && rests_at_once_; }
  [[nodiscard]] bool has_branches(int /*blade*/) const override { return has_branches_; }
  [[nodiscard]] bool starts_unloaded(int blade, double /*slip*/, const contact::Pose& at) const override {
    return load_of(blade).side * at.tangential > 0.0;
  }
  [[nodiscard]] std::optional<Touch> in_equilibrium(const Touch& touch, const TipPlace& at) const override {
    const auto& law = of(touch.blade);
    Touch opened = touch;
    if (touch.slip == 0.0) {
      const auto rest = law.rest(at.pose, at.speed, touch.bend);
      if (!rest || !(rest->firmness > contact::kLeastFirmness)) return std::nullopt;
      opened.bend = rest->bend;
      goes_on(law, at, opened, kNear);  // to rounding
      return opened;
    }
    if (goes_on(law, at, opened, kNear)) return opened;
    if (touch.bend.modulus == 0.0) {
      if (law.opens_unbent(at.pose, touch.slip, at.speed)) {
        opened.bend = {std::sin(0.5 * law.first_load_angle(at.pose, touch.slip, at.speed)), 0.0};
        return opened;
      }
      if (opens_under_load(law, at, opened)) return opened;
    }
    contact::TipForce force{};
    if (!law.respond(at.pose, touch.slip, at.speed, opened.bend, force)) return std::nullopt;
    return opened;
  }
  void take(const Touch& touch) override {
    InclinedLoad& load = loads_[static_cast<std::size_t>(touch.blade)];
    load.rests = touch.slip == 0.0;
    load.side = side(touch);
    load.scale = std::max(2.0 * std::abs(lean_of(touch.bend)), InclinedLoad::kLeastScale);
  }
  Bending lead(const Touch& touch) override {
    const InclinedLoad& load = load_of(touch.blade);
    // A blade that an axial load bends the way friction pushes has no fold (MODEL 4.2).
    has_branches_ =
        load.along_normal || load.rests || !load.friction.has_slip_state() || load.side * touch.slip < 0.0;
    const double lean = lean_of(touch.bend);
    if (touch.touches_down()) set_knots(load, lean);
    return {argument_of(touch), lean};
  }
  [[nodiscard]] double side(const Touch& touch) const override {
    return std::copysign(1.0, touch.bend.modulus);
  }
  [[nodiscard]] BladeStart start(const Touch& touch, const TipPlace& at) const override {
    const auto& law = of(touch.blade);
    const auto there = law.constraint(at.pose, touch.slip, at.speed, touch.bend);
    // g/|D|, as h = 0 has it.
    const double deflection = std::abs(there.blade.deflection.value);
    const double share = deflection > kUnbent ? there.blade.shortening.value / deflection : 0.0;
    const double measure = 2.0 * side(touch) * there.tip.across + law.length() * deflection +
                           share * (2.0 * there.tip.along + law.length() * there.blade.shortening.value);
    BladeStart start = starts(touch, law.force_of(at.pose, at.speed, there), measure);
    start.load = &load_of(touch.blade);
    start.start_lean = lean_of(touch.bend);
    start.start_chart_left = start.load->chart_left(bending_of(touch.bend), start.start_lean);
    start.start_cone_left = start.load->cone() - there.coefficient * there.coefficient;
    return start;
  }
  [[nodiscard]] Tangent tangent(const Touch& touch, const TipPlace& at,
                                const std::complex<double>& acceleration) const override {
    const auto& law = of(touch.blade);
    const auto there = law.constraint(at.pose, touch.slip, at.speed, touch.bend);
    const auto [modulus, amplitude] = there.against(
        law.drift(at.pose, touch.slip, at.speed, {acceleration.real(), acceleration.imag()}, there));
    const double time = there.determinant();
    const double onwards = touch.slip == 0.0 ? std::copysign(1.0, time) : 1.0;
    const double sine = std::sin(touch.bend.amplitude);
    const double cosine = std::cos(touch.bend.amplitude);
    const double bending = side(touch) * (modulus * sine + touch.bend.modulus * cosine * amplitude);
    const double lean = side(touch) * (modulus * cosine - touch.bend.modulus * sine * amplitude);
    const double argument = argument_of(touch);
    const double slope = load_of(touch.blade).bending_slope(argument * argument);
    return {onwards * time, onwards * bending / slope, onwards * lean};
  }
  [[nodiscard]] std::span<const blade::BendingTable::Knot> knots(int /*blade*/) const override {
    return knots_;
  }
  [[nodiscard]] double deflection_per_square(const Touch& touch) const override {
    return of(touch.blade).length() * load_of(touch.blade).deflection_per_square(lean_of(touch.bend));
  }
  void set_course(const Touch& touch, const TipPlace& at, BladeStart& start) const override {
    const double argument = argument_of(touch);
    start.lean.value = start.start_lean;
    if (argument > 0.0) {
      const Tangent along = tangent(touch, at, {});
      start.square = square_of_bent(argument, along);
      start.lean.rate = along.lean / along.time;
    } else {
      // Where the blade begins to bend, g = (g/|D|) |D|, with |D| ~ p².
      const auto& law = of(touch.blade);
      start.square.rate =
          contact::gap_rate(law.geometry(), at.pose, at.speed) /
          (start.start_gap_measure * law.length() * start.load->deflection_per_square(start.start_lean));
    }
  }
  [[nodiscard]] bool solve(const Machine& machine, const Closeness& closeness,
                           Interval& interval) const override {
    return solver_.solve_inclined(machine, closeness, interval);
  }
  [[nodiscard]] Touch touch(const TipStart& tip, const Bending& bending) const override {
    return {tip.number, tip.slip, 0.0, bend_of(load_of(tip.number), bending)};
  }
  [[nodiscard]] contact::TipForce force(const Touch& touch, const TipPlace& at) const override {
    const auto& law = of(touch.blade);
    return law.force_of(at.pose, at.speed, law.constraint(at.pose, touch.slip, at.speed, touch.bend));
  }
  [[nodiscard]] Rates rates(int blade, const Bending& bending, const Tangent& along) const override {
    const InclinedLoad& load = load_of(blade);
    const double u = load.bending(bending.argument);
    const double rate = along.argument * load.bending_slope(bending.argument * bending.argument);
    const double square = u * u + bending.lean * bending.lean;
    return {0.0, load.side * (u * rate + bending.lean * along.lean) / std::sqrt(square),
            (bending.lean * rate - u * along.lean) / square};
  }

  /// Snaps to another equilibrium on the side to which the blade is bent, or, where there is none, to one on
  /// the other side.
  [[nodiscard]] Standing snap(const TipPlace& at, Touch& touch) const override {
    constexpr double kSame = 1e-3;  // of κ: a root so close to the fold is the one that ends there
    const auto& law = of(touch.blade);
    const double modulus = touch.bend.modulus;
    const double side = std::copysign(1.0, modulus);
    auto root = law.solve(at.pose, touch.slip, at.speed, side);
    if (root && std::abs(root->modulus - modulus) < kSame * std::abs(modulus)) root = std::nullopt;
    if (!root) root = law.solve(at.pose, touch.slip, at.speed, -side);
    if (!root) return Standing::lost;
    touch.bend = *root;
    return Standing::stands;
  }
  bool respond(const TipPlace& at, Touch& touch, contact::TipForce& force) const override {
    return of(touch.blade).respond(at.pose, touch.slip, at.speed, touch.bend, force);
  }
  /// None where friction depends on the slip velocity, or tips stick anyway.
  [[nodiscard]] std::optional<contact::DirectedElastica> law_of_rest(int blade) const override {
    if (!has_slip_state() || friction_.sticks) return std::nullopt;
    return of(blade).with_friction(contact::Friction::sticking(friction_.friction, friction_.friction));
  }

 private:
  [[nodiscard]] double holding(const Touch& touch, const contact::Pose& at) const override {
    return of(touch.blade).constraint(at, touch.slip, 0.0, touch.bend).coefficient;
  }

  static constexpr double kNear = 1e-3;    ///< of κ and φ: a bend that goes on differs by less
  static constexpr double kUnbent = 1e-9;  ///< of D/L: below it δ/D is less than rounding

  /// A new contact whose blade is bent at once (MODEL 4.2): looks for the first root of h along the
  /// equilibria from the unbent blade on, as `DirectedElastica::solve` does, in eight steps at once. False
  /// where it is not found so.
  bool opens_under_load(const contact::DirectedElastica& law, const TipPlace& at, Touch& touch) const {
    constexpr double kLeastLean = 1e-3;
    constexpr std::array kReaches{0.1, 0.25, 0.62};  // u up to which steps reach, one time after the other
    constexpr int kRefinements = 2;
    constexpr double kFound = 0.05;  // of κ and φ: what those leave
    const double first = law.first_load_angle(at.pose, touch.slip, at.speed);
    const double lean = std::abs(std::sin(0.5 * first));
    if (lean < kLeastLean) return false;
    InclinedLoad load = load_of(touch.blade);
    load.rests = false;
    load.side = std::copysign(1.0, first);
    load.scale = 2.0 * lean;
    const Blade blade = numbers(touch.blade);
    const TipStart tip{.blade = &blade, .load = &load, .slip = touch.slip};
    BranchPoints points;
    points.lean.value.fill(lean);
    double from = 0.0;
    double to = 0.0;
    // Of the eight, the first where h is no longer positive; kNodes: none.
    std::size_t beyond = kNodes;
    const auto look = [&] {
      for (std::size_t i = 0; i < kNodes; ++i)
        points.argument[i] = from + (to - from) * static_cast<double>(i + 1) / kNodes;
      if (!solver_.inclined_branch(tip, law.geometry().ring_radius, at.pose, at.speed, points)) return false;
      const auto& h = points.residual.value;
      beyond = static_cast<std::size_t>(std::ranges::find_if(h, [](double there) { return !(there > 0.0); }) -
                                        h.begin());
      return true;
    };
    for (std::size_t i = 0; i < kReaches.size() && beyond == kNodes; ++i) {
      from = to;
      to = load.argument(kReaches[i]);
      if (!look()) return false;
      if (beyond == 0 && i == 0) return false;
      points.lean.value.fill(points.lean[std::min(beyond, kNodes - 1)]);
    }
    if (beyond == kNodes) return false;
    for (int i = 0; i < kRefinements; ++i) {
      to = points.argument[beyond];
      if (beyond > 0) from = points.argument[beyond - 1];
      if (!look() || beyond == kNodes) return false;
      points.lean.value.fill(points.lean[beyond]);
    }
    touch.bend = bend_of(load, {points.argument[beyond], points.lean[0]});
    return goes_on(law, at, touch, kFound) &&
           law.constraint(at.pose, touch.slip, at.speed, touch.bend).determinant() > 0.0;
  }
  /// Moves a contact onto its equilibrium if that is as near to its bend as said.
  static bool goes_on(const contact::DirectedElastica& law, const TipPlace& at, Touch& touch, double near) {
    constexpr int kSteps = 4;
    constexpr double kHere = 1e-9;  // Newton's next step is below rounding
    if (touch.bend.modulus == 0.0 || !(touch.bend.amplitude > 0.0)) return false;
    blade::Bend bend = touch.bend;
    for (int i = 0; i < kSteps; ++i) {
      const blade::Bend change = law.constraint(at.pose, touch.slip, at.speed, bend).correction();
      const double size =
          std::max(std::abs(change.modulus / bend.modulus), std::abs(change.amplitude / bend.amplitude));
      if (!(size < near)) return false;
      bend = {bend.modulus + change.modulus, bend.amplitude + change.amplitude};
      if (size < kHere) break;
    }
    touch.bend = bend;
    return true;
  }

  [[nodiscard]] const InclinedLoad& load_of(int blade) const {
    return loads_[static_cast<std::size_t>(blade)];
  }
  /// p.
  [[nodiscard]] double argument_of(const Touch& touch) const {
    return load_of(touch.blade).argument(bending_of(touch.bend));
  }
  static blade::Bend bend_of(const InclinedLoad& load, const Bending& bending) {
    const double u = load.bending(bending.argument);
    return {load.side * std::hypot(u, bending.lean), std::atan2(u, bending.lean)};
  }
  static double bending_of(const blade::Bend& bend) {
    return std::abs(bend.modulus) * std::sin(bend.amplitude);
  }
  static double lean_of(const blade::Bend& bend) { return std::abs(bend.modulus) * std::cos(bend.amplitude); }

  /// As for small deflections, with the lean as it is: q = φ, D/L = 2 (u/φ − l), and a shortening as of a
  /// quarter of a sine.
  void set_knots(const InclinedLoad& load, double lean) {
    constexpr double kShortening = 0.617;  // π²/16
    for (std::size_t i = 0; i < knots_.size(); ++i) {
      const double argument = kKnotWidth * static_cast<double>(i + 1);
      const double bending = load.bending(argument);
      const double amplitude = std::atan2(bending, lean);
      const double deflection = std::max(2.0 * (bending / amplitude - lean), 0.0);
      knots_[i] = {argument, amplitude * amplitude, kShortening * deflection * deflection, deflection};
    }
  }

  bool rests_at_once_;
  std::vector<InclinedLoad> loads_;  ///< of each blade, as it last began or went on
  bool has_branches_ = true;         ///< of the leading blade
  static constexpr double kKnotWidth = 0.25;
  static constexpr std::size_t kKnots = 14;
  std::array<blade::BendingTable::Knot, kKnots> knots_{};
};

}  // namespace rubatlas::collocation
