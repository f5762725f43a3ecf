/// A blade under an inclined load (`inclined_load.hpp`) at eight nodes: how it is bent, and both equations of
/// its tip, h = 0 (MODEL 4.1) and the direction of the load,
///     e = sin(b − [α] − atan c) (1 + c²)^½ = Y − c X = 0,
/// with X, Y = cos b, sin b, or along the normal X = a cos b + β sin b, Y = a sin b − β cos b over R, where
/// (a, β) is the tip against the ring's centre along and across the blade.
#pragma once

#include <cstddef>

#include "collocation/even_rules.hpp"
#include "collocation/friction_in_lanes.hpp"
#include "collocation/inclined_load.hpp"
#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"

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
  Number arc;                         ///< q
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
    arc = largest * (4.0 * twice_quarter) * arcs;
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

/// The shaft seen from the blade at eight nodes (`contact::Pose`).
template <std::size_t kWidth>
struct InclinedPose {
  Lanes<kWidth> gap, radial, tangential, radial_velocity, tangential_velocity;
  Lanes<kWidth> angular_speed;  ///< φ'
};

/// A blade's tip where it stands at eight nodes, with both equations and their slopes by u and l.
template <std::size_t kWidth>
class InclinedTip {
 public:
  using Number = Lanes<kWidth>;
  using Pose = InclinedPose<kWidth>;

  InclinedBlade<kWidth> blade;
  Number bending, lean;           ///< u, l
  Number load;                    ///< P L²/EI
  Number shortening, deflection;  ///< δ and D [m]
  Number a, b;                    ///< of the tip against the ring's centre in (er, et) [m]
  Number a_rate, b_rate;          ///< by τ, of a blade that does not bend
  Number slip_velocity;           ///< v
  Number coefficient;             ///< c
  Number h, e;
  // Slopes.
  Number a_by_bending, a_by_lean, b_by_bending, b_by_lean;
  Number h_by_bending, h_by_lean, e_by_bending, e_by_lean;

  InclinedTip() = default;
  /// `inclined` and what `contact` points to outlive it.
  InclinedTip(const Contact& contact, const InclinedLoad& inclined)
      : blade_(contact.blade),
        load_(&inclined),
        slip_(contact.slip),
        ring_radius_(contact.machine->ring_radius) {}

  /// False where there is no such blade. The quadrature is chosen with the slopes, and kept.
  template <bool kSlopes>
  bool stand(const Number& bending_there, const Number& lean_there, const Pose& at) {
    const Blade& c = *blade_;
    bending = bending_there;
    lean = lean_there;
    if (!blade.template set<kSlopes>(bending, lean, rule_)) return false;
    load = blade.load.value;
    const double across_length = load_->side * c.length;
    shortening = blade.shortening.value * c.length;
    deflection = blade.deflection.value * across_length;
    const Number reach = at.radial + c.reach;
    h = at.gap + (shortening * (shortening - reach * 2.0) + deflection * (deflection - at.tangential * 2.0));
    a = reach - shortening;
    b = at.tangential - deflection;
    const Number along = at.radial_velocity + at.tangential * at.angular_speed;
    const Number across = at.tangential_velocity - at.radial * at.angular_speed;
    const double radius = ring_radius_;
    const double per_radius = 1.0 / radius;
    slip_velocity = (a * across - b * along) * per_radius + at.angular_speed * radius;
    const bool rests = load_->rests;
    const FrictionAtNodes<kWidth> friction = rests ? FrictionAtNodes<kWidth>{Number(0.0), Number(0.0)}
                                                   : friction_at(load_->friction, slip_, slip_velocity);
    coefficient = friction.coefficient;
    cosine_ = Number(1.0) - lean * lean * 2.0;
    sine_ = lean * blade.cosine * (2.0 * load_->side);
    direction_x_ = cosine_;
    Number direction_y = sine_;
    if (load_->along_normal) {
      direction_x_ = (a * cosine_ + b * sine_) * per_radius;
      direction_y = (a * sine_ - b * cosine_) * per_radius;
    }
    e = direction_y - coefficient * direction_x_;
    const double per_speed = -1.0 / radius;  // a length: v over it is as large as an angle's rate
    if (rests) {
      coefficient = direction_y / direction_x_;
      e = slip_velocity * per_speed;
    }
    if (kSlopes) {
      a_by_bending = blade.shortening.by_bending * -c.length;
      a_by_lean = blade.shortening.by_lean * -c.length;
      b_by_bending = blade.deflection.by_bending * -across_length;
      b_by_lean = blade.deflection.by_lean * -across_length;
      a_rate = along;
      b_rate = across;
      h_by_bending = (a * a_by_bending + b * b_by_bending) * 2.0;
      h_by_lean = (a * a_by_lean + b * b_by_lean) * 2.0;
      const Number cosine_by_lean = lean * -4.0;
      const Number sine_by_lean = cosine_ / blade.cosine * (2.0 * load_->side);
      e_by_velocity_ = rests ? Number(per_speed * per_radius) : friction.slope * direction_x_ * -per_radius;
      // By its parts: l, (a, β), of which v depends on (a, β), too.
      Number by_lean = sine_by_lean - coefficient * cosine_by_lean;
      Number by_a = e_by_velocity_ * across;
      Number by_b = e_by_velocity_ * along * -1.0;
      if (rests) {
        by_lean = Number(0.0);
      } else if (load_->along_normal) {
        by_lean = ((a * sine_by_lean - b * cosine_by_lean) -
                   coefficient * (a * cosine_by_lean + b * sine_by_lean)) *
                  per_radius;
        by_a = by_a + (sine_ - coefficient * cosine_) * per_radius;
        by_b = by_b - (cosine_ + coefficient * sine_) * per_radius;
      }
      e_by_bending = by_a * a_by_bending + by_b * b_by_bending;
      e_by_lean = by_lean + (by_a * a_by_lean + by_b * b_by_lean);
    }
    return true;
  }

  /// dh/dτ and de/dτ of a blade that does not bend, at constant speed. `ax`, `ay`: z'' along and across it.
  Number h_rate() const { return (a * a_rate + b * b_rate) * 2.0; }
  Number e_rate(const Pose& at, const Number& ax, const Number& ay) const {
    const Number& speed = at.angular_speed;
    const Number along_rate = ax + (at.tangential_velocity * 2.0 - at.radial * speed) * speed;
    const Number across_rate = ay - (at.radial_velocity * 2.0 + at.tangential * speed) * speed;
    Number rate = e_by_velocity_ * (a * across_rate - b * along_rate);
    if (load_->along_normal && !load_->rests) {
      rate = rate + ((sine_ - coefficient * cosine_) * a_rate - (cosine_ + coefficient * sine_) * b_rate) *
                        (1.0 / ring_radius_);
    }
    return rate;
  }

  /// What acts on the shaft where tip and blade move on by steps in u, l and τ, as an acceleration along and
  /// across the blade.
  struct Push {
    Number along, across;
  };
  Push move_on(const Number& bending_step, const Number& lean_step, const Number& time_step,
               double force_unit) {
    const Number a_step = a_by_bending * bending_step + a_by_lean * lean_step;
    const Number b_step = b_by_bending * bending_step + b_by_lean * lean_step;
    a = a + (a_rate * time_step + a_step);
    b = b + (b_rate * time_step + b_step);
    shortening = shortening - a_step;
    deflection = deflection - b_step;
    bending = bending + bending_step;
    lean = lean + lean_step;
    load = load + (blade.load.by_bending * bending_step + blade.load.by_lean * lean_step);
    const Number push = load * (-blade_->load_unit * force_unit);
    const Number cosine = Number(1.0) - lean * lean * 2.0;
    const Number sine = lean * root(Number(1.0) - lean * lean) * (2.0 * load_->side);
    if (load_->rests) {  // what holds it there
      coefficient = load_->along_normal ? (a * sine - b * cosine) / (a * cosine + b * sine) : sine / cosine;
    }
    Push result{cosine, sine};
    if (!load_->along_normal) {
      const double per_radius = 1.0 / ring_radius_;
      result = {(a * cosine - b * sine) * per_radius, (b * cosine + a * sine) * per_radius};
    }
    return {result.along * push, result.across * push};
  }

  /// How the push changes with the slip velocity where the shaft stands: the bend follows e, at h = 0. To be
  /// asked for after `move_on`.
  Push push_by_slip(double force_unit) const {
    const Number inverse = e_by_velocity() / (h_by_bending * e_by_lean - h_by_lean * e_by_bending);
    const Number bending_rate = h_by_lean * inverse;
    const Number lean_rate = h_by_bending * inverse * -1.0;
    const Number load_rate = blade.load.by_bending * bending_rate + blade.load.by_lean * lean_rate;
    const Number cosine_rate = lean * lean_rate * -4.0;
    const Number sine_rate = cosine_ / blade.cosine * (2.0 * load_->side) * lean_rate;
    Push direction{cosine_, sine_};
    Push turn{cosine_rate, sine_rate};
    if (!load_->along_normal) {
      const double per_radius = 1.0 / ring_radius_;
      const Number moved_a = a_by_bending * bending_rate + a_by_lean * lean_rate;
      const Number moved_b = b_by_bending * bending_rate + b_by_lean * lean_rate;
      direction = {(a * cosine_ - b * sine_) * per_radius, (b * cosine_ + a * sine_) * per_radius};
      turn = {((a * cosine_rate - b * sine_rate) + (moved_a * cosine_ - moved_b * sine_)) * per_radius,
              ((b * cosine_rate + a * sine_rate) + (moved_b * cosine_ + moved_a * sine_)) * per_radius};
    }
    const double unit = -blade_->load_unit * force_unit;
    return {(direction.along * load_rate + turn.along * load) * unit,
            (direction.across * load_rate + turn.across * load) * unit};
  }

  /// What an interval keeps of the tip, but for what has to do with velocities.
  void store(TipInTime& kept) const {
    lean.store(kept.lean);
    (shortening * (1.0 / blade_->length)).store(kept.shortening);
    (Number(load_->cone()) - coefficient * coefficient).store(kept.cone_left);
    load_->chart_left(bending, lean).store(kept.chart_left);
    (load * blade_->load_unit / root(coefficient * coefficient + 1.0)).store(kept.normal_force);
    (bending * (2.0 * load_->strain_unit) * root(larger(load, Number(0.0)))).store(kept.root_strain);
  }

  /// ∂e/∂v.
  [[nodiscard]] Number e_by_velocity() const { return e_by_velocity_ * ring_radius_; }
  [[nodiscard]] const InclinedLoad& inclined() const { return *load_; }
  [[nodiscard]] const Blade& numbers() const { return *blade_; }

 private:
  const Blade* blade_ = nullptr;
  const InclinedLoad* load_ = nullptr;
  double slip_ = 0.0;
  double ring_radius_ = 0.0;
  BladeRule rule_;
  Number cosine_, sine_;  ///< of b
  Number direction_x_;    ///< X
  Number e_by_velocity_;  ///< over R
};

}  // namespace
}  // namespace rubatlas::collocation
