// What is asked of the interval that has been made: states, extremes and tips within it.

#include <algorithm>
#include <cmath>

#include "collocation/contact_arc.hpp"
#include "collocation/interval_samples.hpp"

namespace rubatlas::collocation {
namespace {

/// Between the nodes loads err by a few times as much as velocities do, each against its own size.
constexpr double kSafety = 100.0;

}  // namespace

double ContactArc::fraction_at(double time) const {
  return collocation::fraction_at(made(), time - made().start_time);
}

ContactArc::Point ContactArc::solved_at(double time) {
  if (time <= start_.time) return start_;
  if (time >= end_.time) return end_;
  constexpr int kTimes = 4;
  constexpr double kClose = 1e-6;  // of the stretch: next to a lift-off p changes much in a moment
  double fraction = fraction_at(time);
  for (int i = 0; i < kTimes; ++i) {
    if (!cut(made(), fraction, trial())) break;
    Point point = end_of(trial());
    const double late = time - point.time;
    if (std::abs(late) < kClose * trial().elapsed.at_end()) {
      move(point, trial(), late);
      point.time = time;
      return point;
    }
    const double next = fraction * (1.0 + late / trial().time_slope.at_end());
    fraction = std::clamp(next, 0.5 * fraction, 0.5 * (1.0 + fraction));
  }
  // Next to where time stands still it cannot be met so closely.
  return point_at(fraction_at(time));
}

ContactArc::Point ContactArc::solved_at_fraction(double fraction) {
  if (fraction == 0.0) return start_;
  if (fraction == 1.0) return end_;
  return cut(made(), fraction, trial()) ? end_of(trial()) : point_at(fraction);
}

contact::BladeDirection ContactArc::direction_at_node(int blade, std::size_t node) const {
  return tip(blade).direction(made().blade_x[node], made().blade_y[node]);
}

ContactArc::Stretch ContactArc::stretch(double from, double to) const {
  // The end may lie before that of the interval (`end_at`).
  const bool whole = to >= end_.time && end_.time >= made().start_time + made().elapsed.at_end();
  return {from, to, from <= start_.time ? 0.0 : fraction_at(from),
          whole ? 1.0 : fraction_at(std::min(to, end_.time))};
}
/// At θ of a stretch. The time of θ errs between the nodes: the ends of the stretch are those times.
ContactArc::Point ContactArc::solved_in(const Stretch& stretch, double fraction) {
  return fraction == stretch.first  ? solved_at(stretch.from)
         : fraction == stretch.last ? solved_at(stretch.to)
                                    : solved_at_fraction(fraction);
}

/// θ nearer to where a blade under an axial load is bent most, and loaded most, than one that the interval's
/// polynomials have, if this one misses a billionth of p²; else the same. `there`: solved at that one.
double ContactArc::nearer_to_top(int blade, const Point& there, double fraction) const {
  constexpr double kApart = 0.01;   // of the interval
  constexpr double kMissed = 1e-9;  // of p²
  if (law_->leans() || is_straight(blade) || !(fraction > kApart && fraction < 1.0 - kApart)) return fraction;
  AtPlaces squares = at_places(tip(blade).start_square, tip(blade).square);
  if (blade == leader()) {
    squares = at_places(made().start_argument, made().argument);
    for (double& value : squares) value *= value;
  }
  const auto square = [&](double at) { return sum_of_products(basis_at(at), squares); };
  const double curvature =
      (square(fraction - kApart) - 2.0 * square(fraction) + square(fraction + kApart)) / (kApart * kApart);
  const Law::Tangent tangent = law_->tangent(touch_of(blade, there), tip_place(blade, there), {});
  const double rate = tangent.argument / tangent.time * direction_at(fraction).time;
  const double slope = 2.0 * bending_of(blade, there).argument * rate;
  const double missed = -0.5 * slope * slope / curvature;
  return curvature < 0.0 && missed > kMissed * square(fraction) ? fraction - slope / curvature : fraction;
}

std::optional<ContactArc::Point> ContactArc::most_loaded(int blade, bool of_force, double from, double to,
                                                         double known) {
  const TipInTime& in_time = tip(blade);
  const AtPlaces values = of_force ? at_places(in_time.at_start.normal, in_time.normal_force)
                                   : at_places(in_time.at_start.root_strain, in_time.root_strain);
  const double error = kSafety * allowed_between_nodes() / whole_->constants.length_scale *
                       *std::max_element(values.begin(), values.end());
  if (solver_.upper_bound(values) + error <= known) return std::nullopt;  // mostly
  const Stretch within = stretch(from, to);
  const auto most = largest_of(values, within.first, within.last, known - error);
  if (most.value + error <= known) return std::nullopt;
  const Point there = solved_in(within, most.argument);
  const double nearer = nearer_to_top(blade, there, most.argument);
  if (nearer == most.argument || !(nearer > within.first && nearer < within.last)) return there;
  const Point top = solved_in(within, nearer);
  return bending_of(blade, top).argument > bending_of(blade, there).argument ? top : there;
}

double ContactArc::largest_displacement(double from, double to, double known) {
  if (!(displacement_bound() > known)) return known;
  const Stretch within = stretch(from, to);
  const integrate::Sample there = farthest(made(), within.first, within.last);
  // Between the nodes a place errs by less than a velocity would move it in a unit of time.
  if (!(there.value + allowed_between_nodes() > known)) return known;
  const rotor::ShaftAndRing bodies = solved_in(within, there.argument).bodies;
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
  return read(made(), [&](double start, const AtNodes& nodes) {
    return sum_of_products(basis, at_places(start, nodes));
  });
}
bool ContactArc::ends_at_last_node() const {
  constexpr double kLeft = 1e-10;  // of the interval
  const double length = made().elapsed.at_end();
  return std::abs(end_.time - made().start_time - length) <= kLeft * std::abs(length);
}

Law::Tangent ContactArc::direction_at(double fraction) const {
  const AtNodes basis = slope_basis_at(fraction);
  Law::Tangent tangent{sum_of_products(basis, made().time_slope),
                       sum_of_products(basis, made().argument_slope), 0.0};
  if (law_->leans()) {
    const TipInTime& leading = made().leader();
    AtNodes slopes{};
    for (std::size_t j = 0; j < kNodes; ++j) {
      for (std::size_t i = 0; i < kNodes; ++i)
        slopes[i] += kNodeTables.slope[j][i] * (leading.lean[j] - leading.start_lean);
    }
    tangent.lean = sum_of_products(basis, slopes);
  }
  return tangent;
}

Bending ContactArc::bending_of(int blade, const Point& point) const {
  const std::size_t number = number_of(blade);
  if (number == 0) return point.bending;
  Bending bending = point.further[number - 1];
  bending.argument = std::sqrt(std::max(0.0, bending.argument));
  return bending;
}
Touch ContactArc::touch_of(int blade, const Point& point) const {
  const TipStart& tip = tips_[number_of(blade)];
  if (tip.slip != 0.0 || !law_->is_rigid()) return law_->touch(tip, bending_of(blade, point));
  std::vector<Touch> touching = touching_at(point);
  straight_tips_.hold(state_at(point), touching);
  return *std::ranges::find(touching, blade, &Touch::blade);
}

}  // namespace rubatlas::collocation
