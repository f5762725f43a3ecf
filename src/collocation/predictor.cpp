#include "collocation/predictor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

#include "blade/bending_table.hpp"
#include "collocation/blades_in_contact.hpp"

namespace rubatlas::collocation {
namespace {

constexpr double kMostTurning = 1.2;    ///< [rad] of one arc
constexpr double kLongest = 3.0;        ///< arc: where friction is small, coefficients fall unevenly beyond
constexpr double kLongestOfLone = 2.0;  ///< the curve of a blade over p has branch points at ±iπ/2
constexpr double kAim = 0.68;           ///< of the length that just keeps the bound
constexpr double kAimOfLone = 0.8;
constexpr double kLeastGrowth = 0.5;
constexpr double kMostGrowth = 2.0;
constexpr double kLeastRetry = 0.3;
constexpr double kUnsolvedRetry = 0.5;
constexpr double kFirstAtRest = 0.1;  ///< length of the first arc of a tip at rest
constexpr double kStraight = 1e-6;    ///< [rad]: an arc that turns by less has no curvature
constexpr double kSteep = 0.48;       ///< sine of the slope with which an arc may be followed down to p = 0
constexpr double kReach = 0.15;       ///< of an arc: so far above p = 0 it is stretched to reach it
constexpr double kLongestHalf = 1.5;  ///< [τ] half of a contact, as a first estimate

/// error^(−1/kOrder) to half a per cent: a table over the errors' exponents and first bits. A power takes as
/// long as what else follows from an error.
double root_of_error(double error) {
  constexpr int kFirstBits = 3;
  // Smaller and larger errors change a length by what its change is limited to.
  constexpr double kLeast = 0x1p-15;
  constexpr double kMost = 0x1p11;
  constexpr int kDoublings = 26;  // from one to the other
  const auto place = [](double number) {
    return static_cast<std::size_t>(std::bit_cast<std::uint64_t>(number) >> (52 - kFirstBits));
  };
  static const auto kTable = [&] {
    std::array<double, (kDoublings << kFirstBits) + 1> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const auto middle =
          std::bit_cast<double>(std::uint64_t{2 * (place(kLeast) + i) + 1} << (51 - kFirstBits));
      table[i] = std::pow(middle, -1.0 / Predictor::kOrder);
    }
    return table;
  }();
  return kTable[place(std::clamp(error, kLeast, kMost)) - place(kLeast)];
}

/// Without the care of `std::hypot` for numbers near overflow.
double length_of(double x, double y) {
  return std::sqrt(x * x + y * y);
}

/// Of length 1.
Interval::Direction direction_of(double time, double argument) {
  const double length = length_of(time, argument);
  return {time / length, argument / length};
}

}  // namespace

void Predictor::begin(const Start& start) {
  is_lone_ = start.is_lone;
  shaft_ = {.acceleration = {start.acceleration.shaft.real(), start.acceleration.shaft.imag()}};
  ring_ = {.acceleration = {start.acceleration.ring.real(), start.acceleration.ring.imag()}};
  const double speed = start.at.speed;
  const rotor::State state = rotor::from_ring(start.bodies);
  const contact::Geometry geometry = law_->geometry(start.touch.blade);
  lean_ = {start.bending.lean};
  const double rate = contact::gap_rate(geometry, start.at.pose, speed) - start.blade.ring_opens;
  double curvature = contact::gap_curvature(
      geometry, start.direction, start.at.pose, {state[0], state[1] + machine_->constants.misalignment},
      {state[2], state[3]}, start.acceleration.shaft - start.acceleration.ring, speed);
  // Under a load that stays a ring with dampers opens ever more slowly, at this rate.
  if (const Blade& blade = *start.blade.blade; blade.ring_damping > 0.0)
    curvature += start.blade.ring_opens * blade.ring_stiffness / blade.ring_damping;
  // Half of the contact, as far as the gap is a parabola: from its top to where it is closed.
  const double rate_at_end = std::sqrt(std::max(0.0, rate * rate - 2.0 * curvature * start.at.pose.gap));
  const double half =
      curvature < 0.0 && !start.touch.skims ? std::min(-rate_at_end / curvature, kLongestHalf) : kLongestHalf;
  if (start.bending.argument > 0.0) {
    begin_under_load(start, half);
  } else {
    begin_unloaded(start, half, rate, curvature);
  }
}

void Predictor::begin_under_load(const Start& start, double half) {
  constexpr double kShortestHalf = 1e-6;  // a contact that ends before is a part of its first interval
  time_unit_ = std::max(half, kShortestHalf);
  // Half of the period on the ring's spring.
  if (const double stiffness = start.blade.blade->ring_stiffness * machine_->closing_unit(); stiffness > 0.0)
    time_unit_ = std::min(time_unit_, std::numbers::pi / std::sqrt(stiffness));
  duration_ = std::min(half, time_unit_);
  unit_length_ = 1.0;
  length_ = share_of_first_[1];
  curvature_ = 0.0;
  const contact::BladeDirection& er = start.direction;
  const std::complex<double> acceleration =
      (start.acceleration.shaft - start.acceleration.ring) * std::complex<double>(er.cosine, -er.sine);
  const Law::Tangent tangent = law_->tangent(start.touch, start.at, acceleration);
  rests_ = law_->leans() && start.touch.slip == 0.0;
  if (rests_) {
    longest_unit_ = time_unit_;
    time_unit_ = unit_at_rest(tangent.time, tangent.argument, tangent.lean);
    length_ = kFirstAtRest;
  }
  tangent_ = direction_of(tangent.time / time_unit_, tangent.argument);
  lean_.rate = tangent.lean / tangent.time;
}

/// T for a tip at rest, which bend and lean follow together: near where its place is lost all of it moves
/// ever faster, and either may turn round.
double Predictor::unit_at_rest(double time, double argument, double lean) const {
  return std::min(longest_unit_, time / length_of(argument, lean));
}

/// `rate`, `curvature_of_gap`: dg/dτ, d²g/dτ².
void Predictor::begin_unloaded(const Start& start, double half, double rate, double curvature_of_gap) {
  rests_ = false;
  // The largest bending: the force takes away what the gap's rate has of energy, (dg/dτ)²/2, as the blade
  // follows the gap with ct as it is.
  const Blade& blade = *start.blade.blade;
  const double along = start.at.pose.radial + blade.reach;
  const double side = law_->side(start.touch) * start.at.pose.tangential;
  const double per_load = 2.0 * along * machine_->closing_unit() * blade.load_unit;
  const double radius = law_->geometry(start.touch.blade).ring_radius;
  const std::span<const blade::BendingTable::Knot> knots = law_->knots(start.touch.blade);
  double energy = 0.5 * rate * rate;
  double largest = knots.back().argument;
  double gap = 0.0;
  double load = 0.0;
  double argument = 0.0;
  for (const blade::BendingTable::Knot& knot : knots) {
    const double shortening = blade.length * knot.shortening;
    const double deflection = blade.length * knot.deflection;
    const double yielding = blade.yield_unit * knot.load;
    const double next = shortening * (2.0 * along - shortening) + deflection * (2.0 * side - deflection) +
                        contact::widening(yielding, radius);
    const double taken = (0.5 * (load + knot.load) * per_load - curvature_of_gap) * (next - gap);
    if (taken > energy) {
      // In the first quarter of a piece energy grows as p⁴.
      const double share = energy / taken;
      const double part = argument == 0.0 ? std::sqrt(std::sqrt(share)) : share;
      largest = argument + part * (knot.argument - argument);
      gap += (argument == 0.0 ? std::sqrt(share) : share) * (next - gap);
      break;
    }
    energy -= taken;
    gap = next;
    load = knot.load;
    argument = knot.argument;
  }
  constexpr double kLeastBending = 1e-8;
  constexpr double kRound = 1.6;  // between a parabola, 2, and the quarter of a sine, π/2
  largest = std::max(largest, kLeastBending);
  if (gap > 0.0 && rate > 0.0) half = std::min(half, kRound * gap / rate);
  duration_ = half;
  time_unit_ = half / largest;
  unit_length_ = largest;
  length_ = share_of_first_[0] * unit_length_;
  tangent_ = {0.0, 1.0};
  // Near the touch-down g = dg/dτ τ = (g/Δ) Δ, with Δ ~ p².
  const double deflection = law_->deflection_per_square(start.touch);
  constexpr double kSharpest = 3.0;
  curvature_ = -std::clamp(2.0 * start.blade.start_gap_measure * deflection / (rate * time_unit_), 0.0,
                           kSharpest / largest);
  // A tip that hardly moves outwards, but ever faster, bends its blade in proportion to the time: then g =
  // d²g/dτ² τ²/2.
  constexpr double kHardly = 1e-3;
  const double of_square = start.blade.start_gap_measure * deflection;
  if (curvature_of_gap > 0.0 && rate < kHardly * largest * std::sqrt(2.0 * curvature_of_gap * of_square)) {
    const double time = std::sqrt(2.0 * of_square / curvature_of_gap) / time_unit_;
    tangent_ = direction_of(time, 1.0);
    curvature_ = 0.0;
  }
}

void Predictor::guess(Interval& next) {
  next.shaft.at_start = shaft_;
  next.ring.at_start = ring_;
  const double length = std::min({length_, is_lone_ ? kLongestOfLone : kLongest,
                                  kMostTurning / std::max(std::abs(curvature_), kStraight)});
  length_of_trial_ = length;
  const AtNodes& node = kNodeTables.node;
  const double half_turn = 0.5 * curvature_ * length;
  // Sine, over the angle, and cosine are short series: the chord may be any that is near.
  const double square = half_turn * half_turn;
  const double sine_per_turn = 1.0 - square * (1.0 / 6.0 - square / 120.0);
  const double cosine = 1.0 - square * (0.5 - square / 24.0);
  const double sine = half_turn * sine_per_turn;
  const double chord = length * sine_per_turn;
  const Interval::Direction direction{tangent_.time * cosine - tangent_.argument * sine,
                                      tangent_.argument * cosine + tangent_.time * sine};
  const bool reaches_zero = next.start_argument > 0.0 && tangent_.argument < -kSteep &&
                            next.start_argument + chord * direction.argument < kReach * length;
  if (reaches_zero) {
    // Over p itself, so that the lift-off is the last node.
    next.chord = {0.0, -next.start_argument};
    next.normal = {1.0, 0.0};
    // As long as it is now: a shorter one, which errors may ask for, stays above.
    length_of_trial_ = next.start_argument / -(direction.argument * sine_per_turn);
    const double slope = tangent_.time / tangent_.argument;
    const double bend = -curvature_ / (tangent_.argument * tangent_.argument * tangent_.argument);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double down = -next.start_argument * node[i];
      next.deviation[i] = time_unit_ * down * (slope + 0.5 * bend * down);
    }
  } else {
    next.chord = {time_unit_ * chord * direction.time, chord * direction.argument};
    next.normal = {-time_unit_ * direction.argument, direction.time};
    const double sagitta = -0.5 * curvature_ * chord * chord;
    for (std::size_t i = 0; i < kNodes; ++i) next.deviation[i] = sagitta * node[i] * (1.0 - node[i]);
  }
  if (!law_->leans()) return;
  const AtNodes elapsed = guessed_times(next);
  for (std::size_t i = 0; i < kNodes; ++i) next.leader().lean[i] = lean_.after(elapsed[i]);
}

/// Of the next arc, against that of an arc which errs so.
double Predictor::length_by_error(double error) const {
  return (is_lone_ ? kAimOfLone : kAim) * root_of_error(error);
}

void Predictor::accepts(double error, const Interval* first) {
  length_ = length_of_trial_ * std::clamp(length_by_error(error), kLeastGrowth, kMostGrowth);
  if (first == nullptr || rests_) return;
  double& share = share_of_first_[first->start_argument > 0.0 ? 1 : 0];
  share = std::min(std::sqrt(share * length_ / unit_length_), 1.0);
}

bool Predictor::shortens(double error) {
  const double less = error < kUnknownError ? std::max(kLeastRetry, length_by_error(error)) : kUnsolvedRetry;
  length_ = length_of_trial_ * less;
  return length_ > shortest_;
}

double Predictor::steepness(const Interval& interval) const {
  const Interval::Direction chord{interval.chord.time / time_unit_, interval.chord.argument};
  const Interval::Direction tangent{interval.time_slope.at_end() / time_unit_,
                                    interval.argument_slope.at_end()};
  const double cross = chord.time * tangent.argument - chord.argument * tangent.time;
  const double dot = chord.time * tangent.time + chord.argument * tangent.argument;
  return cross * cross / (cross * cross + dot * dot);
}

void Predictor::goes_on(const Interval& interval) {
  struct Place {
    Interval::Direction tangent;
    double time;
    double argument;
  };
  const auto place = [&](std::size_t node) {
    return Place{direction_of(interval.time_slope[node] / time_unit_, interval.argument_slope[node]),
                 interval.elapsed[node] / time_unit_, interval.argument[node]};
  };
  if (rests_) {
    const double time = interval.time_slope.at_end();
    const double argument = interval.argument_slope.at_end();
    const double before = length_of(time / time_unit_, argument);
    time_unit_ = unit_at_rest(time, argument, time * course_at_end(interval, interval.leader().lean).rate);
    length_ *= length_of(time / time_unit_, argument) / before;
  }
  const std::array<Place, 3> last{place(kNodes - 3), place(kNodes - 2), place(kNodes - 1)};
  const auto between = [](const Place& from, const Place& to) {
    return length_of(to.time - from.time, to.argument - from.argument);
  };
  const auto turning = [](const Interval::Direction& from, const Interval::Direction& to) {
    return from.time * to.argument - from.argument * to.time;
  };
  const double before = between(last[0], last[1]);
  const double after = between(last[1], last[2]);
  const double curvature_before = turning(last[0].tangent, last[1].tangent) / before;
  const double curvature_after = turning(last[1].tangent, last[2].tangent) / after;
  const double time_between = interval.elapsed[kNodes - 1] - interval.elapsed[kNodes - 2];
  const auto at_end = [time_between](const Body& body) {
    const double x = body.ax.at_end();
    const double y = body.ay.at_end();
    return Derivatives{{x, y},
                       {(x - body.ax[kNodes - 2]) / time_between, (y - body.ay[kNodes - 2]) / time_between}};
  };
  shaft_ = at_end(interval.shaft);
  ring_ = at_end(interval.ring);
  curvature_ = curvature_after + (curvature_after - curvature_before) * after / (before + after);
  tangent_ = last[2].tangent;
  if (law_->leans()) lean_ = course_at_end(interval, interval.leader().lean);
}

}  // namespace rubatlas::collocation
