#include "integrate/conservative_step.hpp"

#include <algorithm>
#include <cmath>

namespace rubatlas::integrate {

double conservative_step(double value, double slope, double curvature, double third_bound) {
  const auto majorant = [&](double t) {
    return value + t * (slope + t * (0.5 * curvature + t * (third_bound / 6.0)));
  };
  const auto rate = [&](double t) { return slope + t * (curvature + t * (0.5 * third_bound)); };

  // q is concave up to its inflection and convex beyond; `low` is a point with q <= 0 from which on the first
  // root lies on the convex, rising part.
  const double inflection = -curvature / third_bound;
  const double discriminant = curvature * curvature - 2.0 * third_bound * slope;
  double low = std::max(inflection, 0.0);
  if (inflection > 0.0 && slope > 0.0) {
    // Rising and concave at first: the top is the maximum of q, or the inflection where q has none.
    double top = inflection;
    if (discriminant > 0.0) {
      // Smaller root of q' = 0 in the form that does not cancel (−g'' > 0).
      top = 2.0 * slope / (-curvature + std::sqrt(discriminant));
    }
    if (majorant(top) > 0.0) {
      // Tangents of a concave function lie above it: Newton from the left never passes the root.
      double t = 0.0;
      for (int i = 0; i < 60; ++i) {
        const double q = majorant(t);
        const double q_rate = rate(t);
        if (!(q < 0.0) || !(q_rate > 0.0)) break;
        const double next = t - q / q_rate;
        if (!(next > t * (1.0 + 1e-13))) break;
        t = next;
      }
      return t;
    }
  }
  if (discriminant > 0.0) low = std::max(low, (-curvature + std::sqrt(discriminant)) / third_bound);
  double at_low = majorant(low);
  if (at_low > 0.0) return 0.0;  // rounding at a touch-down

  // A point beyond the root: there the cubic term alone makes up for the negative value at `low`, since slope
  // and curvature at `low` are not negative.
  double high = low + std::cbrt(-6.0 * at_low / third_bound);
  double at_high = majorant(high);
  for (int i = 0; i < 60 && at_high < 0.0; ++i) {
    high = low + 2.0 * (high - low);
    at_high = majorant(high);
  }
  // Convex and rising: Newton from the right stays right of the root, the chord stays left of it.
  for (int i = 0; i < 60; ++i) {
    const double chord =
        high > low && at_high > at_low ? low - at_low * (high - low) / (at_high - at_low) : low;
    const double q_rate = rate(high);
    const double next = q_rate > 0.0 ? high - at_high / q_rate : chord;
    // At the root, rounding may leave the chord's end a little above zero; just before it, it does not.
    for (const double candidate : {chord, chord * (1.0 - 1e-13)}) {
      const double at_candidate = majorant(candidate);
      if (at_candidate <= 0.0 && candidate > low) {
        low = candidate;
        at_low = at_candidate;
        break;
      }
    }
    if (!(next < high) || next <= low) break;
    high = next;
    at_high = majorant(high);
    if (high - low <= 1e-12 * high) break;
  }
  return low;
}

}  // namespace rubatlas::integrate
