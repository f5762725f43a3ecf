#include "collocation/contact_arc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace rubatlas::collocation {

ContactArc::ContactArc(const rotor::Machine& machine, Law& law, double tolerance, double max_shortening)
    : whole_(&machine),
      law_(&law),
      tolerance_(tolerance),
      machine_(machine, law.geometry(0).ring_radius),
      solver_(interval_solver()),
      predictor_(machine, law),
      straight_tips_(machine, law),
      allowed_(allowed_at(tolerance, whole_->constants.length_scale)),
      ring_keeps_load_(!law.ends_at_ring() && !law.is_rigid()),
      earlier_(machine.ring_body() != nullptr, whole_->constants.length_scale) {
  law.take_machine(machine);
  for (int k = 0; k < whole_->blades.count(); ++k) {
    from_first_.push_back(whole_->blades.direction(k, {1.0, 0.0}));
    numbers_.push_back(law.numbers(k));
    numbers_.back().valid_shortening = std::min(max_shortening, law.largest_shortening(k));
  }
}

void ContactArc::start_next(Interval& next) const {
  next.start_time = end_.time;
  next.start_argument = end_.bending.argument;
  std::copy_n(end_.bodies.begin(), 4, next.shaft.start.begin());
  std::copy_n(end_.bodies.begin() + 4, 4, next.ring.start.begin());
  next.blade = {er_.cosine, er_.sine};
  machine_.start(next);
  next.tips.resize(tips_.size());
  for (std::size_t k = 0; k < tips_.size(); ++k) static_cast<TipStart&>(next.tips[k]) = tips_[k];
}

bool ContactArc::solve(Interval& interval, bool warm, double closest) {
  // No closer than places and velocities are rounded.
  const auto& [x, y, vx, vy] = interval.shaft.start;
  const double rounding = std::numeric_limits<double>::epsilon() *
                          std::max(machine().ring_radius, 4.0 * std::sqrt(vx * vx + vy * vy));
  const double left = (ring_keeps_load_ ? kClosestOnDampers : kClosest) * tolerance_;
  const double velocity = std::max(std::min(left, closest), rounding);
  const bool solved = law_->solve(machine(), {velocity, warm}, interval);
  sweeps_ += static_cast<std::uint64_t>(interval.sweeps);
  return solved;
}

/// The stretch of an interval up to θ, solved for itself; may take the place of the interval.
bool ContactArc::cut(const Interval& whole, double fraction, Interval& stretch, double closest) {
  if (&stretch != &whole) {
    static_cast<IntervalStart&>(stretch) = static_cast<const IntervalStart&>(whole);
    stretch.shaft.start = whole.shaft.start;
    stretch.ring.start = whole.ring.start;
    stretch.tips.resize(whole.tips.size());
    for (std::size_t k = 0; k < whole.tips.size(); ++k)
      static_cast<TipStart&>(stretch.tips[k]) = whole.tips[k];
    stretch.normal = whole.normal;
  }
  stretch.chord = {fraction * whole.chord.time, fraction * whole.chord.argument};
  solver_.read_stretch(machine(), whole, fraction, stretch);
  return solve(stretch, true, closest);
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
  const TipInTime& leads = interval.leader();
  if (leads.load != nullptr && point.bending.argument > 0.0) {
    double slope = 0.0;
    for (std::size_t j = 0; j < kNodes; ++j)
      slope += kNodeTables.slope[j].at_end() * (leads.lean[j] - leads.start_lean);
    point.bending.lean += late * slope / interval.time_slope.at_end();
  }
  const auto go_on = [&](const AtNodes& nodes, double& value) {
    value += late * course_at_end(interval, nodes).rate;
  };
  go_on(interval.leader().yielding, point.bending.yielding);
  for (std::size_t k = 0; k < point.further.size(); ++k) {
    const TipInTime& further = interval.further()[k];
    go_on(further.square, point.further[k].argument);
    go_on(further.lean, point.further[k].lean);
    go_on(further.yielding, point.further[k].yielding);
  }
}

void ContactArc::guess_further(Interval& next) const {
  const AtNodes elapsed = guessed_times(next);
  // The next to come to a fold leads, long before. Of two that are close to theirs either may.
  constexpr std::array<double, kMostLeadChanges + 1> kShort{0.2, 1e-3, 0.0};
  for (std::size_t k = 1; k < tips_.size(); ++k) {
    next.tips[k].short_of_fold = kShort[static_cast<std::size_t>(lead_changes_)];
    guess(tips_[k], elapsed, next.tips[k]);
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
    const bool follows = found_.alike != nullptr && number_ < found_.alike->count;
    if (follows) {
      predictor_.follow(found_.alike->intervals[number_].length);
      found_.alike->intervals[number_].guess(machine(), next);
    } else {
      predictor_.guess(next);
    }
    if (tips_.size() > 1) guess_further(next);
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
  found_.alike = nullptr;
  if (found_.kept != nullptr) found_.kept->count = std::min(found_.kept->count, number_);
}

ContactArc::Outcome ContactArc::make() {
  if (is_shorter_than(kImpact)) return rebound();
  predictor_.begin_interval();
  seeks_fold_ = false;
  bool learns = true;
  bool is_anew = false;
  bool is_shortest = false;
  while (true) {
    Ending ending;
    const bool solved = solve_next(learns);
    if (solved && found_.kept != nullptr && number_ < EarlierContact::kMostIntervals) {
      found_.kept->intervals[number_].take(machine(), trial(), predictor_.length_of_trial());
      found_.kept->count = std::max(found_.kept->count, number_ + 1);
    }
    if (solved && begins_) set_out_as_solved();
    const Verdict verdict = solved ? judge(ending) : Verdict::too_long;
    if (verdict == Verdict::at_once) return end_at_once(ending.guard, ending.blade);
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
    if (const int blade = touches_at_once(); blade != kNoBlade) return end_at_once(Guard::touch_down, blade);
    if (!is_anew) {
      is_anew = begin_anew(0);
      if (is_anew) continue;
    }
    if (is_shorter_than(kAllButImpact)) return rebound();
    if (lifts_off_at_once()) return end_at_once(Guard::unbent, leader());
    // Several are at their folds; the one that leads has been closest.
    if (lead_changes_ == kMostLeadChanges && is_held_beyond_ring()) return end_at_once(Guard::fold, leader());
    // A tip that rests, and cannot be followed in the shortest of times, is about to lose its place. Whether
    // it does is seen where it leads; so is the fold of a tip whose friction turns round steeply.
    if (law_->leans() && leading().slip == 0.0) return end_at_once(Guard::loosening, leader());
    if (law_->leans() && tips_.size() > 1 && lead_changes_ < kMostLeadChanges) {
      const auto resting = std::ranges::find(tips_, 0.0, &TipStart::slip);
      begin_anew(resting == tips_.end() ? 1 : static_cast<std::size_t>(resting - tips_.begin()));
      ++lead_changes_;
      continue;
    }
    if (solved && is_met_at_once(ending)) return end_at_once(guard_of_tip(ending.guard), ending.blade);
    // A law with one branch leaves no equilibrium beyond its fold. Only where nothing else goes on it is
    // looked for: elsewhere a slope of time below zero is mostly an error between the nodes.
    if (!seeks_fold_) {
      seeks_fold_ = true;
      predictor_.begin_again();
      continue;
    }
    // Many blades on a light shaft, or one beside a stiff fold, move it in very short times.
    if (is_shortest) return Outcome::gives_up;
    is_shortest = true;
    predictor_.allow_shorter();
  }
}

// Events that leave no interval to be made: contacts that are all but impacts, and guards that are met where
// an interval begins.

/// Whether a contact that begins at the ring lasts no longer than that, as first estimated.
bool ContactArc::is_shorter_than(double duration) const {
  if (!begins_ || machine().ring.is_massless() || predictor_.duration() > duration) return false;
  const double rounding = contact::gap_rounding(law_->geometry(leader()), pose(leader(), end_));
  return std::abs(leading().start_gap) <= rounding;
}

/// A contact that is shorter than times are rounded is an impact: nothing changes meanwhile but that its
/// force −F (n + c t) turns the tip's velocity along n round.
ContactArc::Outcome ContactArc::rebound() {
  const Touch touch = touch_of(leader(), end_);
  const contact::Pose there = pose(leader(), end_);
  const contact::BladeDirection er = direction(leader(), end_.time);
  const std::complex<double> place =
      std::complex<double>(there.radial + numbers(leader()).reach, there.tangential) *
      std::complex<double>(er.cosine, er.sine);
  const double distance = std::abs(place);
  // It leaves the ring by no less than velocities are rounded, or it would stay there for ever.
  const double rounding = 1e-3 * slip_rounding();
  const double outwards = std::max(rounding, 0.5 * gap_rate_at_end(leader(), there) / distance);
  const double coefficient = law_->friction_coefficient(touch, there, force(touch, end_));
  const std::complex<double> change =
      -2.0 * outwards * place / distance * std::complex<double>(1.0, coefficient);
  const double shaft_share = whole_->constants.force_unit / whole_->closing_unit();
  end_.bodies[2] += shaft_share * change.real();
  end_.bodies[3] += shaft_share * change.imag();
  end_.bodies[6] -= (1.0 - shaft_share) * change.real();
  end_.bodies[7] -= (1.0 - shaft_share) * change.imag();
  return end_at_once(Guard::under_load, leader());
}

/// Whether the motion up to a guard that could not be located within the trial is no more than its error.
bool ContactArc::is_met_at_once(const Ending& ending) const {
  switch (guard_of_tip(ending.guard)) {
    case Guard::slip_reversal:
      if (!law_->leans()) return false;  // it would reverse again at once
      break;
    case Guard::fold:  // it has been passed by what sweeps leave
    case Guard::loosening:
    case Guard::shortening_limit:
    case Guard::shaft_at_ring:
      break;
    case Guard::unbent:
    case Guard::under_load:
      if (machine().ring.is_massless()) return false;  // its velocity jumps
      if (gap_rate_at_end(leader(), pose(leader(), end_)) > 0.0) return false;
      break;
    default:  // it would be met again at once
      return false;
  }
  return moves_little(std::max(0.0, ending.fraction) * trial().elapsed.at_end());
}

/// Whether shaft and ring move by less than the tolerance until then [τ from where the next interval begins].
bool ContactArc::moves_little(double late) const {
  const auto moved = [&](const Body& body) {
    const double velocity = std::hypot(body.start[2], body.start[3]);
    const double acceleration = std::hypot(body.ax[0], body.ay[0]);
    return std::abs(late) * std::max(velocity, acceleration);
  };
  return moved(trial().shaft) < tolerance_ && moved(trial().ring) < tolerance_;
}

/// Whether a blade moves off the ring that is all but unbent and has left it before anything has moved, or
/// that bends where the tolerance has already let its tip leave.
bool ContactArc::lifts_off_at_once() const {
  if (law_->is_rigid() || is_straight(leader()) || machine().ring.is_massless()) return false;
  if (law_->releases_at_fold(leader())) return false;
  if (leading().start_gap > 0.0 && !(end_.bending.argument < kNextToUnbent)) return false;
  const double rate = gap_rate_at_end(leader(), pose(leader(), end_));
  return rate < 0.0 && moves_little(-leading().start_gap / rate);
}

/// The next event is where the next interval would begin.
ContactArc::Outcome ContactArc::end_at_once(Guard guard, int blade) {
  start_ = end_;
  ending_ = {guard, 0.0, blade};
  return Outcome::made;
}

/// The blade whose tip is at the ring where the next interval starts, or beyond it by what the tolerance lets
/// it, and moves outwards. In a ring with dampers it is inside: it had lifted off there.
int ContactArc::touches_at_once() const {
  for (const int blade : others_) {
    const contact::Pose there = pose(blade, end_);
    const bool touches = law_->ends_at_ring()
                             ? there.gap >= -contact::gap_rounding(law_->geometry(blade), there)
                             : starts_inside(blade);
    if (touches && gap_rate_at_end(blade, there) > 0.0) return blade;
  }
  return kNoBlade;
}

/// From the interval that has been made to the next.
void ContactArc::goes_on(const Ending& ending) {
  ++number_;
  ++interval_count_;
  end_at(made(), ending);
  for (std::size_t k = 0; k < tips_.size(); ++k) go_on(made(), made().tips[k], k > 0, tips_[k]);
  if (ending_.guard == Guard::none) predictor_.goes_on(made());
  begins_ = false;
  lead_changes_ = 0;
}

ContactArc::Point ContactArc::at_node(const Interval& interval, std::size_t node) {
  return read(interval, [node](double /*start*/, const AtNodes& nodes) { return nodes[node]; });
}

void ContactArc::shift_time(double period) {
  start_.time -= period;
  end_.time -= period;
  intervals_[made_].start_time -= period;
}

}  // namespace rubatlas::collocation
