/// Friction laws, alone and at rigid blades on the elastic ring.
#include "contact/friction_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/elastic_ring_contact.hpp"
#include "rotors.hpp"

namespace rubatlas::contact {
namespace {

constexpr double kRingStiffness = 1e4;  // [N/m]

TEST(FrictionLaw, IsOddInTheSlipAndOpposesIt) {
  const Friction regularised = Friction::regularised(0.2, 1e-3);
  const Friction stribeck = Friction::stribeck(0.3, 0.1, 0.02, 1e-3);
  for (const double v : {1e-9, 1e-4, 1e-3, 0.01, 0.3}) {
    EXPECT_EQ(regularised.coefficient(-v, 1.0), -regularised.coefficient(v, 1.0));
    EXPECT_EQ(stribeck.coefficient(-v, 1.0), -stribeck.coefficient(v, 1.0));
    EXPECT_GT(regularised.coefficient(v, -1.0), 0.0);
    EXPECT_GT(stribeck.coefficient(v, -1.0), 0.0);
  }
  EXPECT_EQ(regularised.coefficient(0.0, 1.0), 0.0);
  EXPECT_EQ(stribeck.coefficient(0.0, 1.0), 0.0);
  EXPECT_EQ(Friction::coulomb(0.2).coefficient(-1.0, 1.0), 0.2) << "the sign is the caller's";
}

TEST(FrictionLaw, SlopesAreTheDerivativesOfTheCoefficients) {
  const Friction regularised = Friction::regularised(0.2, 0.01);
  const Friction stribeck = Friction::stribeck(0.3, 0.1, 0.02, 0.005);
  const auto difference = [](const auto& law, double v) {
    const double step = 1e-5;
    const auto c = [&](double shift) { return law.coefficient(v + shift, 1.0); };
    return (8 * (c(step) - c(-step)) - (c(2 * step) - c(-2 * step))) / (12 * step);
  };
  for (double v = -0.1; v <= 0.1; v += 0.0013) {
    EXPECT_NEAR(regularised.at(v, 1.0).slope, difference(regularised, v), 1e-9);
    EXPECT_NEAR(stribeck.at(v, 1.0).slope, difference(stribeck, v), 1e-8);
  }
}

TEST(FrictionLaw, StribeckRisesToTheStaticCoefficientAndFallsToTheKineticOne) {
  const Friction law = Friction::stribeck(0.3, 0.1, 0.02, 1e-5);
  double largest = 0.0;
  for (double v = 0.0; v < 0.1; v += 1e-6) largest = std::max(largest, law.coefficient(v, 1.0));
  EXPECT_LT(largest, 0.3);
  EXPECT_NEAR(largest, 0.3, 1e-5);
  EXPECT_EQ(law.coefficient(0.2, 1.0), 0.1);
  EXPECT_NEAR(law.coefficient(0.02, 1.0), 0.1 + 0.2 * std::exp(-1.0), 1e-15);
}

TEST(FrictionLaw, StribeckWithEqualCoefficientsIsTheRegularisedLaw) {
  const Friction stribeck = Friction::stribeck(0.2, 0.2, 0.02, 1e-3);
  const Friction regularised = Friction::regularised(0.2, 1e-3);
  for (double v = -0.01; v < 0.01; v += 1e-4)
    EXPECT_EQ(stribeck.coefficient(v, 1.0), regularised.coefficient(v, 1.0));
}

TEST(ElasticRingContact, RegularisedFrictionBecomesCoulombs) {
  RandomContacts contacts(kDefaultRotor, 0.25, 31);
  const Geometry geometry = kDefaultRotor.geometry();
  const ElasticRingContact coulomb(geometry, kRingStiffness, {0.1});
  int bitwise = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose at = contacts.next();
    const double slip = undeformed_slip_velocity(geometry, at, 0.4) >= 0.0 ? 1.0 : -1.0;
    const TipForce sharp = coulomb.force(at, slip, 0.4);
    double before = INFINITY;
    for (const double v0 : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
      const ElasticRingContact law(geometry, kRingStiffness, Friction::regularised(0.1, v0));
      const TipForce soft = law.force(at, slip, 0.4);
      const double difference =
          std::hypot(soft.radial - sharp.radial, soft.tangential - sharp.tangential) / sharp.normal;
      // 1 − tanh x = 2/(1 + exp 2x)
      const double expected = 0.1 * 2 / (1 + std::exp(2 * std::abs(sharp.slip_velocity) / v0));
      ASSERT_NEAR(difference, expected, 1e-15) << i;
      ASSERT_LE(difference, before);
      before = difference;
    }
    if (before == 0.0) ++bitwise;
  }
  EXPECT_GT(bitwise, 2900);
}

TEST(ElasticRingContact, RegularisedForceIsContinuousThroughZeroSlip) {
  const Geometry geometry = kDefaultRotor.geometry();
  const ElasticRingContact law(geometry, kRingStiffness, Friction::regularised(0.1, 1e-3));
  const double speed = 0.4;
  TipForce before{};
  for (int i = -1000; i <= 1000; ++i) {
    const double slip_velocity = 1e-6 * i;  // ct = 0, so that v = c'·et + Ω (rh+L)
    const Pose at{0.0101, 0.0, 0.0, slip_velocity - speed * geometry.reach, 2.2e-5};
    const TipForce force = law.force(at, 1.0, speed);
    ASSERT_NEAR(force.slip_velocity, slip_velocity, 1e-17);
    ASSERT_NEAR(force.tangential, -0.1 * force.normal * std::tanh(slip_velocity / 1e-3),
                1e-14 * force.normal);
    if (i > -1000) {
      ASSERT_LE(std::abs(force.tangential - before.tangential), 1.0001e-4 * force.normal);
    }
    before = force;
  }
}

}  // namespace
}  // namespace rubatlas::contact
