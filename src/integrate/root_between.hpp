/// Root of a function between two points where it has opposite signs.
#pragma once

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

namespace rubatlas::integrate {

/// The root to `bits` bits of the argument, by default to the last one (TOMS 748, which keeps the root
/// bracketed whatever the rounding). Where rounding gives both ends one sign, or makes them one place, the
/// end with the smaller |value|; where a value is not a number, `high`. The ends may be given in either
/// order.
template <class Function>
double root_between(Function function, double low, double high, double at_low, double at_high,
                    unsigned bits = 52) {
  if (at_high == 0.0) return high;
  if (at_low == 0.0) return low;
  const bool bracketed = (at_low < 0.0 && at_high > 0.0) || (at_low > 0.0 && at_high < 0.0);
  if (!bracketed || low == high) return std::abs(at_low) < std::abs(at_high) ? low : high;
  // Counted in evaluations: a dozen where the function is simple, far more at a root of higher multiplicity.
  std::uintmax_t iterations = 300;
  const boost::math::tools::eps_tolerance<double> close(bits);
  const auto bracket =
      low < high ? boost::math::tools::toms748_solve(function, low, high, at_low, at_high, close, iterations)
                 : boost::math::tools::toms748_solve(function, high, low, at_high, at_low, close, iterations);
  return 0.5 * (bracket.first + bracket.second);
}

}  // namespace rubatlas::integrate
