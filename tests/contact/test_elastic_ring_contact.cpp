/// The contact law of rigid blades in a ring that yields (MODEL 4.7), and the gap that both laws share.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/elastic_ring_contact.hpp"
#include "rotors.hpp"

namespace rubatlas::contact {
namespace {

constexpr double kStiffness = 1e4;  // [N/m]
constexpr double kFriction = 0.1;

TEST(ElasticRingContact, ForceIsTheRingsStiffnessTimesItsYield) {
  const ElasticRingContact law(kDefaultRotor.geometry(), kStiffness, {kFriction});
  RandomContacts contacts(kDefaultRotor, 0.25, 21);
  for (int i = 0; i < 5000; ++i) {
    const Pose at = contacts.next();
    const TipForce force = law.force(at, 1.0, 0.4);
    const long double a = static_cast<long double>(at.radial) + law.geometry().reach;
    const long double b = at.tangential;
    const long double distance = std::sqrt(a * a + b * b);
    const auto yield = static_cast<double>(distance - law.geometry().ring_radius);
    ASSERT_NEAR(force.normal, kStiffness * yield, kStiffness * 2e-17) << i;
    // In the frame of normal and tangent: −F and −s μ F.
    const auto along_normal = static_cast<double>((force.radial * a + force.tangential * b) / distance);
    const auto along_tangent = static_cast<double>((force.tangential * a - force.radial * b) / distance);
    ASSERT_NEAR(along_normal, -force.normal, 1e-15 * force.normal);
    ASSERT_NEAR(along_tangent, -kFriction * force.normal, 1e-15 * force.normal);
    ASSERT_NEAR(force.slip_velocity, undeformed_slip_velocity(law.geometry(), at, 0.4), 1e-16);
    ASSERT_EQ(force.shortening, 0.0);
    ASSERT_EQ(force.root_strain, 0.0);
  }
}

TEST(ElasticRingContact, ForceIsContinuousAndLinearThroughLiftOff) {
  const ElasticRingContact law(kDefaultRotor.geometry(), kStiffness, {kFriction});
  const TipForce inside = law.force({0.01, 0.0, 0.0, 0.0, 1e-12}, 1.0, 0.4);
  const TipForce outside = law.force({0.01, 0.0, 0.0, 0.0, -1e-12}, 1.0, 0.4);
  const TipForce there = law.force({0.01, 0.0, 0.0, 0.0, 0.0}, 1.0, 0.4);
  EXPECT_EQ(there.normal, 0.0);
  EXPECT_EQ(there.radial, 0.0);
  EXPECT_EQ(outside.normal, -inside.normal);
  EXPECT_NEAR(inside.normal, kStiffness * 1e-12 / 0.22, 1e-20);
}

TEST(ElasticRingContact, MirroredMotionHasTheMirroredForce) {
  const ElasticRingContact law(kDefaultRotor.geometry(), kStiffness, {kFriction});
  RandomContacts contacts(kDefaultRotor, 0.25, 22);
  for (int i = 0; i < 1000; ++i) {
    const Pose at = contacts.next();
    Pose mirrored = at;
    mirrored.tangential = -at.tangential;
    mirrored.tangential_velocity = -at.tangential_velocity;
    const TipForce one = law.force(at, 1.0, 0.4);
    const TipForce other = law.force(mirrored, -1.0, -0.4);
    EXPECT_EQ(other.radial, one.radial);
    EXPECT_EQ(other.tangential, -one.tangential);
    EXPECT_EQ(other.normal, one.normal);
    EXPECT_EQ(other.slip_velocity, -one.slip_velocity);
  }
}

TEST(Pose, GapKeepsItsDigitsWhereTheTipTouches) {
  // |c + (rh+L) er|² − R² in 80-bit arithmetic, within what the binary64 direction of the blade leaves.
  for (const TestRotor& rotor : {kDefaultRotor, kRig}) {
    const Geometry geometry = rotor.geometry();
    const double clearance = rotor.ring_radius - geometry.reach;
    for (int k = 0; k < 1000; ++k) {
      const double angle = 0.00628 * k;
      const BladeDirection er{std::cos(angle), std::sin(angle)};
      const double overlap = 1e-6 * (k - 500) / 500;
      const double cx = (clearance + overlap) * er.cosine;
      const double cy = (clearance + overlap) * er.sine;
      const Pose at = pose(geometry, er, cx, cy, 0.0, 0.0);
      // (rh+L) and R as given; er of unit length, which its rounded components are not quite.
      const long double reach = geometry.reach;
      const long double radius = rotor.ring_radius;
      const long double exact =
          static_cast<long double>(cx) * cx + static_cast<long double>(cy) * cy +
          2 * reach * (static_cast<long double>(cx) * er.cosine + static_cast<long double>(cy) * er.sine) +
          (reach - radius) * (reach + radius);
      ASSERT_NEAR(at.gap, static_cast<double>(exact), 1e-18) << angle;
    }
  }
}

TEST(Pose, GapRateIsTheDerivativeOfTheGap) {
  const Geometry geometry = kDefaultRotor.geometry();
  const double speed = 0.62;
  for (int k = 0; k < 200; ++k) {
    const double angle = 0.0314 * k;
    const double cx = 0.012 * std::cos(1.3 * k);
    const double cy = 0.012 * std::sin(0.7 * k);
    const double vx = 0.01 * std::sin(2.1 * k);
    const double vy = 0.01 * std::cos(0.4 * k);
    const auto gap = [&](double time) {
      return pose_at(geometry, angle + speed * time, cx + vx * time, cy + vy * time).gap;
    };
    const double step = 1e-3;
    const double difference = (8 * (gap(step) - gap(-step)) - (gap(2 * step) - gap(-2 * step))) / (12 * step);
    EXPECT_NEAR(gap_rate(geometry, pose_at(geometry, angle, cx, cy, vx, vy), speed), difference, 2e-14) << k;
  }
}

TEST(Pose, SlipOfTheUndeformedTipIsItsRigidBodyVelocityAcrossTheNormal) {
  const Geometry geometry = kRig.geometry();
  RandomContacts contacts(kRig, 0.1, 23);
  for (int i = 0; i < 500; ++i) {
    const Pose at = contacts.next();
    // Tip velocity c' + Ω ez × (rh+L) er, along t = n turned by +90°.
    const double a = at.radial + geometry.reach;
    const double b = at.tangential;
    const double across = at.tangential_velocity + 0.7 * geometry.reach;
    const double expected = (-b * at.radial_velocity + a * across) / std::hypot(a, b);
    ASSERT_NEAR(undeformed_slip_velocity(geometry, at, 0.7), expected, 1e-15);
  }
}

}  // namespace
}  // namespace rubatlas::contact
