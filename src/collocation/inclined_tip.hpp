/// A blade under an inclined load (`inclined_load.hpp`) at eight nodes: how it is bent, and both equations of
/// its tip, h = 0 (MODEL 4.1) and the direction of the load,
///     e = sin(b − [α] − atan c) (1 + c²)^½ = Y − c X = 0,
/// with X, Y = cos b, sin b, or along the normal X = a cos b + β sin b, Y = a sin b − β cos b over R, where
/// (a, β) is the tip against the ring's centre along and across the blade.
#pragma once

#include <cstddef>

#include "collocation/even_rules.hpp"
#include "collocation/inclined_load.hpp"
#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"
#include "contact/tip.hpp"

namespace rubatlas::collocation {
namespace {

/// A bent blade at eight nodes: integrals over its length as in `blade/inclined_elastica.cpp`, over z of
/// `BladeRule` in place of φ', so that no angle is needed, by an even rule.
template <std::size_t kWidth>
struct InclinedBlade {
  using Number = Lanes<kWidth>;
  struct WithSlopes {
    Number value, by_bending, by_lean;  ///< slopes by u and l
  };
  WithSlopes load;                    ///< P L²/EI = q²
  WithSlopes shortening, deflection;  ///< δ/L and |D|/L
  Number cosine;                      ///< cos(b/2)

  /// Sets the values, and with `kSlopes` the slopes. False where no rule is accurate enough.
  template <bool kSlopes>
  bool set(const Number& bending, const Number& lean, BladeRule& rule) {
    const Number square = bending * bending;
    const Number modulus = root(square + lean * lean);
    const Number inverse_modulus = Number(1.0) / modulus;
    // Of the two forms of tan(φ/4) and of 1 − cos φ each is the one in which nothing cancels.
    const Number upright = with_sign_of(Number(0.5), lean) + 0.5;  // 1 where l >= 0, else 0
    const Number leaning = Number(1.0) - upright;
    const Number sum = modulus + magnitude(lean);
    const Number tangent = (upright * bending + leaning * sum) /
                           ((upright * sum + leaning * bending) + root(sum * sum + square));
    if (kSlopes) {
      rule = blade_rule(modulus.largest(), magnitude(tangent).largest());
    }
    if (rule.rule == nullptr) return false;
    const EvenRule& points = *rule.rule;
    const double twice_quarter = 2.0 * rule.quarter;
    cosine = root(Number(1.0) - lean * lean);
    const Number versed_at_clamp = (upright * (square / sum) + leaning * sum) * inverse_modulus;
    // z at the clamp.
    const Number largest = tangent / (root(tangent * tangent + rule.quarter * rule.quarter) + rule.quarter);
    const Number largest_square = largest * largest;
    const Number per_cosine = Number(2.0) / cosine;
    Number arcs(0.0), shortenings(0.0), deflections(0.0);
    Number arc_slopes(0.0), shortening_slopes(0.0), deflection_slopes(0.0);
    for (std::size_t i = 0; i < points.count; ++i) {
      const Number place = largest_square * points.square[i];  // z²
      const Number away = Number(1.0) - place;
      const Number denominator = away * away;  // of tan²(φ'/4)
      const Number numerator = place * (twice_quarter * twice_quarter);
      const Number per = Number(1.0) / (denominator + numerator);
      const Number versed = (numerator * per) * (denominator * per) * 8.0;  // 1 − cos φ'
      const Number sine_psi = modulus - modulus * versed;
      const Number cosine_psi = root(Number(1.0) - sine_psi * sine_psi);
      const Number both = cosine_psi + cosine;
      const Number inverse_both = Number(1.0) / (cosine_psi * both);
      const Number inverse = inverse_both * both;  // 1/cos(ψ/2)
      const Number measure = (place + 1.0) * per * inverse * points.weight[i];
      const Number half_cosine = cosine * cosine_psi + lean * sine_psi;  // cos(θ/2)
      const Number share = (versed_at_clamp - versed) * (half_cosine + 1.0) * (inverse_both * cosine_psi);
      const Number half_sine = modulus * share;  // sin(θ/2)
      const Number twice = half_sine * 2.0;
      const Number sine_theta = twice * half_cosine;
      const Number versed_theta = twice * half_sine;
      arcs = arcs + measure;
      shortenings = shortenings + measure * versed_theta;
      deflections = deflections + measure * sine_theta;
      if (kSlopes) {
        // By κ at fixed φ'.
        const Number theta_slope = per_cosine * share * inverse * measure;
        const Number tangent_psi = sine_psi * inverse;
        const Number measure_slope = tangent_psi * tangent_psi * measure;  // times κ
        arc_slopes = arc_slopes + measure_slope;
        shortening_slopes =
            shortening_slopes + (sine_theta * theta_slope * modulus + measure_slope * versed_theta);
        deflection_slopes = deflection_slopes + ((theta_slope - versed_theta * theta_slope) * modulus +
                                                 measure_slope * sine_theta);
      }
    }
    const Number per_arc = Number(1.0) / arcs;
    const Number arc = largest * (4.0 * twice_quarter) * arcs;  // q
    load.value = arc * arc;
    shortening.value = shortenings * per_arc;
    deflection.value = deflections * per_arc;
    if (kSlopes) {
      // κ ∂/∂κ and ∂/∂φ, of which those by u and l are made.
      const Number growth = Number(1.0) / cosine;  // dq/dφ
      const Number load_by_modulus = load.value * 2.0 * (arc_slopes * per_arc);
      const Number load_by_amplitude = arc * 2.0 * growth;
      const Number shortening_by_modulus = (shortening_slopes - shortening.value * arc_slopes) * per_arc;
      const Number deflection_by_modulus = (deflection_slopes - deflection.value * arc_slopes) * per_arc;
      const Number turn = bending * per_cosine;  // −db/dφ
      constexpr double kLeastArc = 1e-200;       // of a straight blade the quotients vanish
      const Number growth_per_arc = growth * arc / (load.value + kLeastArc);
      const Number shortening_by_amplitude = turn * deflection.value - growth_per_arc * shortening.value;
      const Number deflection_by_amplitude =
          turn * (Number(1.0) - shortening.value) - growth_per_arc * deflection.value;
      const Number per_square = inverse_modulus * inverse_modulus;
      const Number along = bending * per_square;
      const Number across = lean * per_square;
      const auto set_slopes = [&](WithSlopes& of, const Number& by_modulus, const Number& by_amplitude) {
        of.by_bending = by_modulus * along + by_amplitude * across;
        of.by_lean = by_modulus * across - by_amplitude * along;
      };
      set_slopes(load, load_by_modulus, load_by_amplitude);
      set_slopes(shortening, shortening_by_modulus, shortening_by_amplitude);
      set_slopes(deflection, deflection_by_modulus, deflection_by_amplitude);
    }
    return true;
  }
};

/// u of p, of which the square is known.
template <std::size_t kWidth>
Lanes<kWidth> bending_of(const InclinedLoad& load, const Lanes<kWidth>& argument,
                         const Lanes<kWidth>& square) {
  return argument *
         ((((square * (1.0 / 362880) + 1.0 / 5040) * square + 1.0 / 120) * square + 1.0 / 6) * square + 1.0) *
         load.scale;
}

/// A blade's tip where it stands at eight nodes, with both equations and their slopes by u and l.
template <std::size_t kWidth>
class InclinedTip {
 public:
  using Number = Lanes<kWidth>;
  using Pose = contact::PoseOf<Number>;
  using InBlade = contact::BladeVector<Number>;

  const TipStart& start;
  InclinedBlade<kWidth> blade;
  Number bending, lean;  ///< u, l
  Number load;           ///< P L²/EI
  InBlade bent;          ///< (δ, D) [m]
  InBlade place, rate;   ///< of the tip from the ring's centre [m], and by τ at this bend
  Number coefficient;    ///< c
  Number h, e;
  // Slopes.
  InBlade place_by_bending, place_by_lean;
  Number h_by_bending, h_by_lean, e_by_bending, e_by_lean;

  InclinedTip(const TipStart& tip, double ring_radius) : start(tip), ring_radius_(ring_radius) {}

  /// False where there is no such blade. The quadrature is chosen with the slopes, and kept. `speed`: φ'.
  template <bool kSlopes>
  bool stand(const Number& bending_there, const Number& lean_there, const Pose& at, const Number& speed) {
    const Blade& c = *start.blade;
    const InclinedLoad& inclined = *start.load;
    bending = bending_there;
    lean = lean_there;
    if (!blade.template set<kSlopes>(bending, lean, rule_)) return false;
    load = blade.load.value;
    const double across_length = inclined.side * c.length;
    const InBlade unbent{at.radial + c.reach, at.tangential};
    bent = {blade.shortening.value * c.length, blade.deflection.value * across_length};
    h = contact::contact_equation(at.gap, unbent, bent);
    place = unbent - bent;
    rate = contact::tip_rate(at, speed);
    const double radius = ring_radius_;
    const double per_radius = 1.0 / radius;
    const Number slip_velocity = contact::slip_velocity(place, rate, speed, per_radius, radius);
    const bool rests = inclined.rests;
    const contact::Friction::At<Number> friction =
        rests ? contact::Friction::At<Number>{Number(0.0), Number(0.0)}
              : inclined.friction.at(slip_velocity, start.slip);
    coefficient = friction.coefficient;
    direction_ = direction_at(lean, blade.cosine);
    const double unit = inclined.along_normal ? per_radius : 1.0;
    const InBlade pressing = against_ring(direction_) * unit;  // X, Y
    e = pressing.across - coefficient * pressing.along;
    const double per_speed = -1.0 / radius;  // a length: v over it is as large as an angle's rate
    if (rests) {
      coefficient = pressing.across / pressing.along;
      e = slip_velocity * per_speed;
    }
    if (kSlopes) {
      place_by_bending = {blade.shortening.by_bending * -c.length,
                          blade.deflection.by_bending * -across_length};
      place_by_lean = {blade.shortening.by_lean * -c.length, blade.deflection.by_lean * -across_length};
      h_by_bending = contact::square_change(place, place_by_bending);
      h_by_lean = contact::square_change(place, place_by_lean);
      e_by_velocity_ = rests ? Number(per_speed * per_radius) : friction.slope * pressing.along * -per_radius;
      // By the place of the tip, on which v depends, too.
      InBlade by_place = InBlade{rate.across, rate.along * -1.0} * e_by_velocity_;
      if (turns_with_normal()) by_place = by_place + turn_of_normal() * per_radius;
      e_by_bending = dot(by_place, place_by_bending);
      e_by_lean = dot(by_place, place_by_lean);
      if (!rests) {
        const InBlade turns = against_ring(direction_by_lean());
        e_by_lean = (turns.across - coefficient * turns.along) * unit + e_by_lean;
      }
    }
    return true;
  }

  /// dh/dτ and de/dτ at this bend and at constant speed. `acceleration`: z''.
  Number h_rate() const { return contact::square_change(place, rate); }
  Number e_rate(const Pose& at, const Number& speed, const InBlade& acceleration) const {
    Number result =
        e_by_velocity_ * contact::cross(place, contact::tip_acceleration(at, speed, acceleration));
    if (turns_with_normal()) result = result + dot(turn_of_normal(), rate) * (1.0 / ring_radius_);
    return result;
  }

  /// What acts on the shaft where tip and blade move on by steps in u, l and τ, as an acceleration.
  InBlade move_on(const Number& bending_step, const Number& lean_step, const Number& time_step,
                  double force_unit) {
    const InBlade step = place_by_bending * bending_step + place_by_lean * lean_step;
    place = place + (rate * time_step + step);
    bent = bent - step;
    bending = bending + bending_step;
    lean = lean + lean_step;
    load = load + (blade.load.by_bending * bending_step + blade.load.by_lean * lean_step);
    const InBlade direction = direction_at(lean, root(Number(1.0) - lean * lean));
    if (start.load->rests) {  // what holds it there
      const InBlade pressing = against_ring(direction);
      coefficient = pressing.across / pressing.along;
    }
    const Number push = load * (-start.blade->load_unit * force_unit);
    return (start.load->along_normal ? direction : turned(place, direction)) * push;
  }

  /// How the push changes with the slip velocity where the shaft stands: the bend follows e, at h = 0. To be
  /// asked for after `move_on`.
  InBlade push_by_slip(double force_unit) const {
    const Number inverse = e_by_velocity() / (h_by_bending * e_by_lean - h_by_lean * e_by_bending);
    const Number bending_rate = h_by_lean * inverse;
    const Number lean_rate = h_by_bending * inverse * -1.0;
    const Number load_rate = blade.load.by_bending * bending_rate + blade.load.by_lean * lean_rate;
    InBlade direction = direction_;
    InBlade turn = direction_by_lean() * lean_rate;
    if (!start.load->along_normal) {
      const InBlade moved = place_by_bending * bending_rate + place_by_lean * lean_rate;
      turn = turned(place, turn) + turned(moved, direction);
      direction = turned(place, direction);
    }
    const double unit = -start.blade->load_unit * force_unit;
    return (direction * load_rate + turn * load) * unit;
  }

  /// What an interval keeps of the tip, but for what has to do with velocities.
  void store(TipInTime& kept) const {
    lean.store(kept.lean);
    (bent.along * (1.0 / start.blade->length)).store(kept.shortening);
    (Number(start.load->cone()) - coefficient * coefficient).store(kept.cone_left);
    start.load->chart_left(bending, lean).store(kept.chart_left);
    (load * start.blade->load_unit / root(coefficient * coefficient + 1.0)).store(kept.normal_force);
    (bending * (2.0 * start.blade->strain_unit) * root(larger(load, Number(0.0)))).store(kept.root_strain);
  }

  /// ∂e/∂v.
  [[nodiscard]] Number e_by_velocity() const { return e_by_velocity_ * ring_radius_; }

 private:
  /// (cos b, sin b) of a load that leans so; `half_cosine`: cos(b/2).
  InBlade direction_at(const Number& lean_there, const Number& half_cosine) const {
    return {Number(1.0) - lean_there * lean_there * 2.0, lean_there * half_cosine * (2.0 * start.load->side)};
  }
  InBlade direction_by_lean() const {
    return {lean * -4.0, direction_.along / blade.cosine * (2.0 * start.load->side)};
  }
  /// A direction of the load against that in which the ring presses, times R where that is the normal.
  InBlade against_ring(const InBlade& direction) const {
    if (!start.load->along_normal) return direction;
    return {dot(place, direction), cross(place, direction)};
  }
  /// Whether the direction that is asked of the load turns with the place of the tip.
  [[nodiscard]] bool turns_with_normal() const { return start.load->along_normal && !start.load->rests; }
  /// What e changes by with the place of the tip, times R, as the normal turns.
  InBlade turn_of_normal() const {
    const auto& [cosine, sine] = direction_;
    return {sine - coefficient * cosine, (cosine + coefficient * sine) * -1.0};
  }
  /// A vector that is turned as the place of the tip is from the blade, at the ring's radius.
  InBlade turned(const InBlade& at, const InBlade& vector) const {
    return InBlade{at.along * vector.along - at.across * vector.across,
                   at.across * vector.along + at.along * vector.across} *
           (1.0 / ring_radius_);
  }

  double ring_radius_;
  BladeRule rule_;
  InBlade direction_;     ///< of the load, at b
  Number e_by_velocity_;  ///< over R
};

}  // namespace
}  // namespace rubatlas::collocation
