#include "collocation/contact_arc.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "collocation/interval_samples.hpp"

namespace rubatlas::collocation {
namespace {

/// Error of a velocity between the nodes that is allowed at the tolerance ε, against the clearance: this
/// times ε^(9/14). The motion goes on from the ends of intervals, whose errors fall as about the fourteenth
/// power of the length where those between the nodes fall as the ninth; orders and factor come from an
/// experiment (`tests/collocation`). Whatever has to be accurate within an interval is solved for
/// (`state_at`).
constexpr double kBetweenNodes = 0.27;
constexpr double kOrderAtEnd = 14.0;
constexpr double kAtEnd = 1.0;            ///< tolerances: of that at the end, as far as it can be estimated
constexpr double kCareWithSeveral = 4.0;  ///< blades: coefficients fall less evenly
/// Between the nodes p and the loads err by a few times as much as velocities do, each against its own size.
constexpr double kSafety = 100.0;
constexpr double kClosest = 0.2;              ///< of the tolerance: what sweeps may leave
constexpr std::size_t kMostIntervals = 1000;  ///< of a contact that is shorter or longer than was predicted

/// Slope by θ of the polynomial through values at the places, just before θ.
double slope_before(const AtPlaces& values, double fraction) {
  constexpr double kApart = 1e-4;
  const double rise =
      sum_of_products(basis_at(fraction), values) - sum_of_products(basis_at(fraction - kApart), values);
  return rise / kApart;
}

/// Cosine and sine of the angle from one blade to another.
std::array<double, 2> offset_between(const contact::BladeDirection& from, const contact::BladeDirection& to) {
  return {to.cosine * from.cosine + to.sine * from.sine, to.sine * from.cosine - to.cosine * from.sine};
}

}  // namespace

ContactArc::ContactArc(const rotor::Machine& machine, ArcLaw& law, double tolerance)
    : whole_(&machine),
      rotor_(&machine.constants),
      blades_(&machine.blades),
      law_(&law),
      tolerance_(tolerance),
      machine_(machine, law.geometry(0).ring_radius),
      solver_(interval_solver()),
      predictor_(machine, law),
      contact_{&machine_.numbers(), nullptr, 1.0, law.leans()},
      allowed_(kBetweenNodes * rotor_->length_scale *
               std::pow(tolerance / rotor_->length_scale, Predictor::kOrder / kOrderAtEnd)),
      earlier_(machine.ring_body() != nullptr, law.geometry(0).reach, rotor_->length_scale) {
  for (int k = 0; k < blades_->count(); ++k) {
    offsets_.push_back(blades_->direction(k, {1.0, 0.0}));
    numbers_.push_back(law.numbers(k));
  }
}

contact::Pose ContactArc::pose(int blade, const Point& point) const {
  return rotor::pose_of(*rotor_, law_->geometry(blade), blades_->direction(blade, blades_->first(point.time)),
                        rotor::from_ring(point.bodies));
}

void ContactArc::begin(double time, const rotor::ShaftAndRing& bodies, std::span<const Touch> touching) {
  // Who touches down now is not the next to lift off.
  std::size_t leader = 0;
  while (leader + 1 < touching.size() && touching[leader].touches_down()) ++leader;
  if (touching[leader].touches_down()) leader = 0;
  lead_has_changed_ = false;
  lead(time, bodies, touching, leader);
}

void ContactArc::lead(double time, const rotor::ShaftAndRing& bodies, std::span<const Touch> touching,
                      std::size_t leader) {
  blade_ = touching[leader].blade;
  contact_.blade = &numbers(blade_);
  contact_.slip = touching[leader].slip;
  begins_ = true;
  ending_ = {};
  start_ = {time, bodies, law_->lead(touching[leader])};
  er_ = blades_->direction(blade_, blades_->first(time));
  const contact::BladeDirection& from = offsets_[static_cast<std::size_t>(blade_)];
  const auto offset_of = [&](int blade) {
    return offset_between(from, offsets_[static_cast<std::size_t>(blade)]);
  };
  further_.clear();
  for (const Touch& touch : touching) {
    if (touch.blade == blade_) continue;
    FurtherStart& start =
        further_.emplace_back(law_->further(touch, pose(touch.blade, start_), blades_->angular_speed(time)));
    start.offset = offset_of(touch.blade);
    start_.squares[further_.size() - 1] = start.square;
  }
  end_ = start_;
  others_.clear();
  for (int blade = 0; blade < blades_->count(); ++blade) {
    if (std::ranges::find(touching, blade, &Touch::blade) == touching.end())
      others_.push_back({blade, offset_of(blade)});
  }
  predict(touching[leader]);
  alike_ = nullptr;
  kept_ = nullptr;
  number_ = 0;
  if (further_.empty()) look_for_earlier();
}

void ContactArc::look_for_earlier() {
  Beginning beginning{.blade = {er_.cosine, er_.sine},
                      .angular_speed = blades_->angular_speed(end_.time),
                      .argument = end_.bending.argument,
                      .slip = contact_.slip};
  std::copy_n(end_.bodies.begin(), 4, beginning.shaft.begin());
  std::copy_n(end_.bodies.begin() + 4, 4, beginning.ring.begin());
  const std::complex<double> forcing = machine_.forcing(end_.time);
  beginning.forcing = {forcing.real(), forcing.imag()};
  const EarlierContacts::Found found = earlier_.find(beginning);
  alike_ = found.alike;
  kept_ = found.next;
}

/// What is known where the leading blade takes the lead.
void ContactArc::predict(const Touch& touch) {
  const double angular_speed = blades_->angular_speed(end_.time);
  const contact::Pose there = pose(blade_, end_);
  at_end_ = law_->start(touch, there, angular_speed);
  // A tip that has come loose slips from zero on in the direction of s.
  double& slip_velocity = at_end_.force.slip_velocity;
  if (contact_.slip != 0.0 && std::abs(slip_velocity) <= contact::kSlipRounding *
                                                             std::abs(rotor_->speed_ratio) *
                                                             machine().ring_radius)
    slip_velocity = std::copysign(std::numeric_limits<double>::min(), contact_.slip);
  std::complex<double> force = contact::on_rotor(at_end_.force, er_);
  for (const FurtherStart& further : further_) {
    const contact::BladeDirection er{er_.cosine * further.offset[0] - er_.sine * further.offset[1],
                                     er_.sine * further.offset[0] + er_.cosine * further.offset[1]};
    force += contact::on_rotor(further.force, er);
  }
  const rotor::RingBody* ring = whole_->ring_body();
  const rotor::RingContactState full = rotor::full_state(end_.bodies, end_.time, 0.0);
  predictor_.begin(
      {.touch = touch,
       .blade = contact_.blade,
       .ring_radius = machine().ring_radius,
       .angular_speed = angular_speed,
       .bodies = end_.bodies,
       .pose = there,
       .direction = er_,
       .bending = end_.bending,
       .gap_measure = at_end_.gap_measure,
       .shaft_acceleration = whole_->shaft.shaft_acceleration(*rotor_, full, force),
       .ring_acceleration = ring != nullptr ? ring->acceleration(rotor::ring(end_.bodies), -force) : 0.0});
}

void ContactArc::start_next(Interval& next) const {
  next.start_time = end_.time;
  next.start_argument = end_.bending.argument;
  std::copy_n(end_.bodies.begin(), 4, next.shaft.start.begin());
  std::copy_n(end_.bodies.begin() + 4, 4, next.ring.start.begin());
  next.blade = {er_.cosine, er_.sine};
  machine_.start(next);
  next.start_gap_measure = at_end_.gap_measure;
  next.start_slip_velocity = at_end_.force.slip_velocity;
  next.further_count = further_.size();
  if (!contact_.leans) return;
  next.start_lean = end_.bending.lean;
  next.start_shortening = at_end_.force.shortening;
  next.start_chart_left = at_end_.chart_left;
  next.start_cone_left = at_end_.cone_left;
  next.start_force = at_end_.force.normal;
  next.start_strain = at_end_.force.root_strain;
}

bool ContactArc::solve(Interval& interval, bool warm) {
  const bool solved = law_->solve(contact_, {kClosest * tolerance_, warm}, interval);
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
  const double fall = last > 0.0 ? std::min(1.0, std::sqrt(last / std::max(fifth, last))) : 0.0;
  const double between = std::max(seventh, kShareOfSixth * sixth * fall) * fall * kLargestIntegral;
  // Quadrature leaves out the fifteenth coefficient at the end: much less, unless coefficients hardly fall.
  const double fall_by_four = (fall * fall) * (fall * fall);
  const double at_end = last * fall_by_four * fall_by_four * kLargestIntegral;
  double error = std::max(between / allowed_, at_end / (kAtEnd * tolerance_));
  if (interval.further_count > 0) error *= kCareWithSeveral;
  const double length = interval.elapsed.at_end() / machine_.longest_interval();
  return length > 1.0 ? std::max(error, std::pow(length, Predictor::kOrder)) : error;
}

/// No slip reverses but the one that ends the interval, no blade snaps, the shaft stays within the ring and
/// the blades within their limit.
bool ContactArc::stays_valid(const Bounds& bounds, const Ending& ending) const {
  const auto is_valid = [&](int blade, double slip_velocity, double argument) {
    const bool reverses = ending.guard == Guard::slip_reversal && ending.blade == blade;
    return (slip_velocity > (reverses ? -rounding_at_end_ : 0.0) || !slips()) &&
           argument < law_->valid_argument(blade);
  };
  if (!(bounds.distance < machine().ring_radius)) return false;
  if (!is_valid(blade_, bounds.slip_velocity[0], bounds.argument)) return false;
  for (std::size_t k = 0; k < further_.size(); ++k) {
    if (!is_valid(further_[k].blade, bounds.slip_velocity[1 + k], bounds.further_argument[k])) return false;
  }
  if (contact_.slip == 0.0 && !(bounds.cone_left > 0.0)) return false;
  return !contact_.leans || (bounds.time_slope > 0.0 && bounds.chart_left > 0.0);
}

/// The first guard of the blades in contact.
ContactArc::Ending ContactArc::guard_of_contacts(const Interval& interval) const {
  Ending first;
  std::size_t place_of_first = kPlaces;
  // A quantity that is positive while the contact lasts, at the first `count` nodes.
  const auto look = [&](Guard guard, int blade, double start, const AtNodes& nodes, double sign,
                        std::size_t count = kNodes) {
    std::size_t node = 0;
    while (node < count && !(sign * nodes[node] < 0.0)) ++node;
    if (node == count || node + 1 > place_of_first) return;
    AtPlaces values = at_places(start, nodes);
    for (double& value : values) value *= sign;
    if (guard == Guard::slip_reversal && !(values[node] > 0.0)) return;  // it slips back from the start on
    const double fraction = crossing(values, node + 1);
    if (node + 1 < place_of_first || fraction < first.fraction) {
      first = {guard, fraction, blade, slope_before(values, fraction)};
      place_of_first = node + 1;
    }
  };
  const bool releases_at_fold = law_->releases_at_fold(blade_);
  if (!releases_at_fold)
    look(Guard::under_load, blade_, interval.start_gap_measure, interval.gap_measure, 1.0);
  // Over p itself the last node is the unbent blade.
  const std::size_t count = interval.chord.time == 0.0 ? kNodes - 1 : kNodes;
  look(Guard::unbent, blade_, interval.start_argument, interval.argument, 1.0, count);
  if (releases_at_fold || law_->has_branches(blade_))
    look(Guard::fold, blade_, sum_of_products(node_tables().value_at_start, interval.time_slope),
         interval.time_slope, 1.0, count);
  if (contact_.leans) look(Guard::chart_end, blade_, interval.start_chart_left, interval.chart_left, 1.0);
  if (contact_.slip == 0.0) look(Guard::loosening, blade_, interval.start_cone_left, interval.cone_left, 1.0);
  if (!slips()) return first;
  look(Guard::slip_reversal, blade_, interval.start_slip_velocity, interval.slip_velocity, contact_.slip);
  for (std::size_t k = 0; k < further_.size(); ++k) {
    const FurtherBlade& further = interval.further[k];
    look(Guard::slip_reversal, further_[k].blade, further.start_slip_velocity, further.slip_velocity,
         further.slip);
  }
  return first;
}

/// The first touch-down of another blade, if it comes before this ending. None where it cannot be told.
std::optional<ContactArc::Ending> ContactArc::touch_down(const Interval& interval, Ending before) {
  gap_bound_of_others_ = -std::numeric_limits<double>::infinity();
  for (const Other& other : others_) {
    const Blade& blade = numbers(other.blade);
    const double bound = solver_.largest_gap(contact_, interval, blade, other.offset);
    gap_bound_of_others_ = std::max(gap_bound_of_others_, bound);
    if (bound < 0.0) continue;
    const auto clear_of_ring = [&](double x, double y, double er_x, double er_y) {
      const double centre = y + machine().misalignment;
      const double along = er_x * other.offset[0] - er_y * other.offset[1];
      const double across = er_y * other.offset[0] + er_x * other.offset[1];
      return -(x * x + centre * centre + 2.0 * blade.reach * (x * along + centre * across) + blade.closing);
    };
    const Body& shaft = interval.shaft;
    const Body& ring = interval.ring;
    AtPlaces values;
    values[0] = clear_of_ring(shaft.start[0] - ring.start[0], shaft.start[1] - ring.start[1],
                              interval.blade[0], interval.blade[1]);
    std::size_t place = kPlaces;
    for (std::size_t i = 0; i < kNodes; ++i) {
      values[i + 1] = clear_of_ring(shaft.x[i] - ring.x[i], shaft.y[i] - ring.y[i], interval.blade_x[i],
                                    interval.blade_y[i]);
      if (place == kPlaces && values[i + 1] < 0.0) place = i + 1;
    }
    // It may come near the ring without touching it, or it touches at the start: shorter intervals tell.
    if (place == kPlaces || (place == 1 && !(values[0] > 0.0))) return std::nullopt;
    const double fraction = crossing(values, place);
    if (fraction < before.fraction)
      before = {Guard::touch_down, fraction, other.blade, slope_before(values, fraction)};
  }
  return before;
}

/// The stretch of an interval up to θ, solved for itself.
bool ContactArc::cut(const Interval& whole, double fraction, Interval& shorter) {
  shorter.start_time = whole.start_time;
  shorter.start_argument = whole.start_argument;
  shorter.shaft.start = whole.shaft.start;
  shorter.ring.start = whole.ring.start;
  shorter.blade = whole.blade;
  shorter.start_angular_speed = whole.start_angular_speed;
  std::copy_n(whole.forcing.begin(), machine().forcing_count, shorter.forcing.begin());
  shorter.ripple = whole.ripple;
  shorter.start_gap_measure = whole.start_gap_measure;
  shorter.start_slip_velocity = whole.start_slip_velocity;
  if (contact_.leans) {
    shorter.start_lean = whole.start_lean;
    shorter.start_shortening = whole.start_shortening;
    shorter.start_chart_left = whole.start_chart_left;
    shorter.start_cone_left = whole.start_cone_left;
    shorter.start_force = whole.start_force;
    shorter.start_strain = whole.start_strain;
  }
  shorter.further_count = whole.further_count;
  for (std::size_t k = 0; k < whole.further_count; ++k) {
    shorter.further[k].blade = whole.further[k].blade;
    shorter.further[k].offset = whole.further[k].offset;
    shorter.further[k].slip = whole.further[k].slip;
    shorter.further[k].start_square = whole.further[k].start_square;
    shorter.further[k].start_gap_measure = whole.further[k].start_gap_measure;
    shorter.further[k].start_slip_velocity = whole.further[k].start_slip_velocity;
  }
  shorter.chord = {fraction * whole.chord.time, fraction * whole.chord.argument};
  shorter.normal = whole.normal;
  read_stretch(contact_, whole, fraction, shorter);
  return solve(shorter, true);
}

/// What is left of the guard's quantity at the end of an interval that it ends.
double ContactArc::left_at_end(const Ending& ending, const Interval& interval) const {
  switch (ending.guard) {
    case Guard::touch_down:
      return -pose(ending.blade, end_of(interval)).gap;
    case Guard::under_load:
      return interval.gap_measure.at_end();
    case Guard::unbent:
      return interval.argument.at_end();
    case Guard::fold:
      return interval.time_slope.at_end();
    case Guard::chart_end:
      return interval.chart_left.at_end();
    case Guard::loosening:
      return interval.cone_left.at_end();
    default: {
      if (ending.blade == blade_) return contact_.slip * interval.slip_velocity.at_end();
      const FurtherBlade& further = interval.further[number_of(ending.blade)];
      return further.slip * further.slip_velocity.at_end();
    }
  }
}

/// The same up to a guard, which the polynomials have only as accurately as velocities between the nodes.
bool ContactArc::cut_at(const Interval& whole, Ending& ending, Interval& shorter) {
  constexpr int kTimes = 4;
  constexpr double kClosestFraction = 1e-11;
  // At a fold time stands still, and where no force is left nothing is missed in a moment.
  const bool once = ending.guard == Guard::fold || (ending.guard == Guard::unbent && further_.empty());
  for (int i = 0; i < kTimes; ++i) {
    if (!cut(whole, ending.fraction, shorter)) return false;
    if (once) break;
    const double left = left_at_end(ending, shorter);
    rounding_at_end_ = 2.0 * std::abs(left);
    const double less = left / ending.slope;
    if (!(std::abs(less) > kClosestFraction) || ending.fraction - less > 1.0) break;
    ending.fraction -= less;
    if (!(ending.fraction > 0.0)) return false;
  }
  return true;
}

void ContactArc::move(Point& point, const Interval& interval, double late) {
  const Body& shaft = interval.shaft;
  const Body& ring = interval.ring;
  rotor::ShaftAndRing rate;
  rate << point.bodies[2], point.bodies[3], shaft.ax.at_end(), shaft.ay.at_end(), point.bodies[6],
      point.bodies[7], ring.ax.at_end(), ring.ay.at_end();
  point.time += late;
  point.bodies += late * rate;
  if (point.bending.argument > 0.0)
    point.bending.argument += late * interval.argument_slope.at_end() / interval.time_slope.at_end();
}

/// The end of an interval: of the contact, or at a touch-down, to rounding, where one ends it.
void ContactArc::end_at(const Interval& interval, const Ending& ending) {
  start_ = end_;
  end_ = end_of(interval);
  er_ = {interval.blade_x.at_end(), interval.blade_y.at_end()};
  ending_ = ending;
  if (ending.guard == Guard::none && interval.chord.time == 0.0) ending_ = {Guard::unbent, 1.0, blade_, 0.0};
  // To where the gap of a blade is zero: in time, and what is left, or all where the tip hardly moves against
  // the ring, the shortest way for the shaft.
  const auto goes_on_to_ring = [&](int blade) {
    constexpr int kTimes = 2;
    constexpr double kFarthest = 0.1;  // of the interval
    for (int i = 0; i < kTimes; ++i) {
      const contact::Pose there = pose(blade, end_);
      const double late =
          -there.gap / contact::gap_rate(law_->geometry(blade), there, blades_->angular_speed(end_.time));
      if (std::abs(late) < kFarthest * interval.elapsed.at_end()) move(end_, interval, late);
    }
    const double radius = machine().ring_radius;
    const double left = pose(blade, end_).gap / (2.0 * radius);
    if (!(std::abs(left) < tolerance_)) return;
    const contact::BladeDirection er = blades_->direction(blade, blades_->first(end_.time));
    const rotor::State seen = rotor::from_ring(end_.bodies);
    const double reach = numbers(blade).reach;
    end_.bodies[0] -= left * (seen[0] + reach * er.cosine) / radius;
    end_.bodies[1] -= left * (seen[1] + rotor_->misalignment + reach * er.sine) / radius;
  };
  switch (ending_.guard) {
    case Guard::unbent:
      move(end_, interval,
           -end_.bending.argument * interval.time_slope.at_end() / interval.argument_slope.at_end());
      end_.bending.argument = 0.0;
      goes_on_to_ring(blade_);
      break;
    case Guard::under_load:
    case Guard::touch_down:
      goes_on_to_ring(ending_.blade);
      break;
    default:
      break;
  }
}

void ContactArc::guess_further(Interval& next) const {
  AtNodes elapsed;
  const AtNodes& node = node_tables().node;
  for (std::size_t i = 0; i < kNodes; ++i)
    elapsed[i] = node[i] * next.chord.time + next.deviation[i] * next.normal.time;
  for (std::size_t k = 0; k < further_.size(); ++k) {
    next.further[k].blade = &numbers(further_[k].blade);
    guess(further_[k], elapsed, next.further[k]);
  }
}

/// Makes the trial a solution that is accurate enough.
bool ContactArc::solve_next() {
  while (true) {
    Interval& next = trial();
    start_next(next);
    const bool follows = alike_ != nullptr && number_ < alike_->count;
    if (follows) {
      predictor_.follow(alike_->intervals[number_].length);
      alike_->intervals[number_].guess(contact_, next);
    } else {
      predictor_.guess(next);
    }
    if (!further_.empty()) guess_further(next);
    const bool solved = solve(next, follows);
    const double error = solved ? error_of(next) : Predictor::kUnknownError;
    if (error <= 1.0) {
      predictor_.accepts(error, begins_ && !follows ? &next : nullptr);
      return true;
    }
    ++rejected_;
    if (follows) {
      leave_earlier();
    } else if (!predictor_.shortens(error)) {
      return false;
    }
  }
}

/// The earlier contact is followed no longer.
void ContactArc::leave_earlier() {
  alike_ = nullptr;
  if (kept_ != nullptr) kept_->count = number_;
}

/// Whether a fold is the lift-off of an unbent blade: time stands still there, too, so that rounding, or an
/// error between the nodes where there can be no fold, is taken for one.
bool ContactArc::is_next_to_unbent(const Interval& interval) const {
  constexpr double kNext = 1e-4;  // p: the force is some 1e-9 of EI/L²
  constexpr double kNear = 0.03;
  if (contact_.leans && !(interval.lean.at_end() > 0.0)) return false;  // it is bent against its load
  const double argument = interval.argument.at_end();
  return argument < kNext ||
         (argument < kNear && law_->starts_unloaded(blade_, contact_.slip, pose(blade_, end_of(interval))));
}

/// The blade of a tip at rest is no straight strut between hub and ring.
bool ContactArc::is_held_firmly(const Interval& interval) const {
  constexpr double kLeastModulus = 1e-3;  // κ
  for (std::size_t i = 0; i < kNodes; ++i) {
    const Bending bending{interval.argument[i], interval.lean[i]};
    if (!(std::abs(law_->touch(blade_, 0.0, bending).bend.modulus) > kLeastModulus)) return false;
  }
  return true;
}

ContactArc::Verdict ContactArc::judge(Ending& ending) {
  const Interval& next = trial();
  const bool reaches_zero = next.chord.time == 0.0;
  Bounds bounds = law_->bounds(contact_, next);
  const auto first = touch_down(next, guard_of_contacts(next));
  if (!first) return Verdict::too_long;
  ending = *first;
  const bool in_part = ending.guard != Guard::none;
  Interval& part = intervals_[made_];  // what has been made before is not asked for again
  if (in_part) {
    if (!cut_at(next, ending, part)) return Verdict::gives_up;
    // Beyond its ending the interval is no motion.
    const bool lifts = ending.guard == Guard::unbent || ending.guard == Guard::under_load;
    if (!lifts || !further_.empty() || !stays_valid(bounds, ending)) bounds = law_->bounds(contact_, part);
    // The tip that touches is at the ring at the end.
    const double at_ring = 2.0 * machine().ring_radius * tolerance_;
    gap_bound_of_others_ = -std::numeric_limits<double>::infinity();
    for (const Other& other : others_) {
      const double bound = solver_.largest_gap(contact_, part, numbers(other.blade), other.offset);
      gap_bound_of_others_ = std::max(gap_bound_of_others_, bound);
      if (!(bound < (other.blade == ending.blade ? at_ring : 0.0))) return Verdict::too_long;
    }
  }
  // Close to a fold bounds of shorter intervals tell.
  if (!stays_valid(bounds, ending)) return contact_.leans ? Verdict::too_long : Verdict::gives_up;
  displacement_bound_ = bounds.displacement;
  const bool held_beyond_ring = law_->releases_at_fold(blade_);
  const bool stays_bent = bounds.gap_measure > 0.0 && (begins_ || next.start_gap_measure > 0.0);
  if (ending.guard != Guard::under_load && !held_beyond_ring && !stays_bent) return Verdict::gives_up;
  const Interval& kept = in_part ? part : next;
  if (ending.guard == Guard::fold && is_next_to_unbent(kept)) ending.guard = Guard::unbent;
  // A tip at rest whose blade unbends, or which is about to be no longer firm, is for steps to follow.
  if (contact_.slip == 0.0 && (ending.guard == Guard::unbent || ending.guard == Guard::fold ||
                               ending.guard == Guard::chart_end || !is_held_firmly(kept)))
    return Verdict::gives_up;
  // At a fold a tip is free only outside the ring, or it snaps.
  if (ending.guard == Guard::fold && !law_->has_branches(blade_) && !(pose(blade_, end_of(kept)).gap < 0.0))
    return Verdict::gives_up;
  // Time goes on.
  for (std::size_t i = 0; i < kNodes; ++i) {
    const bool may_turn = i + 1 == kNodes && (reaches_zero || in_part);
    if (!(kept.time_slope[i] > 0.0) && !may_turn) return Verdict::gives_up;
  }
  for (std::size_t k = 0; k < further_.size(); ++k) {
    if (bounds.stays[k]) continue;
    if (lead_has_changed_) return Verdict::too_long;
    change_leader(k);
    return Verdict::another_leads;
  }
  return in_part ? Verdict::holds_in_part : Verdict::holds;
}

/// Another blade leads from where the last interval has ended.
void ContactArc::change_leader(std::size_t further) {
  std::vector<Touch> touching{law_->touch(blade_, contact_.slip, end_.bending)};
  for (const FurtherStart& start : further_)
    touching.push_back(law_->touch(start.blade, start.slip, {std::sqrt(start.square)}));
  lead(end_.time, rotor::ShaftAndRing(end_.bodies), touching, further + 1);
  lead_has_changed_ = true;
}

ContactArc::Outcome ContactArc::make() {
  if (number_ >= kMostIntervals || predictor_.is_too_short()) return Outcome::gives_up;
  predictor_.begin_interval();
  while (true) {
    if (!solve_next()) return Outcome::gives_up;
    if (kept_ != nullptr && number_ < EarlierContact::kMostIntervals) {
      kept_->intervals[number_].take(contact_, trial(), predictor_.length_of_trial());
      kept_->count = std::max(kept_->count, number_ + 1);
    }
    Ending ending;
    const Verdict verdict = judge(ending);
    if (verdict == Verdict::gives_up) return Outcome::gives_up;
    if (verdict == Verdict::holds || verdict == Verdict::holds_in_part) {
      if (verdict == Verdict::holds) made_ = 1 - made_;
      goes_on(ending);
      return Outcome::made;
    }
    ++rejected_;
    if (verdict == Verdict::another_leads) {
      predictor_.begin_interval();
    } else {
      leave_earlier();
      if (!predictor_.shortens(Predictor::kUnknownError)) return Outcome::gives_up;
    }
  }
}

/// From the interval that has been made to the next.
void ContactArc::goes_on(const Ending& ending) {
  ++number_;
  ++interval_count_;
  end_at(made(), ending);
  at_end_.gap_measure = made().gap_measure.at_end();
  at_end_.force.slip_velocity = made().slip_velocity.at_end();
  if (contact_.leans) {
    at_end_.force.shortening = made().shortening.at_end();
    at_end_.chart_left = made().chart_left.at_end();
    at_end_.cone_left = made().cone_left.at_end();
    at_end_.force.normal = made().normal_force.at_end();
    at_end_.force.root_strain = made().root_strain.at_end();
  }
  for (std::size_t k = 0; k < further_.size(); ++k) go_on(made(), made().further[k], further_[k]);
  if (ending_.guard == Guard::none) predictor_.goes_on(made());
  begins_ = false;
  lead_has_changed_ = false;
}

double ContactArc::fraction_at(double time) const {
  return collocation::fraction_at(made(), time - made().start_time);
}
/// θ of a time, or of the end, which may lie before that of the interval (`end_at`).
double ContactArc::last_fraction(double time) const {
  const bool whole = time >= end_.time && end_.time >= made().start_time + made().elapsed.at_end();
  return whole ? 1.0 : fraction_at(std::min(time, end_.time));
}

ContactArc::Point ContactArc::solved_at(double time) {
  if (time <= start_.time) return start_;
  if (time >= end_.time) return end_;
  const double fraction = fraction_at(time);
  if (!cut(made(), fraction, trial())) return point_at(fraction);
  Point point = end_of(trial());
  move(point, trial(), time - point.time);
  point.time = time;
  return point;
}

ContactArc::Point ContactArc::solved_at_fraction(double fraction) {
  if (fraction == 0.0) return start_;
  if (fraction == 1.0) return end_;
  return cut(made(), fraction, trial()) ? end_of(trial()) : point_at(fraction);
}

ContactArc::Point ContactArc::end_of(const Interval& interval) {
  const Body& shaft = interval.shaft;
  const Body& ring = interval.ring;
  Point end{.time = interval.start_time + interval.elapsed.at_end(),
            .bending = {interval.argument.at_end(), interval.lean.at_end()}};
  end.bodies << shaft.x.at_end(), shaft.y.at_end(), shaft.vx.at_end(), shaft.vy.at_end(), ring.x.at_end(),
      ring.y.at_end(), ring.vx.at_end(), ring.vy.at_end();
  for (std::size_t k = 0; k < interval.further_count; ++k)
    end.squares[k] = interval.further[k].square.at_end();
  return end;
}

ContactArc::Stretch ContactArc::stretch(double from, double to) const {
  return {from, to, from <= start_.time ? 0.0 : fraction_at(from), last_fraction(to)};
}
/// At θ of a stretch. The time of θ errs between the nodes: the ends of the stretch are those times.
ContactArc::Point ContactArc::solved_in(const Stretch& stretch, double fraction) {
  return fraction == stretch.first  ? solved_at(stretch.from)
         : fraction == stretch.last ? solved_at(stretch.to)
                                    : solved_at_fraction(fraction);
}

std::optional<ContactArc::Point> ContactArc::most_bent(int blade, double from, double to, double known) {
  const double bound = 1.0 + kSafety * allowed_ / rotor_->length_scale;
  const double least = known / bound;
  const Stretch within = stretch(from, to);
  const FurtherBlade* further = blade == blade_ ? nullptr : &made().further[number_of(blade)];
  const AtPlaces values = further != nullptr ? at_places(further->start_square, further->square)
                                             : at_places(made().start_argument, made().argument);
  const auto most = largest_of(values, within.first, within.last, further != nullptr ? least * least : least);
  const double argument = further != nullptr ? std::sqrt(std::max(0.0, most.value)) : most.value;
  if (bound * argument <= known) return std::nullopt;
  return solved_in(within, most.argument);
}

std::optional<ContactArc::Point> ContactArc::most_loaded(const AtNodes Interval::*load,
                                                         double Interval::*at_start, double from, double to,
                                                         double known) {
  const Stretch within = stretch(from, to);
  const AtPlaces values = at_places(made().*at_start, made().*load);
  const double error =
      kSafety * allowed_ / rotor_->length_scale * *std::max_element(values.begin(), values.end());
  const auto most = largest_of(values, within.first, within.last, known - error);
  if (most.value + error <= known) return std::nullopt;
  return solved_in(within, most.argument);
}

double ContactArc::largest_displacement(double from, double to, double known) {
  if (!(displacement_bound_ > known)) return known;
  const Stretch within = stretch(from, to);
  const Farthest there = farthest(made(), within.first, within.last);
  // Between the nodes a place errs by less than a velocity would move it in a unit of time.
  if (!(there.displacement + allowed_ > known)) return known;
  const rotor::ShaftAndRing bodies = solved_in(within, there.fraction).bodies;
  return std::max(known, std::sqrt(bodies[0] * bodies[0] + bodies[1] * bodies[1]));
}

std::array<double, 2> ContactArc::place_at(double fraction) const {
  const AtPlaces basis = basis_at(fraction);
  const Body& shaft = made().shaft;
  return {sum_of_products(basis, at_places(shaft.start[0], shaft.x)),
          sum_of_products(basis, at_places(shaft.start[1], shaft.y))};
}

ContactArc::Point ContactArc::point_at(double fraction) const {
  const AtPlaces basis = basis_at(fraction);
  const auto value = [&](double start, const AtNodes& nodes) {
    return sum_of_products(basis, at_places(start, nodes));
  };
  const Body& shaft = made().shaft;
  const Body& ring = made().ring;
  Point point{.time = made().start_time + value(0.0, made().elapsed),
              .bending = {value(made().start_argument, made().argument)}};
  if (contact_.leans) point.bending.lean = value(made().start_lean, made().lean);
  const auto place = [&](const Body& body, Eigen::Index first) {
    point.bodies.segment<4>(first) << value(body.start[0], body.x), value(body.start[1], body.y),
        value(body.start[2], body.vx), value(body.start[3], body.vy);
  };
  place(shaft, 0);
  if (machine().ring.moves) place(ring, 4);
  for (std::size_t k = 0; k < made().further_count; ++k)
    point.squares[k] = value(made().further[k].start_square, made().further[k].square);
  return point;
}

ArcLaw::Tangent ContactArc::direction_at(double fraction) const {
  const AtNodes basis = slope_basis_at(fraction);
  ArcLaw::Tangent tangent{sum_of_products(basis, made().time_slope),
                          sum_of_products(basis, made().argument_slope), 0.0};
  if (contact_.leans) {
    AtNodes slopes{};
    for (std::size_t j = 0; j < kNodes; ++j) {
      for (std::size_t i = 0; i < kNodes; ++i)
        slopes[i] += node_tables().slope[j][i] * (made().lean[j] - made().start_lean);
    }
    tangent.lean = sum_of_products(basis, slopes);
  }
  return tangent;
}

std::size_t ContactArc::number_of(int blade) const {
  std::size_t number = 0;
  while (further_[number].blade != blade) ++number;
  return number;
}

Bending ContactArc::bending_of(int blade, const Point& point) const {
  if (blade == blade_) return point.bending;
  return {std::sqrt(std::max(0.0, point.squares[number_of(blade)]))};
}
Touch ContactArc::touch_of(int blade, const Point& point) const {
  const double slip = blade == blade_ ? contact_.slip : further_[number_of(blade)].slip;
  return law_->touch(blade, slip, bending_of(blade, point));
}

std::optional<TipTop> ContactArc::top_of_tip(int blade) const {
  const auto& from = offsets_[static_cast<std::size_t>(blade_)];
  const auto& to = offsets_[static_cast<std::size_t>(blade)];
  const auto offset = blade == blade_ ? std::array{1.0, 0.0} : offset_between(from, to);
  return collocation::top_of_tip(machine(), made(), numbers(blade), offset);
}

void ContactArc::shift_time(double period) {
  start_.time -= period;
  end_.time -= period;
  intervals_[made_].start_time -= period;
}

}  // namespace rubatlas::collocation
