#include "blade/inclined_elastica.hpp"

#include <Eigen/Core>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

namespace rubatlas::blade {
namespace {

/// Gauss–Legendre rule of N points on [0, 1].
template <int N>
struct UnitRule {
  Eigen::Array<double, N, 1> abscissa;
  Eigen::Array<double, N, 1> weight;

  UnitRule() {
    using Rule = boost::math::quadrature::gauss<double, N>;
    static_assert(N % 2 == 0);
    for (int i = 0; i < N / 2; ++i) {
      const auto k = static_cast<std::size_t>(i);
      abscissa[i] = 0.5 * (1.0 - Rule::abscissa()[k]);
      abscissa[N - 1 - i] = 0.5 * (1.0 + Rule::abscissa()[k]);
      weight[i] = weight[N - 1 - i] = 0.5 * Rule::weights()[k];
    }
  }
};

/// 1 − cos x for |x| <= π, as 2 sin²(x/2) with the series of the sine, which keeps its relative accuracy
/// where x is small.
template <class Array>
Array versed_sine(const Array& x) {
  const Array half = 0.5 * x;
  const Array square = half * half;
  Array sum = Array::Constant(1.0 / 51090942171709440000.0);  // 1/21!
  sum = sum * square - 1.0 / 121645100408832000.0;
  sum = sum * square + 1.0 / 355687428096000.0;
  sum = sum * square - 1.0 / 1307674368000.0;
  sum = sum * square + 1.0 / 6227020800.0;
  sum = sum * square - 1.0 / 39916800.0;
  sum = sum * square + 1.0 / 362880.0;
  sum = sum * square - 1.0 / 5040.0;
  sum = sum * square + 1.0 / 120.0;
  sum = sum * square - 1.0 / 6.0;
  sum = sum * square + 1.0;
  const Array sine = half * sum;
  return 2.0 * sine * sine;
}

template <int N>
InclinedPoint integrate(double modulus, double amplitude) {
  using Array = Eigen::Array<double, N, 1>;
  static const UnitRule<N> kRule;
  // At the clamp: b/2.
  const double half_sine = std::sin(0.5 * amplitude);
  const double clamp_versed = 2.0 * half_sine * half_sine;
  const double clamp_cosine = std::cos(amplitude);
  const double clamp_sine = std::sin(amplitude);
  const double sine_b = modulus * clamp_cosine;              // sin(b/2)
  const double cosine_b = std::sqrt(1.0 - sine_b * sine_b);  // cos(b/2)
  const double inverse_cosine_b = 1.0 / cosine_b;

  const auto versed = versed_sine<Array>(amplitude * kRule.abscissa);
  const Array cosine = 1.0 - versed;
  const Array sine_psi = modulus * cosine;                      // sin(ψ/2)
  const Array cosine_psi = (1.0 - sine_psi * sine_psi).sqrt();  // cos(ψ/2)
  const Array inverse_cosine_psi = cosine_psi.inverse();
  const Array measure = (amplitude * kRule.weight) * inverse_cosine_psi;  // dw
  // sin(ψ/2 − b/2) = (sin ψ/2 − sin b/2) (1 + cos(ψ/2 − b/2)) / (cos ψ/2 + cos b/2), divided by κ; the versed
  // sines give the first factor.
  const Array half_cosine = cosine_b * cosine_psi + sine_b * sine_psi;  // cos(θ/2)
  const Array half_sine_share = (clamp_versed - versed) * (1.0 + half_cosine) / (cosine_psi + cosine_b);
  const Array half_theta = modulus * half_sine_share;  // sin(θ/2)
  const Array sine_theta = 2.0 * half_theta * half_cosine;
  const Array versed_theta = 2.0 * half_theta * half_theta;
  // Derivatives by κ at fixed φ': tan(ψ/2)/κ = cos φ'/cos(ψ/2), and the same holds for b, hence ∂θ/∂κ = 2
  // sin(θ/2) / (κ cos(ψ/2) cos(b/2)).
  const Array theta_slope = (2.0 * inverse_cosine_b) * half_sine_share * inverse_cosine_psi;
  const Array measure_slope = modulus * (cosine * inverse_cosine_psi).square() * measure;

  const double arc = measure.sum();
  const double inverse_arc = 1.0 / arc;
  const double arc_slope = measure_slope.sum();
  InclinedPoint point;
  point.load = {arc * arc, 2.0 * arc * arc_slope, 2.0 * arc * inverse_cosine_b};
  point.curvature = 2.0 * modulus * clamp_sine * arc;
  point.load_angle = {2.0 * std::asin(sine_b), 2.0 * clamp_cosine * inverse_cosine_b,
                      -2.0 * modulus * clamp_sine * inverse_cosine_b};
  const double shortening = (measure * versed_theta).sum() * inverse_arc;
  const double deflection = (measure * sine_theta).sum() * inverse_arc;
  // Derivatives by φ: the whole blade turns with its clamp against the load line, and the arc grows by
  // 1/cos(b/2).
  const double turn = -point.load_angle.by_amplitude;
  const double growth = inverse_cosine_b * inverse_arc;
  point.shortening = {
      shortening,
      ((measure * sine_theta * theta_slope + measure_slope * versed_theta).sum() - shortening * arc_slope) *
          inverse_arc,
      turn * deflection - growth * shortening};
  point.deflection = {deflection,
                      ((measure * (1.0 - versed_theta) * theta_slope + measure_slope * sine_theta).sum() -
                       deflection * arc_slope) *
                          inverse_arc,
                      turn * (1.0 - shortening) - growth * deflection};
  return point;
}

InclinedPoint integrated(double modulus, double amplitude) {
  // The distance of the integrands' nearest singularities, φ' = ±i arcosh(1/|κ|), relative to the length of
  // the interval decides on the number of points: errors stay at 1e-15 while arcosh(1/|κ|) is more than φ (12
  // points) or 0.3 φ (24).
  const double magnitude = std::abs(modulus);
  if (magnitude * std::cosh(amplitude) < 1.0) return integrate<12>(modulus, amplitude);
  if (magnitude * std::cosh(0.3 * amplitude) < 1.0) return integrate<24>(modulus, amplitude);
  return integrate<60>(modulus, amplitude);
}

}  // namespace

InclinedPoint inclined_equilibrium(Bend bend) {
  constexpr double kUnloaded = 1e-100;  // next to φ = 0, where quotients are 0/0
  if (!(std::abs(bend.amplitude) > kUnloaded)) bend.amplitude = kUnloaded;
  // What judges a contact asks for the same blade again, half of the time.
  struct Last {
    Bend bend{std::numeric_limits<double>::quiet_NaN(), 0.0};
    InclinedPoint point{};
  };
  thread_local Last last;
  if (bend.modulus != last.bend.modulus || bend.amplitude != last.bend.amplitude)
    last = {bend, integrated(bend.modulus, bend.amplitude)};
  return last.point;
}

}  // namespace rubatlas::blade
