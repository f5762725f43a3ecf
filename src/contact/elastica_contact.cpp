#include "contact/elastica_contact.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rubatlas::contact {

std::optional<double> ElasticaContact::solve(const Pose& at, double slip) const {
  const auto& knots = curve_->knots();
  // The residual is positive from the unloaded blade on (g > 0; on the receding side it first rises) and
  // falls through zero once: walk up the curve until it has.
  const auto after = std::find_if(knots.begin() + 1, knots.end(), [&](const auto& knot) {
    return residual(at, slip, knot.shortening, knot.deflection) < 0.0;
  });
  if (after == knots.end()) return std::nullopt;
  double low = (after - 1)->bending;
  double high = after->bending;
  const auto function = [&](double bending) {
    const blade::CurvePoint point = curve_at(bending);
    return residual(at, slip, point.shortening, point.deflection);
  };
  double at_low = function(low);
  // The first piece starts at the unloaded blade, where h = g may be zero or negative by rounding. Step off
  // it to where h is positive; where it is nowhere, the contact is too light to load the blade.
  if (low == 0.0 && at_low <= 0.0) {
    double step = high;
    do {
      step *= 0.5;
      at_low = function(step);
    } while (at_low <= 0.0 && step > high * 1e-12);
    if (at_low <= 0.0) return 0.0;
    low = step;
    if (function(2.0 * step) < 0.0) high = 2.0 * step;
  }
  const double at_high = function(high);
  std::uintmax_t iterations = 100;
  const auto bracket = boost::math::tools::toms748_solve(
      function, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(52), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

std::optional<double> ElasticaContact::solve_near(const Pose& at, double slip, double bending) const {
  // Newton on the falling branch. Its floor is the rounding of g against the slope, so it ends when a step no
  // longer shrinks; a step that leaves the branch hands over to the bracketing solver.
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 12; ++iteration) {
    const blade::CurvePoint point = curve_at(bending);
    const double h = residual(at, slip, point.shortening, point.deflection);
    const double a = at.radial + geometry_.reach - length_ * point.shortening;
    const double b = at.tangential - slip * length_ * point.deflection;
    const double slope = -2.0 * length_ * (a * point.shortening_slope + slip * b * point.deflection_slope);
    if (!(slope < 0.0)) break;
    const double step = -h / slope;
    const double size = std::abs(step);
    bending += step;
    if (!(bending > 0.0) || bending > curve_->end()) break;
    if (size <= 4e-16 * bending || (size < 1e-9 * bending && size >= 0.5 * previous)) return bending;
    previous = size;
  }
  return solve(at, slip);
}

bool ElasticaContact::respond(const Pose& at, double slip, double speed_ratio, double& bending,
                              TipForce& force) const {
  // Beyond a lift-off on the approaching side the gap is negative and no positive load exists. There the load
  // is continued as an odd function of the gap (at μ = 0, where it does not vanish at lift-off, as an even
  // one).
  const bool beyond_end = at.gap < 0.0 && slip * at.tangential >= 0.0;
  Pose mirrored = at;
  if (beyond_end) mirrored.gap = -at.gap;
  const auto root = solve_near(mirrored, slip, bending);
  if (!root) return false;
  bending = *root;
  force = constraint(mirrored, slip, bending, speed_ratio).force;
  if (beyond_end && friction_ > 0.0) {
    force.radial = -force.radial;
    force.tangential = -force.tangential;
    force.normal = -force.normal;
  }
  return true;
}

bool ElasticaContact::respond_upwards(const Pose& at, double slip, double speed_ratio, double increment,
                                      TipForce& force) const {
  constexpr double kShareOfIncrement = 0.05;  // how closely the curve's point stands for the load
  constexpr double kFirstBending = 1e-3;      // of β: there F ~ u² still
  // From the unloaded blade F grows like u²; at μ = 0 the column stays straight up to its Euler load.
  const double first = kFirstBending * (friction_ > 0.0 ? curve_->load_angle() : 1.0);
  const double buckling = curve_at(0.0).load;
  const double curvature = (curve_at(first).load - buckling) / (first * first);
  const double step = increment / load_unit_;
  double bending = 0.0;
  blade::CurvePoint point{};
  for (double count = std::floor(buckling / step) + 1.0;; ++count) {
    const double load = count * step;
    if (bending == 0.0) {
      bending = std::sqrt((load - buckling) / curvature);
      point = curve_at(bending);
    }
    while (std::abs(load - point.load) > kShareOfIncrement * step) {
      bending += (load - point.load) / point.load_slope;
      if (!(bending < curve_->end())) return false;
      point = curve_at(bending);
    }
    if (residual(at, slip, point.shortening, point.deflection) <= 0.0) break;
  }
  force = constraint(at, slip, bending, speed_ratio).force;
  return true;
}

}  // namespace rubatlas::contact
