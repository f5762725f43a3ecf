#include "collocation/even_rules.hpp"

#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <vector>

namespace rubatlas::collocation {
namespace {

EvenRule gauss(std::size_t count) {
  using Real = long double;
  constexpr double kLeft = 1e-17;
  const auto degree = static_cast<int>(2 * count);
  EvenRule rule;
  rule.count = count;
  rule.least_ellipse = std::pow(kLeft, -1.0 / static_cast<double>(4 * count));
  std::size_t place = count;
  for (const Real x : boost::math::legendre_p_zeros<Real>(degree)) {  // the positive ones
    const Real slope = boost::math::legendre_p_prime(degree, x);
    rule.square[--place] = static_cast<double>(x * x);
    rule.weight[place] = static_cast<double>(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

std::vector<EvenRule> make_rules() {
  constexpr std::size_t kFewest = 4;
  std::vector<EvenRule> rules;
  for (std::size_t count = kFewest; count <= EvenRule::kMost; ++count) rules.push_back(gauss(count));
  return rules;
}

}  // namespace

BladeRule blade_rule(double modulus, double tangent) {
  static const std::vector<EvenRule> kRules = make_rules();
  if (!(modulus < 1.0)) return {};
  const double half_square = (1.0 - modulus) / (1.0 + modulus);  // tanh²(arcosh(1/|κ|)/2)
  const double quarter = std::sqrt(half_square) / (1.0 + std::sqrt(1.0 - half_square));
  const double square = quarter * quarter;
  const double largest = tangent / (quarter + std::sqrt(square + tangent * tangent));
  // The nearest singularity that is left, φ' = π + i arcosh(1/|κ|), is at t = (1 + iq)/(1 − iq) in tan(φ'/4),
  // and at z = t/(q + (q² + t²)^½) in z. Written out: a complex root costs as much as a node of the rule.
  const double cosine = (1.0 - square) / (1.0 + square);
  const double sine = 2.0 * quarter / (1.0 + square);
  const double real = square + (cosine - sine) * (cosine + sine);  // of q² + t²
  const double imaginary = 2.0 * sine * cosine;
  const double magnitude = std::sqrt(real * real + imaginary * imaginary);
  const double root_real = std::sqrt(0.5 * (magnitude + real));
  const double root_imaginary = std::sqrt(0.5 * std::max(magnitude - real, 0.0));
  const double below = quarter + root_real;
  const double per_square = 1.0 / (below * below + root_imaginary * root_imaginary);
  const double along = (cosine * below + sine * root_imaginary) * per_square;
  // The sum of its distances from the ends of the integral over [−z, z].
  const double sum = per_square + largest * largest;  // |t| = 1
  const double difference = 2.0 * along * largest;
  const double axis = (std::sqrt(sum - difference) + std::sqrt(sum + difference)) / (2.0 * largest);
  const double ellipse = axis + std::sqrt(axis * axis - 1.0);
  for (const EvenRule& rule : kRules) {
    if (rule.least_ellipse <= ellipse) return {&rule, quarter};
  }
  return {};
}

}  // namespace rubatlas::collocation
