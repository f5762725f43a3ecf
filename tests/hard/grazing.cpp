/// Grazing: touch-downs so shallow that sampling, sign tests or an error estimate step over them.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "../support/honest_end.hpp"
#include "../support/machine_of.hpp"
#include "../support/point.hpp"
#include "contact/pose.hpp"
#include "modes/flight.hpp"
#include "modes/touchdown_search.hpp"
#include "modes/work_meter.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::test {
namespace {

// Lengths that add up without rounding, so that a depth of 1e-12 of the clearance is what it says.
constexpr double kRadius = 0.140625;  // R [m]
constexpr double kReach = 0.125;      // rh + L [m]
constexpr double kClearance = kRadius - kReach;

/// Number i of 401 depths from 1e-3 to 1e-12 of the clearance, evenly spaced in the logarithm [-].
double swept_depth(int i) {
  return std::pow(10.0, -3.0 - 9.0 * i / 400.0);
}

/// An undamped rotor, whirling freely around the ring's centre with the amplitude ρ: z = ρ e^{i(τ − t0)}, so
/// that g of blade k is a harmonic motion in time, (rh+L)² + ρ² − R² + 2 (rh+L) ρ cos((1 − Ω) τ − t0 −
/// 2πk/n).
class FreeWhirl {
 public:
  using Search = modes::TouchdownSearch;

  FreeWhirl(int blades, double speed_ratio)
      : machine_(machine_of({speed_ratio, 0.0, 0.0, 1.0, kClearance}, rotor::BladeSet(blades, speed_ratio),
                            kNoForcing)),
        flight_(machine_),
        search_(flight_, {static_cast<std::size_t>(blades), contact::Geometry{kReach, kRadius}}, meter_) {}

  /// First touch-down of the whirl with amplitude ρ that has been at angle −t0 at τ = 0, from τ = `from` on.
  std::optional<Search::Touchdown> first_touchdown(double amplitude, double delay, double from,
                                                   double until) {
    const double angle = from - delay;
    const double x = amplitude * std::cos(angle);
    const double y = amplitude * std::sin(angle);
    flight_.start(from, rotor::shaft_and_ring(rotor::State{x, y, -y, x}));
    meter_.begin_revolution(nobody_);
    return search_.find(until);
  }
  [[nodiscard]] std::uint64_t evaluations() const { return search_.evaluations(); }

 private:
  rotor::Machine machine_;
  modes::Flight flight_;
  modes::GoOn nobody_;
  modes::WorkMeter meter_;
  Search search_;
};

TEST(Grazing, NoTouchdownOfASweptWhirlIsMissedAndNoneIsInvented) {
  // g is harmonic with one maximum per blade in each turn against the rotor, of height set by ρ alone: every
  // flight that reaches the ring has its touch-down where cos of the angle says, every other one has none.
  const double speed = 0.3;
  const double turn = 2.0 * std::numbers::pi / (1.0 - speed);
  FreeWhirl whirl(1, speed);
  int found = 0;
  int invented = 0;
  for (int i = 0; i <= 400; ++i) {
    const double depth = swept_depth(i) * kClearance;
    const double delay = 0.37 * turn * (1.0 - speed) + 0.01 * i;  // each graze at another time
    const double top = delay / (1.0 - speed);
    const double amplitude = kClearance + depth;
    // From just behind the last maximum, where the gap still opens, to just before this one.
    const double from = top - (0.05 + 0.09 * (i % 11)) * turn;
    const auto touchdown = whirl.first_touchdown(amplitude, delay, from, top + 0.5 * turn);
    if (touchdown) {
      ++found;
      // g = 0: sin²(angle/2) = depth (2R − depth … ) / (4 (rh+L) ρ), exact for the harmonic motion.
      const double rise = depth * (2.0 * kReach + 2.0 * kClearance + depth);
      const double half_angle = std::asin(std::sqrt(rise / (4.0 * kReach * amplitude)));
      const double exact = top - 2.0 * half_angle / (1.0 - speed);
      // Rounding of g, 1e-17 m², over its rate 2 (rh+L) ρ (1 − Ω) sin(angle).
      const double rate = 2.0 * kReach * amplitude * (1.0 - speed) * std::sin(2.0 * half_angle);
      EXPECT_NEAR(touchdown->time, exact, 3e-17 / rate + 1e-14) << "depth " << swept_depth(i);
    }
    if (whirl.first_touchdown(kClearance - depth, delay, from, top + 0.5 * turn)) ++invented;
  }
  EXPECT_EQ(found, 401);
  EXPECT_EQ(invented, 0);
  EXPECT_LE(whirl.evaluations(), 802U * 40U) << "a graze is found by few steps, not by creeping";
}

/// A scene with the lengths above, blades (or a ring) so soft that a contact moves the shaft by less than
/// 1e-9 of how deep it is, and a rotor at rest `depth` beyond the clearance.
settings::Scene resting_rotor(settings::ContactLaw law, double depth, int revolutions) {
  settings::Scene scene = default_rotor(revolutions);
  scene.contact.law = law;
  scene.blades.length = kReach;
  scene.blades.youngs_modulus = 1e-3;
  scene.ring.radius = kRadius;
  scene.ring.stiffness = 1e-9;
  scene.rotor.misalignment = kClearance * (1.0 + depth);
  scene.observables = {"touchdowns_per_revolution"};
  return scene;
}

TEST(Grazing, EachBladeTouchesOncePerRevolutionHoweverShallow) {
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    for (int decade = 3; decade <= 12; ++decade) {
      const double depth = std::pow(10.0, -decade);
      for (const int blades : {1, 3, 50}) {
        settings::Scene scene = resting_rotor(law, depth, 10);
        scene.blades.count = blades;
        const auto touching = run(scene, 0.3);
        ASSERT_EQ(touching.status, ending::PointStatus::done) << "depth 1e-" << decade;
        EXPECT_EQ(touching.rows[0][0], blades) << "depth 1e-" << decade << ", law " << static_cast<int>(law);
        scene.rotor.misalignment = kClearance * (1.0 - depth);
        const auto clear = run(scene, 0.3);
        ASSERT_EQ(clear.status, ending::PointStatus::done);
        EXPECT_EQ(clear.work.touchdowns, 0U);
        EXPECT_EQ(clear.work.right_hand_sides, 0U);
      }
    }
  }
}

/// Unbalance turns the shaft with the rotor, from the start in its steady whirl: blade 1 stays at the same
/// gap for ever, `depth` of the clearance beyond the ring (negative: below it).
point::PointOutcome locked_whirl(double depth) {
  const double speed = 0.8;
  settings::Scene scene = resting_rotor(settings::ContactLaw::elastica, 0.0, 5);
  scene.observables = {"touchdowns_per_revolution", "contact_fraction"};
  scene.rotor.misalignment = 0.0;
  scene.accuracy.tolerance = std::min(1e-9, 0.1 * std::abs(depth));  // a depth below it is none
  const double amplitude = kClearance * (1.0 + depth);
  const std::complex<double> stiffness(1.0 - speed * speed, 2.0 * scene.rotor.damping_ratio * speed);
  scene.unbalance =
      settings::Unbalance{amplitude * std::abs(stiffness) / (speed * speed), std::arg(stiffness)};
  auto outcome = run(scene, speed, {amplitude, 0.0, 0.0, speed * amplitude});
  expect_an_honest_end(scene, outcome);
  return outcome;
}

TEST(Grazing, ATipThatTouchesAHairPastTopDeadCentreIsPressedIn) {
  // Half a nanometre past: the force sets in with 1e-5 N, by less than the rounding of the gap.
  settings::Scene scene = default_rotor(1);
  scene.rotor.damping_ratio = 0.06;
  for (const auto method : {settings::Method::hybrid, settings::Method::collocation}) {
    for (const double tolerance : {1e-8, 1e-9, 1e-10, 1e-11}) {
      scene.accuracy = {.method = method, .tolerance = tolerance};
      const auto outcome = run(
          scene, 0.68770856507230261,
          {-0.00037071892797697713, -0.0024190551723511453, 5.656755988111379e-05, -0.0014636350087912776});
      expect_an_honest_end(scene, outcome);
      EXPECT_EQ(outcome.status, ending::PointStatus::done);
      EXPECT_EQ(outcome.work.touchdowns, 3);
      EXPECT_NEAR(outcome.final_state[0], 1.77006612e-4, 1e-10) << tolerance;
    }
  }
}

TEST(Grazing, ABladeThatStaysJustBelowTheRingNeverTouchesAtLittleCost) {
  // Bounds on slope and curvature give steps that shrink with the distance; that the amplitude does not grow
  // is what ends the search.
  for (int decade = 3; decade <= 12; ++decade) {
    SCOPED_TRACE(::testing::Message() << "depth 1e-" << decade);
    const auto outcome = locked_whirl(-std::pow(10.0, -decade));
    ASSERT_EQ(outcome.status, ending::PointStatus::done);
    EXPECT_EQ(outcome.work.touchdowns, 0U);
    EXPECT_EQ(outcome.work.right_hand_sides, 0U);
    EXPECT_LE(outcome.work.gap_evaluations, 5U * 12U);
  }
}

TEST(Grazing, ABladeThatStaysJustInsideTheRingStaysInContact) {
  // A lift-off invented by rounding would break the contact or bring touch-downs; so soft a blade does
  // neither. At 1e-12 the depth is some ten times the rounding of a gap.
  for (int decade = 3; decade <= 11; ++decade) {
    SCOPED_TRACE(::testing::Message() << "depth 1e-" << decade);
    const auto outcome = locked_whirl(std::pow(10.0, -decade));
    ASSERT_EQ(outcome.status, ending::PointStatus::done);
    EXPECT_EQ(outcome.rows[0][0], 0.0);
    EXPECT_NEAR(outcome.rows[1][0], 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace rubatlas::test
