#include "blade/beam_column.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace rubatlas::blade {

Equilibrium<long double> beam_column_equilibrium(long double friction, long double bending) {
  using Real = long double;
  const Real tip_psi = std::hypot(friction, bending);
  // At μ = 0 the blade is a column, which carries its Euler load however little it is bent.
  const Real lambda = friction == 0 ? std::numbers::pi_v<Real> / 2 : std::atan2(bending, friction);
  Real shortening = 0;
  Real deflection = 0;
  const auto add = [&](Real from_tip, Real weight) {  // 1 − x/L
    // w' = ψL (cos λ(1 − x/L) − cos λ)
    const Real slope =
        2 * tip_psi * std::sin(lambda * (1 + from_tip) / 2) * std::sin(lambda * (1 - from_tip) / 2);
    shortening += weight * slope * slope / 2;
    deflection += weight * slope;
  };
  // The integrands are entire functions and λ <= π/2, so that 20 points leave no error above rounding.
  using Rule = boost::math::quadrature::gauss<Real, 20>;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    const Real weight = Rule::weights()[i] / 2;
    add((1 + Rule::abscissa()[i]) / 2, weight);
    add((1 - Rule::abscissa()[i]) / 2, weight);
  }
  return {lambda * lambda, shortening, deflection};
}

}  // namespace rubatlas::blade
