#include "contact/elastica_contact.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rubatlas::contact {
namespace {

constexpr double kGapRounding = 1e-17;  ///< [m²]: g where a touch-down has been located

}  // namespace

template <class Ring, Release kRelease>
std::optional<double> ElasticBladeContact<Ring, kRelease>::solve(const Pose& at, double slip) const {
  if (!carried_ && straight_load(at) <= blade::kEulerLoad) return 0.0;
  if constexpr (kReleasesAtFold) {
    if (at.gap < -kGapRounding) return solve_held(at, slip);
  }
  const auto& knots = curve_->knots();
  // The residual is positive from the unloaded blade on (g > 0; on the receding side it first rises) and
  // falls through zero once: walk up the curve until it has.
  const auto after = std::find_if(knots.begin() + 1, knots.end(),
                                  [&](const auto& knot) { return residual(at, slip, knot) < 0.0; });
  if (after == knots.end()) return std::nullopt;
  double low = (after - 1)->bending;
  double high = after->bending;
  const auto function = [&](double bending) { return residual(at, slip, curve_at(bending)); };
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

template <class Ring, Release kRelease>
std::optional<double> ElasticBladeContact<Ring, kRelease>::solve_held(const Pose& at, double slip) const {
  // h is negative at the unloaded blade, rises up to the fold and falls from there on.
  constexpr double kNextToUnloaded = 1e-6;  // of the first piece
  const auto& knots = curve_->knots();
  const auto measure = [&](double bending) {
    return fold_measure(bending, slope(at, slip, curve_at(bending)));
  };
  double before = kNextToUnloaded * knots[1].bending;
  double at_before = measure(before);
  if (!(at_before > 0.0)) return std::nullopt;
  auto knot = knots.begin() + 1;
  double at_knot = measure(knot->bending);
  while (at_knot > 0.0) {
    before = knot->bending;
    at_before = at_knot;
    if (++knot == knots.end()) return std::nullopt;
    at_knot = measure(knot->bending);
  }
  const auto solved = [](const auto& function, double low, double high, double at_low, double at_high) {
    std::uintmax_t iterations = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        function, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(52), iterations);
    return 0.5 * (bracket.first + bracket.second);
  };
  const auto function = [&](double bending) { return residual(at, slip, curve_at(bending)); };
  const double fold =
      at_knot < 0.0 ? solved(measure, before, knot->bending, at_before, at_knot) : knot->bending;
  const double at_fold = function(fold);
  if (!(at_fold > 0.0)) return std::nullopt;
  knot = std::find_if(knot, knots.end(), [&](const auto& after) { return residual(at, slip, after) < 0.0; });
  if (knot == knots.end()) return std::nullopt;
  return solved(function, fold, knot->bending, at_fold, function(knot->bending));
}

template <class Ring, Release kRelease>
std::optional<double> ElasticBladeContact<Ring, kRelease>::solve_near(const Pose& at, double slip,
                                                                      double bending) const {
  // Newton on the falling branch. Its floor is the rounding of g against the slope, so it ends when a step no
  // longer shrinks; a step that leaves the branch hands over to the bracketing solver.
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 12; ++iteration) {
    const blade::CurvePoint point = curve_at(bending);
    const double h = residual(at, slip, point);
    const double descent = slope(at, slip, point);
    if (!(descent < 0.0)) break;
    const double step = -h / descent;
    const double size = std::abs(step);
    bending += step;
    if (!(bending > 0.0) || bending > curve_->end()) break;
    if (size <= 4e-16 * bending || (size < 1e-9 * bending && size >= 0.5 * previous)) return bending;
    previous = size;
  }
  return solve(at, slip);
}

template <class Ring, Release kRelease>
bool ElasticBladeContact<Ring, kRelease>::respond(const Pose& at, double slip, double speed_ratio,
                                                  double& bending, TipForce& force) const {
  // Beyond a lift-off on the approaching side the gap is negative and no positive load exists. There the load
  // is continued as an odd function of the gap (at μ = 0, where it does not vanish at lift-off, as an even
  // one).
  if (!carried_) {
    // Straight, and linearly so beyond lift-off.
    if (const double load = straight_load(at); load <= blade::kEulerLoad) {
      bending = 0.0;
      force = constraint_at(at, slip, straight(load), speed_ratio).force;
      return true;
    }
  }
  const bool beyond_end = at.gap < 0.0 && starts_unloaded(at, slip);
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

template <class Ring, Release kRelease>
bool ElasticBladeContact<Ring, kRelease>::respond_upwards(const Pose& at, double slip, double speed_ratio,
                                                          double increment, TipForce& force) const {
  constexpr double kShareOfIncrement = 0.05;  // how closely the curve's point stands for the load
  constexpr double kFirstBending = 1e-3;      // of β: there F ~ u² still
  // From the unloaded blade F grows like u²; at μ = 0 the column stays straight up to its Euler load.
  const double first = kFirstBending * (friction_ > 0.0 ? curve_->load_angle() : 1.0);
  const double buckling = curve_at(0.0).load;
  const double step = increment / load_unit_;
  if (!carried_) {
    const double stepped = std::ceil(straight_load(at) / step) * step;
    if (stepped <= blade::kEulerLoad) {
      force = constraint_at(at, slip, straight(stepped), speed_ratio).force;
      return true;
    }
  }
  const double curvature = (curve_at(first).load - buckling) / (first * first);
  double bending = 0.0;
  blade::CurvePoint point{};
  for (double count = std::floor(buckling / step) + 1.0;; ++count) {
    const double load = count * step;
    if (curve_->theory() == blade::Theory::beam_column && load >= blade::kEulerLoad) {
      // No increment beyond the Euler load has an equilibrium: h changes its sign before.
      const auto root = solve(at, slip);
      if (!root) return false;
      bending = *root;
      break;
    }
    if (bending == 0.0) {
      bending = std::sqrt((load - buckling) / curvature);
      point = curve_at(bending);
    }
    while (std::abs(load - point.load) > kShareOfIncrement * step) {
      bending += (load - point.load) / point.load_slope;
      if (!(bending < curve_->end())) return false;
      point = curve_at(bending);
    }
    if (residual(at, slip, point) <= 0.0) break;
  }
  force = constraint(at, slip, bending, speed_ratio).force;
  return true;
}

template class ElasticBladeContact<RigidRing, Release::at_ring>;
template class ElasticBladeContact<RigidRing, Release::at_fold>;
template class ElasticBladeContact<YieldingRing, Release::at_ring>;
template class ElasticBladeContact<YieldingRing, Release::at_fold>;

}  // namespace rubatlas::contact
