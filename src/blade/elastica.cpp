#include "blade/elastica.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace rubatlas::blade {
namespace {

/// The integrals over α in [0, α0], even functions of α, by half of Gauss's rule of 2N points on [−α0, α0].
/// They go over t = tan(α/4), so that no angle is needed at a point.
template <unsigned N>
Equilibrium<long double> integrate(long double beta, long double kappa, long double largest) {
  using Rule = boost::math::quadrature::gauss<long double, 2 * N>;
  const long double clamp_cosine = std::cos(beta / 2);
  const auto versed_sine = [](long double square, long double per) {
    return 8 * square * per * per;
  };  // 1 − cos α
  const long double largest_square = largest * largest;
  const long double largest_versed = versed_sine(largest_square, 1 / (1 + largest_square));
  // One pass for the three integrals, with dσ/L = dα / (q cos(ψ/2)) and dα = 4 dt / (1 + t²).
  long double arc = 0;         // q
  long double shortening = 0;  // q δ/L = ∫ (1 − cos θ)
  long double deflection = 0;  // q Δ/L = ∫ sin θ
  for (unsigned i = 0; i < N; ++i) {
    const long double share = Rule::abscissa()[i];
    const long double square = largest_square * (share * share);
    const long double per = 1 / (1 + square);
    const long double versed = versed_sine(square, per);
    const long double sine = kappa - kappa * versed;        // sin(ψ/2)
    const long double cosine = std::sqrt(1 - sine * sine);  // cos(ψ/2)
    // tan(θ/4) = (sin(ψ/2) − sin(β/2)) / (cos(ψ/2) + cos(β/2)); the versed sines give the difference.
    const long double tangent = kappa * (largest_versed - versed) / (cosine + clamp_cosine);
    const long double per_tangent = 1 / (1 + tangent * tangent);
    const long double half = 2 * tangent * per_tangent;                     // sin(θ/2)
    const long double half_cosine = (1 - tangent * tangent) * per_tangent;  // cos(θ/2)
    const long double measure = Rule::weights()[i] * per / cosine;
    arc += measure;
    shortening += measure * half * half;
    deflection += measure * half * half_cosine;
  }
  const long double whole_arc = 4 * largest * arc;
  return {whole_arc * whole_arc * std::cos(beta), 2 * shortening / arc, 2 * deflection / arc};
}

/// Whether N points leave less than rounding. Gauss's rule leaves the sum of the semi-axes of the ellipse
/// around [−1, 1] through the integrand's nearest singularities, to the power −4N, times what grows with
/// their order: up to 1e6 for the poles of order five at t = ±i. The others are at α = ±i arcosh(1/κ).
template <unsigned N>
bool suffices(long double kappa, long double largest) {
  constexpr double kLeft = 1e-26;
  static const double kLeastEllipse = std::pow(kLeft, -1.0 / (4 * N));
  const auto half_square = static_cast<double>((1 - kappa) / (1 + kappa));  // tanh²(arcosh(1/κ)/2)
  const double quarter = std::sqrt(half_square) / (1.0 + std::sqrt(1.0 - half_square));
  const double ratio = quarter / static_cast<double>(largest);
  return ratio + std::sqrt(1.0 + ratio * ratio) > kLeastEllipse;
}

}  // namespace

Equilibrium<long double> equilibrium(long double friction, long double bending) {
  const long double beta = std::atan(friction);
  const long double tip_psi = std::hypot(beta, bending);
  const long double tip_angle = bending * (bending / (tip_psi + beta));  // θL, not ψL − β, which cancels
  const long double kappa = std::sin(tip_psi / 2);
  const long double root_sine = std::sin(beta / 2);
  // κ² − sin²(β/2) = sin((ψL + β)/2) sin(θL/2)
  const long double end =
      std::atan2(std::sqrt(std::sin((tip_psi + beta) / 2) * std::sin(tip_angle / 2)), root_sine);
  const long double largest = std::tan(end / 4);
  if (suffices<10>(kappa, largest)) return integrate<10>(beta, kappa, largest);
  if (suffices<20>(kappa, largest)) return integrate<20>(beta, kappa, largest);
  if (suffices<40>(kappa, largest)) return integrate<40>(beta, kappa, largest);
  if (suffices<80>(kappa, largest)) return integrate<80>(beta, kappa, largest);
  return integrate<320>(beta, kappa, largest);  // without friction, θL above 145°
}

}  // namespace rubatlas::blade
