#include "collocation/contact_arc.hpp"

#include <algorithm>
#include <array>
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
/// (`solved_at`).
constexpr double kBetweenNodes = 0.27;
constexpr double kOrderAtEnd = 14.0;
constexpr double kAtEnd = 1.0;            ///< tolerances: of that at the end, as far as it can be estimated
constexpr double kCareWithSeveral = 4.0;  ///< blades: coefficients fall less evenly
/// [τ]: times and gaps of so short a contact, which count from where it begins, are rounding; and of one that
/// may be all but rounding.
constexpr double kImpact = 1e-14;
constexpr double kAllButImpact = 1e-11;
constexpr double kClosest = 0.2;  ///< of the tolerance: what sweeps may leave

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
      earlier_(machine.ring_body() != nullptr, rotor_->length_scale) {
  for (int k = 0; k < blades_->count(); ++k) {
    offsets_.push_back(blades_->direction(k, {1.0, 0.0}));
    numbers_.push_back(law.numbers(k));
  }
}

contact::Pose ContactArc::pose(int blade, const Point& point) const {
  return rotor::pose_of(*rotor_, law_->geometry(blade), blades_->direction(blade, blades_->first(point.time)),
                        rotor::from_ring(point.bodies));
}

/// g of a straight tip in contact [m²]. One that touches down stands on the ring.
double ContactArc::gap_at(const Touch& touch, const Point& point) const {
  if (law_->is_rigid() || law_->may_stand_straight(touch.blade) || !touch.touches_down())
    return pose(touch.blade, point).gap;
  return touch.yielding * (2.0 * machine().ring_radius + touch.yielding);
}

void ContactArc::begin(double time, const rotor::ShaftAndRing& bodies, std::span<const Touch> touching) {
  // Who touches down now is not the next to lift off. But the load of a blade with next to no friction all
  // but jumps there, which takes a time that only an arc over its bending resolves.
  const auto all_but_jumps = [this](const Touch& touch) {
    constexpr double kLongest = 10.0;  // p of the largest bend
    const blade::BendingTable* const table = numbers(touch.blade).table;
    return touch.touches_down() && table != nullptr && table->knots().back().argument > kLongest;
  };
  const auto leads = std::ranges::find_if(touching, all_but_jumps);
  const auto is_bent =
      std::ranges::find_if(touching, [](const Touch& touch) { return !touch.touches_down(); });
  std::size_t leader = 0;
  if (leads != touching.end()) {
    leader = static_cast<std::size_t>(leads - touching.begin());
  } else if (is_bent != touching.end()) {
    leader = static_cast<std::size_t>(is_bent - touching.begin());
  }
  lead_changes_ = 0;
  lead(time, bodies, touching, leader);
}

void ContactArc::lead(double time, const rotor::ShaftAndRing& bodies, std::span<const Touch> touching,
                      std::size_t leader) {
  blade_ = touching[leader].blade;
  contact_.blade = &numbers(blade_);
  contact_.slip = touching[leader].slip;
  contact_.straight = touching[leader].straight;
  contact_.skims = touching[leader].skims;
  begins_ = true;
  ending_ = {};
  start_ = {.time = time, .bodies = bodies, .bending = {}};
  std::vector<Touch> held;
  if (std::ranges::count(touching, true, &Touch::skims) > 0) {
    held.assign(touching.begin(), touching.end());
    skim(held, start_);
    touching = held;
  }
  start_.bending = law_->lead(touching[leader]);
  if (law_->is_rigid() && std::ranges::count(touching, 0.0, &Touch::slip) > 0) {
    held.assign(touching.begin(), touching.end());
    hold(held, start_);
    touching = held;
  }
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
    start.tip.start_gap = gap_at(touch, start_);
    start_.further.push_back({start.square.value, start.lean.value, start.tip.start_yielding, touch.share});
  }
  end_ = start_;
  gap_at_end_ = gap_at(touching[leader], start_);
  others_.clear();
  for (int blade = 0; blade < blades_->count(); ++blade) {
    if (std::ranges::find(touching, blade, &Touch::blade) == touching.end())
      others_.push_back({blade, offset_of(blade)});
  }
  predict(touching[leader]);
  alike_ = nullptr;
  kept_ = nullptr;
  number_ = 0;
  if (further_.empty() && !contact_.skims) look_for_earlier();
}

double ContactArc::shortening_at_start() const {
  double largest = at_end_.force.shortening;
  for (const FurtherStart& further : further_) largest = std::max(largest, further.force.shortening);
  return largest;
}
bool ContactArc::starts_within_ring() const {
  const rotor::State seen = rotor::from_ring(start_.bodies);
  return std::hypot(seen[0], seen[1] + rotor_->misalignment) < machine().ring_radius;
}

void ContactArc::look_for_earlier() {
  const auto seen = [this](double x, double y) {
    return std::array{x * er_.cosine + y * er_.sine, y * er_.cosine - x * er_.sine};
  };
  const auto motion = [&](Eigen::Index body, double above) {
    const auto [x, y] = seen(end_.bodies[body], end_.bodies[body + 1] + above);
    const auto [vx, vy] = seen(end_.bodies[body + 2], end_.bodies[body + 3]);
    return std::array{x, y, vx, vy};
  };
  const std::complex<double> forcing = machine_.forcing(end_.time);
  const Beginning beginning{.shaft = motion(0, machine().misalignment),
                            .ring = motion(4, 0.0),
                            .angular_speed = blades_->angular_speed(end_.time),
                            .forcing = seen(forcing.real(), forcing.imag()),
                            .argument = end_.bending.argument,
                            .slip = contact_.slip,
                            .straight = contact_.straight};
  const EarlierContacts::Found found = earlier_.find(beginning);
  alike_ = found.alike;
  kept_ = found.next;
}

/// What is known where the leading blade takes the lead.
void ContactArc::predict(const Touch& touch) {
  const double angular_speed = blades_->angular_speed(end_.time);
  const contact::Pose there = pose(blade_, end_);
  at_end_ = law_->start(touch, there, angular_speed);
  std::complex<double> force = contact::on_rotor(at_end_.force, er_);
  for (const FurtherStart& further : further_) {
    const contact::BladeDirection er{er_.cosine * further.offset[0] - er_.sine * further.offset[1],
                                     er_.sine * further.offset[0] + er_.cosine * further.offset[1]};
    force += contact::on_rotor(further.force, er);
  }
  const rotor::Acceleration acceleration =
      whole_->acceleration(rotor::full_state(end_.bodies, end_.time, 0.0), force);
  const std::complex<double> closing = acceleration.shaft - acceleration.ring;
  set_out(blade_, contact_.slip, closing, at_end_.force.slip_velocity);
  for (FurtherStart& further : further_)
    set_out(further.blade, further.slip, closing, further.tip.start_slip_velocity);
  predictor_.begin({.touch = touch,
                    .blade = contact_.blade,
                    .ring_radius = machine().ring_radius,
                    .angular_speed = angular_speed,
                    .bodies = end_.bodies,
                    .pose = there,
                    .direction = er_,
                    .bending = end_.bending,
                    .gap_measure = at_end_.gap_measure,
                    .ring_opens = at_end_.ring_opens,
                    .acceleration = acceleration});
}

void ContactArc::start_next(Interval& next) const {
  next.start_time = end_.time;
  next.start_argument = end_.bending.argument;
  std::copy_n(end_.bodies.begin(), 4, next.shaft.start.begin());
  std::copy_n(end_.bodies.begin() + 4, 4, next.ring.start.begin());
  next.blade = {er_.cosine, er_.sine};
  machine_.start(next);
  next.start_gap = gap_at_end_;
  next.start_gap_measure = at_end_.gap_measure;
  next.start_slip_velocity = at_end_.force.slip_velocity;
  next.start_yielding = end_.bending.yielding;
  next.further.resize(further_.size());
  if (keeps_loads()) {
    next.start_force = at_end_.force.normal;
    next.start_strain = at_end_.force.root_strain;
  }
  if (keeps_loads() || contact_.skims) next.start_cone_left = at_end_.cone_left;
  if (!contact_.leans) return;
  next.start_lean = end_.bending.lean;
  next.start_shortening = at_end_.force.shortening;
  next.start_chart_left = at_end_.chart_left;
}

bool ContactArc::solve(Interval& interval, bool warm, double closest) {
  // No closer than places and velocities are rounded.
  const double rounding =
      std::numeric_limits<double>::epsilon() *
      std::max(machine().ring_radius, 4.0 * std::hypot(interval.shaft.start[2], interval.shaft.start[3]));
  const double velocity = std::min(std::max(kClosest * tolerance_, rounding), closest);
  const bool solved = law_->solve(contact_, {velocity, warm}, interval);
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
  if (!interval.further.empty()) error *= kCareWithSeveral;
  const double length = interval.elapsed.at_end() / machine_.longest_interval();
  return length > 1.0 ? std::max(error, std::pow(length, Predictor::kOrder)) : error;
}

/// The stretch of an interval up to θ, solved for itself.
bool ContactArc::cut(const Interval& whole, double fraction, Interval& shorter, double closest) {
  shorter.start_time = whole.start_time;
  shorter.start_argument = whole.start_argument;
  shorter.shaft.start = whole.shaft.start;
  shorter.ring.start = whole.ring.start;
  shorter.blade = whole.blade;
  shorter.start_angular_speed = whole.start_angular_speed;
  std::copy_n(whole.forcing.begin(), machine().forcing_count, shorter.forcing.begin());
  shorter.ripple = whole.ripple;
  static_cast<TipStart&>(shorter) = static_cast<const TipStart&>(whole);
  shorter.further.resize(whole.further.size());
  for (std::size_t k = 0; k < whole.further.size(); ++k) {
    static_cast<TipStart&>(shorter.further[k]) = static_cast<const TipStart&>(whole.further[k]);
    shorter.further[k].blade = whole.further[k].blade;
    shorter.further[k].load = whole.further[k].load;
    shorter.further[k].short_of_fold = whole.further[k].short_of_fold;
    shorter.further[k].offset = whole.further[k].offset;
    shorter.further[k].slip = whole.further[k].slip;
    shorter.further[k].straight = whole.further[k].straight;
    shorter.further[k].skims = whole.further[k].skims;
    shorter.further[k].start_square = whole.further[k].start_square;
  }
  shorter.chord = {fraction * whole.chord.time, fraction * whole.chord.argument};
  shorter.normal = whole.normal;
  read_stretch(contact_, whole, fraction, shorter);
  return solve(shorter, true, closest);
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
  if (late == 0.0) return;
  const auto go_on = [&](const AtNodes& nodes, double& value) {
    value += late * course_at_end(interval, nodes).rate;
  };
  go_on(interval.yielding, point.bending.yielding);
  for (std::size_t k = 0; k < interval.further.size(); ++k) {
    const FurtherBlade& further = interval.further[k];
    go_on(further.square, point.further[k].square);
    go_on(further.lean, point.further[k].lean);
    go_on(further.yielding, point.further[k].yielding);
  }
}

void ContactArc::guess_further(Interval& next) const {
  AtNodes elapsed;
  const AtNodes& node = node_tables().node;
  for (std::size_t i = 0; i < kNodes; ++i)
    elapsed[i] = node[i] * next.chord.time + next.deviation[i] * next.normal.time;
  // The next to come to a fold leads, long before. Of two that are close to theirs either may.
  constexpr std::array<double, kMostLeadChanges + 1> kShort{0.2, 1e-3, 0.0};
  for (std::size_t k = 0; k < further_.size(); ++k) {
    next.further[k].blade = &numbers(further_[k].blade);
    next.further[k].short_of_fold = kShort[static_cast<std::size_t>(lead_changes_)];
    guess(further_[k], elapsed, next.further[k]);
  }
}

/// Makes the trial a solution that is accurate enough. `learns`: its length is what errors allow, not what
/// events do.
bool ContactArc::solve_next(bool learns) {
  constexpr double kFalls = 0.9;      // of an error when the interval becomes shorter; it should by much more
  constexpr double kRounding = 10.0;  // the error of a blade so stiff that rounding shakes it
  double error_before = Predictor::kUnknownError;
  jumps_ = false;
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
    const bool falls = !(solved && !follows && error > kFalls * error_before);
    if (error <= 1.0 || (!falls && begins_ && error <= kRounding)) {
      // An error that does not fall tells nothing of the length: the next interval may be longer.
      constexpr double kMayBeLonger = 0.01;
      predictor_.accepts(falls ? error : kMayBeLonger, learns && begins_ && !follows ? &next : nullptr);
      return true;
    }
    ++rejected_;
    jumps_ = !falls && !begins_;
    if (jumps_) return false;
    if (solved && !follows) error_before = error;
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
  if (kept_ != nullptr) kept_->count = std::min(kept_->count, number_);
}

/// The leading blade, then the others.
std::vector<Touch> ContactArc::touching_at(const Point& point) const {
  std::vector<Touch> touching{law_->touch(blade_, contact_.slip, point.bending)};
  for (const FurtherStart& further : further_)
    touching.push_back(law_->touch(further.blade, further.slip, bending_of(further.blade, point)));
  return touching;
}

/// Begins anew where the last interval has ended: what sweeps have left of the leader's equation there would
/// be a jump at the start of the next one. `leader`: as in `touching_at`. False where it cannot be found
/// anew.
bool ContactArc::begin_anew(std::size_t leader) {
  std::vector<Touch> touching = touching_at(end_);
  Touch& leads = touching[leader];
  contact::Pose there = pose(leads.blade, end_);
  there.gap = leader == 0 ? gap_at_end_ : further_[leader - 1].tip.start_gap;
  std::optional<Touch> found;
  if (std::abs(there.gap) > contact::gap_rounding(law_->geometry(leads.blade), there))
    found = law_->found_anew(leads, there, blades_->angular_speed(end_.time));
  leads = found.value_or(leads);
  begin_anew(touching, leader);
  return found.has_value();
}
/// Gaps stay those by how far the tips have come: those of places would lose digits, or be nothing but
/// rounding.
void ContactArc::begin_anew(std::span<const Touch> touching, std::size_t leader) {
  std::vector<double> gaps{gap_at_end_};
  for (const FurtherStart& further : further_) gaps.push_back(further.tip.start_gap);
  lead(end_.time, rotor::ShaftAndRing(end_.bodies), touching, leader);
  gap_at_end_ = gaps[leader];
  gaps.erase(gaps.begin() + static_cast<std::ptrdiff_t>(leader));
  for (std::size_t k = 0; k < further_.size(); ++k) further_[k].tip.start_gap = gaps[k];
  predictor_.begin_interval();
}

ContactArc::Outcome ContactArc::make() {
  if (is_shorter_than(kImpact)) {
    rebound();
    return Outcome::made;
  }
  predictor_.begin_interval();
  bool learns = true;
  bool is_anew = false;
  while (true) {
    Ending ending;
    const bool solved = solve_next(learns);
    if (solved && kept_ != nullptr && number_ < EarlierContact::kMostIntervals) {
      kept_->intervals[number_].take(contact_, trial(), predictor_.length_of_trial());
      kept_->count = std::max(kept_->count, number_ + 1);
    }
    const Verdict verdict = solved ? judge(ending) : Verdict::too_long;
    if (verdict == Verdict::gives_up) return Outcome::gives_up;
    if (verdict == Verdict::holds || verdict == Verdict::holds_in_part) {
      if (verdict == Verdict::holds) made_ = 1 - made_;
      goes_on(ending);
      return Outcome::made;
    }
    if (solved) {
      ++rejected_;
      if (verdict == Verdict::another_leads) continue;
      learns = false;
      leave_earlier();
      if (predictor_.shortens(Predictor::kUnknownError)) continue;
    }
    if (jumps_) {
      begin_anew(0);
      continue;
    }
    if (const int blade = touches_at_once(); blade != kNoBlade) {
      end_at_once({Guard::touch_down, 0.0, blade, 0.0});
      return Outcome::made;
    }
    if (!is_anew) {
      is_anew = begin_anew(0);
      if (is_anew) continue;
    }
    if (is_shorter_than(kAllButImpact)) {
      rebound();
      return Outcome::made;
    }
    if (lifts_off_at_once()) {
      end_at_once({Guard::unbent, 0.0, blade_, 0.0});
      return Outcome::made;
    }
    // Several are at their folds; the one that leads has been closest.
    if (lead_changes_ == kMostLeadChanges && law_->releases_at_fold(blade_) && !is_straight(blade_)) {
      end_at_once({Guard::fold, 0.0, blade_, 0.0});
      return Outcome::made;
    }
    if (!solved || !is_met_at_once(ending)) return Outcome::gives_up;
    ending.guard = guard_of_tip(ending.guard);
    end_at_once(ending);
    return Outcome::made;
  }
}

/// From the interval that has been made to the next.
void ContactArc::goes_on(const Ending& ending) {
  ++number_;
  ++interval_count_;
  end_at(made(), ending);
  gap_at_end_ = made().gap.at_end();
  at_end_.gap_measure = made().gap_measure.at_end();
  at_end_.force.slip_velocity = made().slip_velocity.at_end();
  if (contact_.leans) {
    at_end_.force.shortening = made().shortening.at_end();
    at_end_.chart_left = made().chart_left.at_end();
  }
  if (keeps_loads()) {
    at_end_.force.normal = made().normal_force.at_end();
    at_end_.force.root_strain = made().root_strain.at_end();
  }
  if (keeps_loads() || contact_.skims) at_end_.cone_left = made().cone_left.at_end();
  for (std::size_t k = 0; k < further_.size(); ++k) go_on(made(), made().further[k], further_[k]);
  if (ending_.guard == Guard::none) predictor_.goes_on(made());
  begins_ = false;
  lead_changes_ = 0;
}

ContactArc::Point ContactArc::at_node(const Interval& interval, std::size_t node) {
  const Body& shaft = interval.shaft;
  const Body& ring = interval.ring;
  Point point{.time = interval.start_time + interval.elapsed[node],
              .bending = {interval.argument[node], interval.lean[node], interval.yielding[node],
                          interval.gap_measure[node] - kShareBeyond}};
  point.bodies << shaft.x[node], shaft.y[node], shaft.vx[node], shaft.vy[node], ring.x[node], ring.y[node],
      ring.vx[node], ring.vy[node];
  for (const FurtherBlade& further : interval.further)
    point.further.push_back({further.square[node], further.lean[node], further.yielding[node],
                             further.gap_measure[node] - kShareBeyond});
  return point;
}

std::size_t ContactArc::number_of(int blade) const {
  std::size_t number = 0;
  while (further_[number].blade != blade) ++number;
  return number;
}

void ContactArc::shift_time(double period) {
  start_.time -= period;
  end_.time -= period;
  intervals_[made_].start_time -= period;
}

}  // namespace rubatlas::collocation
