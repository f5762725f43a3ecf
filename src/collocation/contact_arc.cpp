#include "collocation/contact_arc.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

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
constexpr double kClosest = 0.2;          ///< of the tolerance: what sweeps may leave
constexpr std::size_t kMostIntervals = 1000;  ///< of a contact that is shorter or longer than was predicted

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
      predictor_(rotor, law),
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
               std::pow(limits.tolerance / rotor.length_scale, Predictor::kOrder / kOrderAtEnd)),
      earlier_(law.geometry().reach, rotor.length_scale) {
  for (int k = 0; k < blades.count(); ++k) offsets_.push_back(blades.direction(k, {1.0, 0.0}));
  const auto& knots = table_->knots();
  const auto beyond = std::find_if(knots.begin(), knots.end(), [&](const blade::BendingTable::Knot& knot) {
    return knot.shortening > limits.max_shortening;
  });
  valid_argument_ = beyond == knots.begin() ? 0.0 : std::prev(beyond)->argument;
}

void ContactArc::begin(double time, const rotor::State& state, std::span<const Touch> touching) {
  // Who touches down now is not the next to lift off.
  std::size_t leader = 0;
  while (leader + 1 < touching.size() && touching[leader].bending == 0.0) ++leader;
  if (touching[leader].bending == 0.0) leader = 0;
  lead_has_changed_ = false;
  lead(time, state, touching, leader);
}

void ContactArc::lead(double time, const rotor::State& state, std::span<const Touch> touching,
                      std::size_t leader) {
  blade_ = touching[leader].blade;
  contact_.slip = touching[leader].slip;
  begins_ = true;
  lifts_off_ = false;
  touches_ = -1;
  start_ = {time, state, table_->argument(touching[leader].bending)};
  const contact::BladeDirection first = blades_->first(time);
  er_ = blades_->direction(blade_, first);
  const contact::BladeDirection& from = offsets_[static_cast<std::size_t>(blade_)];
  const auto offset_of = [&](int blade) {
    const contact::BladeDirection& to = offsets_[static_cast<std::size_t>(blade)];
    return std::array{to.cosine * from.cosine + to.sine * from.sine,
                      to.sine * from.cosine - to.cosine * from.sine};
  };
  further_.clear();
  for (const Touch& touch : touching) {
    if (touch.blade == blade_) continue;
    const contact::BladeDirection er = blades_->direction(touch.blade, first);
    const contact::Pose pose = rotor::pose_of(*rotor_, law_->geometry(), er, state);
    FurtherStart& start = further_.emplace_back(further_start(*law_, pose, touch, rotor_->speed_ratio));
    start.offset = offset_of(touch.blade);
    start_.squares[further_.size() - 1] = start.square;
  }
  end_ = start_;
  others_.clear();
  for (int blade = 0; blade < blades_->count(); ++blade) {
    if (std::ranges::find(touching, blade, &Touch::blade) == touching.end())
      others_.push_back({blade, offset_of(blade)});
  }
  predict();
  alike_ = nullptr;
  kept_ = nullptr;
  number_ = 0;
  if (further_.empty()) look_for_earlier();
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
}

/// What is known where the leading blade takes the lead.
void ContactArc::predict() {
  const contact::Pose pose = rotor::pose_of(*rotor_, law_->geometry(), er_, end_.state);
  const double bending = table_->bending(end_.argument);
  const auto there = law_->constraint(pose, contact_.slip, bending, rotor_->speed_ratio);
  gap_measure_ = law_->gap_per_deflection(pose, contact_.slip, bending);
  slip_velocity_ = there.force.slip_velocity;
  std::complex<double> acceleration =
      rotor::shaft_acceleration(*rotor_, end_.state, contact::on_rotor(there.force, er_));
  for (const FurtherStart& further : further_) {
    const contact::BladeDirection er{er_.cosine * further.offset[0] - er_.sine * further.offset[1],
                                     er_.sine * further.offset[0] + er_.cosine * further.offset[1]};
    acceleration += rotor_->force_unit * contact::on_rotor(further.force, er);
  }
  if (unbalance_ != nullptr) acceleration += unbalance_->acceleration(end_.time);
  predictor_.begin({end_.state, pose, er_, contact_.slip, bending, end_.argument, acceleration, there});
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
  next.start_gap_measure = gap_measure_;
  next.start_slip_velocity = slip_velocity_;
  next.further_count = further_.size();
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
  const double error = std::max(between / allowed_, at_end / (kAtEnd * limits_.tolerance));
  return interval.further_count > 0 ? kCareWithSeveral * error : error;
}

/// No slip reverses, the shaft stays within the ring and the blades within their limit.
bool ContactArc::stays_valid(const Bounds& bounds) const {
  return bounds.distance < contact_.ring_radius && bounds.slip_velocity > 0.0 &&
         bounds.argument < valid_argument_;
}

ContactArc::Ending ContactArc::lift_off(const Interval& interval) const {
  const bool reaches_zero = interval.chord.time == 0.0;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const bool last = i + 1 == kNodes;
    if (interval.gap_measure[i] < 0.0) {
      return {Ending::Kind::under_load,
              crossing(at_places(interval.start_gap_measure, interval.gap_measure), i + 1), blade_};
    }
    if (interval.argument[i] < 0.0 && !(reaches_zero && last)) {
      return {Ending::Kind::unbent, crossing(at_places(interval.start_argument, interval.argument), i + 1),
              blade_};
    }
  }
  return {};
}

/// The first touch-down of another blade, if it comes before this ending. None where it cannot be told.
std::optional<ContactArc::Ending> ContactArc::touch_down(const Interval& interval, Ending before) {
  gap_bound_of_others_ = -std::numeric_limits<double>::infinity();
  for (const Other& other : others_) {
    const double bound = solver_.largest_gap(contact_, interval, other.offset);
    gap_bound_of_others_ = std::max(gap_bound_of_others_, bound);
    if (bound < 0.0) continue;
    const auto clear_of_ring = [&](double x, double y, double er_x, double er_y) {
      const double centre = y + contact_.misalignment;
      const double along = er_x * other.offset[0] - er_y * other.offset[1];
      const double across = er_y * other.offset[0] + er_x * other.offset[1];
      return -(x * x + centre * centre + 2.0 * contact_.reach * (x * along + centre * across) +
               contact_.closing);
    };
    AtPlaces values;
    values[0] = clear_of_ring(interval.start[0], interval.start[1], interval.blade[0], interval.blade[1]);
    std::size_t place = kPlaces;
    for (std::size_t i = 0; i < kNodes; ++i) {
      values[i + 1] = clear_of_ring(interval.x[i], interval.y[i], interval.blade_x[i], interval.blade_y[i]);
      if (place == kPlaces && values[i + 1] < 0.0) place = i + 1;
    }
    // It may come near the ring without touching it, or it touches at the start: shorter intervals tell.
    if (place == kPlaces || (place == 1 && !(values[0] > 0.0))) return std::nullopt;
    const double fraction = crossing(values, place);
    if (fraction < before.fraction) before = {Ending::Kind::touch_down, fraction, other.blade};
  }
  return before;
}

/// The stretch of an interval up to θ, solved for itself.
bool ContactArc::cut(const Interval& whole, double fraction, Interval& shorter) {
  shorter.start_time = whole.start_time;
  shorter.start_argument = whole.start_argument;
  shorter.start = whole.start;
  shorter.blade = whole.blade;
  shorter.forcing = whole.forcing;
  shorter.start_gap_measure = whole.start_gap_measure;
  shorter.start_slip_velocity = whole.start_slip_velocity;
  shorter.further_count = whole.further_count;
  for (std::size_t k = 0; k < whole.further_count; ++k) {
    shorter.further[k].offset = whole.further[k].offset;
    shorter.further[k].slip = whole.further[k].slip;
    shorter.further[k].start_square = whole.further[k].start_square;
    shorter.further[k].start_gap_measure = whole.further[k].start_gap_measure;
    shorter.further[k].start_slip_velocity = whole.further[k].start_slip_velocity;
  }
  shorter.chord = {fraction * whole.chord.time, fraction * whole.chord.argument};
  shorter.normal = whole.normal;
  read_stretch(whole, fraction, shorter);
  return solve(shorter, true);
}

/// The end of an interval: of the contact, or at a touch-down, to rounding, where one ends it.
void ContactArc::end_at(const Interval& interval, const Ending& ending) {
  using Kind = Ending::Kind;
  start_ = end_;
  end_ = end_of(interval);
  er_ = {interval.blade_x.at_end(), interval.blade_y.at_end()};
  lifts_off_ = ending.kind == Kind::unbent || ending.kind == Kind::under_load ||
               (ending.kind == Kind::none && interval.chord.time == 0.0);
  touches_ = ending.kind == Kind::touch_down ? ending.blade : -1;
  const double rise = interval.argument_slope.at_end() / interval.time_slope.at_end();
  const auto goes_on = [&](double late) {
    end_.time += late;
    end_.state +=
        late * rotor::State(end_.state[2], end_.state[3], interval.ax.at_end(), interval.ay.at_end());
    if (end_.argument > 0.0) end_.argument += late * rise;
  };
  // To where the gap of a blade is zero: in time, and what is left, or all where the tip hardly moves against
  // the ring, the shortest way for the shaft.
  const auto goes_on_to_ring = [&](int blade) {
    constexpr int kTimes = 2;
    constexpr double kFarthest = 0.1;  // of the interval
    const auto direction = [&] { return blades_->direction(blade, blades_->first(end_.time)); };
    const auto pose = [&] { return rotor::pose_of(*rotor_, law_->geometry(), direction(), end_.state); };
    for (int i = 0; i < kTimes; ++i) {
      const contact::Pose there = pose();
      const double late = -there.gap / contact::gap_rate(law_->geometry(), there, rotor_->speed_ratio);
      if (std::abs(late) < kFarthest * interval.elapsed.at_end()) goes_on(late);
    }
    const double left = pose().gap / (2.0 * contact_.ring_radius);
    if (!(std::abs(left) < limits_.tolerance)) return;
    const contact::BladeDirection er = direction();
    end_.state[0] -= left * (end_.state[0] + contact_.reach * er.cosine) / contact_.ring_radius;
    end_.state[1] -=
        left * (end_.state[1] + rotor_->misalignment + contact_.reach * er.sine) / contact_.ring_radius;
  };
  if (ending.kind == Kind::unbent) goes_on(-end_.argument / rise);
  if (lifts_off_ && ending.kind != Kind::under_load) end_.argument = 0.0;
  if (lifts_off_) goes_on_to_ring(blade_);
  if (touches_ >= 0) goes_on_to_ring(touches_);
}

void ContactArc::guess_further(Interval& next) const {
  AtNodes elapsed;
  const AtNodes& node = node_tables().node;
  for (std::size_t i = 0; i < kNodes; ++i)
    elapsed[i] = node[i] * next.chord.time + next.deviation[i] * next.normal.time;
  for (std::size_t k = 0; k < further_.size(); ++k) guess(further_[k], elapsed, next.further[k]);
}

/// Makes the trial a solution that is accurate enough.
bool ContactArc::solve_next() {
  while (true) {
    Interval& next = trial();
    start_next(next);
    const bool follows = alike_ != nullptr && number_ < alike_->count;
    if (follows) {
      predictor_.follow(alike_->intervals[number_].length);
      alike_->intervals[number_].guess(next);
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

ContactArc::Verdict ContactArc::judge(Ending& ending) {
  using Kind = Ending::Kind;
  const Interval& next = trial();
  const bool reaches_zero = next.chord.time == 0.0;
  Bounds bounds = solver_.bounds(contact_, next);
  const auto first = touch_down(next, lift_off(next));
  if (!first) return Verdict::too_long;
  ending = *first;
  const bool in_part = ending.kind != Kind::none;
  Interval& part = intervals_[made_];  // what has been made before is not asked for again
  if (in_part) {
    if (!cut(next, ending.fraction, part)) return Verdict::gives_up;
    // Beyond its ending the interval is no motion.
    if (ending.kind == Kind::touch_down || !further_.empty() || !stays_valid(bounds))
      bounds = solver_.bounds(contact_, part);
    // The tip that touches is at the ring at the end.
    const double at_ring = 2.0 * contact_.ring_radius * limits_.tolerance;
    gap_bound_of_others_ = -std::numeric_limits<double>::infinity();
    for (const Other& other : others_) {
      const double bound = solver_.largest_gap(contact_, part, other.offset);
      gap_bound_of_others_ = std::max(gap_bound_of_others_, bound);
      if (!(bound < (other.blade == ending.blade ? at_ring : 0.0))) return Verdict::too_long;
    }
  }
  if (!stays_valid(bounds)) return Verdict::gives_up;
  displacement_bound_ = bounds.displacement;
  const bool stays_bent = bounds.gap_measure > 0.0 && (begins_ || next.start_gap_measure > 0.0);
  if (ending.kind != Kind::under_load && !stays_bent) return Verdict::gives_up;
  // Time goes on.
  const Interval& kept = in_part ? part : next;
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
  std::vector<Touch> touching{{blade_, contact_.slip, table_->bending(end_.argument)}};
  for (const FurtherStart& start : further_)
    touching.push_back({start.blade, start.slip, table_->bending(std::sqrt(start.square))});
  lead(end_.time, rotor::State(end_.state), touching, further + 1);
  lead_has_changed_ = true;
}

ContactArc::Outcome ContactArc::make() {
  if (number_ >= kMostIntervals || predictor_.is_too_short()) return Outcome::gives_up;
  predictor_.begin_interval();
  while (true) {
    if (!solve_next()) return Outcome::gives_up;
    if (kept_ != nullptr && number_ < EarlierContact::kMostIntervals) {
      kept_->intervals[number_].take(trial(), predictor_.length_of_trial());
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
  gap_measure_ = made().gap_measure.at_end();
  slip_velocity_ = made().slip_velocity.at_end();
  for (std::size_t k = 0; k < further_.size(); ++k) go_on(made(), made().further[k], further_[k]);
  if (!lifts_off_ && touches_ < 0) predictor_.goes_on(made());
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
  const double late = time - point.time;
  const std::size_t last = kNodes - 1;
  point.time = time;
  point.state += late * rotor::State(point.state[2], point.state[3], trial().ax[last], trial().ay[last]);
  point.argument += late * trial().argument_slope[last] / trial().time_slope[last];
  return point;
}

ContactArc::Point ContactArc::solved_at_fraction(double fraction) {
  if (fraction == 0.0) return start_;
  if (fraction == 1.0) return end_;
  return cut(made(), fraction, trial()) ? end_of(trial()) : point_at(fraction);
}

ContactArc::Point ContactArc::end_of(const Interval& interval) {
  Point end{interval.start_time + interval.elapsed.at_end(),
            {interval.x.at_end(), interval.y.at_end(), interval.vx.at_end(), interval.vy.at_end()},
            interval.argument.at_end()};
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
  // Between the nodes p errs by a few times as much as velocities do, each against its own size.
  constexpr double kSafety = 100.0;
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

double ContactArc::largest_displacement(double from, double to, double known) {
  if (!(displacement_bound_ > known)) return known;
  const Stretch within = stretch(from, to);
  const Farthest there = farthest(made(), within.first, within.last);
  // Between the nodes a place errs by less than a velocity would move it in a unit of time.
  if (!(there.displacement + allowed_ > known)) return known;
  const Point point = solved_in(within, there.fraction);
  return std::max(known, std::sqrt(point.state[0] * point.state[0] + point.state[1] * point.state[1]));
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
  Point point{made().start_time + value(0.0, made().elapsed),
              {value(made().start[0], made().x), value(made().start[1], made().y),
               value(made().start[2], made().vx), value(made().start[3], made().vy)},
              value(made().start_argument, made().argument)};
  for (std::size_t k = 0; k < made().further_count; ++k)
    point.squares[k] = value(made().further[k].start_square, made().further[k].square);
  return point;
}

Interval::Direction ContactArc::direction_at(double fraction) const {
  const AtNodes basis = slope_basis_at(fraction);
  return {sum_of_products(basis, made().time_slope), sum_of_products(basis, made().argument_slope)};
}

std::size_t ContactArc::number_of(int blade) const {
  std::size_t number = 0;
  while (further_[number].blade != blade) ++number;
  return number;
}

double ContactArc::argument_of(int blade, const Point& point) const {
  return blade == blade_ ? point.argument : std::sqrt(std::max(0.0, point.squares[number_of(blade)]));
}

std::optional<TipTop> ContactArc::top_of_tip(int blade) const {
  const auto top = [&](const std::array<double, 2>& offset) {
    return collocation::top_of_tip(contact_, made(), offset);
  };
  if (blade == blade_) return top({1.0, 0.0});
  const auto other = std::ranges::find(others_, blade, &Other::blade);
  return other != others_.end() ? top(other->offset) : top(further_[number_of(blade)].offset);
}

void ContactArc::shift_time(double period) {
  start_.time -= period;
  end_.time -= period;
  intervals_[made_].start_time -= period;
}

}  // namespace rubatlas::collocation
