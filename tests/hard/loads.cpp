/// Force through and far beyond the Euler load, blades from foil to block, friction from none to twice the
/// load.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../support/honest_end.hpp"
#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;

constexpr std::array kThicknesses = {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 2e-2};  // h [m]
constexpr std::array kFrictions = {0.0, 1e-4, 0.01, 0.1, 0.5, 1.0, 2.0};
constexpr double kSteel = 206e9;  // E [Pa]
constexpr double kRubber = 5e6;

double euler_load(const settings::Scene& scene) {
  const settings::Blades& blades = scene.blades;
  const double stiffness = blades.youngs_modulus * blades.width * std::pow(blades.thickness, 3) / 12.0;
  return 0.25 * std::numbers::pi * std::numbers::pi * stiffness / (blades.length * blades.length);
}

TEST(Loads, EveryBladeMaterialAndFrictionKeepsTheTolerance) {
  // From the softest to the stiffest blade a factor of 3e11. The first contacts of a rotor at rest: what
  // comes after them amplifies errors, and is not what is asked here.
  for (const double modulus : {kSteel, kRubber}) {
    for (const double thickness : kThicknesses) {
      for (const double friction : kFrictions) {
        for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
          SCOPED_TRACE(::testing::Message()
                       << "modulus " << modulus << ", thickness " << thickness << ", friction " << friction
                       << ", law " << static_cast<int>(law));
          settings::Scene scene = default_rotor(1);
          scene.contact = {law, friction};
          scene.blades.youngs_modulus = modulus;
          scene.blades.thickness = thickness;
          scene.ring.stiffness = modulus * std::pow(thickness, 3);  // as wide a range
          scene.accuracy.tolerance = 1e-9;
          const auto loose = run(scene, 0.62);
          scene.accuracy.tolerance = 1e-11;
          const auto tight = run(scene, 0.62);
          ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, loose));
          ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, tight));
          EXPECT_GT(tight.work.touchdowns, 0U);
          EXPECT_EQ(loose.status, PointStatus::done);
          EXPECT_EQ(tight.status, PointStatus::done);
          EXPECT_LE(largest_difference(loose.final_state, tight.final_state),
                    100.0 * 1e-9 * scene.clearance());
        }
      }
    }
  }
}

TEST(Loads, TheForceGoesThroughTheEulerLoadAndFarBeyond) {
  // A stiff shaft pushes its blades through and beyond buckling, up to where they are shortened by half (at
  // twice the Euler load a blade is shortened by 0.9, beyond the model): nothing special happens to the
  // integrator, whose force is a function of the bending. Without friction the blade is a column, and no load
  // below the Euler load exists.
  for (const double friction : {0.0, 1e-3, 0.1, 0.5}) {
    double largest = 0.0;
    double smallest = 1e300;
    for (int i = 0; i <= 36; ++i) {
      SCOPED_TRACE(::testing::Message() << "friction " << friction << ", " << i);
      settings::Scene scene = default_rotor(1);
      scene.contact.friction = friction;
      scene.observables = {"max_contact_force"};
      scene.rotor.mass = 100.0;  // a shaft of 1e4 N/m
      scene.rotor.misalignment = 0.01 + 5e-5 * std::pow(10.0, 0.065 * i);
      const auto loose = run(scene, 0.2);
      scene.accuracy.tolerance = 1e-11;
      const auto tight = run(scene, 0.2);
      ASSERT_EQ(loose.status, PointStatus::done);
      ASSERT_EQ(tight.status, PointStatus::done);
      EXPECT_NEAR(loose.rows[0][0], tight.rows[0][0], 1e-6 * tight.rows[0][0]);
      const double load = tight.rows[0][0] / euler_load(scene);
      largest = std::max(largest, load);
      smallest = std::min(smallest, load);
    }
    EXPECT_GT(largest, friction < 0.2 ? 1.25 : 1.1);
    if (friction == 0.0) {
      EXPECT_GT(smallest, 1.0);
    } else {
      EXPECT_LT(smallest, 1.0);
    }
  }
}

}  // namespace
}  // namespace rubatlas::test
