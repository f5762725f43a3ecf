/// Slip that reverses, and tips that nearly stick.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "../support/honest_end.hpp"
#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;

struct Kicked {
  int reversals = 0;  ///< a tip that comes to rest counts as one
  int done = 0;
};

/// A shaft that whirls against the spin faster than the tips run reverses the slip of every contact; where
/// both nearly cancel, the tip sticks and the model flips to and fro. Kicks of all sizes against slow and
/// fast rotors, friction from none to twice the load.
Kicked kick(settings::Scene scene, double most_steps) {
  scene.rotor.misalignment = 0.0;
  Kicked result;
  for (const double friction : {0.0, 0.1, 0.5, 2.0}) {
    for (const double speed : {0.005, 0.05, 0.3}) {
      for (int size = -10; size <= 10; ++size) {
        SCOPED_TRACE(::testing::Message()
                     << "friction " << friction << ", speed " << speed << ", kick " << size);
        scene.contact.friction = friction;
        const motion::SectionState start{0.005, 0.0, 0.0, 3e-4 * size * std::abs(size)};
        const auto outcome = run(scene, speed, start);
        expect_an_honest_end(scene, outcome);
        if (testing::Test::HasFatalFailure()) return result;
        result.reversals += static_cast<int>(outcome.work.slip_reversals);
        if (outcome.status == PointStatus::done) ++result.done;
        const auto events = static_cast<double>(1 + outcome.work.touchdowns + outcome.work.slip_reversals);
        EXPECT_LE(outcome.work.slip_reversals, 100U * (1U + outcome.work.touchdowns));
        // Not right-hand sides: an interval of collocation has more of them than a step, side by side.
        EXPECT_LE(static_cast<double>(outcome.work.steps + outcome.work.rejected_steps), most_steps * events);
        EXPECT_NE(outcome.status, PointStatus::integrator_failed);
      }
    }
  }
  return result;
}

TEST(Slip, KickedRotorsReverseTheirSlipABoundedNumberOfTimes) {
  int reversals = 0;
  int done = 0;
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    SCOPED_TRACE(::testing::Message() << "law " << static_cast<int>(law));
    settings::Scene scene = default_rotor(2);
    scene.contact.law = law;
    const Kicked kicked = kick(scene, 30.0);
    reversals += kicked.reversals;
    done += kicked.done;
  }
  EXPECT_GT(done, 400) << "kicks through the ring are few";
  EXPECT_GT(reversals, 1000);
}

TEST(Slip, TipsThatMayStickComeToRestABoundedNumberOfTimes) {
  // A tip comes loose at the very edge of the cone, and may be at rest again at once.
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    int rests = 0;
    int done = 0;
    for (const double static_ratio : {1.0, 1.0 + 1e-9, 2.0}) {
      SCOPED_TRACE(::testing::Message() << "law " << static_cast<int>(law) << ", ratio " << static_ratio);
      settings::Scene scene = default_rotor(2);
      scene.contact.law = law;
      scene.stick.emplace().static_ratio = static_ratio;
      // An elastic blade at rest is a stiff strut between hub and ring.
      const Kicked kicked = kick(scene, law == settings::ContactLaw::elastica ? 80.0 : 30.0);
      rests += kicked.reversals;
      done += kicked.done;
    }
    EXPECT_GT(done, 300) << "kicks through the ring are few";
    EXPECT_GT(rests, 500);
  }
}

TEST(Slip, OfAFlexibleTipThatChattersIntoRestIsFollowedAtEveryTolerance) {
  // In the contact of blade 3 each two reversals take 0.87 of the time of the last two, since both slipping
  // states stand close together, until the tip holds. Later on blade 1 is left neither rest nor slip.
  settings::Scene scene = default_rotor(1);
  scene.rotor.misalignment = 0.004;
  scene.stick.emplace();
  for (const double tolerance : {1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    SCOPED_TRACE(tolerance);
    scene.accuracy.tolerance = tolerance;
    const auto outcome = run(scene, 0.02, {0.005, 0.0, 0.0, 0.02917});
    EXPECT_EQ(outcome.status, PointStatus::left_validity);
    EXPECT_EQ(outcome.detail, ending::StatusDetail::slip_undecided);
    EXPECT_EQ(outcome.work.touchdowns, 5U);
    EXPECT_GT(outcome.work.slip_reversals, 60U);
    EXPECT_LT(outcome.work.slip_reversals, 200U);
  }
}

/// At the end of the revolution a contact reverses its slip at intervals of which each cycle is a fixed share
/// of the one before. Without a limit their number is a matter of rounding, and with it s.
void expect_rest_in_the_limit(settings::Scene scene, double speed_ratio, const motion::SectionState& start) {
  const auto moved = [&](double tolerance, double aside) {
    scene.accuracy.tolerance = tolerance;
    return run(scene, speed_ratio, {start[0] + aside, start[1], start[2], start[3]});
  };
  const auto finest = moved(1e-12, 0.0);
  ASSERT_EQ(finest.status, PointStatus::done);
  EXPECT_EQ(finest.work.slip_accumulations, 1U);
  for (const double tolerance : {1e-9, 1e-10, 1e-11, 1e-12}) {
    for (const double aside : {0.0, 1e-17, -1e-17, 1e-16}) {
      SCOPED_TRACE(::testing::Message() << "tolerance " << tolerance << ", aside " << aside);
      const auto outcome = moved(tolerance, aside);
      ASSERT_EQ(outcome.status, PointStatus::done);
      EXPECT_EQ(outcome.work.slip_accumulations, 1U);
      EXPECT_EQ(outcome.work.slip_reversals, finest.work.slip_reversals);
      EXPECT_LE(largest_difference(outcome.final_state, finest.final_state),
                100.0 * tolerance * scene.clearance() + 1e-13);
    }
  }
}

settings::Scene default_rotor_with_friction(double friction) {
  settings::Scene scene = default_rotor(1);
  scene.contact.friction = friction;
  return scene;
}

TEST(Slip, ReversalsThatAccumulateEndInRestWhateverTheToleranceAndTheLastDigits) {
  expect_rest_in_the_limit(default_rotor_with_friction(0.356), 0.1233,
                           {1.999e-3, 3.643e-3, 0.01703, -0.003606});
}

TEST(Slip, ReversalsThatAccumulateUnderTheNormalLoadEndInRestToo) {
  settings::Scene scene = default_rotor_with_friction(0.580342);
  scene.load_direction = effects::LoadDirection{true};
  expect_rest_in_the_limit(scene, 0.152107, {-0.002073743, -0.0009391492, 0.01479563, 0.02589101});
}

TEST(Slip, ReversalsThatAccumulateInARingThatMovesEndInRestToo) {
  settings::Scene scene = default_rotor_with_friction(0.524977);
  scene.ring_body = effects::RingBody{1.0, 1e-4, 40.0};
  expect_rest_in_the_limit(scene, 0.133429, {0.00389085, 0.004146671, -0.01551225, -0.01780531});
  scene.contact.friction = 0.481596;
  expect_rest_in_the_limit(scene, 0.122366, {-0.0009037914, 0.0024058, 0.02773649, -0.0154589});
}

TEST(Slip, ReversalsThatAccumulateWhereNoLawOfRestIsKnownLeaveValidityAtEveryTolerance) {
  for (const char* effect : {"axial compliance", "yielding ring"}) {
    settings::Scene scene = default_rotor(1);
    motion::SectionState start{};
    double speed_ratio = 0.0;
    if (effect == std::string("axial compliance")) {
      scene.axial_compliance = effects::AxialCompliance{1.0};
      scene.contact.friction = 0.480132;
      speed_ratio = 0.144118;
      start = {-0.003121118, 0.002431327, 0.01909368, -0.01034802};
    } else {
      scene.yielding_ring = effects::YieldingRing{1e-5};
      scene.contact.friction = 0.555494;
      speed_ratio = 0.047507;
      start = {-0.002311158, 0.003550517, 0.01015702, 0.0238619};
    }
    std::uint64_t reversals = 0;
    for (const double tolerance : {1e-9, 1e-10, 1e-11}) {
      SCOPED_TRACE(::testing::Message() << effect << ", tolerance " << tolerance);
      scene.accuracy.tolerance = tolerance;
      const auto outcome = run(scene, speed_ratio, start);
      EXPECT_EQ(outcome.status, PointStatus::left_validity);
      EXPECT_EQ(outcome.detail, ending::StatusDetail::slip_undecided);
      if (reversals == 0) reversals = outcome.work.slip_reversals;
      EXPECT_EQ(outcome.work.slip_reversals, reversals);
    }
  }
}

}  // namespace
}  // namespace rubatlas::test
