/// Flight on a general linear support against closed forms and the matrix exponential.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "effects/unbalance.hpp"
#include "exact_motion.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/linear_support.hpp"

namespace rubatlas::rotor {
namespace {

using Complex = std::complex<double>;
using State = LinearSupport::State;
using Eigen::Matrix2d;

const State kStart(0.003, -0.001, 0.002, 0.004);

Matrix2d cross_coupling(double strength) {
  return (Matrix2d() << 0.0, strength, -strength, 0.0).finished();
}
LinearSupport isotropic(double damping_ratio, std::vector<HarmonicForcing> forcing = {}) {
  return {Matrix2d::Identity(), 2 * damping_ratio * Matrix2d::Identity(), forcing};
}
State state_of(Complex position, Complex velocity) {
  return {position.real(), position.imag(), velocity.real(), velocity.imag()};
}

TEST(LinearSupport, IsotropicSupportIsTheFreeMotionOfTheJeffcottRotor) {
  for (const double damping : {0.0, 0.1, 1 - 1e-12, 1.0, 1 + 1e-12, 5.0}) {
    const LinearSupport support = isotropic(damping);
    const FreeMotion free(damping);
    for (const double elapsed : {0.0, 1e-9, 0.03, 0.7, 3.0, 21.0, 300.0, 1000.0}) {
      const auto kernel = free.kernel(elapsed);
      const Complex position(kStart[0], kStart[1]), velocity(kStart[2], kStart[3]);
      const State exact = state_of(FreeMotion::position(kernel, damping, position, velocity),
                                   FreeMotion::velocity(kernel, damping, position, velocity));
      // Both must be right; FreeMotion rounds its phase ωd τ.
      const double allowed = std::max(2e-15, 3e-16 * elapsed) * kStart.norm();
      EXPECT_LE((support.state(0.4, kStart, elapsed) - exact).norm(), allowed) << damping << ", " << elapsed;
    }
  }
}

TEST(LinearSupport, UnbalancedIsotropicSupportIsTheJeffcottRotorAtResonanceToo) {
  const double moment = 1e-4, phase = 0.7;
  for (const double damping : {0.0, 0.1, 1 - 1e-12, 1.0, 1 + 1e-12, 5.0}) {
    for (const double speed : {0.05, 0.62, 1 - 1e-9, 1.0, 1 + 1e-12, 3.0}) {
      const LinearSupport support = isotropic(damping, {{std::polar(moment * speed * speed, phase), speed}});
      const FreeMotion free(damping);
      const effects::Unbalance unbalance(moment, phase, speed, damping);
      for (const double start : {0.0, 1.3, 5.0}) {
        for (const double elapsed : {1e-3, 0.3, 2.0, 10.0, 60.0, 300.0}) {
          const auto response = unbalance.from_rest(start, elapsed, free, free.kernel(elapsed));
          const State found = support.state(start, State::Zero(), elapsed);
          // Of the motion that may build up meanwhile, e.g. the secular growth at Ω = 1, ζ = 0.
          const double scale = moment * speed * speed * std::max(1.0, damping < 0.1 ? elapsed : 10.0);
          EXPECT_LE((found - state_of(response.position, response.velocity)).norm(), 1e-13 * scale)
              << damping << ", " << speed << ", " << elapsed;
        }
      }
    }
  }
}

TEST(LinearSupport, UndampedResonanceGrowsWithTime) {
  const LinearSupport support = isotropic(0.0, {{1.0, 1.0}});
  for (const double time : {0.1, 1.0, 10.0, 1000.0}) {
    const Complex exact = (time * std::polar(1.0, time) - std::sin(time)) / Complex(0.0, 2.0);
    const State found = support.state(0.0, State::Zero(), time);
    EXPECT_LE(std::abs(Complex(found[0], found[1]) - exact), 1e-15 * (1 + time)) << time;
  }
}

TEST(LinearSupport, CrossCouplingDrivesForwardWhirlOnceItOutgrowsDamping) {
  // k_xy = −k_yx = q: λ = −ζ ± (ζ² − 1 ± iq)^½, forward whirl at frequency 1 exactly at its onset q = 2ζ.
  for (const double damping : {0.02, 0.1, 0.5}) {
    const auto support = [&](double strength) {
      return LinearSupport(Matrix2d::Identity() + cross_coupling(strength),
                           2 * damping * Matrix2d::Identity(), {});
    };
    for (const double strength : {0.01, 0.04, 0.3, 1.0, 2.0}) {
      const double exact = -damping + std::abs(std::sqrt(Complex(damping * damping - 1, strength)).real());
      EXPECT_NEAR(support(strength).growth_rate(), exact, 2e-14) << damping << ", " << strength;
    }
    EXPECT_TRUE(support(2 * damping * (1 - 1e-9)).is_stable_in_flight());
    EXPECT_FALSE(support(2 * damping * (1 + 1e-9)).is_stable_in_flight());
    // At the onset forward whirl is a circle at frequency 1, and backward whirl decays at the rate 2ζ.
    for (const Complex rate : {Complex(0.0, 1.0), Complex(-2 * damping, -1.0)}) {
      for (const double time : {1.0, 30.0}) {
        const Complex whirl = 1e-3 * std::exp(rate * time);
        const State found = support(2 * damping).state(0.0, state_of(1e-3, 1e-3 * rate), time);
        EXPECT_LE((found - state_of(whirl, rate * whirl)).norm(), 1e-17) << rate;
      }
    }
  }
}

}  // namespace
}  // namespace rubatlas::rotor
