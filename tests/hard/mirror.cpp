/// Mirror symmetry: a rotor that spins the other way round in the mirrored ring moves the mirrored way.
///
/// Nothing in a scene can say a negative speed; the equations can (MODEL 1, 2, 4). Mirrored about the x axis:
/// Ω and y0 change sign, blade k stands where blade n − k stood, γ changes sign, and so do y and y'.
#include <gtest/gtest.h>

#include <cmath>

#include "recorded_motion.hpp"

namespace rubatlas::test {
namespace {

using solve::PointStatus;
using solve::State;

State mirrored(const State& state) {
  return {state[0], -state[1], state[2], -state[3]};
}

HardRotor mirrored(HardRotor rotor) {
  rotor.speed_ratio = -rotor.speed_ratio;
  rotor.misalignment = -rotor.misalignment;
  return rotor;
}

template <class MakeLaw, class MakeForcing>
void expect_mirror_images(const HardRotor& rotor, MakeLaw make_law, MakeForcing make_forcing,
                          const State& start) {
  const auto no_piece = [](observables::MotionPiece&) {};
  const HardRotor other = mirrored(rotor);
  const auto motion = follow(rotor, make_law(rotor), make_forcing(rotor, 1.0), start, 6, no_piece);
  const auto image = follow(other, make_law(other), make_forcing(other, -1.0), mirrored(start), 6, no_piece);
  ASSERT_EQ(motion.status, PointStatus::done);
  ASSERT_EQ(image.status, PointStatus::done);
  ASSERT_GE(motion.work.touchdowns, 2U);
  ASSERT_EQ(motion.events.size(), image.events.size());
  for (std::size_t i = 0; i < motion.events.size(); ++i) {
    const solve::Event& event = motion.events[i].event;
    const solve::Event& mirror_event = image.events[i].event;
    EXPECT_EQ(event.kind, mirror_event.kind) << i;
    EXPECT_EQ((event.blade + mirror_event.blade) % rotor.blades, 0) << i;
    EXPECT_EQ(event.slip, -mirror_event.slip) << i;
    EXPECT_NEAR(event.time, mirror_event.time, 1e-9) << i;
  }
  for (std::size_t i = 0; i < motion.sections.size(); ++i) {
    EXPECT_LE((motion.sections[i] - mirrored(image.sections[i])).abs().maxCoeff(), 1e-9 * rotor.clearance())
        << i;
  }
}

const auto kElastica = [](const HardRotor& rotor) { return rotor.elastica(); };
const auto kElasticRing = [](const HardRotor& rotor) { return rotor.elastic_ring(); };
const auto kUnforced = [](const HardRotor&, double) { return effects::NoForcing{}; };
const auto kUnbalanced = [](const HardRotor& rotor, double side) {
  return effects::RotatingUnbalance(1e-4, side * 0.7, rotor.speed_ratio, rotor.damping_ratio);
};

TEST(Mirror, ARotorThatSpinsTheOtherWayMovesTheMirroredWay) {
  for (const double speed : {0.3, 0.62}) {
    for (const int blades : {1, 3, 4}) {
      SCOPED_TRACE(::testing::Message() << "speed " << speed << ", blades " << blades);
      HardRotor rotor;
      rotor.speed_ratio = speed;
      rotor.blades = blades;
      const State start{1e-3, 2e-3, 5e-4, -1e-3};
      expect_mirror_images(rotor, kElastica, kUnforced, start);
      expect_mirror_images(rotor, kElastica, kUnbalanced, start);
      expect_mirror_images(rotor, kElasticRing, kUnforced, start);
      expect_mirror_images(rotor, kElasticRing, kUnbalanced, start);
    }
  }
}

}  // namespace
}  // namespace rubatlas::test
