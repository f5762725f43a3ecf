/// Bounds of flight on a linear support: never passed, and as tight as they are meant to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <vector>

#include "../integrate/allocations.hpp"
#include "random_support.hpp"
#include "rotor/linear_support.hpp"
#include "rotor/support_bounds.hpp"
#include "rotor/support_matrices.hpp"

namespace rubatlas::rotor {
namespace {

using Complex = std::complex<double>;
using State = LinearSupport::State;
using Eigen::Matrix2d;

constexpr double kForEver = std::numeric_limits<double>::infinity();
const State kBegin(0.003, -0.001, 0.002, 0.004);

LinearSupport support_of(const SupportMatrices& parts, const std::vector<HarmonicForcing>& forcing = {}) {
  return {parts.stiffness, parts.damping, forcing};
}
SupportMatrices cross_coupled(double damping_ratio, double strength) {
  SupportMatrices parts = isotropic_shaft(damping_ratio);
  parts.stiffness(0, 1) += strength;
  parts.stiffness(1, 0) -= strength;
  return parts;
}
State random_state(std::mt19937& random) {
  std::normal_distribution<double> any;
  State state;
  for (double& entry : state) entry = any(random);
  return 0.005 * state / state.norm();
}
/// Largest (|z|² + |z'|²)^½ of a flight over its samples.
double largest(const LinearSupport& support, double time, const State& start, double horizon) {
  double found = 0.0;
  for (int i = 0; i <= 400; ++i)
    found = std::max(found, support.state(time, start, horizon * i / 400).norm());
  return found;
}

TEST(SupportBounds, NoFlightPassesItsAmplitudeBound) {
  std::mt19937 random(11);
  int tight = 0;
  for (std::size_t trial = 0; trial < 200; ++trial) {
    const RandomSupport parts(random, trial % 4);
    const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
    const SupportBounds bounds(support);
    for (const double horizon : {0.01, 0.5, 3.0, 20.0, 100.0}) {
      if (growth_rate(support) * horizon > 300) continue;
      const State start = random_state(random);
      const double bound = bounds.amplitude_bound(0.8, start, horizon);
      const double found = largest(support, 0.8, start, horizon);
      ASSERT_LE(found, bound) << trial << ", " << horizon;
      if (horizon < 1 && bound < 2 * found) ++tight;
    }
  }
  EXPECT_GT(tight, 300);  // of 400 short flights
}

TEST(SupportBounds, StableSupportsAreBoundedForEverAndUnstableOnesAreNot) {
  std::mt19937 random(12);
  int stable = 0, unstable = 0;
  for (std::size_t trial = 0; trial < 300; ++trial) {
    const RandomSupport parts(random, trial % 3);
    const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
    const SupportBounds bounds(support);
    const State start = random_state(random);
    const double bound = bounds.amplitude_bound(0.3, start, kForEver);
    // Eigenvalues of a matrix of this size come out to some tens of roundings of its norm.
    const double rounding = 100.0 * std::numeric_limits<double>::epsilon() * support.system_matrix().norm();
    if (growth_rate(support) <= rounding) {
      ++stable;
      ASSERT_TRUE(std::isfinite(bound)) << trial << ", growth " << growth_rate(support);
      ASSERT_LE(largest(support, 0.3, start, 40 / std::abs(growth_rate(support))), bound) << trial;
    } else {
      ++unstable;
      ASSERT_EQ(bound, kForEver) << trial;
    }
  }
  EXPECT_GT(stable, 50);
  EXPECT_GT(unstable, 50);
}

TEST(SupportBounds, IsotropicShaftNeverGainsEnergy) {
  for (const double damping : {0.0, 0.1, 1 - 1e-12, 1.0, 1 + 1e-12, 5.0}) {
    const SupportBounds bounds(support_of(isotropic_shaft(damping)));
    EXPECT_LE(bounds.amplitude_bound(0.0, kBegin, kForEver), kBegin.norm() * (1 + 1e-12)) << damping;
  }
}

TEST(SupportBounds, AnisotropicUndampedShaftIsBoundedByItsEnergy) {
  // (k x²)max = (x'²)max: from rest at the soft end the speed stays below, at the stiff end it rises to √k.
  SupportMatrices parts = isotropic_shaft(0.0);
  parts.stiffness.diagonal() << 0.5, 2.0;
  const SupportBounds bounds(support_of(parts));
  EXPECT_NEAR(bounds.amplitude_bound(0.0, {0.0, 1e-3, 0.0, 0.0}, kForEver), 1e-3 * std::sqrt(2.0 / 0.5),
              1e-15);
  EXPECT_NEAR(bounds.amplitude_bound(0.0, {0.0, 0.0, 1e-3, 0.0}, kForEver), 1e-3 / std::sqrt(0.5), 1e-15);
}

TEST(SupportBounds, BoundednessEndsWhereCrossCouplingOutgrowsDamping) {
  const double damping = 0.1;
  for (const double share : {0.0, 0.5, 0.99, 1 - 1e-9}) {
    const SupportBounds bounds(support_of(cross_coupled(damping, 2 * damping * share)));
    EXPECT_TRUE(std::isfinite(bounds.amplitude_bound(0.0, kBegin, kForEver))) << share;
  }
  for (const double share : {1 + 1e-9, 1.5}) {
    const LinearSupport support = support_of(cross_coupled(damping, 2 * damping * share));
    const SupportBounds bounds(support);
    EXPECT_EQ(bounds.amplitude_bound(0.0, kBegin, kForEver), kForEver) << share;
    EXPECT_NEAR(bounds.logarithmic_norm(), growth_rate(support), 1e-12);
    EXPECT_EQ(bounds.amplitude_bound(0.0, State::Zero(), kForEver), 0.0);
  }
}

TEST(SupportBounds, UndampedResonanceIsNotBoundedForEver) {
  const LinearSupport support = support_of(isotropic_shaft(0.0), {{1e-4, 1.0}});
  const SupportBounds bounds(support);
  EXPECT_EQ(bounds.amplitude_bound(0.0, kBegin, kForEver), kForEver);
  EXPECT_LE(bounds.amplitude_bound(0.0, State::Zero(), 20.0), 1e-4 * 20.0 * (1 + 1e-12));
  EXPECT_LE(largest(support, 0.0, State::Zero(), 20.0), bounds.amplitude_bound(0.0, State::Zero(), 20.0));
}

TEST(SupportBounds, SteadyResponseRepeats) {
  std::mt19937 random(13);
  for (std::size_t trial = 0; trial < 50; ++trial) {
    const RandomSupport parts(random, 3);
    const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
    const SupportBounds bounds(support);
    const State there = support.state(0.4, bounds.steady(0.4), 2.5);
    ASSERT_LE((there - bounds.steady(2.9)).norm(), 1e-12 * std::max(1.0, bounds.steady(0.4).norm())) << trial;
  }
}

TEST(SupportBounds, OrbitOfAnUnbalancedIsotropicShaftIsItsSteadyResponse) {
  const double damping = 0.1, speed = 0.62, amplitude = 1e-4;
  const LinearSupport support = support_of(isotropic_shaft(damping), {{amplitude, speed}});
  const SupportBounds bounds(support);
  const Complex compliance = 1.0 / Complex(1 - speed * speed, 2 * damping * speed);
  const Complex position = amplitude * compliance * std::polar(1.0, speed * 2.0);
  const State steady = bounds.steady(2.0);
  EXPECT_LE(std::abs(Complex(steady[0], steady[1]) - position), 1e-18);
  // On its orbit it stays there for ever.
  EXPECT_NEAR(bounds.amplitude_bound(2.0, steady, kForEver), std::abs(position) * std::hypot(1.0, speed),
              1e-17);
}

TEST(SupportBounds, DerivativesStayBelowTheirBounds) {
  std::mt19937 random(14);
  double closest = 0.0;
  for (std::size_t trial = 0; trial < 200; ++trial) {
    const RandomSupport parts(random, trial % 4);
    const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
    const SupportBounds bounds(support);
    const ExactFlight::Matrix generator = ExactFlight::generator(support);
    for (int sample = 0; sample < 50; ++sample) {
      const State state = random_state(random);
      const double time = 0.37 * sample;
      const ExactFlight::Vector first = generator * ExactFlight::whole(support, time, state);
      const ExactFlight::Vector second = generator * first, third = generator * second,
                                fourth = generator * third;
      const auto leading = [](const ExactFlight::Vector& whole) {
        return Complex(static_cast<double>(whole[0]), static_cast<double>(whole[1]));
      };
      const double bound = state.norm();
      ASSERT_LE(std::abs(leading(second)), bounds.derivative_bounds(bound).second * (1 + 1e-15));
      ASSERT_LE(std::abs(leading(third)), bounds.derivative_bounds(bound).third * (1 + 1e-15));
      ASSERT_LE(std::abs(leading(fourth)), bounds.derivative_bounds(bound).fourth * (1 + 1e-15));
      if (parts.forcing.empty())
        closest = std::max(closest, std::abs(leading(third)) / bounds.derivative_bounds(bound).third);
    }
  }
  EXPECT_GT(closest, 0.98);  // some state is bent as much as the bound allows
}

TEST(SupportBounds, IsotropicDerivativeBoundsAreThoseOfTheJeffcottRotor) {
  for (const double damping : {0.0, 0.1, 5.0}) {
    const SupportBounds bounds(support_of(isotropic_shaft(damping)));
    const double c = 2 * damping;
    EXPECT_NEAR(bounds.derivative_bounds(1.0).second, std::hypot(1.0, c), 1e-13 * (1 + c));
    EXPECT_NEAR(bounds.derivative_bounds(1.0).third, std::hypot(c, c * c - 1), 1e-14 * (1 + c * c));
    EXPECT_NEAR(bounds.derivative_bounds(1.0).fourth, std::hypot(c * c - 1, c * (c * c - 2)),
                1e-14 * (1 + c * c * c));
  }
}

TEST(SupportBounds, ShaftThatDriftsIsStillBoundedInFiniteTime) {
  // No stiffness across: y drifts on for ever at its speed.
  SupportMatrices parts = isotropic_shaft(0.0);
  parts.stiffness(1, 1) = 0.0;
  const LinearSupport support = support_of(parts);
  const SupportBounds bounds(support);
  EXPECT_EQ(bounds.amplitude_bound(0.0, kBegin, kForEver), kForEver);
  for (const double horizon : {0.5, 5.0})
    EXPECT_LE(largest(support, 0.0, kBegin, horizon), bounds.amplitude_bound(0.0, kBegin, horizon));
}

TEST(SupportBounds, FlightAndItsBoundsAskForNoMemory) {
  std::mt19937 random(15);
  const RandomSupport parts(random, LinearSupport::kMostTerms);
  const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
  const SupportBounds bounds(support);
  const auto before = integrate::allocations();
  double sum = 0.0;
  for (const double elapsed : {0.0, 0.3, 20.0, 500.0}) {
    const State state = support.state(0.1, kBegin, elapsed);
    sum += bounds.amplitude_bound(elapsed, state, 1.0) + std::abs(support.acceleration(elapsed, state)) +
           bounds.derivative_bounds(1.0).second + bounds.derivative_bounds(1.0).third;
  }
  EXPECT_EQ(integrate::allocations() - before, 0u);
  EXPECT_GT(sum, 0.0);
}

}  // namespace
}  // namespace rubatlas::rotor
