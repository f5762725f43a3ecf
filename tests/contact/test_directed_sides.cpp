/// Where the direction of the load matters: buckling under the true normal, the side as a memory, snapping
/// through, friction that goes through zero, and how far the axial assumption is from the normal.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>

#include "contact/sticking_elastica.hpp"
#include "directed_rotors.hpp"

namespace rubatlas::contact {
namespace {

constexpr double kPi = std::numbers::pi;

/// Pose with the undeformed tip at an overlap [m] and ct [m].
Pose pressed(const TestRotor& rotor, double overlap, double tangential, double slip_velocity = 1.0,
             double speed = 0.5) {
  const Geometry geometry = rotor.geometry();
  const double a = std::sqrt(rotor.ring_radius * rotor.ring_radius - tangential * tangential) + overlap;
  Pose at{a - geometry.reach, tangential, 0.0, 0.0, 0.0};
  at.gap =
      at.radial * at.radial + tangential * tangential + 2 * geometry.reach * at.radial + geometry.closing();
  // c' along et only, so that v of the undeformed tip is as asked for.
  at.tangential_velocity = slip_velocity * std::hypot(a, tangential) / a - speed * geometry.reach;
  return at;
}

TEST(DirectedSides, ColumnUnderTheNormalBucklesWhereTimoshenkoSaysAboveTheEulerLoad) {
  // Without friction the load points at the ring's centre, R behind the tip: tan q / q = 1 − R/L. The axial
  // assumption has the Euler load there.
  for (const TestRotor& rotor : {kDefaultRotor, kRig}) {
    const auto condition = [&](double q) { return std::tan(q) / q - (1 - rotor.ring_radius / rotor.length); };
    const double q = boost::math::tools::bisect(condition, kPi / 2 + 1e-9, kPi,
                                                boost::math::tools::eps_tolerance<double>())
                         .first;
    const Pose at = pressed(rotor, 1e-9 * rotor.length, 0.0);
    const Met met = meet(directed(LoadDirection::normal, rotor, Friction::coulomb(0.0)), at, 1.0, 0.5);
    ASSERT_TRUE(met.found);
    EXPECT_NEAR(met.force.normal / (q * q * rotor.load_unit()), 1.0, 1e-6);
    const Met axial = meet(directed(LoadDirection::axial, rotor, Friction::coulomb(0.0)), at, 1.0, 0.5);
    EXPECT_NEAR(axial.force.normal / rotor.euler_load(), 1.0, 1e-6);
    // 3.3 Euler loads for the default rotor, 1.8 for the rig.
    EXPECT_GT(met.force.normal, 1.7 * axial.force.normal);
  }
}

TEST(DirectedSides, NormalLoadOnAVeryLargeRingIsTheAxialOne) {
  // α of a bent tip is of the order of L/R: the difference dies like 1/R.
  double before = 0.0;
  for (const double radius : {1e2, 1e3, 1e4, 1e5}) {
    TestRotor rotor = kDefaultRotor;
    rotor.ring_radius = radius;
    rotor.hub_radius = radius - rotor.length - 0.01;
    const Pose at = pressed(rotor, 0.002, 0.0);
    const Met normal = meet(directed(LoadDirection::normal, rotor, Friction::coulomb(0.1)), at, 1.0, 1.0);
    const Met axial = meet(directed(LoadDirection::axial, rotor, Friction::coulomb(0.1)), at, 1.0, 1.0);
    const double apart = difference(normal.force, axial.force) / axial.force.normal;
    if (before > 0.0) {
      EXPECT_NEAR(before / apart, 10.0, 0.2) << radius;
    }
    before = apart;
  }
  EXPECT_LT(before, 1e-5);
}

TEST(DirectedSides, AxialAssumptionOfALightContactGetsWorseWithTheDistanceFromTopDeadCentre) {
  // A light load P sin b bends the tip aside by P sin b L³/(3 EI), and with that off the ring: F ~ cos β /
  // sin b, so the true force is sin β / sin(α + β) of the axial one.
  for (const double friction : {0.05, 0.1, 0.5}) {
    const double beta = std::atan(friction);
    double before = 0.0;
    for (const double share : {0.01, 0.025, 0.05, 0.1, 0.2}) {  // |ct|/R
      const Pose at = pressed(kDefaultRotor, 1e-12, share * kDefaultRotor.ring_radius);
      const Met normal =
          meet(directed(LoadDirection::normal, kDefaultRotor, Friction::coulomb(friction)), at, 1.0, 0.5);
      const Met axial =
          meet(directed(LoadDirection::axial, kDefaultRotor, Friction::coulomb(friction)), at, 1.0, 0.5);
      ASSERT_TRUE(normal.found && axial.found);
      const double ratio = axial.force.normal / normal.force.normal;
      EXPECT_NEAR(ratio, std::sin(std::asin(share) + beta) / std::sin(beta), 1e-5 * ratio);
      EXPECT_GT(ratio, before);
      before = ratio;
    }
    EXPECT_GT(before, 1.0 + 0.18 / friction);
  }
}

TEST(DirectedSides, TrueNormalRemovesTheFiniteForceAtLiftOffBeyondTheFrictionAngle) {
  // Receding side. Under the axial load the force drops from a finite value at g = 0 (MODEL 4.2). Under the
  // normal the load's angle is α + β, which turns with α < −β: the blade then bends the other way, out of the
  // ring's way, and the force starts from zero.
  const double friction = 0.1;
  const auto law = directed(LoadDirection::normal, kDefaultRotor, Friction::coulomb(friction));
  const auto small_angle = directed(LoadDirection::axial, kDefaultRotor, Friction::coulomb(friction));
  for (const double share : {-0.02, -0.05, -0.15}) {
    const Pose at = pressed(kDefaultRotor, 1e-12, share * kDefaultRotor.ring_radius);
    const Met normal = meet(law, at, 1.0, 0.5);
    const Met axial = meet(small_angle, at, 1.0, 0.5);
    ASSERT_TRUE(normal.found && axial.found);
    EXPECT_GT(axial.force.normal, 0.1 * kDefaultRotor.euler_load());
    if (std::asin(share) < -std::atan(friction)) {
      EXPECT_LT(normal.force.normal, 1e-6 * kDefaultRotor.euler_load());
      EXPECT_LT(normal.bending, 0.0);
    } else {
      EXPECT_GT(normal.force.normal, axial.force.normal);
      EXPECT_GT(normal.bending, 0.0);
    }
  }
}

/// Largest jump of the force while the slip goes from +0.05 to −0.05 in steps, with the side remembered or
/// not.
template <class Law>
double largest_jump(const Law& law, double tangential, int steps, bool remembers) {
  Met met{true};
  TipForce before{};
  double largest = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const Pose at = pressed(kDefaultRotor, 1e-3, tangential, 0.05 - 0.1 * i / steps);
    met = remembers ? meet(law, at, 1.0, 0.5, met.bending, met.amplitude) : meet(law, at, 1.0, 0.5);
    EXPECT_TRUE(met.found) << i;
    if (i > 0) largest = std::max(largest, difference(met.force, before) / met.force.normal);
    before = met.force;
  }
  return largest;
}

TEST(DirectedSides, RegularisedForceIsContinuousThroughZeroSlipWhileTheBladeStaysOnItsSide) {
  const Friction friction = Friction::regularised(0.1, 0.01);
  const auto axial = directed(LoadDirection::axial, kDefaultRotor, friction);
  const auto normal = directed(LoadDirection::normal, kDefaultRotor, friction);
  EXPECT_NEAR(largest_jump(axial, 0.0, 400, true) / largest_jump(axial, 0.0, 800, true), 2.0, 0.05);
  EXPECT_NEAR(largest_jump(normal, 0.02, 400, true) / largest_jump(normal, 0.02, 800, true), 2.0, 0.05);
  // (Under the normal, here, b = α + atan c stays positive: α is 0.18.) Without the memory the blade would
  // change sides at v = 0, and the force jump.
  EXPECT_NEAR(largest_jump(axial, 0.0, 401, false) / largest_jump(axial, 0.0, 801, false), 1.0, 0.05);
  EXPECT_GT(largest_jump(axial, 0.0, 801, false), 10 * largest_jump(axial, 0.0, 801, true));
}

TEST(DirectedSides, BladeBentAgainstItsLoadSnapsThroughAtAFoldAndStaysThere) {
  // Bent to −et by friction at v > 0; then the slip turns, and the shaft draws back.
  const Friction friction = Friction::regularised(0.1, 0.001);
  const auto law = directed(LoadDirection::axial, kDefaultRotor, friction);
  const auto at_overlap = [&](double overlap, double slip) {
    return pressed(kDefaultRotor, overlap, 0.0, slip);
  };
  const double deep = 2e-3;
  Met met = meet(law, at_overlap(deep, 0.1), 1.0, 0.5);
  ASSERT_GT(met.bending, 0.0);
  met = meet(law, at_overlap(deep, -0.1), 1.0, 0.5, met.bending, met.amplitude);
  ASSERT_GT(met.bending, 0.0) << "held by the load that bends it";
  const auto determinant = [&](double overlap) {
    return law.constraint(at_overlap(overlap, -0.1), 1.0, 0.5, {met.bending, met.amplitude}).determinant();
  };
  const double first = determinant(deep);
  double last = first;
  double fold = 0.0;
  for (double overlap = deep; overlap > 1e-6; overlap -= 1e-6) {
    met = meet(law, at_overlap(overlap, -0.1), 1.0, 0.5, met.bending, met.amplitude);
    ASSERT_TRUE(met.found);
    if (met.bending < 0.0) {
      fold = overlap;
      break;
    }
    last = determinant(overlap);
    ASSERT_GT(last, 0.0);
  }
  ASSERT_GT(fold, 0.0);
  EXPECT_LT(last, 0.1 * first) << "the way to the fold shows";
  EXPECT_FALSE(law.solve(at_overlap(fold, -0.1), 1.0, 0.5, 1.0).has_value());
  EXPECT_TRUE(law.solve(at_overlap(fold + 2e-6, -0.1), 1.0, 0.5, 1.0).has_value());
  met = meet(law, at_overlap(deep, -0.1), 1.0, 0.5, met.bending, met.amplitude);
  EXPECT_LT(met.bending, 0.0) << "and does not come back";
  EXPECT_LT(difference(met.force, meet(law, at_overlap(deep, -0.1), 1.0, 0.5).force),
            1e-11 * met.force.normal)
      << "it is bent as a blade that comes down there";
}

TEST(DirectedSides, RegularisedFrictionBecomesCoulombs) {
  const auto coulomb = directed(LoadDirection::normal, kDefaultRotor, Friction::coulomb(0.2));
  RandomContacts contacts(kDefaultRotor, 0.2, 61);
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose at = contacts.next();
    const double slip = undeformed_slip_velocity(coulomb.geometry(), at, 0.5) >= 0.0 ? 1.0 : -1.0;
    const Met sharp = meet(coulomb, at, slip, 0.5);
    ASSERT_TRUE(sharp.found);
    if (sharp.force.slip_velocity * slip < 1e-3) continue;  // sharp: a slip reversal there
    double before = INFINITY;
    for (const double v0 : {3e-2, 3e-3, 3e-4, 3e-5}) {
      const Met soft =
          meet(directed(LoadDirection::normal, kDefaultRotor, Friction::regularised(0.2, v0)), at, slip, 0.5);
      ASSERT_TRUE(soft.found) << i;
      const double apart = difference(soft.force, sharp.force) / sharp.force.normal;
      ASSERT_LE(apart, before + 1e-12) << i << ", " << v0;
      before = apart;
    }
    EXPECT_LT(before, 1e-11) << i;
    ++compared;
  }
  EXPECT_GT(compared, 250);
}

/// How often c − c(v) changes its sign along the equilibria to one side, under c from one end of its range to
/// the other.
int equilibria(const DirectedElastica& law, const Pose& at, double speed, double side) {
  constexpr int kLooks = 200;
  int found = 0;
  double before = NAN;
  for (int i = -kLooks; i <= kLooks; ++i) {
    const double c = law.friction().largest() * i / kLooks;
    const auto bend = law.with_friction(Friction::coulomb(c)).solve(at, 1.0, speed, side);
    const double excess =
        bend ? c - law.constraint(at, 1.0, speed, {bend->modulus, std::max(bend->amplitude, 1e-300)})
                       .coefficient
             : NAN;
    if (before * excess < 0.0) ++found;
    before = excess;
  }
  return found;
}

TEST(DirectedSides, EquilibriumUnderVelocityDependentFrictionIsFoundAlsoNextToTheEndOfItsSide) {
  // Without a load along t a blade stands on neither side for long: at ct ~ 0 and at light contacts the
  // equilibria to a side begin near c = 0.
  constexpr double kSpeed = 0.5;
  const auto law = directed(LoadDirection::axial, kDefaultRotor, Friction::stribeck(0.8, 0.1, 0.01, 0.002));
  RandomContacts random(kDefaultRotor, 0.1, 64);
  int odd = 0;
  for (int i = 0; i < 16; ++i) {
    const double lateral = (i % 2 == 0 ? 1e-3 : 1e-2) * (2 * random.uniform() - 1);
    const double overlap = i % 3 == 0 ? 0.0 : 1e-3 * std::pow(10.0, -4 * random.uniform());
    const Pose at = pressed(kDefaultRotor, overlap, lateral, 0.06 * (2 * random.uniform() - 1), kSpeed);
    for (const double side : {1.0, -1.0}) {
      // Pairs, one of them unstable, need not be met by a load that grows from zero.
      if (equilibria(law, at, kSpeed, side) % 2 == 0) continue;
      ++odd;
      const auto bend = law.solve(at, 1.0, kSpeed, side);
      ASSERT_TRUE(bend.has_value()) << i << ", side " << side;
      const auto there = law.constraint(
          at, 1.0, kSpeed, {bend->modulus, std::max(bend->amplitude, 1e-300)});  // 0: without load
      EXPECT_NEAR(there.misdirection, 0.0, 1e-10);
      EXPECT_NEAR(there.residual, 0.0, 1e-12 * kDefaultRotor.ring_radius * kDefaultRotor.ring_radius);
    }
  }
  EXPECT_GT(odd, 8);
}

TEST(StickingElastica, HeldBladeNeedsTheFrictionUnderWhichASlidingOneStandsThere) {
  RandomContacts contacts(kDefaultRotor, 0.15, 62);
  const double speed = 0.5;
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    Pose at = contacts.next();
    const double c = 0.6 * contacts.uniform() - 0.3;
    const auto law = directed(LoadDirection::normal, kDefaultRotor, Friction::coulomb(c));
    const Met sliding = meet(law, at, 1.0, speed);
    ASSERT_TRUE(sliding.found);
    const auto there = law.constraint(at, 1.0, speed, {sliding.bending, sliding.amplitude});
    const double place = std::atan2(there.tip.across, there.tip.along);
    // Velocities under which that tip is at rest on the ring.
    at.tangential_velocity -= sliding.force.slip_velocity / std::cos(place);
    // The place is found again from v = 0 alone.
    const auto found = resting_normal_angle(law.geometry(), at, speed, place + 1e-3);
    ASSERT_TRUE(found.has_value()) << i;
    const double across = at.tangential_velocity - speed * at.radial;
    const double along = at.radial_velocity + speed * at.tangential;
    const auto slip = [&](double angle) {
      return across * std::cos(angle) - along * std::sin(angle) + speed * kDefaultRotor.ring_radius;
    };
    ASSERT_NEAR(slip(*found), 0.0, 1e-15);
    ASSERT_NEAR(slip(place), 0.0, 1e-15);
    // From a nearby bend to the one that holds the tip there.
    const blade::Bend near{sliding.bending * 1.02, sliding.amplitude * 0.99};
    const auto held =
        hold(LoadDirection::normal, law.geometry(), kDefaultRotor.length, at, speed, place, near);
    if (!held) continue;
    // δ of a lightly bent blade carries 1e-16 of rounding, and only little of δ tells how it is loaded.
    ASSERT_NEAR(held->coefficient, c, 3e-13 / sliding.force.shortening) << i;
    const blade::InclinedPoint point = blade::inclined_equilibrium(held->bend);
    ASSERT_NEAR(kDefaultRotor.ring_radius * std::cos(place),
                at.radial + kDefaultRotor.length * (1 - point.shortening.value), 1e-15);
    ASSERT_NEAR(kDefaultRotor.ring_radius * std::sin(place),
                at.tangential - kDefaultRotor.length * point.deflection.value, 1e-15);
    ++compared;
  }
  EXPECT_GT(compared, 900);
}

TEST(StickingElastica, FrictionOfAHeldTipGrowsAsTheShaftMovesOnUntilTheTipSlides) {
  // From a frictionless contact on, the tip stays where it is on the ring while the shaft moves along et.
  // Where c reaches μ, the blade stands as the sliding one does.
  constexpr double kFriction = 0.1;
  const auto law = directed(LoadDirection::normal, kDefaultRotor, Friction::coulomb(0.0));
  const Pose start = pressed(kDefaultRotor, 1e-3, 0.004);
  const Met met = meet(law, start, 1.0, 0.5);
  ASSERT_TRUE(met.found);
  const auto there = law.constraint(start, 1.0, 0.5, {met.bending, met.amplitude});
  const double place = std::atan2(there.tip.across, there.tip.along);
  const auto moved = [&](double by) {
    return pose(law.geometry(), {1.0, 0.0}, start.radial, start.tangential + by, 0.0, 0.0);
  };
  blade::Bend bend{met.bending, met.amplitude};
  const auto held = [&](double by) {
    const auto result =
        hold(LoadDirection::normal, law.geometry(), kDefaultRotor.length, moved(by), 0.5, place, bend);
    EXPECT_TRUE(result.has_value()) << by;
    if (result) bend = result->bend;
    return result ? result->coefficient : INFINITY;
  };
  EXPECT_NEAR(held(0.0), 0.0, 1e-12);
  double by = 0.0;
  double before = 0.0;
  for (double c = 0.0; c < kFriction; before = c) {
    by += 1e-5;
    c = held(by);
    ASSERT_GT(c, before);
    ASSERT_LT(by, 1e-3);
  }
  by = boost::math::tools::bisect([&](double moved_by) { return held(moved_by) - kFriction; }, by - 1e-5, by,
                                  boost::math::tools::eps_tolerance<double>())
           .second;
  const auto sliding_law = directed(LoadDirection::normal, kDefaultRotor, Friction::coulomb(kFriction));
  const Met sliding = meet(sliding_law, moved(by), 1.0, 0.5);
  ASSERT_TRUE(sliding.found);
  const auto slides = sliding_law.constraint(moved(by), 1.0, 0.5, {sliding.bending, sliding.amplitude});
  EXPECT_NEAR(std::atan2(slides.tip.across, slides.tip.along), place, 1e-10);
}

}  // namespace
}  // namespace rubatlas::contact
