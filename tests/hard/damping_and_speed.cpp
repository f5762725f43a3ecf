/// The parameters at which formulas change their form, and how long a contact can last.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "../support/honest_end.hpp"
#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;

constexpr std::array<double, 7> kDampings = {0.0, 1e-4, 0.1, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 5.0};
constexpr std::array<double, 9> kSpeeds = {0.005, 0.02, 0.1, 1.0 / 3.0, 0.62, 1.0, 1.5, 3.0, 5.0};

const std::array kLaws = {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring};

TEST(DampingAndSpeed, EveryDampingAtEverySpeedConverges) {
  // Undamped, nearly undamped, critical to within a rounding, creeping; two hundred natural periods in a
  // revolution to five revolutions in one. Two tolerances agree after a revolution as far as the motion lets
  // errors be: starts that are shifted by a nanometre tell how much it amplifies what each contact adds.
  constexpr double kTolerance = 1e-10;
  constexpr double kShift = 1e-9;
  int touched = 0;
  int done = 0;
  for (const auto law : kLaws) {
    for (const double damping : kDampings) {
      for (const double speed : kSpeeds) {
        SCOPED_TRACE(::testing::Message() << "law " << static_cast<int>(law) << ", damping 1 + "
                                          << damping - 1.0 << ", speed " << speed);
        settings::Scene scene = default_rotor(1);
        scene.contact.law = law;
        scene.rotor.damping_ratio = damping;
        scene.unbalance = settings::Unbalance{1e-4, 0.3};
        scene.accuracy.tolerance = kTolerance;
        const auto loose = run(scene, speed);
        scene.accuracy.tolerance = 0.1 * kTolerance;
        const auto tight = run(scene, speed);
        double growth = 1.0;
        for (std::size_t component = 0; component < 4; ++component) {
          motion::SectionState start{};
          start[component] = kShift;
          const auto shifted = run(scene, speed, start);
          if (shifted.status != PointStatus::done) continue;
          growth = std::max(growth, largest_difference(shifted.final_state, tight.final_state) / kShift);
        }
        ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, loose));
        ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, tight));
        if (tight.work.touchdowns > 0) ++touched;
        EXPECT_EQ(loose.status, tight.status);
        if (loose.status != PointStatus::done || tight.status != PointStatus::done) continue;
        ++done;
        const double contacts = static_cast<double>(1 + tight.work.touchdowns);
        EXPECT_LE(largest_difference(loose.final_state, tight.final_state),
                  10.0 * contacts * kTolerance * scene.clearance() * growth);
      }
    }
  }
  EXPECT_EQ(touched, static_cast<int>(kLaws.size() * kDampings.size() * kSpeeds.size()));
  EXPECT_EQ(done, touched);
}

TEST(DampingAndSpeed, AMotionFullOfContactsPassesThroughCriticalDampingWithoutAJump) {
  for (const auto law : kLaws) {
    settings::Scene scene = default_rotor(5);
    scene.contact.law = law;
    scene.unbalance = settings::Unbalance{1e-4, 0.0};
    scene.accuracy.tolerance = 1e-13;
    scene.rotor.damping_ratio = 1.0;
    const auto critical = run(scene, 0.3);
    ASSERT_EQ(critical.status, PointStatus::done);
    ASSERT_GT(critical.work.touchdowns, 10U);
    for (const double off : {-1e-12, 1e-12, -1e-9, 1e-9}) {
      scene.rotor.damping_ratio = 1.0 + off;
      const auto near = run(scene, 0.3);
      ASSERT_EQ(near.status, PointStatus::done);
      EXPECT_LE(largest_difference(near.final_state, critical.final_state), 1e-13 + std::abs(off)) << off;
    }
  }
}

TEST(DampingAndSpeed, AnUndampedResonantRotorGrowsWithTimeUntilItMeetsTheRing) {
  // Ω = 1, ζ = 0 with unbalance, from rest: z = (me/m) (i/2) (sin τ − τ e^{iτ}), which after N revolutions is
  // (me/m) πN (−i, 1) in (z, z'). Then the ring holds it, or the point says that it has left the model.
  settings::Scene scene = default_rotor(200);
  scene.rotor.damping_ratio = 0.0;
  scene.rotor.misalignment = 0.0;
  scene.unbalance = settings::Unbalance{1e-5, 0.0};
  const auto growing = run(scene, 1.0);
  ASSERT_EQ(growing.status, PointStatus::done);
  EXPECT_EQ(growing.work.touchdowns, 0U);
  for (std::size_t revolution = 0; revolution < 200; ++revolution) {
    const double grown = 1e-5 * std::numbers::pi * static_cast<double>(revolution + 1);
    const auto state = section(growing.rows[0], revolution);
    EXPECT_LE(largest_difference(state, {0.0, -grown, grown, 0.0}),
              1e-13 * static_cast<double>(revolution + 1) * grown)
        << revolution;
  }
  // δc = 0.01 is passed in revolution 318.3.
  scene.protocol = {0, 500, 64};
  const auto held = run(scene, 1.0);
  ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, held));
  EXPECT_GT(held.work.touchdowns, 0U);
  EXPECT_TRUE(held.status == PointStatus::done || held.failed_revolution >= 318);
}

TEST(DampingAndSpeed, ADeeplyMisalignedRotorIsInContactForEver) {
  // Soft blades under a shaft far off the ring's centre: one or two of eight always touch, there is no flight
  // to search, and each blade comes and goes once in a revolution.
  settings::Scene scene = default_rotor(20);
  scene.blades.count = 8;
  scene.blades.thickness = 1e-4;
  scene.rotor.misalignment = 0.018;
  scene.observables = {"contact_fraction", "touchdowns_per_revolution"};
  scene.protocol.transient_revolutions = 20;
  for (const double speed : {0.05, 0.3, 0.6}) {
    const auto outcome = run(scene, speed);
    ASSERT_EQ(outcome.status, PointStatus::done);
    EXPECT_EQ(outcome.work.gap_evaluations, 0U);
    EXPECT_EQ(outcome.rows[0][0], 8.0);
    EXPECT_NEAR(outcome.rows[1][0], 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace rubatlas::test
