/// What ends a contact is found in whatever step it lies: lift-offs near the head-on point, slips that turn
/// round twice in a step, and the limits of validity.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>

#include "../support/point.hpp"
#include "recorded_motion.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using modes::Guard;
using rotor::State;

/// Largest difference of the states after a revolution, relative to the clearance.
double difference(const HardRotor& rotor, const RecordedMotion& a, const RecordedMotion& b,
                  std::size_t revolution) {
  return (a.sections.at(revolution) - b.sections.at(revolution)).abs().maxCoeff() / rotor.clearance();
}

/// A rotor like the paper's rig.
HardRotor rig() {
  HardRotor rotor;
  rotor.speed_ratio = 0.605;
  rotor.damping_ratio = 0.05;
  rotor.misalignment = 0.00036;
  rotor.ring_radius = 0.0625;
  rotor.hub_radius = 0.02215;
  rotor.length = 0.04;
  rotor.thickness = 0.0005;
  rotor.bending_stiffness = 206e9 * 0.0127 * std::pow(rotor.thickness, 3) / 12.0;
  rotor.friction = 0.2;
  rotor.force_unit = 1.0 / (0.5 * 189.94 * 189.94);
  return rotor;
}

TEST(Guards, LiftOffWhereGapAndForceVanishInOneStepErrsByTheTolerance) {
  HardRotor rotor = rig();
  const auto motion = [&](double tolerance) {
    rotor.tolerance = tolerance;
    return follow(rotor, rotor.elastica(), kNoForcing, State::Zero(), 3, kNoPiece);
  };
  const auto exact = motion(1e-13);
  for (const double tolerance : {1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    const auto found = motion(tolerance);
    for (std::size_t revolution = 0; revolution < 3; ++revolution) {
      EXPECT_LE(difference(rotor, found, exact, revolution), 20.0 * tolerance) << tolerance;
    }
  }
}

struct LiftOff {
  State state;
  bool under_load;  ///< there is a force up to it
};

/// The first lift-off of a motion of one blade.
template <class Law>
std::optional<LiftOff> first_lift_off(const HardRotor& rotor, const Law& law, const State& start,
                                      bool collocates) {
  double force = 0.0;
  bool touched = false;
  bool left = false;
  const auto on_piece = [&](trajectory::MotionPiece& piece) {
    left = left || (touched && piece.contact_count() == 0);
    if (left || piece.contact_count() == 0) return;
    touched = true;
    force = piece.normal_force(0, piece.end());
  };
  const auto motion = follow(rotor, law, kNoForcing, start, 1, on_piece, collocates);
  const auto lift_offs = motion.of_kind(Guard::lift_off);
  if (lift_offs.empty()) return std::nullopt;
  return LiftOff{lift_offs.front().state, force > 0.0};
}

TEST(Guards, ContactsThatEndOnTheRecedingSideErrByTheToleranceHoweverNearTheyAreToHeadOn) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto between_powers = [&](double low, double high) {
    return std::pow(10.0, low + (high - low) * uniform(random));
  };
  HardRotor rotor;
  rotor.blades = 1;
  rotor.misalignment = 0.0;
  int receding = 0;
  for (const double friction : {0.05, 0.2, 0.5}) {
    rotor.friction = friction;
    const auto law = rotor.elastica();
    for (int i = 0; i < 40; ++i) {
      rotor.speed_ratio = 0.2 + 0.8 * uniform(random);
      const double across = between_powers(-6.0, -3.0);
      const double along =
          std::sqrt(rotor.ring_radius * rotor.ring_radius - across * across) - rotor.length - 1e-9;
      const double outward = between_powers(-4.0, -2.0);
      const State start{along, across, outward, 1e-3 * (uniform(random) - 0.5)};
      rotor.tolerance = 1e-13;
      const auto exact = first_lift_off(rotor, law, start, false);
      if (!exact || !exact->under_load) continue;
      ++receding;
      for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
        rotor.tolerance = tolerance;
        const auto error = [&](bool collocates) {
          const auto found = first_lift_off(rotor, law, start, collocates);
          const double infinity = std::numeric_limits<double>::infinity();
          return found ? (found->state - exact->state).abs().maxCoeff() / (tolerance * rotor.clearance())
                       : infinity;
        };
        EXPECT_LE(error(false), 20.0) << "in steps";
        EXPECT_LE(error(true), 40.0) << "friction " << friction << ", speed " << rotor.speed_ratio
                                     << ", across " << across << ", tolerance " << tolerance;
      }
    }
  }
  EXPECT_GT(receding, 60);
}

TEST(Guards, SlipThatReversesTwiceInAStepDoesSoAtEveryTolerance) {
  // The last section by steps of 3e-6 of the classical method, with slip directions changed between steps,
  // which errs by 4e-6 m.
  HardRotor rotor;
  rotor.ring_radius = 0.03;
  rotor.length = 0.02;
  rotor.friction = 0.5;
  rotor.speed_ratio = 0.53;
  const State by_fixed_steps{7.0495e-3, -4.252e-4, 1.7620e-3, -1.6959e-3};
  for (const double tolerance : {1e-8, 1e-9, 1e-11}) {
    rotor.tolerance = tolerance;
    const auto motion = follow(rotor, rotor.elastic_ring(), kNoForcing, State::Zero(), 8, kNoPiece);
    ASSERT_EQ(motion.status, PointStatus::done);
    EXPECT_EQ(motion.work.slip_reversals, 9U);
    EXPECT_LE((motion.sections.back() - by_fixed_steps).abs().maxCoeff(), 1e-5) << tolerance;
  }
}

TEST(Guards, SlipThatReversesAgainInTheStepAfterAReversalDoesSoAtEveryTolerance) {
  HardRotor rotor;
  rotor.ring_stiffness = 72520.0;
  rotor.friction = 0.4091;
  rotor.damping_ratio = 0.02458;
  rotor.speed_ratio = 0.2693;
  const State start{-0.004712, 0.004175, -0.0362, 0.00332};
  // By steps of 1e-6, which err by 1e-3 m in the velocities.
  const State by_fixed_steps{0.011842, -0.004377, 0.082195, -0.070436};
  const auto motion = [&](double tolerance) {
    rotor.tolerance = tolerance;
    return follow(rotor, rotor.elastic_ring(), kNoForcing, start, 1, kNoPiece);
  };
  const auto exact = motion(1e-12);
  EXPECT_LE((exact.sections.front() - by_fixed_steps).abs().maxCoeff(), 2e-3);
  for (const double tolerance : {1e-8, 1e-9, 1e-10, 1e-11}) {
    const auto found = motion(tolerance);
    EXPECT_EQ(found.work.slip_reversals, exact.work.slip_reversals);
    EXPECT_LE(difference(rotor, found, exact, 0), 1e4 * tolerance) << tolerance;
  }
}

TEST(Guards, SlipOfATipThatIsHeldUntilItsForceEndsMayDipBelowZero) {
  HardRotor rotor;
  rotor.speed_ratio = 0.24804789922863912;
  rotor.friction = 0.45;
  const State start{0.0015771167237649975, -0.0022065293944549345, 0.029356464879735131,
                    -0.023620726224428068};
  const contact::ElasticaContact law(
      rotor.geometry(), {rotor.length, rotor.thickness, rotor.bending_stiffness},
      std::make_shared<blade::ElasticaCurve>(rotor.friction), {.releases_at_fold = true});
  const auto motion = [&](double tolerance) {
    rotor.tolerance = tolerance;
    return follow(rotor, law, kNoForcing, start, 1, kNoPiece);
  };
  const auto exact = motion(1e-12);
  ASSERT_EQ(exact.status, PointStatus::done);
  for (const double tolerance : {1e-8, 1e-9, 1e-10}) {
    const auto found = motion(tolerance);
    ASSERT_EQ(found.status, PointStatus::done);
    EXPECT_EQ(found.work.slip_reversals, exact.work.slip_reversals);
    EXPECT_LE(difference(rotor, found, exact, 0), 1e4 * tolerance) << tolerance;
  }
}

TEST(Guards, ValidityIsLeftAtTheSameTimeWhateverTheStepsThatPassIt) {
  HardRotor rotor;
  rotor.speed_ratio = 0.45;
  rotor.max_shortening = 0.1;
  double first_end = 0.0;
  for (const double tolerance : {1e-10, 1e-9, 1e-7, 1e-6}) {
    rotor.tolerance = tolerance;
    double end = 0.0;
    const auto motion = follow(rotor, rotor.elastica(), kNoForcing, State::Zero(), 12,
                               [&](trajectory::MotionPiece& piece) { end = piece.end(); });
    EXPECT_EQ(motion.status, PointStatus::left_validity) << tolerance;
    EXPECT_EQ(motion.sections.size(), 10U) << tolerance;
    if (first_end == 0.0) first_end = end;
    EXPECT_NEAR(end, first_end, 1e-2) << tolerance;
  }
}

TEST(Guards, ABladeThatIsBentTooFarWhereItTouchesDownLeavesValidityAtOnce) {
  HardRotor rotor;
  rotor.speed_ratio = 0.108;
  rotor.friction = 0.3805;
  const State start{4.502e-3, 2.133e-3, -0.03186, -0.02665};
  for (const double tolerance : {1e-6, 1e-8, 1e-9, 1e-12}) {
    rotor.tolerance = tolerance;
    const auto motion = follow(rotor, rotor.elastica(), kNoForcing, start, 4, kNoPiece);
    EXPECT_EQ(motion.status, PointStatus::left_validity) << tolerance;
    EXPECT_EQ(motion.sections.size(), 1U) << tolerance;
    EXPECT_EQ(motion.work.touchdowns, 3U) << tolerance;
  }
}

TEST(Guards, AShaftThatFliesToTheRingLeavesValidityHoweverShortlyItIsThere) {
  // On a support a hundred times as fast as the rotor turns, to the side where no blade stands.
  settings::Scene scene = default_rotor(1);
  scene.blades.count = 1;
  scene.rotor.damping_ratio = 0.0;
  scene.rotor.misalignment = 0.0;
  scene.support.emplace().stiffness_xx = 1e6;  // N/m
  const double frequency = std::sqrt(1.0 + 1e6 / 100.0);
  const double begin = -0.1;
  for (const double beyond : {-1e-3, -1e-6, -1e-9, 1e-9, 1e-6, 1e-3}) {
    SCOPED_TRACE(beyond);
    const double amplitude = (1.0 + beyond) * scene.ring.radius;
    const double velocity = -frequency * std::sqrt(amplitude * amplitude - begin * begin);
    const auto outcome = run(scene, 0.05, {begin, 0.0, velocity, 0.0});
    EXPECT_EQ(outcome.detail == ending::StatusDetail::shaft_at_ring, beyond > 0.0);
    EXPECT_EQ(outcome.work.touchdowns == 0U, beyond > 0.0) << "it would come back and touch";
  }
}

TEST(Guards, ABladeThatStandsAtItsFoldWhereAnIntervalBeginsIsReleasedThere) {
  // In revolution 4 a contact goes on at its fold, to rounding, where another one has ended.
  constexpr int kRevolutions = 6;
  constexpr double kAllowed = 1e-8;  // m: both tolerances, 1e-11 m, which this motion magnifies
  settings::Scene scene = default_rotor(kRevolutions);
  scene.release.emplace().at_fold = true;
  scene.observables = {"poincare"};
  const auto sections = [&](settings::Method method) {
    scene.accuracy.method = method;
    const auto outcome = run(scene, 0.7367415730337079);
    EXPECT_EQ(outcome.status, PointStatus::done) << static_cast<int>(outcome.detail);
    return outcome.rows.at(0);
  };
  const auto by_collocation = sections(settings::Method::collocation);
  const auto in_steps = sections(settings::Method::hybrid);
  for (std::size_t i = 0; i < kRevolutions; ++i)
    EXPECT_LT(largest_difference(section(by_collocation, i), section(in_steps, i)), kAllowed) << i;
}

TEST(Guards, ADefaultRotorIsNotAskedForDenseOutputToShowThatNothingHappens) {
  // In steps: 12 evaluations an attempt, 2 at the start of a contact, 3 for dense output at its end and at
  // sections.
  HardRotor rotor;
  rotor.tolerance = 1e-9;
  std::uint64_t evaluations = 0;
  std::uint64_t needed = 0;
  for (const double speed : {0.1, 0.2, 0.3, 0.45, 0.62, 0.8}) {
    rotor.speed_ratio = speed;
    const auto motion = follow(rotor, rotor.elastica(), kNoForcing, State::Zero(), 20, kNoPiece, false);
    evaluations += motion.work.right_hand_sides;
    needed += 12 * (motion.work.steps + motion.work.rejected_steps) + 5 * motion.work.touchdowns;
  }
  EXPECT_LE(static_cast<double>(evaluations), 1.01 * static_cast<double>(needed));
}

}  // namespace
}  // namespace rubatlas::test
