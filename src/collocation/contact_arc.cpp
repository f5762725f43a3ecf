#include "collocation/contact_arc.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "collocation/interval_samples.hpp"
#include "integrate/root_between.hpp"

namespace rubatlas::collocation {
namespace {

/// Error of a velocity between the nodes that is allowed at the tolerance ε, against the clearance: this
/// times ε^(9/14). The motion goes on from the ends of intervals, whose errors fall as about the fourteenth
/// power of the length where those between the nodes fall as the ninth; orders and factor come from an
/// experiment (`README.md`). Whatever has to be accurate within an interval is solved for (`state_at`).
constexpr double kBetweenNodes = 0.27;
constexpr double kOrderAtEnd = 14.0;
constexpr double kAtEnd = 1.0;        ///< tolerances: of that at the end, as far as it can be estimated
constexpr double kClosest = 0.2;      ///< of the tolerance: what sweeps may leave
constexpr double kMostTurning = 1.2;  ///< [rad] of one arc
constexpr double kLongest = 3.0;      ///< arc: where friction is small, coefficients fall unevenly beyond
constexpr double kOrder = 9.0;        ///< of the error between the nodes
constexpr double kAim = 0.68;         ///< of the length that just keeps the bound
constexpr double kLeastGrowth = 0.5;
constexpr double kMostGrowth = 2.0;
constexpr double kLeastRetry = 0.3;
constexpr double kShortest = 1e-5;    ///< of the first arc of a contact
constexpr double kStraight = 1e-6;    ///< [rad]: an arc that turns by less has no curvature
constexpr double kSteep = 0.48;       ///< sine of the slope with which an arc may be followed down to p = 0
constexpr double kReach = 0.15;       ///< of an arc: so far above p = 0 it is stretched to reach it
constexpr double kLongestHalf = 1.5;  ///< [τ] half of a contact, as a first estimate
constexpr std::size_t kMostIntervals =
    1000;                                 ///< of a contact that is shorter or longer than it was estimated
constexpr double kUnbentArgument = 0.01;  ///< p at which Δ ~ p² holds

/// Without the care of `std::hypot` for numbers near overflow.
double length_of(double x, double y) {
  return std::sqrt(x * x + y * y);
}

}  // namespace

ContactArc::ContactArc(const rotor::RotorConstants& rotor, const rotor::BladeSet& blades,
                       const contact::ElasticaContact& law, const rotor::Harmonic* unbalance,
                       const Limits& limits)
    : rotor_(&rotor),
      blades_(&blades),
      law_(&law),
      unbalance_(unbalance),
      limits_(limits),
      table_(&law.curve().over_asinh()),
      solver_(interval_solver()),
      contact_{.reach = law.geometry().reach,
               .ring_radius = law.geometry().ring_radius,
               .closing = law.geometry().closing(),
               .length = law.length(),
               .load_unit = law.load_unit(),
               .friction = law.curve().friction(),
               .force_unit = rotor.force_unit,
               .damping_ratio = rotor.damping_ratio,
               .speed_ratio = rotor.speed_ratio,
               .misalignment = rotor.misalignment,
               .slip = 1.0,
               .forced = unbalance != nullptr},
      allowed_(kBetweenNodes * rotor.length_scale *
               std::pow(limits.tolerance / rotor.length_scale, kOrder / kOrderAtEnd)),
      earlier_(law.geometry().reach, rotor.length_scale) {
  for (int k = 0; k < blades.count(); ++k) offsets_.push_back(blades.direction(k, {1.0, 0.0}));
  const auto& knots = table_->knots();
  const auto beyond = std::find_if(knots.begin(), knots.end(), [&](const blade::BendingTable::Knot& knot) {
    return knot.shortening > limits.max_shortening;
  });
  valid_argument_ = beyond == knots.begin() ? 0.0 : std::prev(beyond)->argument;
}

void ContactArc::begin(double time, const rotor::State& state, int blade, double slip, double bending) {
  blade_ = blade;
  contact_.slip = slip;
  turn_to_others();
  begins_ = true;
  lifts_off_ = false;
  start_ = end_ = {time, state, table_->argument(bending)};
  er_ = blades_->direction(blade_, blades_->first(time));
  estimate();
  look_for_earlier();
}

/// Directions of the other blades against that of the one in contact.
void ContactArc::turn_to_others() {
  others_.clear();
  const contact::BladeDirection& from = offsets_[static_cast<std::size_t>(blade_)];
  for (std::size_t other = 0; other < offsets_.size(); ++other) {
    if (other == static_cast<std::size_t>(blade_)) continue;
    const contact::BladeDirection& to = offsets_[other];
    others_.push_back(
        {to.cosine * from.cosine + to.sine * from.sine, to.sine * from.cosine - to.cosine * from.sine});
  }
}

void ContactArc::look_for_earlier() {
  Beginning beginning{.argument = end_.argument, .slip = contact_.slip};
  std::copy(end_.state.begin(), end_.state.end(), beginning.state.begin());
  beginning.blade = {er_.cosine, er_.sine};
  if (unbalance_ != nullptr) {
    const std::complex<double> forcing = unbalance_->acceleration(end_.time);
    beginning.forcing = {forcing.real(), forcing.imag()};
  }
  const EarlierContacts::Found found = earlier_.find(beginning);
  alike_ = found.alike;
  kept_ = found.next;
  number_ = 0;
}

/// T, and the arc with which the contact begins.
void ContactArc::estimate() {
  const rotor::State& state = end_.state;
  const contact::Pose pose = rotor::pose_of(*rotor_, law_->geometry(), er_, state);
  const double slip = contact_.slip;
  const double speed = rotor_->speed_ratio;
  const auto there = law_->constraint(pose, slip, table_->bending(end_.argument), speed);
  gap_measure_ = law_->gap_per_deflection(pose, slip, table_->bending(end_.argument));
  slip_velocity_ = there.force.slip_velocity;
  std::complex<double> acceleration =
      rotor::shaft_acceleration(*rotor_, state, contact::on_rotor(there.force, er_));
  if (unbalance_ != nullptr) acceleration += unbalance_->acceleration(end_.time);
  acceleration_ = {acceleration.real(), acceleration.imag()};
  jerk_ = {};
  const double rate = contact::gap_rate(law_->geometry(), pose, speed);
  const double curvature =
      contact::gap_curvature(law_->geometry(), er_, pose, {state[0], state[1] + rotor_->misalignment},
                             {state[2], state[3]}, acceleration, speed);
  // Half of the contact, as far as the gap is a parabola: from its top to where it is closed.
  const double rate_at_end = std::sqrt(std::max(0.0, rate * rate - 2.0 * curvature * pose.gap));
  double half = curvature < 0.0 ? std::min(-rate_at_end / curvature, kLongestHalf) : kLongestHalf;
  if (end_.argument > 0.0) {
    time_unit_ = half;
    unit_length_ = 1.0;
    length_ = share_of_first_[1];
    curvature_ = 0.0;
    const double argument_slope =
        there.bending_slope * length_of(law_->curve().load_angle(), table_->bending(end_.argument));
    const double norm = length_of(there.time_slope * time_unit_, argument_slope);
    tangent_ = {-argument_slope / norm, there.time_slope * time_unit_ / norm};
    return;
  }

  // The largest bending: the force takes away what the gap's rate has of energy, (dg/dτ)²/2, as the blade
  // follows the gap with ct as it is.
  const double along = pose.radial + contact_.reach;
  const double per_load = 2.0 * along * rotor_->force_unit * contact_.load_unit;
  double energy = 0.5 * rate * rate;
  double largest = table_->knots().back().argument;
  double gap = 0.0;
  double load = 0.0;
  double argument = 0.0;
  for (const blade::BendingTable::Knot& knot : table_->knots()) {
    const double shortening = contact_.length * knot.shortening;
    const double deflection = contact_.length * knot.deflection;
    const double next =
        shortening * (2.0 * along - shortening) + deflection * (2.0 * slip * pose.tangential - deflection);
    const double taken = (0.5 * (load + knot.load) * per_load - curvature) * (next - gap);
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
  time_unit_ = half / largest;
  unit_length_ = largest;
  length_ = share_of_first_[0] * unit_length_;
  tangent_ = {0.0, 1.0};
  // Near the touch-down g = dg/dτ τ = 2 s ct Δ, with Δ ~ p².
  const double deflection = contact_.length * law_->curve().at(table_->bending(kUnbentArgument)).deflection /
                            (kUnbentArgument * kUnbentArgument);
  constexpr double kSharpest = 3.0;
  curvature_ =
      -std::clamp(4.0 * slip * pose.tangential * deflection / (rate * time_unit_), 0.0, kSharpest / largest);
}

void ContactArc::start_next(Interval& next) const {
  next.start_time = end_.time;
  next.start_argument = end_.argument;
  std::copy(end_.state.begin(), end_.state.end(), next.start.begin());
  next.blade = {er_.cosine, er_.sine};
  if (unbalance_ != nullptr) {
    const std::complex<double> forcing = unbalance_->acceleration(end_.time);
    next.forcing = {forcing.real(), forcing.imag()};
  }
  next.acceleration = acceleration_;
  next.jerk = jerk_;
  next.start_gap_measure = gap_measure_;
  next.start_slip_velocity = slip_velocity_;
}

/// The first guess of the next interval.
void ContactArc::plan(Interval& next, double length) const {
  const AtNodes& node = node_tables().node;
  const double half_turn = 0.5 * curvature_ * length;
  const bool straight = std::abs(half_turn) < kStraight;
  const double cosine = std::cos(half_turn);
  const double sine = std::sin(half_turn);
  const double chord = straight ? length : length * sine / half_turn;
  const Tangent direction{tangent_.time * cosine - tangent_.argument * sine,
                          tangent_.argument * cosine + tangent_.time * sine};
  const bool reaches_zero = end_.argument > 0.0 && tangent_.argument < -kSteep &&
                            end_.argument + chord * direction.argument < kReach * length;
  if (reaches_zero) {
    // Over p itself, so that the lift-off is the last node.
    next.chord = {0.0, -end_.argument};
    next.normal = {1.0, 0.0};
    const double slope = tangent_.time / tangent_.argument;
    const double bend = -curvature_ / (tangent_.argument * tangent_.argument * tangent_.argument);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double down = -end_.argument * node[i];
      next.deviation[i] = time_unit_ * down * (slope + 0.5 * bend * down);
    }
    return;
  }
  next.chord = {time_unit_ * chord * direction.time, chord * direction.argument};
  next.normal = {-time_unit_ * direction.argument, direction.time};
  const double sagitta = -0.5 * curvature_ * chord * chord;
  for (std::size_t i = 0; i < kNodes; ++i) next.deviation[i] = sagitta * node[i] * (1.0 - node[i]);
}

bool ContactArc::solve(Interval& interval, bool warm) {
  const bool solved = solver_.solve(contact_, *table_, {kClosest * limits_.tolerance, warm}, interval);
  sweeps_ += static_cast<std::uint64_t>(interval.sweeps);
  return solved;
}

/// Error of a velocity in what is allowed, between the nodes and at the end. Between the nodes: the first
/// coefficient of the acceleration that eight nodes leave out, as the last ones fall, times the largest value
/// of the integral of its polynomial.
double ContactArc::error_of(const Interval& interval) const {
  const double fifth = interval.coefficients[5];
  const double sixth = interval.coefficients[6];
  const double seventh = interval.coefficients[7];
  // Coefficients fall by a common factor; one alone may vanish.
  constexpr double kShareOfSixth = 0.3;
  constexpr double kLargestIntegral = 0.5 / (2.0 * kNodes + 1.0);
  const double last = std::max(seventh, kShareOfSixth * sixth);
  if (last == 0.0) return 0.0;
  const double fall = std::min(1.0, std::sqrt(last / std::max(fifth, last)));
  const double between = std::max(seventh, kShareOfSixth * sixth * fall) * fall * kLargestIntegral;
  // Quadrature leaves out the fifteenth coefficient at the end: much less, unless coefficients hardly fall.
  const double fall_by_four = (fall * fall) * (fall * fall);
  const double at_end = last * fall_by_four * fall_by_four * kLargestIntegral;
  return std::max(between / allowed_, at_end / (kAtEnd * limits_.tolerance));
}

/// No tip touches besides, no slip reverses, the shaft stays within the ring and the blade within its limit.
bool ContactArc::nothing_else_happens(const Interval& interval, const Bounds& bounds) const {
  return bounds.distance < contact_.ring_radius && bounds.slip_velocity > 0.0 &&
         bounds.argument < valid_argument_ &&
         std::all_of(others_.begin(), others_.end(), [&](const std::array<double, 2>& other) {
           return solver_.largest_gap(contact_, interval, other) < 0.0;
         });
}

ContactArc::Ending ContactArc::ending(const Interval& interval) const {
  const bool reaches_zero = interval.chord.time == 0.0;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const bool last = i + 1 == kNodes;
    if (interval.gap_measure[i] < 0.0) return {i + 1, true};
    if (interval.argument[i] < 0.0 && !(reaches_zero && last)) return {i + 1, false};
  }
  return {};
}

/// θ just before a place by which values have become negative where they pass through zero.
double ContactArc::crossing(const AtPlaces& values, std::size_t place) const {
  const AtPlaces& at = node_tables().place;
  const auto value = [&](double fraction) { return sum_of_products(basis_at(fraction), values); };
  if (values[place - 1] <= 0.0) {
    // It starts at zero, and rises from there.
    const auto mean = [&](double fraction) { return (value(fraction) - values[place - 1]) / fraction; };
    return integrate::root_between(mean, 0.0, at[place], std::abs(mean(at[place])), mean(at[place]));
  }
  return integrate::root_between(value, at[place - 1], at[place], values[place - 1], values[place]);
}

/// The stretch of the interval up to θ, solved for itself.
bool ContactArc::cut(double fraction, Interval& shorter) {
  shorter.start_time = made().start_time;
  shorter.start_argument = made().start_argument;
  shorter.start = made().start;
  shorter.blade = made().blade;
  shorter.forcing = made().forcing;
  shorter.start_gap_measure = made().start_gap_measure;
  shorter.start_slip_velocity = made().start_slip_velocity;
  shorter.chord = {fraction * made().chord.time, fraction * made().chord.argument};
  shorter.normal = made().normal;
  read_stretch(made(), fraction, shorter);
  return solve(shorter, true);
}

/// The end of an interval: of the contact, to rounding, where it ends there.
void ContactArc::end_at(const Interval& interval, const Ending& ending) {
  start_ = end_;
  const std::size_t last = kNodes - 1;
  end_.time = interval.start_time + interval.elapsed[last];
  end_.state = {interval.x[last], interval.y[last], interval.vx[last], interval.vy[last]};
  end_.argument = interval.argument[last];
  er_ = {interval.blade_x[last], interval.blade_y[last]};
  lifts_off_ = interval.chord.time == 0.0 || ending.place < kPlaces;
  double late = 0.0;
  if (ending.under_load) {
    const contact::Pose pose = rotor::pose_of(*rotor_, law_->geometry(), er_, end_.state);
    late = -pose.gap / contact::gap_rate(law_->geometry(), pose, rotor_->speed_ratio);
  } else if (ending.place < kPlaces) {
    late = -end_.argument * interval.time_slope[last] / interval.argument_slope[last];
  }
  end_.time += late;
  end_.state += late * rotor::State(end_.state[2], end_.state[3], interval.ax[last], interval.ay[last]);
  if (ending.under_load) {
    end_.argument += late * interval.argument_slope[last] / interval.time_slope[last];
  } else if (lifts_off_) {
    end_.argument = 0.0;
  }
}

/// Direction and curvature with which an interval ends.
void ContactArc::take_direction(const Interval& interval) {
  struct Place {
    Tangent tangent;
    double time;
    double argument;
  };
  const auto place = [&](std::size_t node) {
    const double time = interval.time_slope[node] / time_unit_;
    const double argument = interval.argument_slope[node];
    const double norm = length_of(time, argument);
    return Place{
        {time / norm, argument / norm}, interval.elapsed[node] / time_unit_, interval.argument[node]};
  };
  const std::array<Place, 3> last{place(kNodes - 3), place(kNodes - 2), place(kNodes - 1)};
  const auto between = [](const Place& from, const Place& to) {
    return length_of(to.time - from.time, to.argument - from.argument);
  };
  const auto turning = [](const Tangent& from, const Tangent& to) {
    return from.time * to.argument - from.argument * to.time;
  };
  const double before = between(last[0], last[1]);
  const double after = between(last[1], last[2]);
  const double curvature_before = turning(last[0].tangent, last[1].tangent) / before;
  const double curvature_after = turning(last[1].tangent, last[2].tangent) / after;
  const double time_between = interval.elapsed[kNodes - 1] - interval.elapsed[kNodes - 2];
  acceleration_ = {interval.ax.at_end(), interval.ay.at_end()};
  jerk_ = {(interval.ax.at_end() - interval.ax[kNodes - 2]) / time_between,
           (interval.ay.at_end() - interval.ay[kNodes - 2]) / time_between};
  curvature_ = curvature_after + (curvature_after - curvature_before) * after / (before + after);
  tangent_ = last[2].tangent;
}

ContactArc::Outcome ContactArc::make() {
  if (number_ >= kMostIntervals) return Outcome::gives_up;
  const double shortest = kShortest * length_;
  double length = 0.0;
  while (true) {
    Interval& next = trial();
    start_next(next);
    const bool follows = alike_ != nullptr && number_ < alike_->count;
    if (follows) {
      length = alike_->intervals[number_].length;
      alike_->intervals[number_].guess(next);
    } else {
      length = std::min({length_, kLongest, kMostTurning / std::max(std::abs(curvature_), kStraight)});
      plan(next, length);
    }
    const bool solved = solve(next, follows);
    const double error = solved ? error_of(next) : 0.0;
    if (solved && error <= 1.0) {
      length_ = length *
                std::clamp(kAim * std::pow(std::max(error, 1e-12), -1.0 / kOrder), kLeastGrowth, kMostGrowth);
      if (begins_ && !follows) {
        double& share = share_of_first_[next.start_argument > 0.0 ? 1 : 0];
        share = std::min(std::sqrt(share * length_ / unit_length_), 1.0);
      }
      break;
    }
    ++rejected_;
    if (follows) {
      alike_ = nullptr;
      kept_->count = number_;
      continue;
    }
    length_ = length * (solved ? std::max(kLeastRetry, kAim * std::pow(error, -1.0 / kOrder)) : 0.5);
    if (!(length_ > shortest)) return Outcome::gives_up;
  }
  if (number_ < EarlierContact::kMostIntervals) {
    kept_->intervals[number_].take(trial(), length);
    kept_->count = std::max(kept_->count, number_ + 1);
  }
  ++number_;
  ++interval_count_;
  const Bounds bounds = solver_.bounds(contact_, trial());
  if (!nothing_else_happens(trial(), bounds)) return Outcome::gives_up;
  displacement_bound_ = bounds.displacement;
  const Ending ending = this->ending(trial());
  const bool reaches_zero = trial().chord.time == 0.0;
  const bool stays_bent = bounds.gap_measure > 0.0 && (begins_ || trial().start_gap_measure > 0.0);
  if (!ending.under_load && !stays_bent) return Outcome::gives_up;
  // Time goes on up to the end of the contact.
  for (std::size_t i = 0; i + 1 < std::min(ending.place, kPlaces); ++i) {
    if (!(trial().time_slope[i] > 0.0) && !(reaches_zero && i + 1 == kNodes)) return Outcome::gives_up;
  }
  made_ = 1 - made_;
  if (ending.place < kPlaces) {
    const AtPlaces values = ending.under_load ? at_places(made().start_gap_measure, made().gap_measure)
                                              : at_places(made().start_argument, made().argument);
    if (!cut(crossing(values, ending.place), trial())) return Outcome::gives_up;
    made_ = 1 - made_;
  }
  rises_ = tangent_.argument > 0.0;
  end_at(made(), ending);
  gap_measure_ = made().gap_measure.at_end();
  slip_velocity_ = made().slip_velocity.at_end();
  if (!lifts_off_) take_direction(made());
  begins_ = false;
  return Outcome::made;
}

double ContactArc::fraction_at(double time) const {
  return collocation::fraction_at(made(), time - made().start_time);
}

ContactArc::Point ContactArc::solved_at(double time) {
  if (time <= start_.time) return start_;
  if (time >= end_.time) return end_;
  const double fraction = fraction_at(time);
  if (!cut(fraction, trial())) return point_at(fraction);
  Point point = end_of_stretch();
  const double late = time - point.time;
  const std::size_t last = kNodes - 1;
  point.time = time;
  point.state += late * rotor::State(point.state[2], point.state[3], trial().ax[last], trial().ay[last]);
  point.argument += late * trial().argument_slope[last] / trial().time_slope[last];
  return point;
}

ContactArc::Point ContactArc::solved_at_fraction(double fraction) {
  return cut(fraction, trial()) ? end_of_stretch() : point_at(fraction);
}

ContactArc::Point ContactArc::largest_bending() {
  return solved_at_fraction(fraction_of_largest_bending(made()));
}

ContactArc::Point ContactArc::end_of_stretch() const {
  return {trial().start_time + trial().elapsed.at_end(),
          {trial().x.at_end(), trial().y.at_end(), trial().vx.at_end(), trial().vy.at_end()},
          trial().argument.at_end()};
}

double ContactArc::argument_bound() const {
  if (!peaks()) return std::max(start_.argument, end_.argument);
  // Between the nodes p errs by a few times as much as velocities do, each against its own size.
  constexpr double kSafety = 100.0;
  return bound_of_largest_bending(made()) * (1.0 + kSafety * allowed_ / rotor_->length_scale);
}

double ContactArc::largest_displacement(double from, double to, double known) {
  if (!(displacement_bound_ > known)) return known;
  const double first = from <= start_.time ? 0.0 : fraction_at(from);
  const double last = to >= end_.time ? 1.0 : fraction_at(to);
  const Farthest there = farthest(made(), first, last);
  // Between the nodes a place errs by less than a velocity would move it in a unit of time.
  if (!(there.displacement + allowed_ > known)) return known;
  const Point point = there.fraction == first  ? solved_at(from)
                      : there.fraction == last ? solved_at(to)
                                               : solved_at_fraction(there.fraction);
  return std::max(known, length_of(point.state[0], point.state[1]));
}

std::array<double, 2> ContactArc::place_at(double fraction) const {
  const AtPlaces basis = basis_at(fraction);
  return {sum_of_products(basis, at_places(made().start[0], made().x)),
          sum_of_products(basis, at_places(made().start[1], made().y))};
}

ContactArc::Point ContactArc::point_at(double fraction) const {
  const AtPlaces basis = basis_at(fraction);
  const auto value = [&](double start, const AtNodes& nodes) {
    return sum_of_products(basis, at_places(start, nodes));
  };
  return {made().start_time + value(0.0, made().elapsed),
          {value(made().start[0], made().x), value(made().start[1], made().y),
           value(made().start[2], made().vx), value(made().start[3], made().vy)},
          value(made().start_argument, made().argument)};
}

double ContactArc::bending_at(double fraction) const {
  return table_->bending(
      sum_of_products(basis_at(fraction), at_places(made().start_argument, made().argument)));
}

bool ContactArc::peaks() const {
  return rises_ && made().argument_slope.at_end() < 0.0;
}

void ContactArc::shift_time(double period) {
  start_.time -= period;
  end_.time -= period;
  intervals_[made_].start_time -= period;
}

}  // namespace rubatlas::collocation
