#include "integrate/root_between.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

namespace rubatlas::integrate {

double root_between(FunctionView function, double low, double high, double at_low, double at_high,
                    unsigned bits) {
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
