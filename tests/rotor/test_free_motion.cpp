/// The rotor left to itself (MODEL 4.5) at every damping.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

#include "exact_motion.hpp"
#include "rotor/free_motion.hpp"

namespace rubatlas::rotor {
namespace {

using Complex = std::complex<double>;

constexpr std::array<double, 13> kDampings = {0.0, 1e-4,      0.1,      0.5, 1 - 1e-4, 1 - 1e-8, 1 - 1e-12,
                                              1.0, 1 + 1e-12, 1 + 1e-8, 1.5, 5.0,      50.0};

Motion moved(double damping_ratio, const Motion& start, double time) {
  const FreeMotion free(damping_ratio);
  const auto kernel = free.kernel(time);
  return {FreeMotion::position(kernel, damping_ratio, start.position, start.velocity),
          FreeMotion::velocity(kernel, damping_ratio, start.position, start.velocity)};
}

double size(const Motion& motion) {
  return std::hypot(std::abs(motion.position), std::abs(motion.velocity));
}
double distance(const Motion& one, const Motion& other) {
  return std::hypot(std::abs(one.position - other.position), std::abs(one.velocity - other.velocity));
}

TEST(FreeMotion, EqualsTheMatrixExponentialAtEveryDamping) {
  for (const double damping : kDampings) {
    for (const double time : {1e-9, 1e-3, 0.1, 1.0, 3.0, 10.0, 40.0, 150.0}) {
      for (const Motion& start : {Motion{{0.01, -0.004}, {0.002, 0.007}}, Motion{{0.01, 0.0}, {0.0, 0.0}},
                                  Motion{{0.0, 0.0}, {0.0, 0.01}}}) {
        const Motion exact = exact_motion(damping, 0.0, start, 0.0, time);
        // A few roundings of the state and one of the phase; for a heavily damped rotor, of the rate ζ + ωd.
        const double allowed = 4e-16 * (2 + std::min(time, 40.0)) * size(start);
        ASSERT_LE(distance(moved(damping, start, time), exact), allowed)
            << "damping " << damping << ", time " << time;
      }
    }
  }
}

TEST(FreeMotion, TwoFlightsInARowAreOne) {
  const Motion start{{0.01, -0.004}, {0.002, 0.007}};
  for (const double damping : kDampings) {
    for (const double first : {0.01, 0.7, 5.0, 20.0}) {
      for (const double second : {0.02, 1.3, 9.0}) {
        const Motion twice = moved(damping, moved(damping, start, first), second);
        const Motion once = moved(damping, start, first + second);
        ASSERT_LE(distance(twice, once), 1e-15 * (2 + first + second) * size(start))
            << damping << ", " << first;
      }
    }
  }
}

TEST(FreeMotion, IsContinuousThroughCriticalDamping) {
  const Motion start{{0.01, -0.004}, {0.002, 0.007}};
  for (const double time : {0.1, 1.0, 5.0, 30.0}) {
    const Motion critical = moved(1.0, start, time);
    for (const double away : {1e-15, 1e-12, 1e-9, 1e-6}) {
      for (const double damping : {1 - away, 1 + away}) {
        // |dz/dζ| stays below 2 |z0| over all times.
        ASSERT_LE(distance(moved(damping, start, time), critical), (2 * away + 1e-15) * size(start))
            << damping << ", " << time;
      }
    }
  }
}

TEST(FreeMotion, EnergyNeverGrows) {
  for (const double damping : kDampings) {
    const Motion start{{0.003, 0.001}, {-0.002, 0.004}};
    double before = size(start);
    for (int i = 1; i <= 400; ++i) {
      const double now = size(moved(damping, start, 0.1 * i));
      ASSERT_LE(now, before + 1e-16 * (2 + 0.1 * i) * size(start)) << damping << ", " << i;
      before = now;
    }
  }
}

TEST(FreeMotion, HeavilyDampedRotorCreepsBackWithoutOverflow) {
  // The slow rate is 1/(ζ + ωd): at ζ = 50 and τ = 1e4 cosh(ωd τ) would be e^500000.
  for (const double damping : {1.5, 5.0, 50.0}) {
    const FreeMotion free(damping);
    const double rate = 1 / (damping + std::sqrt(damping * damping - 1));
    for (const double time : {100.0, 1e4}) {
      const auto kernel = free.kernel(time);
      EXPECT_TRUE(std::isfinite(kernel.cosine) && std::isfinite(kernel.sine));
      EXPECT_NEAR(kernel.cosine, 0.5 * std::exp(-rate * time), 1e-15) << damping << ", " << time;
    }
  }
}

TEST(FreeMotion, UndampedRotorSwingsForever) {
  const Motion start{{0.01, 0.0}, {0.0, 0.01}};
  for (const double time : {1e3, 1e5})
    EXPECT_NEAR(size(moved(0.0, start, time)), size(start), 4e-16 * size(start));
}

}  // namespace
}  // namespace rubatlas::rotor
