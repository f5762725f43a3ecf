/// Flight on a general linear support against closed forms and the matrix exponential.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "random_support.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/harmonic.hpp"
#include "rotor/linear_support.hpp"
#include "rotor/support_matrices.hpp"

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
      const rotor::RotatingUnbalance unbalance(moment, phase, speed, damping);
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
      EXPECT_NEAR(growth_rate(support(strength)), exact, 2e-14) << damping << ", " << strength;
    }
    EXPECT_LT(growth_rate(support(2 * damping * (1 - 1e-9))), 0.0);
    EXPECT_GT(growth_rate(support(2 * damping * (1 + 1e-9))), 0.0);
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

TEST(LinearSupport, RotatingDampingDrivesForwardWhirlAboveItsThreshold) {
  // Onset at Ω = 1 + ζ/ζ_r, at whirl frequency 1; below it, and turning backward, the same damping helps.
  for (const double external : {0.0, 0.05, 0.1}) {
    for (const double rotating : {0.02, 0.1}) {
      const double threshold = 1 + external / rotating;
      const auto support = [&](double speed) {
        const SupportMatrices parts = with_rotating_damping(isotropic_shaft(external), rotating, speed);
        return LinearSupport(parts.stiffness, parts.damping, {});
      };
      EXPECT_LT(growth_rate(support(threshold * (1 - 1e-9))), 0.0);
      EXPECT_GT(growth_rate(support(threshold * (1 + 1e-9))), 0.0);
      // Whirl with the rotor grows, against it decays.
      const LinearSupport above = support(2 * threshold);
      const double time = 4 / growth_rate(above);
      EXPECT_GT(above.state(0.0, {1e-3, 0.0, 0.0, 1e-3}, time).head<2>().norm(), 10e-3);
      const LinearSupport mirrored = support(-2 * threshold);
      EXPECT_GT(mirrored.state(0.0, {1e-3, 0.0, 0.0, -1e-3}, time).head<2>().norm(), 10e-3);
      EXPECT_NEAR(growth_rate(mirrored), growth_rate(above), 1e-14);
    }
  }
}

TEST(LinearSupport, AnisotropicUndampedShaftSwingsInTwoPlanes) {
  const double soft = 0.8, stiff = 1.7, angle = 0.4;  // principal stiffnesses, direction of the soft one
  const Eigen::Rotation2Dd turn(angle);
  const Matrix2d stiffness = turn.toRotationMatrix() * Eigen::Vector2d(soft, stiff).asDiagonal() *
                             turn.toRotationMatrix().transpose();
  const LinearSupport support(stiffness, Matrix2d::Zero(), {});
  const Eigen::Vector2d position = turn.inverse() * kStart.head<2>();
  const Eigen::Vector2d velocity = turn.inverse() * kStart.tail<2>();
  for (const double time : {0.01, 1.0, 30.0, 1000.0}) {
    Eigen::Vector2d there, speed;
    for (int plane = 0; plane < 2; ++plane) {
      const double frequency = std::sqrt(plane == 0 ? soft : stiff);
      const double c = std::cos(frequency * time), s = std::sin(frequency * time);
      there[plane] = position[plane] * c + velocity[plane] * s / frequency;
      speed[plane] = velocity[plane] * c - position[plane] * s * frequency;
    }
    State exact;
    exact << turn * there, turn * speed;
    // The stiffness in turned axes and the phases are rounded.
    EXPECT_LE((support.state(0.0, kStart, time) - exact).norm(), 1e-15 * (2 + time) * kStart.norm()) << time;
  }
}

TEST(LinearSupport, EqualsTheMatrixExponentialForAnySupportAndForcing) {
  std::mt19937 random(4);
  double worst = 0.0;
  for (std::size_t trial = 0; trial < 200; ++trial) {
    const RandomSupport parts(random, trial % 4);
    const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
    for (const double elapsed : {1e-9, 0.02, 0.9, 7.0, 60.0, 1000.0}) {
      if (growth_rate(support) * elapsed > 300) continue;  // squares overflow
      const ExactFlight exact(support, elapsed);
      const double error = (support.state(1.3, kStart, elapsed) - exact.state(1.3, kStart)).norm();
      worst = std::max(worst, error / exact.scale(kStart));
    }
  }
  EXPECT_LE(worst, 1e-14);
}

TEST(LinearSupport, FortyFrequenciesAreOneMotion) {
  std::mt19937 random(7);
  const RandomSupport parts(random, LinearSupport::kMostTerms);
  const LinearSupport support(parts.stiffness, 2.0 * Matrix2d::Identity(), parts.forcing);
  for (const double elapsed : {0.5, 40.0}) {
    const ExactFlight exact(support, elapsed);
    EXPECT_LE((support.state(0.2, kStart, elapsed) - exact.state(0.2, kStart)).norm(),
              1e-14 * exact.scale(kStart));
  }
}

TEST(LinearSupport, TwoFlightsInARowAreOne) {
  std::mt19937 random(5);
  for (std::size_t trial = 0; trial < 50; ++trial) {
    const RandomSupport parts(random, 2);
    const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
    for (const double first : {0.01, 0.7, 5.0, 20.0}) {
      for (const double second : {0.02, 1.3, 9.0}) {
        const State middle = support.state(0.6, kStart, first);
        const State twice = support.state(0.6 + first, middle, second);
        const State once = support.state(0.6, kStart, first + second);
        // Rounding of the sum of times moves a state by its speed; what is lost on the way grows with the
        // flow.
        const double way =
            ExactFlight(support, second).scale(middle) + ExactFlight(support, first + second).scale(kStart);
        ASSERT_LE((twice - once).norm(), 1e-14 * (1 + first + second) * way) << trial << ", " << first;
      }
    }
  }
}

TEST(LinearSupport, FlightBackComesFromWhereItHasStarted) {
  const Matrix2d damping = 0.2 * Matrix2d::Identity();
  const LinearSupport support(Matrix2d::Identity() + cross_coupling(0.3), damping,
                              std::vector{HarmonicForcing{1e-3, 2.2}});
  for (const double elapsed : {1e-3, 0.04, 0.7, 3.0}) {
    const State end = support.state(0.4, kStart, elapsed);
    EXPECT_LE((support.state(0.4 + elapsed, end, -elapsed) - kStart).norm(), 1e-15) << elapsed;
    EXPECT_LE((support.free(support.free(kStart, elapsed), -elapsed) - kStart).norm(), 1e-15) << elapsed;
  }
  EXPECT_FALSE(support.state(0.0, kStart, -1e6).allFinite()) << "so far back would take for ever";
}

TEST(LinearSupport, RevolutionContractsPhaseVolumeByTheTraceOfDamping) {
  std::mt19937 random(6);
  for (std::size_t trial = 0; trial < 50; ++trial) {
    const RandomSupport parts(random, 1);
    const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
    const double period = 3.0;
    const State origin = support.state(0.0, State::Zero(), period);
    Eigen::Matrix4d map;
    for (int i = 0; i < 4; ++i) map.col(i) = support.state(0.0, State::Unit(i), period) - origin;
    const double scale = map.jacobiSvd().singularValues().head<3>().prod() * map.norm();
    EXPECT_NEAR(map.determinant(), std::exp(-parts.damping.trace() * period), 1e-13 * scale) << trial;
  }
}

TEST(LinearSupport, AccelerationIsTheRateOfVelocity) {
  std::mt19937 random(8);
  const RandomSupport parts(random, 3);
  const LinearSupport support(parts.stiffness, parts.damping, parts.forcing);
  const double step = 1e-4;
  const State before = support.state(0.7, kStart, 1.0 - step), after = support.state(0.7, kStart, 1.0 + step);
  const State now = support.state(0.7, kStart, 1.0);
  const Complex rate = Complex(after[2] - before[2], after[3] - before[3]) / (2 * step);
  const Complex acceleration = support.acceleration(1.7, now);
  EXPECT_LE(std::abs(rate - acceleration), 1e-6 * std::abs(acceleration));
  EXPECT_EQ(acceleration, support.acceleration(now) + support.forcing(1.7));
}

TEST(LinearSupport, TermsOfOneFrequencyAreOneTerm) {
  const LinearSupport two = isotropic(0.1, {{{1.0, 0.5}, 0.0}, {2.0, 0.6}, {{0.25, -2.0}, 0.0}});
  const LinearSupport one = isotropic(0.1, {{{1.25, -1.5}, 0.0}, {2.0, 0.6}});
  EXPECT_EQ(two.terms().size(), 2u);
  EXPECT_EQ(two.state(0.3, kStart, 5.0), one.state(0.3, kStart, 5.0));
}

TEST(LinearSupport, NoTimeIsNoMotion) {
  const LinearSupport support = isotropic(0.1, {{1.0, 0.0}, {2.0, 0.6}});
  EXPECT_EQ(support.state(0.3, kStart, 0.0), kStart);
}

TEST(LinearSupport, MisuseIsRefused) {
  const Matrix2d unit = Matrix2d::Identity();
  std::vector<HarmonicForcing> forcing;
  for (std::size_t j = 0; j <= LinearSupport::kMostTerms; ++j)
    forcing.push_back({1.0, 0.1 * static_cast<double>(j)});
  EXPECT_THROW(LinearSupport(unit, unit, forcing), std::invalid_argument);
  forcing.pop_back();
  EXPECT_NO_THROW(LinearSupport(unit, unit, forcing));
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(LinearSupport(unit * nothing, unit, {}), std::invalid_argument);
  EXPECT_THROW(LinearSupport(unit, unit * nothing, {}), std::invalid_argument);
  EXPECT_THROW(isotropic(0.1, {{1.0, nothing}}), std::invalid_argument);
}

}  // namespace
}  // namespace rubatlas::rotor
