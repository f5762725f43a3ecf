/// The sweeps that solve an interval of a blade under an inclined load (`inclined_load.hpp`). As those of the
/// paper's law (`interval_sweeps.hpp`), with the lean of the load as a second unknown at each node and its
/// direction as a second equation,
///     e = sin(b − [α] − atan c) (1 + c²)^½ = Y − c X = 0,
/// with X, Y = cos b, sin b, or along the normal X = a cos b + β sin b, Y = a sin b − β cos b over R, where
/// (a, β) is the tip against the ring's centre along and across the blade.
#pragma once

#include "collocation/arc_sweeps.hpp"
#include "collocation/even_rules.hpp"
#include "collocation/friction_in_lanes.hpp"
#include "collocation/inclined_load.hpp"
#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"

namespace rubatlas::collocation {
namespace {

/// A bent blade at eight nodes: integrals over its length as in `blade/inclined_elastica.cpp`, over tan(φ'/4)
/// in place of φ', so that no angle is needed, by an even rule.
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
  RUBATLAS_INLINE bool set(const Number& bending, const Number& lean, const EvenRule*& rule) {
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
      rule = even_rule(modulus.largest(), magnitude(tangent).largest());
    }
    if (rule == nullptr) return false;
    cosine = root(Number(1.0) - lean * lean);
    const Number versed_at_clamp = (upright * (square / sum) + leaning * sum) * inverse_modulus;
    const Number tangent_square = tangent * tangent;
    const Number per_cosine = Number(2.0) / cosine;
    Number arcs(0.0), shortenings(0.0), deflections(0.0);
    Number arc_slopes(0.0), shortening_slopes(0.0), deflection_slopes(0.0);
    for (std::size_t i = 0; i < rule->count; ++i) {
      const Number place = tangent_square * rule->square[i];
      const Number per = Number(1.0) / (place + 1.0);
      const Number versed = place * 8.0 * (per * per);  // 1 − cos φ'
      const Number sine_psi = modulus - modulus * versed;
      const Number cosine_psi = root(Number(1.0) - sine_psi * sine_psi);
      const Number both = cosine_psi + cosine;
      const Number inverse_both = Number(1.0) / (cosine_psi * both);
      const Number inverse = inverse_both * both;  // 1/cos(ψ/2)
      const Number measure = per * inverse * rule->weight[i];
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
    arc = tangent * 4.0 * arcs;
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
      const auto set_slopes = [&](WithSlopes& of, const Number& by_modulus, const Number& by_amplitude)
                                  RUBATLAS_INLINED {
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
RUBATLAS_INLINE Lanes<kWidth> bending_of(const InclinedLoad& load, const Lanes<kWidth>& argument,
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
  RUBATLAS_INLINE bool stand(const Number& bending_there, const Number& lean_there, const Pose& at) {
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
    const bool rests = load_->friction.law == FrictionNumbers::Law::rest;
    const Friction<kWidth> friction = rests ? Friction<kWidth>{Number(0.0), Number(0.0)}
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
  RUBATLAS_INLINE Number h_rate() const { return (a * a_rate + b * b_rate) * 2.0; }
  RUBATLAS_INLINE Number e_rate(const Pose& at, const Number& ax, const Number& ay) const {
    const Number& speed = at.angular_speed;
    const Number along_rate = ax + (at.tangential_velocity * 2.0 - at.radial * speed) * speed;
    const Number across_rate = ay - (at.radial_velocity * 2.0 + at.tangential * speed) * speed;
    Number rate = e_by_velocity_ * (a * across_rate - b * along_rate);
    if (load_->along_normal && load_->friction.law != FrictionNumbers::Law::rest) {
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
  RUBATLAS_INLINE Push move_on(const Number& bending_step, const Number& lean_step, const Number& time_step,
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
    Push result{cosine, sine};
    if (!load_->along_normal) {
      const double per_radius = 1.0 / ring_radius_;
      result = {(a * cosine - b * sine) * per_radius, (b * cosine + a * sine) * per_radius};
    }
    return {result.along * push, result.across * push};
  }

  /// How the push changes with the slip velocity where the shaft stands: the bend follows e, at h = 0. To be
  /// asked for after `move_on`.
  RUBATLAS_INLINE Push push_by_slip(double force_unit) const {
    const Number e_by_slip = e_by_velocity_ * ring_radius_;
    const Number inverse = e_by_slip / (h_by_bending * e_by_lean - h_by_lean * e_by_bending);
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
    (bending * InclinedLoad::kChartEnd.cosine + lean * InclinedLoad::kChartEnd.sine).store(kept.chart_left);
    (load * blade_->load_unit / root(coefficient * coefficient + 1.0)).store(kept.normal_force);
    (bending * (2.0 * load_->strain_unit) * root(larger(load, Number(0.0)))).store(kept.root_strain);
  }

  [[nodiscard]] const InclinedLoad& inclined() const { return *load_; }
  [[nodiscard]] const Blade& numbers() const { return *blade_; }

 private:
  const Blade* blade_ = nullptr;
  const InclinedLoad* load_ = nullptr;
  double slip_ = 0.0;
  double ring_radius_ = 0.0;
  const EvenRule* rule_ = nullptr;
  Number cosine_, sine_;  ///< of b
  Number direction_x_;    ///< X
  Number e_by_velocity_;  ///< over R
};

template <std::size_t kWidth>
class InclinedSweeps : public ArcSweeps<kWidth, false> {
  using Base = ArcSweeps<kWidth, false>;
  friend Base;

 public:
  using Number = Lanes<kWidth>;

  InclinedSweeps(const Contact& contact, const InclinedLoad& load, const Closeness& closeness,
                 Interval& interval)
      : Base(contact, closeness, interval), lean_(interval.lean), lead_(contact, load) {
    for (std::size_t k = 0; k < interval.further_count; ++k) {
      const FurtherBlade& blade = interval.further[k];
      FurtherTip& further = further_[k];
      further.tip = {Contact{contact.machine, blade.blade, blade.slip, true}, *blade.load};
      further.square = Number(blade.square);
      further.lean = Number(blade.lean);
    }
    const auto first_guess = [](const Body& body, typename Base::Motion& motion) {
      motion.ax = body.acceleration[0];
      motion.ay = body.acceleration[1];
    };
    first_guess(interval.shaft, shaft_);
    first_guess(interval.ring, ring_);
  }

  RUBATLAS_INLINE bool solve() { return this->converge(*this, kMostSweeps, kFullSweeps); }

 private:
  using Vector = typename Base::Vector;
  using Tip = InclinedTip<kWidth>;
  static constexpr int kMostSweeps = 12;
  static constexpr int kFullSweeps = 3;  ///< with slopes of their own
  /// An interval may be so short that its velocities hardly change, whatever its ends are.
  [[nodiscard]] double largest_step_allowed() const {
    constexpr double kShareOfInterval = 1e-3;
    const double length = std::max(std::abs(interval_.chord.argument), interval_.chord.time);
    return std::min(Base::kLargestStep, kShareOfInterval * length);
  }

  /// A further blade. Newton's steps for p² and l at the times that the leading one has.
  struct FurtherTip {
    Tip tip;
    Number square, lean;   ///< p², l
    Number bending_slope;  ///< du/dp
    Number e_rate;         ///< de/dτ
    Number inverse;        ///< of the determinant of h and e by u and l
    typename Tip::Push push;
  };

  /// The shaft seen from a blade in the direction er.
  RUBATLAS_INLINE InclinedPose<kWidth> pose_from(const Blade& blade, const Vector& er) const {
    const Vector c = seen();
    const Vector v = seen_velocity();
    const Number radial = c.x * er.x + c.y * er.y;
    return {(c.x * c.x + c.y * c.y) + (radial * (2.0 * blade.reach) + blade.closing),
            radial,
            c.y * er.x - c.x * er.y,
            v.x * er.x + v.y * er.y,
            v.y * er.x - v.x * er.y,
            angular_speed_};
  }
  RUBATLAS_INLINE Number e_rate_of(const Tip& tip, const InclinedPose<kWidth>& at, const Vector& er) const {
    Vector acceleration{shaft_.ax, shaft_.ay};
    if (ring_moves()) acceleration = {shaft_.ax - ring_.ax, shaft_.ay - ring_.ay};
    return tip.e_rate(at, acceleration.x * er.x + acceleration.y * er.y,
                      acceleration.y * er.x - acceleration.x * er.y);
  }
  /// du/dp, of which p² is known.
  RUBATLAS_INLINE static Number bending_slope_of(const InclinedLoad& load, const Number& square) {
    return ((((square * (1.0 / 40320) + 1.0 / 720) * square + 1.0 / 24) * square + 0.5) * square + 1.0) *
           load.scale;
  }
  RUBATLAS_INLINE static Vector along(const typename Tip::Push& push, const Vector& er) {
    return {push.along * er.x - push.across * er.y, push.along * er.y + push.across * er.x};
  }

  /// Returns the largest change of a velocity [m per unit τ]; not a number where there is no blade.
  ///
  /// A `light` sweep keeps the slopes of the sweep before.
  template <bool kLight>
  RUBATLAS_INLINE double sweep() {
    const Interval& in = interval_;
    take_direction(elapsed());
    const Number argument = chord_argument_ + deviation_ * in.normal.argument;
    const Number square = argument * argument;
    const InclinedPose<kWidth> at = pose_from(lead_.numbers(), er_);
    if (!lead_.template stand<!kLight>(bending_of(lead_.inclined(), argument, square), lean_, at))
      return std::numeric_limits<double>::quiet_NaN();
    if (!kLight) {
      bending_slope_ = bending_slope_of(lead_.inclined(), square);
      const Number bending_by_deviation = bending_slope_ * in.normal.argument;
      const Number h_by_deviation =
          lead_.h_by_bending * bending_by_deviation + lead_.h_rate() * in.normal.time;
      const Number e_by_deviation =
          lead_.e_by_bending * bending_by_deviation + e_rate_of(lead_, at, er_) * in.normal.time;
      const Number inverse =
          Number(-1.0) / (h_by_deviation * lead_.e_by_lean - lead_.h_by_lean * e_by_deviation);
      deviation_per_h_ = lead_.e_by_lean * inverse;
      deviation_per_e_ = lead_.h_by_lean * inverse;
      lean_per_h_ = e_by_deviation * inverse;
      lean_per_e_ = h_by_deviation * inverse;
    }

    // One Newton step; what follows is taken at its end.
    const Number step = lead_.h * deviation_per_h_ - lead_.e * deviation_per_e_;
    const Number lean_step = lead_.e * lean_per_e_ - lead_.h * lean_per_h_;
    deviation_ = deviation_ + step;
    lean_ = lean_ + lean_step;
    largest_step_ = std::max(magnitude(step).largest(), magnitude(lean_step).largest());
    const Number time_step = step * in.normal.time;
    const Number bending_step = bending_slope_ * (step * in.normal.argument);
    const Vector er_before = er_;
    turn_on(time_step);
    Vector push = along(lead_.move_on(bending_step, lean_step, time_step, machine_.force_unit), er_);
    for (std::size_t k = 0; k < in.further_count; ++k) {
      const std::array<double, 2>& offset = in.further[k].offset;
      if (!step_further<kLight>(further_[k], offset_by(er_before, offset), time_step))
        return std::numeric_limits<double>::quiet_NaN();
      const Vector more = along(further_[k].push, offset_by(er_, offset));
      push = {push.x + more.x, push.y + more.y};
    }
    if (lead_.inclined().friction.law != FrictionNumbers::Law::rest) return move(push);
    const Vector before{shaft_.vx, shaft_.vy};
    const Vector expected{shaft_.vx + shaft_.ax * time_step, shaft_.vy + shaft_.ay * time_step};
    move(push);
    follow_slip<kLight>(expected);
    return larger(magnitude(shaft_.vx - before.x), magnitude(shaft_.vy - before.y)).largest();
  }

  /// Newton's step for the slip velocity of the leading tip: while it rests its load follows the shaft's
  /// velocity at once, which in turn is its integral, so that sweeps alone hardly converge. `expected`: the
  /// velocity with which the tip was brought to rest.
  template <bool kLight>
  RUBATLAS_INLINE void follow_slip(const Vector& expected) {
    const double per_radius = 1.0 / machine_.ring_radius;
    const Vector along_ring{(lead_.b * er_.x + lead_.a * er_.y) * -per_radius,
                            (lead_.a * er_.x - lead_.b * er_.y) * per_radius};
    if (!kLight) {
      push_by_slip_ = along(lead_.push_by_slip(machine_.force_unit), er_);
      set_slip_coupling(along_ring);
    }
    const Number change = along_ring.x * (shaft_.vx - expected.x) + along_ring.y * (shaft_.vy - expected.y);
    const Number slip = Number::combined(slip_coupling_, change);
    add_push({push_by_slip_.x * slip, push_by_slip_.y * slip});
  }
  /// The inverse of 1 − ∂v/∂v by the way of the load, [j][i]: what a change at node j makes at node i.
  [[gnu::noinline]] void set_slip_coupling(const Vector& along_ring) {
    std::array<AtNodes, kNodes> matrix;
    AtNodes rate_x, rate_y, along_x, along_y;
    (push_by_slip_.x * time_rate_).store(rate_x);
    (push_by_slip_.y * time_rate_).store(rate_y);
    along_ring.x.store(along_x);
    along_ring.y.store(along_y);
    for (std::size_t j = 0; j < kNodes; ++j) {
      for (std::size_t i = 0; i < kNodes; ++i) {
        const double unit = i == j ? 1.0 : 0.0;
        matrix[j][i] = unit - nodes_.integral[j][i] * (along_x[i] * rate_x[j] + along_y[i] * rate_y[j]);
        slip_coupling_[j][i] = unit;
      }
    }
    // Gauss's elimination, of all rows but one at a time.
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double per_pivot = 1.0 / matrix[k][k];
      AtNodes factor;
      for (std::size_t i = 0; i < kNodes; ++i)
        factor[i] = i == k ? 1.0 - per_pivot : matrix[k][i] * per_pivot;
      const auto eliminate = [&](AtNodes& column) {
        const double in_row = column[k];
        for (std::size_t i = 0; i < kNodes; ++i) column[i] -= factor[i] * in_row;
      };
      for (std::size_t j = k; j < kNodes; ++j) eliminate(matrix[j]);
      for (AtNodes& column : slip_coupling_) eliminate(column);
    }
  }

  /// False where there is no such blade. `er`: its direction before the step in time. A function of its own:
  /// compilers keep more of the leading blade in registers.
  template <bool kLight>
  [[gnu::noinline]] bool step_further(FurtherTip& further, const Vector& er, const Number& time_step) {
    constexpr double kLeastLeft = 0.01;  // of p², in one step
    Tip& tip = further.tip;
    const Number argument = root(further.square);
    const InclinedPose<kWidth> at = pose_from(tip.numbers(), er);
    if (!tip.template stand<!kLight>(bending_of(tip.inclined(), argument, further.square), further.lean, at))
      return false;
    if (!kLight) {
      further.bending_slope = bending_slope_of(tip.inclined(), further.square);
      further.e_rate = e_rate_of(tip, at, er);
      further.inverse = Number(1.0) / (tip.h_by_bending * tip.e_by_lean - tip.h_by_lean * tip.e_by_bending);
    }
    const Number h = tip.h + tip.h_rate() * time_step;
    const Number e = tip.e + further.e_rate * time_step;
    const Number bending_step = (e * tip.h_by_lean - h * tip.e_by_lean) * further.inverse;
    const Number lean_step = (h * tip.e_by_bending - e * tip.h_by_bending) * further.inverse;
    const Number step = argument * 2.0 * (bending_step / further.bending_slope);
    further.square = larger(further.square + step, further.square * kLeastLeft);
    further.lean = further.lean + lean_step;
    largest_step_ = std::max({largest_step_, magnitude(step).largest(), magnitude(lean_step).largest()});
    further.push = tip.move_on((root(further.square) - argument) * further.bending_slope, lean_step,
                               time_step, machine_.force_unit);
    return true;
  }

  void store_tip(const Tip& tip, const Vector& er, TipInTime& kept) const {
    const double radius = machine_.ring_radius;
    tip.store(kept);
    gap_per_deflection(tip, tip.inclined().side, tip.numbers().length, 0.0).store(kept.gap_measure);
    slip_velocity_of(tip, er, tip.numbers().reach, 1.0 / radius, radius).store(kept.slip_velocity);
  }
  void store() const {
    Interval& in = interval_;
    store_motion();
    store_tip(lead_, er_, in);
    for (std::size_t k = 0; k < in.further_count; ++k) {
      const FurtherTip& further = further_[k];
      FurtherBlade& kept = in.further[k];
      store_tip(further.tip, offset_by(er_, kept.offset), kept);
      further.square.store(kept.square);
      // The determinant by p² and l: positive where a slipping tip's branch goes on from the unbent blade.
      (further.bending_slope / (further.inverse * root(further.square)) * -further.tip.inclined().side)
          .store(kept.firmness);
      if (kept.slip == 0.0 && kept.firmness[0] < 0.0) {
        for (double& value : kept.firmness.value) value = -value;
      }
    }
  }

  using Base::add_push;
  using Base::angular_speed_;
  using Base::chord_argument_;
  using Base::deviation_;
  using Base::elapsed;
  using Base::er_;
  using Base::gap_per_deflection;
  using Base::interval_;
  using Base::largest_step_;
  using Base::machine_;
  using Base::move;
  using Base::nodes_;
  using Base::offset_by;
  using Base::ring_;
  using Base::ring_moves;
  using Base::seen;
  using Base::seen_velocity;
  using Base::shaft_;
  using Base::slip_velocity_of;
  using Base::store_motion;
  using Base::take_direction;
  using Base::time_rate_;
  using Base::turn_on;

  Number lean_;
  Tip lead_;
  Number bending_slope_;                                                ///< du/dp
  Number deviation_per_h_, deviation_per_e_, lean_per_h_, lean_per_e_;  ///< Newton's steps
  Vector push_by_slip_;                        ///< `Tip::push_by_slip` of the leading tip at rest
  std::array<AtNodes, kNodes> slip_coupling_;  ///< of it
  std::array<FurtherTip, kMostFurther> further_;
};

/// Sets h and l of the eight blades of `points`, in equilibrium but for h = 0. False where one of them has no
/// such equilibrium that goes on from the unbent blade's.
template <std::size_t kWidth>
bool inclined_branch(const Contact& contact, const InclinedLoad& load, const contact::Pose& pose,
                     double angular_speed, BranchPoints& points) {
  using Number = Lanes<kWidth>;
  constexpr int kMost = 8;
  constexpr double kClosest = 1e-6;  // of l: h is for Newton's method to go on from
  constexpr double kFarthest = 0.7;  // of l: no load leans more
  const InclinedPose<kWidth> at{
      pose.gap, pose.radial, pose.tangential, pose.radial_velocity, pose.tangential_velocity, angular_speed};
  const Number argument(points.argument);
  const Number square = argument * argument;
  const Number bending = bending_of(load, argument, square);
  Number lean(points.lean);
  InclinedTip<kWidth> tip(contact, load);
  for (int i = 0; i < kMost; ++i) {
    if (!tip.template stand<true>(bending, lean, at)) return false;
    if (!((tip.e_by_lean * load.side).least() > 0.0)) return false;
    const Number step = tip.e / tip.e_by_lean;
    lean = lean - step;
    const double largest = magnitude(step).largest();
    if (!(magnitude(lean).largest() < kFarthest)) return false;
    if (largest < kClosest) {
      lean.store(points.lean);
      (tip.h - tip.h_by_lean * step).store(points.residual);
      return true;
    }
  }
  return false;
}

template <std::size_t kWidth>
bool inclined_solved(const Contact& contact, const InclinedLoad& load, const Closeness& closeness,
                     Interval& interval) {
  return InclinedSweeps<kWidth>(contact, load, closeness, interval).solve();
}

}  // namespace
}  // namespace rubatlas::collocation
