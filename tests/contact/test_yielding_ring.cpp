/// Flexible blades in a ring that yields.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "compliant_blades.hpp"

namespace rubatlas::contact {
namespace {

TEST(YieldingRing, HoldsTheTipWhereItYieldsTo) {
  for (const double friction : {0.0, 0.01, 0.1, 0.5}) {
    for (const double share : {0.0, 1.0}) {
      for (const double stiffness : {1e2, 1e4, 1e6}) {
        const ElasticaContact law = make({friction, share}, Ring{stiffness});
        RandomContacts contacts(kDefaultRotor, 0.2, 22);
        for (int i = 0; i < 300; ++i) {
          const Pose at = contacts.next();
          const double slip = i % 4 != 0 ? 1.0 : -1.0;
          TipForce force{};
          double bending = law.solve(at, slip).value();
          ASSERT_TRUE(law.respond(at, slip, 0.3, bending, force));
          const auto tip = law.curve().at(bending);
          const bool straight = bending == 0.0;
          const double a = at.radial + kDefaultRotor.length * (1 - force.shortening);
          const double b =
              straight ? at.tangential : at.tangential - slip * kDefaultRotor.length * tip.deflection;
          ASSERT_NEAR(std::hypot(a, b), kDefaultRotor.ring_radius + force.normal / stiffness, 2e-15)
              << friction << ", " << share << ", " << stiffness << ", " << i;
          if (!law.may_stand_straight()) {
            ASSERT_LT(law.constraint(at, slip, bending, 0.3).bending_slope, 0.0);
          }
        }
      }
    }
  }
}

TEST(YieldingRing, IsTheRigidRingInTheLimitToFirstOrder) {
  RandomContacts contacts(kDefaultRotor, 0.2, 23);
  const ElasticaContact rigid = make({0.1});
  std::vector<ElasticaContact> laws;
  for (const double stiffness : {1e7, 1e8, 1e9}) laws.push_back(make({0.1}, Ring{stiffness}));
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose at = contacts.next();
    if (at.gap < 1e-4 || at.tangential < 0.0) continue;
    const auto root = rigid.solve(at, 1.0);
    if (!root) continue;
    const double exact = rigid.constraint(at, 1.0, *root, 0.3).force.normal;
    std::array<double, 3> difference{};
    for (std::size_t k = 0; k < difference.size(); ++k) {
      difference[k] = exact - force_at(laws[k], at, 1.0, *root).normal;
    }
    EXPECT_GT(difference[2], 0.0);
    EXPECT_NEAR(difference[0] / difference[1], 10.0, 0.1) << i;
    EXPECT_NEAR(difference[1] / difference[2], 10.0, 0.1) << i;
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST(YieldingRing, UnderAStiffBladeIsTheElasticRing) {
  constexpr double kStiffnessOfRing = 1e4;
  RandomContacts contacts(kDefaultRotor, 0.1, 24);
  const ElasticRingContact ring(kDefaultRotor.geometry(), kStiffnessOfRing, {0.0});
  const ElasticaContact column = make({0.0, 0.0, Theory::elastica, 0.01}, Ring{kStiffnessOfRing});
  // With friction a blade bends by μF L³/(3 EI); the thicker blades below bend less and less.
  const ElasticRingContact rubbed(kDefaultRotor.geometry(), kStiffnessOfRing, {0.1});
  const ElasticaContact stiff = make({0.1, 0.0, Theory::elastica, 0.05}, Ring{kStiffnessOfRing});
  const ElasticaContact stiffer = make({0.1, 0.0, Theory::elastica, 0.5}, Ring{kStiffnessOfRing});
  for (int i = 0; i < 300; ++i) {
    const Pose at = contacts.next();
    const TipForce expected = force_at(ring, at);
    const TipForce found = force_at(column, at);
    EXPECT_NEAR(found.normal, expected.normal, 1e-14 * expected.normal);
    EXPECT_NEAR(found.radial, expected.radial, 1e-14 * expected.normal);
    EXPECT_NEAR(found.tangential, expected.tangential, 1e-14 * expected.normal);
    if (at.tangential < 0.0) continue;
    const double exact = force_at(rubbed, at).normal;
    const double off = std::abs(force_at(stiff, at).normal / exact - 1);
    EXPECT_LT(off, 1e-4);
    EXPECT_LT(std::abs(force_at(stiffer, at).normal / exact - 1), 2e-3 * off + 1e-13);
  }
}

TEST(YieldingRing, AddsItsComplianceToTheBladesUnderSmallLoads) {
  constexpr double kStiffnessOfRing = 1e7;
  const BladeCase column{0.0, 1.0};
  const BladeCase rubbed{0.1, 1.0};
  const double compliance = kDefaultRotor.length / column.axial_stiffness() + 1 / kStiffnessOfRing;
  const ElasticaContact straight = make(column, Ring{kStiffnessOfRing});
  const ElasticaContact bent = make(rubbed, Ring{kStiffnessOfRing});
  for (const double penetration : {1e-12, 1e-14}) {
    EXPECT_NEAR(force_at(straight, pressed_tip(penetration)).normal * compliance / penetration, 1.0, 1e-10);
    EXPECT_NEAR(force_at(bent, pressed_tip(penetration)).normal * compliance / penetration, 1.0,
                2e7 * penetration);
    // Away from top dead centre the lateral compliance L³/(3 EI) adds to this, times μ s ct/R.
    const double lateral = 1e-3;
    const double side =
        0.1 * lateral / kDefaultRotor.ring_radius * kDefaultRotor.length / 3 / rubbed.load_unit();
    EXPECT_NEAR(force_at(bent, pressed_tip(penetration, lateral)).normal * (compliance + side) / penetration,
                1.0, 1e-4);
  }
}

TEST(YieldingRing, SlopesOfTheConstraintAreItsDerivatives) {
  const ElasticaContact law = make({0.1, 1.0}, Ring{1e3});
  RandomContacts contacts(kDefaultRotor, 0.2, 25);
  for (int i = 0; i < 500; ++i) {
    const Pose at = contacts.next();
    const double bending = 0.01 + 1.2 * contacts.uniform();
    const double slip = i % 2 == 0 ? 1.0 : -1.0;
    const auto h = [&](double u) { return law.residual(at, slip, law.curve_at(u)); };
    const double step = 1e-3 * bending;
    const double difference =
        (8 * (h(bending + step) - h(bending - step)) - (h(bending + 2 * step) - h(bending - 2 * step))) /
        (12 * step);
    EXPECT_NEAR(law.constraint(at, slip, bending, 0.3).bending_slope, difference, 1e-9 * 0.11 * 0.11);
  }
}

}  // namespace
}  // namespace rubatlas::contact
