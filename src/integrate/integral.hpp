/// Integrals over a stretch of time, by Gauss points.
#pragma once

#include <boost/math/quadrature/gauss.hpp>

namespace rubatlas::integrate {

/// ∫ f dτ of a function that is smooth within the stretch and at its ends.
template <unsigned kPoints, class Function>
double integral(const Function& f, double begin, double end) {
  return boost::math::quadrature::gauss<double, kPoints>::integrate(f, begin, end);
}

/// The same of a function that may start and end like a square root of the time: where a tip touches down or
/// lifts off its force does (MODEL 3.3). It is smooth in q, τ = begin + (end − begin) q²(3 − 2q).
template <unsigned kPoints, class Function>
double integral_with_root_ends(const Function& f, double begin, double end) {
  const double length = end - begin;
  const auto in_q = [&](double q) {
    return 6.0 * q * (1.0 - q) * f(begin + length * (q * q * (3.0 - 2.0 * q)));
  };
  return length * integral<kPoints>(in_q, 0.0, 1.0);
}

}  // namespace rubatlas::integrate
