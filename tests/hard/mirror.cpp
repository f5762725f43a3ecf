/// Mirror symmetry: a rotor that spins the other way round in the mirrored ring moves the mirrored way.
///
/// Nothing in a scene can say a negative speed; the equations can (MODEL 1, 2, 4). Mirrored about the x axis:
/// Ω and y0 change sign, blade k stands where blade n − k stood, γ changes sign, and so do y and y'.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "recorded_motion.hpp"
#include "rotor/blade_set.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using rotor::State;

State mirrored(const State& state) {
  return {state[0], -state[1], state[2], -state[3]};
}

HardRotor mirrored(HardRotor rotor) {
  rotor.speed_ratio = -rotor.speed_ratio;
  rotor.misalignment = -rotor.misalignment;
  return rotor;
}

const auto kEqualBlades = [](const HardRotor& rotor, double) {
  return rotor::BladeSet(rotor.blades, rotor.speed_ratio);
};

/// What is made for a rotor and a side, 1 or −1, is made for the mirror image where that is −1.
template <class MakeLaw, class MakeForcing, class MakeBlades = decltype(kEqualBlades)>
void expect_mirror_images(const HardRotor& rotor, MakeLaw make_law, MakeForcing make_forcing,
                          const State& start, MakeBlades make_blades = kEqualBlades) {
  const auto no_piece = [](trajectory::MotionPiece&) {};
  const HardRotor other = mirrored(rotor);
  const auto motion = follow(rotor, make_blades(rotor, 1.0), make_law(rotor, 1.0), make_forcing(rotor, 1.0),
                             start, 6, no_piece);
  const auto image = follow(other, make_blades(other, -1.0), make_law(other, -1.0), make_forcing(other, -1.0),
                            mirrored(start), 6, no_piece);
  ASSERT_EQ(motion.status, PointStatus::done);
  ASSERT_EQ(image.status, PointStatus::done);
  ASSERT_GE(motion.work.touchdowns, 2U);
  ASSERT_EQ(motion.events.size(), image.events.size());
  for (std::size_t i = 0; i < motion.events.size(); ++i) {
    const modes::Event& event = motion.events[i].event;
    const modes::Event& mirror_event = image.events[i].event;
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

const auto kElastica = [](const HardRotor& rotor, double) { return rotor.elastica(); };
const auto kElasticRing = [](const HardRotor& rotor, double) { return rotor.elastic_ring(); };
const auto kUnforced = [](const HardRotor&, double) { return kNoForcing; };
const auto kUnbalanced = [](const HardRotor& rotor, double side) {
  return rotor::RotatingUnbalance(1e-4, side * 0.7, rotor.speed_ratio, rotor.damping_ratio);
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

// Effects are mirrored like all else: a load points the other way along y, the blade that was ahead is
// behind.

const auto kLoaded = [](const HardRotor& rotor, double side) {
  return rotor::Harmonics(
      {rotor::Harmonic(8e-4, side * 0.9, 0.0, rotor.damping_ratio),
       rotor::RotatingUnbalance(5e-5, side * 0.7, rotor.speed_ratio, rotor.damping_ratio)});
};

/// Blade k of the image is blade n − k.
int image_of(int blade, int count, double side) {
  return side > 0.0 ? blade : (count - blade) % count;
}

template <class MakeLaw>
auto unequal(MakeLaw make_law) {
  return [make_law](const HardRotor& rotor, double side) {
    std::vector<decltype(make_law(rotor, side))> laws;
    for (int k = 0; k < rotor.blades; ++k) {
      HardRotor own = rotor;
      own.length += 1e-4 * (image_of(k, rotor.blades, side) % 3 - 1);
      laws.push_back(make_law(own, side));
    }
    return laws;
  };
}

std::vector<double> unequal_angles(const HardRotor& rotor, double side) {
  auto angles = rotor::equal_angles(rotor.blades);
  for (int k = 0; k < rotor.blades; ++k) {
    angles[static_cast<std::size_t>(k)] += side * 0.02 * image_of(k, rotor.blades, side);
  }
  return angles;
}

TEST(Mirror, LoadsUnequalBladesAndARipplingSpeedAreMirroredToo) {
  const auto steady = [](const HardRotor& rotor, double side) {
    return rotor::BladeSet(unequal_angles(rotor, side), rotor.speed_ratio);
  };
  const auto rippling = [](const HardRotor& rotor, double side) {
    return rotor::BladeSet(unequal_angles(rotor, side), rotor.speed_ratio, {0.2, 2, side * 0.8});
  };
  for (const double speed : {0.3, 0.62}) {
    for (const int blades : {1, 3, 4}) {
      SCOPED_TRACE(::testing::Message() << "speed " << speed << ", blades " << blades);
      HardRotor rotor;
      rotor.speed_ratio = speed;
      rotor.blades = blades;
      const State start{1e-3, 2e-3, 5e-4, -1e-3};
      expect_mirror_images(rotor, kElastica, kLoaded, start);
      expect_mirror_images(rotor, unequal(kElastica), kLoaded, start, steady);
      expect_mirror_images(rotor, unequal(kElasticRing), kLoaded, start, steady);
      expect_mirror_images(rotor, unequal(kElastica), kLoaded, start, rippling);
      expect_mirror_images(rotor, unequal(kElasticRing), kLoaded, start, rippling);
    }
  }
}

}  // namespace
}  // namespace rubatlas::test
