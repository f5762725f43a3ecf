#include "legendre_form.hpp"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace rubatlas::blade {
namespace {

namespace mp = boost::multiprecision;
using Digits160 = mp::number<mp::cpp_bin_float<160>, mp::et_off>;

struct Exact {
  Digits160 load, shortening, deflection;
};

Exact column(const Digits160& u) {
  const Digits160 kappa = sin(u / 2);  // β = 0
  const Digits160 K = boost::math::ellint_1(kappa);
  const Digits160 E = boost::math::ellint_2(kappa);
  return {K * K, 2 * (1 - E / K), 2 * kappa / K};
}

Exact form(double friction, const Digits160& u) {
  if (friction == 0.0) return column(u);
  const Digits160 mu = friction;
  const Digits160 beta = atan(mu);
  const Digits160 kappa = sin(sqrt(beta * beta + u * u) / 2);
  const Digits160 chi0 = asin(sin(beta / 2) / kappa);
  const Digits160 q = boost::math::ellint_1(kappa) - boost::math::ellint_1(kappa, chi0);
  const Digits160 mean_cos =
      (2 * (boost::math::ellint_2(kappa) - boost::math::ellint_2(kappa, chi0)) - q) / q;
  const Digits160 mean_sin = 2 * kappa * cos(chi0) / q;
  return {q * q * cos(beta), 1 - (mean_cos * cos(beta) + mean_sin * sin(beta)),
          mean_sin * cos(beta) - mean_cos * sin(beta)};
}

LegendrePoint rounded(const Exact& exact) {
  return {exact.load.convert_to<long double>(), exact.shortening.convert_to<long double>(),
          exact.deflection.convert_to<long double>()};
}

}  // namespace

LegendrePoint legendre_form(double friction, double bending) {
  return rounded(form(friction, bending));
}

LegendrePoint legendre_slopes(double friction, double bending) {
  const Digits160 u = bending;
  const Digits160 step = u * Digits160("1e-9");
  const Exact after = form(friction, u + step);
  const Exact before = form(friction, u - step);
  return rounded({(after.load - before.load) / (2 * step),
                  (after.shortening - before.shortening) / (2 * step),
                  (after.deflection - before.deflection) / (2 * step)});
}

}  // namespace rubatlas::blade
