/// Several blades at once: their number, equal instants, and no blade that counts more than another.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "../support/point.hpp"
#include "recorded_motion.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using modes::Guard;
using rotor::State;

/// Runs a test with both laws.
template <class Test>
void with_each_law(const HardRotor& rotor, Test test) {
  {
    SCOPED_TRACE("elastica");
    test(rotor.elastica());
  }
  {
    SCOPED_TRACE("elastic ring");
    test(rotor.elastic_ring());
  }
}

State turned(const State& state, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * state[0] - s * state[1], s * state[0] + c * state[1], c * state[2] - s * state[3],
          s * state[2] + c * state[3]};
}

TEST(ManyBlades, ToleranceHoldsHoweverManyTouchAtOnce) {
  // Two to fifty blades, deep enough that several touch together: two tolerances agree, and the work stays in
  // proportion to the touch-downs.
  struct Way {
    settings::ContactLaw law;
    settings::Method method;
    std::uint64_t evaluations;  ///< at most, for each touch-down and lift-off
  };
  // By collocation eight are made side by side.
  for (const Way& way : {Way{settings::ContactLaw::elastica, settings::Method::hybrid, 500},
                         Way{settings::ContactLaw::elastica, settings::Method::collocation, 8 * 40},
                         Way{settings::ContactLaw::elastic_ring, settings::Method::hybrid, 200}}) {
    for (const int blades : {2, 4, 5, 12, 50}) {
      SCOPED_TRACE(::testing::Message() << blades << " blades, law " << static_cast<int>(way.law)
                                        << ", method " << static_cast<int>(way.method));
      settings::Scene scene = default_rotor(2);
      scene.contact.law = way.law;
      scene.accuracy.method = way.method;
      scene.blades.count = blades;
      scene.blades.thickness = 2e-4;
      scene.ring.stiffness = 10.0;
      scene.rotor.misalignment = 0.014;
      scene.accuracy.tolerance = 1e-9;
      const auto loose = run(scene, 0.3);
      scene.accuracy.tolerance = 1e-11;
      const auto tight = run(scene, 0.3);
      ASSERT_EQ(loose.status, PointStatus::done);
      ASSERT_EQ(tight.status, PointStatus::done);
      EXPECT_GT(tight.work.touchdowns, static_cast<std::uint64_t>(blades));
      const double contacts = static_cast<double>(1 + tight.work.touchdowns);
      EXPECT_LE(largest_difference(loose.final_state, tight.final_state),
                10.0 * contacts * 1e-9 * scene.clearance());
      EXPECT_LE(loose.work.right_hand_sides, way.evaluations * (loose.work.touchdowns + loose.work.liftoffs));
    }
  }
}

TEST(ManyBlades, BladesThatTouchAtTheSameInstantAllTouch) {
  // A shaft on the bisector of two blades, a rounding away from where both tips stand on the ring, and moving
  // out: which of them comes first is rounding, that both come at once is not.
  HardRotor rotor;
  rotor.misalignment = 0.0;
  for (const int blades : {2, 4, 5, 50}) {
    SCOPED_TRACE(blades);
    rotor.blades = blades;
    const double bisector = std::numbers::pi / blades;
    const double across = rotor.length * std::sin(bisector);
    const double distance = std::sqrt((rotor.ring_radius - across) * (rotor.ring_radius + across)) -
                            rotor.length * std::cos(bisector);
    const State start = turned({distance - 1e-15, 0.0, 0.2, 0.0}, bisector);
    with_each_law(rotor, [&](const auto& law) {
      const auto motion = hybrid_motion(rotor.constants(), rotor::BladeSet(blades, rotor.speed_ratio), law,
                                        kNoForcing, rotor.limits());
      auto recording = Recording(kNoPiece);
      ASSERT_EQ(motion->start(rotor::as_array(start)), ending::StatusDetail::none);
      revolve(*motion, recording);
      std::vector<modes::Event> touchdowns;
      for (const auto& entry : recording.events) {
        if (entry.event.kind == Guard::touch_down) touchdowns.push_back(entry.event);
      }
      ASSERT_GE(touchdowns.size(), 2U);
      EXPECT_EQ(touchdowns[0].blade + touchdowns[1].blade, 1) << "blades 0 and 1";
      EXPECT_NEAR(touchdowns[0].time, 0.0, 1e-13);
      EXPECT_NEAR(touchdowns[1].time, 0.0, 1e-13);
    });
  }
}

TEST(ManyBlades, NoBladeCountsMoreThanAnother) {
  // Around a centred shaft the whole motion can be turned by a blade spacing: another blade does what one
  // did, at the same time, and the section is turned.
  HardRotor rotor;
  rotor.misalignment = 0.0;
  rotor.speed_ratio = 0.35;
  rotor.damping_ratio = 0.02;
  const State start{0.004, 0.002, 0.012, -0.009};
  for (const int blades : {2, 4, 5, 50}) {
    SCOPED_TRACE(blades);
    rotor.blades = blades;
    with_each_law(rotor, [&](const auto& law) {
      const auto motion = follow(rotor, law, kNoForcing, start, 3, kNoPiece);
      ASSERT_EQ(motion.status, PointStatus::done);
      ASSERT_GE(motion.work.touchdowns, 2U);
      for (const int by : {1, blades / 2}) {
        const double angle = 2.0 * std::numbers::pi * by / blades;
        const auto other = follow(rotor, law, kNoForcing, turned(start, angle), 3, kNoPiece);
        ASSERT_EQ(other.status, PointStatus::done);
        ASSERT_EQ(other.events.size(), motion.events.size());
        for (std::size_t i = 0; i < motion.events.size(); ++i) {
          EXPECT_EQ(other.events[i].event.kind, motion.events[i].event.kind) << i;
          EXPECT_EQ(other.events[i].event.blade, (motion.events[i].event.blade + by) % blades) << i;
        }
        const double difference =
            (other.sections.back() - turned(motion.sections.back(), angle)).abs().maxCoeff();
        EXPECT_LE(difference, 1e-8 * rotor.clearance());
      }
    });
  }
}

}  // namespace
}  // namespace rubatlas::test
