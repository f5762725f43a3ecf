#include "contact/directed_elastica.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "integrate/root_between.hpp"

namespace rubatlas::contact {
namespace {

using blade::kLargestAmplitude;
using blade::kLargestModulus;

constexpr double kLargestShortening = 0.75;  ///< of L: where the table of `ElasticaContact` ends, too
constexpr unsigned kCoefficientBits = 40;    ///< of c, which Newton's method on both unknowns then refines

}  // namespace

auto DirectedElastica::newton(const Pose& at, double slip, double angular_speed, Bend bend) const
    -> std::optional<Bend> {
  constexpr double kFarthest = 4.0;  // factor by which one step may shrink κ or φ
  const double side = std::copysign(1.0, bend.modulus);
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 16; ++iteration) {
    const Constraint there = constraint(at, slip, angular_speed, bend);
    const double determinant = there.determinant();
    const Bend change = there.correction();
    const double size =
        std::max(std::abs(change.modulus / bend.modulus), std::abs(change.amplitude / bend.amplitude));
    if (!(size < 1e3)) return std::nullopt;  // a fold, or not a number
    // Steps cannot become smaller than the rounding of g divided by the slope, so the iteration also ends
    // where they no longer shrink.
    const bool small = size < 1e-8;
    const bool ends = small && (size * size * size <= 1e-16 * previous * previous || size >= 0.5 * previous);
    if (ends) {
      // On the branch that a growing load reaches h falls as |κ| grows along d = 0, and d falls as φ grows at
      // fixed κ. (Under friction that is steep in v, d need not fall; the determinant has the same sign.)
      const bool falls = !friction_.has_slip_state() || side * there.by_amplitude.misdirection < 0.0;
      if (!falls || !(determinant > 0.0)) return std::nullopt;
    }
    const double modulus = side * (bend.modulus + change.modulus);
    const double least = side * bend.modulus / kFarthest;
    bend.modulus = side * std::clamp(modulus, least, kLargestModulus);
    bend.amplitude =
        std::clamp(bend.amplitude + change.amplitude, bend.amplitude / kFarthest, kLargestAmplitude);
    if (ends) {
      if (there.blade.shortening.value > kLargestShortening) return std::nullopt;
      return bend;
    }
    previous = size;
  }
  return std::nullopt;
}

/// Walks along the equilibria on one side under a given friction coefficient. The parameter of the walk is
/// the angle A = 2 asin |κ| of the tip against its load. It starts at the unloaded blade (A = b, or 0 for a
/// column), or at the fold where the equilibria against the side of the load begin.
class DirectedElastica::Walk {
 public:
  Walk(const DirectedElastica& law, const Pose& at, double slip, double angular_speed, double side)
      : law_(law), at_(at), slip_(slip), angular_speed_(angular_speed), side_(side) {}

  /// Finds the angles between which h falls through zero for the first time; false where h does so nowhere.
  bool find() {
    constexpr double kLargestStep = 0.1;       // [rad]
    if (!std::isfinite(start_)) return false;  // a walk from no place would not end
    const bool approaching = side_ * at_.tangential >= 0.0;
    const double last = 2.0 * std::asin(kLargestModulus);
    // h = g at the unloaded blade: where g is positive the walk need not begin with the lightest load.
    double step = at_.gap > 0.0 ? std::max(0.01 * start_, 1e-3) : least_;
    double outside = start_;  // the last angle before the equilibria begin
    for (double angle = start_;;) {
      angle = std::min(angle + step, last);
      const auto there = state(angle);
      if (!there) {
        if (low_) return false;
        outside = angle;
      } else {
        take(angle, there->residual);
        // The root may lie before the first step, towards the unloaded blade or the fold.
        while (high_ && !low_ && *high_ - outside > (outside > start_ ? kRounding * outside : least_)) {
          const double middle =
              outside > start_ ? 0.5 * (outside + *high_) : start_ + (*high_ - start_) / 16.0;
          const auto between = state(middle);
          if (between)
            take(middle, between->residual);
          else
            outside = middle;
        }
        if (high_ && low_) return true;
        if ((high_ && approaching) || there->blade.shortening.value > kLargestShortening) return false;
        high_.reset();
        outside = start_;
      }
      if (angle == last) return false;
      step = std::min(angle - start_, kLargestStep);
    }
  }

  /// After `find`: the equilibrium between the two angles.
  std::optional<Bend> root() {
    const auto crossing = bend(*low_ + (*high_ - *low_) * at_low_ / (at_low_ - at_high_));
    if (crossing) {
      const auto root = law_.newton(at_, slip_, angular_speed_, *crossing);
      if (root && side_ * root->modulus >= std::sin(0.5 * *low_) &&
          side_ * root->modulus <= std::sin(0.5 * *high_))
        return root;
    }
    const auto residual = [&](double angle) {
      const auto there = state(angle);
      return there ? there->residual : at_low_;
    };
    const auto found = bend(integrate::root_between(residual, *low_, *high_, at_low_, at_high_));
    if (!found || blade::inclined_equilibrium(*found).shortening.value > kLargestShortening)
      return std::nullopt;
    return found;
  }

  /// Where h is nowhere positive (g <= 0 by a little) nothing bends the blade; a column carries its buckling
  /// load.
  std::optional<Bend> unbent() {
    if (low_ || first_ < 0.0) return std::nullopt;
    if (first_ > 0.0) return Bend{side_ * std::sin(0.5 * start_), 0.0};
    return bend(kLeast);
  }

 private:
  static constexpr double kRounding = 1e-12;  ///< of b: the least difference of A from b
  static constexpr double kLeast = 1e-18;     ///< [rad]: the least A of a column, straight to rounding

  /// The smallest φ with d = 0 at a fixed κ, which has the smallest load.
  std::optional<double> amplitude_of(double modulus, double guess) const {
    constexpr double kRoundingOfDirection = 1e-15;  // of d
    constexpr double kSmallStep = 1e-8;             // of φ: the next one is a rounding error
    // d falls from A − b of the unloaded blade (φ = 0), so that it has a root between the two ends or none.
    const double angle = 2.0 * std::asin(side_ * modulus);
    if (angle < first_) return std::nullopt;
    double low = 0.0;
    double high = kLargestAmplitude;
    if (first_ <= 0.0 && side_ * constraint({modulus, kLargestAmplitude}).misdirection >= 0.0)
      return std::nullopt;
    // A light load bends the blade by A − b ~ A φ².
    double amplitude =
        guess > low && guess < high ? guess : std::min(1.5, std::sqrt(3.0 * (angle - first_) / angle));
    for (int iteration = 0; iteration < 80; ++iteration) {
      const Constraint now = constraint({modulus, amplitude});
      const double value = side_ * now.misdirection;
      (value > 0.0 ? low : high) = amplitude;
      const double step = -now.misdirection / now.by_amplitude.misdirection;
      const double next = amplitude + step;
      if (std::abs(step) <= kSmallStep * amplitude || std::abs(value) <= kRoundingOfDirection) {
        return next > 0.0 ? next : amplitude;
      }
      if (next > low && next < high)
        amplitude = next;
      else
        amplitude = low > 0.0 ? 0.5 * (low + high) : 0.25 * high;
    }
    return std::nullopt;
  }
  std::optional<Bend> bend(double angle) {
    // A − b ~ A φ² at light loads.
    const double share = (angle - start_) / angle;
    const double guess = share_ > 0.0 ? amplitude_ * std::sqrt(share / share_) : 0.0;
    const double modulus = side_ * std::sin(0.5 * angle);
    const auto amplitude = amplitude_of(modulus, guess);
    if (!amplitude) return std::nullopt;
    share_ = share;
    amplitude_ = *amplitude;
    return Bend{modulus, *amplitude};
  }
  [[nodiscard]] Constraint constraint(const Bend& bend) const {
    return law_.constraint(at_, slip_, angular_speed_, bend);
  }
  std::optional<Constraint> state(double angle) {
    const auto found = bend(angle);
    return found ? std::optional(constraint(*found)) : std::nullopt;
  }
  void take(double angle, double residual) {
    (residual > 0.0 ? low_ : high_) = angle;
    (residual > 0.0 ? at_low_ : at_high_) = residual;
  }

  const DirectedElastica& law_;
  Pose at_;
  double slip_;
  double angular_speed_;
  double side_;
  /// b of the undeformed blade, positive towards the side.
  double first_ = side_ * law_.first_load_angle(at_, slip_, angular_speed_);
  double start_ = std::max(first_, 0.0);                 ///< A of the unloaded blade
  double least_ = std::max(start_ * kRounding, kLeast);  ///< the smallest A − `start_`
  double amplitude_ = 0.0;
  double share_ = 0.0;  ///< (A − start)/A at `amplitude_`
  std::optional<double> low_, high_;
  double at_low_ = 0.0, at_high_ = 0.0;
};

auto DirectedElastica::solve_for_coefficient(const Pose& at, double slip, double angular_speed,
                                             double side) const -> std::optional<Bend> {
  constexpr int kSteps = 8;  // from the coefficient of the undeformed tip to the largest
  constexpr int kHalvings = 40;
  // c − c(v) where the tip stands under c: negative at the least c, positive at the largest. Not a number
  // where the blade cannot stand on this side.
  std::optional<Bend> bend;
  const auto excess = [&](double coefficient) {
    const DirectedElastica law = with_friction(Friction::coulomb(coefficient));
    bend = law.solve(at, 1.0, angular_speed, side);
    evaluations_ += law.evaluations();
    if (!bend) return std::numeric_limits<double>::quiet_NaN();
    return coefficient - constraint(at, slip, angular_speed, *bend).coefficient;
  };
  const double start = load_angle(at, slip, angular_speed, unbent_tip(geometry_, at)).coefficient;
  double low = start;
  double at_low = excess(low);
  if (at_low == 0.0) return bend;
  // Friction along −side·t holds a blade to its side.
  const double end = std::copysign(friction_.largest(), bend ? -at_low : side);
  double high = low;
  double at_high = at_low;
  const auto leaves = [&] { return std::isnan(at_high) && !std::isnan(at_low); };
  for (int i = 1; i <= kSteps && !(at_high * end >= 0.0) && !leaves(); ++i) {
    low = high;
    at_low = at_high;
    high = i < kSteps ? start + (end - start) * i / kSteps : end;
    at_high = excess(high);
  }
  // Where the equilibria on this side begin or end between the two coefficients, halvings look for the
  // crossing where the blade has equilibria.
  for (int halving = 0; (std::isnan(at_low) || std::isnan(at_high)) && halving < kHalvings; ++halving) {
    const double middle = 0.5 * (low + high);
    const double at_middle = excess(middle);
    const bool beyond = std::isnan(at_middle) ? std::isnan(at_high) : at_middle * end >= 0.0;
    (beyond ? high : low) = middle;
    (beyond ? at_high : at_low) = at_middle;
  }
  if (!(at_high * at_low <= 0.0)) return std::nullopt;
  bool lost = false;
  const auto excess_or_end = [&](double coefficient) {
    const double value = excess(coefficient);
    lost = lost || !bend;
    return bend ? value : at_high;
  };
  excess_or_end(integrate::root_between(excess_or_end, low, high, at_low, at_high, kCoefficientBits));
  if (lost) return std::nullopt;
  return newton(at, slip, angular_speed, *bend);
}

auto DirectedElastica::solve(const Pose& at, double slip, double angular_speed, double side) const
    -> std::optional<Bend> {
  if (!friction_.has_slip_state()) return solve_for_coefficient(at, slip, angular_speed, side);
  Walk walk(*this, at, slip, angular_speed, side);
  return walk.find() ? walk.root() : walk.unbent();
}

TipForce DirectedElastica::force_of(const Pose& at, double angular_speed, const Constraint& there) const {
  const double c = there.coefficient;
  TipForce force = bent_tip_force(there.tip, tip_rate(at, angular_speed), angular_speed,
                                  load_unit_ * there.blade.load.value / std::sqrt(1.0 + c * c), c);
  force.shortening = there.blade.shortening.value;
  force.root_strain = strain_unit_ * std::abs(there.blade.curvature);
  return force;
}

auto DirectedElastica::rest(const Pose& at, double angular_speed, const Bend& near) const
    -> std::optional<RestingBlade> {
  constexpr int kSteps = 8;                        // where Newton's method does not converge at once
  constexpr std::uint64_t kEvaluationsOfHold = 8;  // as a rule, of Newton's method on both unknowns
  if (!(near.amplitude > 0.0)) return std::nullopt;
  const BladeVector<double> tip = constraint(at, 0.0, angular_speed, near).tip;
  const double from = std::atan2(tip.across, tip.along);
  const auto place = resting_normal_angle(geometry_, at, angular_speed, from);
  if (!place) return std::nullopt;
  const auto held = [&](double normal_angle, const Bend& from_bend) {
    evaluations_ += kEvaluationsOfHold;
    return hold(direction_, geometry_, length_, at, angular_speed, normal_angle, from_bend);
  };
  if (const auto resting = held(*place, near)) return resting;
  std::optional<RestingBlade> resting = held(from, near);
  for (int i = 1; resting && i <= kSteps; ++i)
    resting = held(from + (*place - from) * i / kSteps, resting->bend);
  return resting;
}

bool DirectedElastica::respond(const Pose& at, double slip, double angular_speed, Bend& bend,
                               TipForce& force) const {
  if (friction_.sticks && slip == 0.0) {
    const auto there = rest(at, angular_speed, bend);
    if (!there) return false;
    bend = there->bend;
    force = force_of(at, angular_speed, constraint(at, slip, angular_speed, bend));
    return true;
  }
  const double first = first_load_angle(at, slip, angular_speed);
  double side = first != 0.0 ? std::copysign(1.0, first) : slip;
  bool known = bend.modulus != 0.0;
  if (remembers_side()) {
    if (known) side = std::copysign(1.0, bend.modulus);
  } else {
    known = known && side * bend.modulus > 0.0;
  }
  // Beyond a lift-off on the approaching side no positive load exists. The load is continued as an odd
  // function of the gap, or as an even one where it does not vanish at lift-off: for a column, and for a
  // blade that is bent against its load.
  const bool beyond_end = at.gap < 0.0 && side * at.tangential >= 0.0;
  Pose mirrored = at;
  if (beyond_end) mirrored.gap = -at.gap;
  std::optional<Bend> root;
  if (known) root = newton(mirrored, slip, angular_speed, bend);
  if (!root) root = solve(mirrored, slip, angular_speed, side);
  if (!root && remembers_side()) {  // it snaps through
    side = -side;
    root = solve(mirrored, slip, angular_speed, side);
  }
  if (!root) return false;
  bend = *root;
  force = force_of(mirrored, angular_speed, constraint(mirrored, slip, angular_speed, bend));
  if (beyond_end && side * first > 0.0) {
    force.radial = -force.radial;
    force.tangential = -force.tangential;
    force.normal = -force.normal;
  }
  return true;
}

}  // namespace rubatlas::contact
