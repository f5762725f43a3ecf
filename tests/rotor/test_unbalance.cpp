/// Flight with unbalance (MODEL 1, 4.5) through resonance, against the matrix exponential.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "exact_motion.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::test {
namespace {

using Complex = std::complex<double>;
using rotor::FreeMotion;
using rotor::Motion;

constexpr double kSpecificMoment = 1e-4;  ///< me/m [m]
constexpr double kPhase = 0.7;            ///< γ [rad]

Motion from_rest(double speed_ratio, double damping_ratio, double start, double elapsed) {
  const FreeMotion free(damping_ratio);
  const rotor::RotatingUnbalance unbalance(kSpecificMoment, kPhase, speed_ratio, damping_ratio);
  const auto response = unbalance.from_rest(start, elapsed, free, free.kernel(elapsed));
  return {response.position, response.velocity};
}

/// Distance from the exact response, in units of the largest that a rotor could have built up till then, but
/// not less than the static (me/m) Ω²: after a short flight the response is the difference of two such
/// motions.
double error(double speed_ratio, double damping_ratio, double start, double elapsed) {
  const Complex forcing =
      std::polar(kSpecificMoment * speed_ratio * speed_ratio, speed_ratio * start + kPhase);
  const Motion exact = rotor::exact_motion(damping_ratio, speed_ratio, {}, forcing, elapsed);
  const Motion found = from_rest(speed_ratio, damping_ratio, start, elapsed);
  const double stiffness = std::hypot(1 - speed_ratio * speed_ratio, 2 * damping_ratio * speed_ratio);
  const double scale =
      std::abs(forcing) * std::min(std::max(elapsed, 1.0), 2 * (1 + speed_ratio) / stiffness);
  return std::hypot(std::abs(found.position - exact.position), std::abs(found.velocity - exact.velocity)) /
         scale;
}

/// Rounding of the phases Ωτ and ωd τ, and of what they are built from.
double allowed(double speed_ratio, double elapsed) {
  return 4e-16 * (4 + (1 + speed_ratio) * elapsed);
}

TEST(Unbalance, ResponseEqualsTheMatrixExponentialAtEverySpeedAndDamping) {
  for (const double damping :
       {0.0, 1e-6, 1e-4, 0.02, 0.1, 0.13, 0.5, 1 - 1e-12, 1.0, 1 + 1e-12, 1.5, 5.0, 50.0}) {
    for (const double speed : {0.05, 0.3, 0.62, 0.9, 0.99, 0.999999, 1.0, 1.000001, 1.01, 1.2, 3.0}) {
      for (const double elapsed : {1e-3, 0.3, 2.0, 10.0, 60.0}) {
        ASSERT_LE(error(speed, damping, 1.3, elapsed), allowed(speed, elapsed))
            << "damping " << damping << ", speed ratio " << speed << ", elapsed " << elapsed;
      }
    }
  }
}

TEST(Unbalance, UndampedResonanceGrowsWithTime) {
  // Ω = 1, ζ = 0: (me/m) e^{iγ} (τ e^{iτ} − sin τ)/(2i), the secular solution and what starts it from rest.
  const Complex i(0.0, 1.0);
  for (const double time : {0.1, 1.0, 10.0, 1000.0}) {
    const Complex exact =
        std::polar(kSpecificMoment, kPhase) * (time * std::polar(1.0, time) - std::sin(time)) / (2.0 * i);
    EXPECT_LE(std::abs(from_rest(1.0, 0.0, 0.0, time).position - exact), 1e-15 * kSpecificMoment * (1 + time))
        << time;
  }
}

TEST(Unbalance, ResponseIsContinuousThroughResonance) {
  for (const double elapsed : {1.0, 30.0, 300.0}) {
    const Motion at = from_rest(1.0, 0.0, 0.0, elapsed);
    for (const double away : {1e-15, 1e-12, 1e-9}) {
      for (const double speed : {1 - away, 1 + away}) {
        const Motion near = from_rest(speed, away, 0.0, elapsed);
        // Amplitude ~ τ/2, its sensitivity ~ τ²/2 and 2τ of the forcing.
        const double bound = kSpecificMoment * (away * elapsed * (elapsed + 4) + 1e-15 * (1 + elapsed));
        EXPECT_LE(std::abs(near.position - at.position), bound) << speed << ", " << elapsed;
        EXPECT_LE(std::abs(near.velocity - at.velocity), bound) << speed << ", " << elapsed;
      }
    }
  }
}

TEST(Unbalance, BothFormsAgreeWhereTheyMeet) {
  // The forms change over at |1 − Ω² + 2iζΩ| = 0.25; on either side both must equal the exact motion.
  for (const double damping : {0.0, 0.05, 0.1}) {
    for (const double side : {-1.0, 1.0}) {
      // Ω² of the change: (1 − w)² + 4 ζ² w = 1/16.
      const double b = 2 * damping * damping - 1;
      const double square = -b + side * std::sqrt(b * b - 1 + 1.0 / 16);
      for (const double beside : {1 - 1e-12, 1.0, 1 + 1e-12}) {
        const double speed = std::sqrt(square) * beside;
        ASSERT_NEAR(std::hypot(1 - speed * speed, 2 * damping * speed), 0.25, 1e-11);
        for (const double elapsed : {0.01, 1.0, 20.0}) {
          EXPECT_LE(error(speed, damping, 0.4, elapsed), allowed(speed, elapsed)) << damping << ", " << speed;
        }
      }
    }
  }
}

TEST(Unbalance, TwoFlightsInARowAreOne) {
  // The second flight starts from the state of the first, at its time of the revolution.
  for (const double damping : {0.0, 0.05, 1.0, 2.0}) {
    for (const double speed : {0.4, 1.0, 1.7}) {
      const FreeMotion free(damping);
      for (const double first : {0.3, 4.0}) {
        for (const double second : {0.5, 7.0}) {
          const Motion start = from_rest(speed, damping, 0.2, first);
          const auto kernel = free.kernel(second);
          const Motion forced = from_rest(speed, damping, 0.2 + first, second);
          const Complex position =
              FreeMotion::position(kernel, damping, start.position, start.velocity) + forced.position;
          const Complex velocity =
              FreeMotion::velocity(kernel, damping, start.position, start.velocity) + forced.velocity;
          const Motion once = from_rest(speed, damping, 0.2, first + second);
          const double bound = 1e-15 * kSpecificMoment * speed * speed * std::pow(2 + first + second, 2);
          EXPECT_LE(std::abs(position - once.position), bound) << damping << ", " << speed;
          EXPECT_LE(std::abs(velocity - once.velocity), bound) << damping << ", " << speed;
        }
      }
    }
  }
}

TEST(Unbalance, DampedRotorSettlesOnTheSteadyWhirl) {
  // Z e^{iΩτ} with Z = (me/m) e^{iγ} Ω² / (1 − Ω² + 2iζΩ), after e^{-ζτ} = e^{-50}.
  const double damping = 0.1;
  for (const double speed : {0.3, 0.95, 1.0, 2.0}) {
    const Complex steady =
        std::polar(kSpecificMoment * speed * speed, kPhase) / Complex(1 - speed * speed, 2 * damping * speed);
    const Motion found = from_rest(speed, damping, 0.0, 500.0);
    const Complex turned = steady * std::polar(1.0, speed * 500.0);
    EXPECT_LE(std::abs(found.position - turned), 2e-13 * std::abs(steady)) << speed;
    EXPECT_LE(std::abs(found.velocity - Complex(0, speed) * turned), 2e-13 * std::abs(steady) * (1 + speed))
        << speed;
  }
}

TEST(Unbalance, AccelerationIsTheForcingOfTheResponse) {
  // Second difference of the response: z'' + 2ζ z' + z is the acceleration that the effect states.
  const double speed = 0.62;
  const double damping = 0.1;
  const rotor::RotatingUnbalance unbalance(kSpecificMoment, kPhase, speed, damping);
  EXPECT_EQ(unbalance.amplitude(), kSpecificMoment * speed * speed);
  for (const double elapsed : {0.5, 2.0, 9.0}) {
    const double step = 1e-3;
    const auto velocity = [&](double t) { return from_rest(speed, damping, 0.3, t).velocity; };
    const Complex rate = (8.0 * (velocity(elapsed + step) - velocity(elapsed - step)) -
                          (velocity(elapsed + 2 * step) - velocity(elapsed - 2 * step))) /
                         (12 * step);
    const Motion now = from_rest(speed, damping, 0.3, elapsed);
    const Complex residual =
        rate + 2 * damping * now.velocity + now.position - unbalance.acceleration(0.3 + elapsed);
    EXPECT_LE(std::abs(residual), 1e-11 * unbalance.amplitude()) << elapsed;
  }
}

}  // namespace
}  // namespace rubatlas::test
