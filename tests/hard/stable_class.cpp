/// What an atlas says of a point does not hang on the digits that nobody chose: where the motion is called
/// periodic, it is that whatever the tolerance, the step or the last digits of the start; where it hangs on
/// them, it is not called periodic.
#include <gtest/gtest.h>

#include <cmath>

#include "../support/point.hpp"
#include "analysis/rules/class.hpp"
#include "analysis/rules/scene_tolerances.hpp"

namespace rubatlas::test {
namespace {

using analysis::is_periodic;
using analysis::motion_class::kAperiodic;
using analysis::motion_class::kUnresolved;
using ending::PointStatus;

struct Verdict {
  std::uint8_t motion;
  double displacement;  ///< largest [m]
};

Verdict verdict(const settings::Scene& scene, double speed, const motion::SectionState& start) {
  const auto outcome = run(scene, speed, start);
  EXPECT_EQ(outcome.status, PointStatus::done) << speed;
  return {analysis::classify(outcome.rows[0], analysis::closing_tolerance(scene)), outcome.rows[1][0]};
}

void expect_stable(settings::Scene scene, const char* name, int speeds) {
  // Transients of some speeds last for hundreds of revolutions, and how long is what digits decide.
  scene.protocol = {800, 100, 64, settings::Settle::never};
  int periodic = 0;
  int other = 0;
  for (int i = 0; i < speeds; ++i) {
    const double speed = 0.1 + 0.7 * i / (speeds - 1);
    SCOPED_TRACE(::testing::Message() << name << ", speed " << speed);
    const Verdict base = verdict(scene, speed, {});
    settings::Scene tighter = scene;
    tighter.accuracy.tolerance *= 0.1;
    // The error of a step of order eight falls with 2⁻⁸.
    settings::Scene half_steps = scene;
    half_steps.accuracy.tolerance /= 256.0;
    const Verdict variants[] = {verdict(tighter, speed, {}), verdict(half_steps, speed, {}),
                                verdict(scene, speed, {1e-10, 0.0, 0.0, 0.0}),
                                verdict(scene, speed, {0.0, -1e-10, 0.0, 1e-10})};
    for (const Verdict& variant : variants) {
      if (is_periodic(base.motion)) {
        EXPECT_EQ(variant.motion, base.motion);
        EXPECT_NEAR(variant.displacement, base.displacement, 1e-5 * base.displacement);
      } else {
        EXPECT_TRUE(variant.motion == kUnresolved || variant.motion == kAperiodic)
            << static_cast<int>(base.motion) << " became " << static_cast<int>(variant.motion);
      }
    }
    // A motion that settles is the same motion; one whose class the protocol leaves open may come out as
    // periodic.
    settings::Scene settling = scene;
    settling.protocol.settle = settings::Settle::newton;
    const Verdict settled = verdict(settling, speed, {});
    if (base.motion != kUnresolved) {
      EXPECT_EQ(settled.motion, base.motion);
      EXPECT_NEAR(settled.displacement, base.displacement, 1e-5 * base.displacement);
    }
    (is_periodic(base.motion) ? periodic : other) += 1;
  }
  EXPECT_GT(periodic, speeds / 7);
  EXPECT_GT(other, speeds / 7);
}

settings::Scene in_an_elastic_ring() {
  settings::Scene scene = default_rotor(1);
  scene.contact.law = settings::ContactLaw::elastic_ring;
  return scene;
}

constexpr int kFewSpeeds = 15;

TEST(StableClass, OfTheDefaultRotorDoesNotHangOnDigitsThatNobodyChose) {
  expect_stable(default_rotor(1), "default rotor", kFewSpeeds);
}
TEST(StableClass, OfBladesInAnElasticRingDoesNotHangOnDigitsThatNobodyChose) {
  expect_stable(in_an_elastic_ring(), "elastic ring", kFewSpeeds);
}
TEST(StableClass, OfTheTestRigDoesNotHangOnDigitsThatNobodyChose) {
  expect_stable(test_rig(1), "test rig", kFewSpeeds);
}

TEST(StableClassSlow, AtSpeedsSideBySideDoesNotHangOnDigitsThatNobodyChose) {
  constexpr int kSideBySide = 29;
  expect_stable(default_rotor(1), "default rotor", kSideBySide);
  expect_stable(in_an_elastic_ring(), "elastic ring", kSideBySide);
  expect_stable(test_rig(1), "test rig", kSideBySide);
}

}  // namespace
}  // namespace rubatlas::test
