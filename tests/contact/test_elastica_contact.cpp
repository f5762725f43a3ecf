/// The contact law of elastic blades (MODEL 4): direction of the force, its root, its rates.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "blade/elastica.hpp"
#include "rotors.hpp"

namespace rubatlas::contact {
namespace {

constexpr std::array<double, 6> kFrictions = {0.0, 1e-4, 0.01, 0.1, 0.5, 2.0};

/// The tip and the force on the rotor, in the blade's frame.
struct Tip {
  double radial, tangential;  ///< rk [m]
  double normal, along;       ///< force along n and along t [N]
};
Tip tip(const ElasticaContact& law, const TestRotor& rotor, const Pose& at, double slip, double bending) {
  const blade::CurvePoint point = law.curve().at(bending);
  const TipForce force = law.constraint(at, slip, bending, 0.5).force;
  const double a = at.radial + rotor.hub_radius + rotor.length * (1 - point.shortening);
  const double b = at.tangential - slip * rotor.length * point.deflection;
  const double distance = std::hypot(a, b);
  return {a, b, (force.radial * a + force.tangential * b) / distance,
          (force.tangential * a - force.radial * b) / distance};
}

TEST(ElasticaContact, TipLiesOnTheRing) {
  for (const double friction : kFrictions) {
    RandomContacts contacts(kDefaultRotor, 0.25, 11);
    const ElasticaContact law = kDefaultRotor.contact(friction);
    for (int i = 0; i < 2000; ++i) {
      const Pose at = contacts.next();
      const double slip = i % 2 == 0 ? 1.0 : -1.0;
      const auto root = law.solve(at, slip);
      if (!root) continue;
      const Tip end = tip(law, kDefaultRotor, at, slip, *root);
      ASSERT_NEAR(std::hypot(end.radial, end.tangential), kDefaultRotor.ring_radius, 1e-15)
          << friction << ", " << i;
    }
  }
}

TEST(ElasticaContact, FrictionIsPerpendicularToTheNormalAndOpposesTheSlip) {
  for (const double friction : kFrictions) {
    RandomContacts contacts(kDefaultRotor, 0.25, 12);
    const ElasticaContact law = kDefaultRotor.contact(friction);
    for (int i = 0; i < 2000; ++i) {
      const Pose at = contacts.next();
      const double slip = undeformed_slip_velocity(law.geometry(), at, 0.5) >= 0.0 ? 1.0 : -1.0;
      const auto root = law.solve(at, slip);
      if (!root) continue;
      const TipForce force = law.constraint(at, slip, *root, 0.5).force;
      const Tip end = tip(law, kDefaultRotor, at, slip, *root);
      const double rounding = 1e-14 * force.normal;
      ASSERT_NEAR(end.normal, -force.normal, rounding) << "the ring pushes inwards";
      ASSERT_NEAR(end.along, -slip * friction * force.normal, rounding) << "friction is mu F along -s t";
      ASSERT_NEAR(force.normal, kDefaultRotor.load_unit() * law.curve().at(*root).load, rounding);
      if (friction > 0.0 && force.slip_velocity * slip > 0.0) {
        ASSERT_LT(end.along * force.slip_velocity, 0.0) << "friction takes power from the slip";
      }
    }
  }
}

TEST(ElasticaContact, RootBendingFollowsFromTheMomentAtTheClamp) {
  const ElasticaContact law = kRig.contact(0.2);
  RandomContacts contacts(kRig, 0.1, 13);
  const double stiffness = kRig.load_unit() * kRig.length * kRig.length;
  for (int i = 0; i < 500; ++i) {
    const Pose at = contacts.next();
    const auto root = law.solve(at, 1.0);
    ASSERT_TRUE(root.has_value());
    const TipForce force = law.constraint(at, 1.0, *root, 0.3).force;
    const double deflection = kRig.length * law.curve().at(*root).deflection;
    const double lever = kRig.length * (1 - force.shortening);
    const double moment = force.normal * deflection + 0.2 * force.normal * lever;
    ASSERT_NEAR(force.root_strain, kRig.thickness / 2 * moment / stiffness, 1e-14 * force.root_strain);
  }
}

TEST(ElasticaContact, ForceRootIsOnTheFallingBranchAndTheOnlyOne) {
  constexpr int kPoints = 300;
  for (const double friction : kFrictions) {
    RandomContacts contacts(kDefaultRotor, 0.25, 14);
    const ElasticaContact law = kDefaultRotor.contact(friction);
    for (int i = 0; i < 3000; ++i) {
      const Pose at = contacts.next();
      const double slip = contacts.uniform() < 0.8 ? 1.0 : -1.0;
      const auto root = law.solve(at, slip);
      // h along the whole curve, close together near the unloaded blade: one change of sign, from plus to
      // minus.
      int changes = 0;
      bool positive = true;
      for (int k = 1; k <= kPoints; ++k) {
        const double part = static_cast<double>(k) / kPoints;
        const bool now = law.residual(at, slip, law.curve_at(law.curve().end() * part * part)) > 0.0;
        if (now != positive) ++changes;
        positive = now;
      }
      ASSERT_LE(changes, 1) << friction << ", " << i;
      ASSERT_EQ(root.has_value(), changes == 1) << friction << ", " << i;
      if (root) {
        ASSERT_LT(law.constraint(at, slip, *root, 0.5).bending_slope, 0.0) << friction << ", " << i;
      }
    }
  }
}

TEST(ElasticaContact, RootFromANeighbourIsTheRootFromScratch) {
  int compared = 0;
  for (const double friction : {0.0, 0.01, 0.1, 0.5}) {
    RandomContacts contacts(kDefaultRotor, 0.35, 15);
    const ElasticaContact law = kDefaultRotor.contact(friction);
    for (int i = 0; i < 25000; ++i) {
      const Pose at = contacts.next();
      const double slip = contacts.uniform() < 0.8 ? 1.0 : -1.0;
      const auto root = law.solve(at, slip);
      // Guesses from next to the root to anywhere along the curve.
      const double scatter = std::pow(10.0, -6.0 * contacts.uniform());
      const double guess =
          root ? std::min(*root * std::exp(scatter * (2 * contacts.uniform() - 1)), law.curve().end())
               : law.curve().end() * contacts.uniform();
      const auto near = law.solve_near(at, slip, guess);
      ASSERT_EQ(near.has_value(), root.has_value()) << friction << ", " << i;
      if (!root) continue;
      // Both stop where g's rounding does.
      const double slope = std::abs(law.constraint(at, slip, *root, 0.5).bending_slope);
      ASSERT_NEAR(*near, *root, 1e-14 * *root + 2e-17 / slope) << friction << ", " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 80000);
}

TEST(ElasticaContact, ForceVanishesAtTouchDownOnTheApproachingSide) {
  // s ct > 0: F ~ g as the tip comes down, with a side load that bends the blade back.
  const ElasticaContact law = kDefaultRotor.contact(0.1);
  double before = kDefaultRotor.euler_load();
  for (const double gap : {1e-8, 1e-10, 1e-12, 1e-14}) {
    const Pose at{0.0098, 0.001, 0.0, 0.0, gap};
    const auto root = law.solve(at, 1.0);
    ASSERT_TRUE(root.has_value());
    const double force = law.constraint(at, 1.0, *root, 0.3).force.normal;
    EXPECT_GT(force, 0.0);
    EXPECT_LT(force, 0.1 * before) << gap;
    before = force;
  }
  EXPECT_LT(before, 1e-6 * kDefaultRotor.euler_load());
}

TEST(ElasticaContact, ForceGrowsLikeARootWhereTheTipMeetsTheRingHeadOn) {
  const ElasticaContact law = kDefaultRotor.contact(0.1);
  const auto force = [&](double gap) {
    const Pose at{0.01, 0.0, 0.0, 0.0, gap};
    return law.constraint(at, 1.0, law.solve(at, 1.0).value(), 0.3).force.normal;
  };
  for (const double gap : {1e-10, 1e-12, 1e-14})
    EXPECT_NEAR(force(gap) / force(gap / 100), 10.0, 2e-2) << gap;
}

TEST(ElasticaContact, ForceIsFiniteAtTouchDownOnTheRecedingSide) {
  // The tip 1 mm past top dead centre: 0.42 of the Euler load at once (MODEL 4.2).
  const ElasticaContact law = kDefaultRotor.contact(0.1);
  const double lateral = 1e-3;
  const double radial = std::sqrt(0.11 * 0.11 - lateral * lateral) - 0.1;
  double before = 0.0;
  for (const double gap : {1e-10, 1e-13, 1e-16, 0.0}) {
    const Pose at{radial, -lateral, 0.0, 0.0, gap};
    const auto root = law.solve(at, 1.0);
    ASSERT_TRUE(root.has_value());
    const auto contact = law.constraint(at, 1.0, *root, 0.3);
    EXPECT_NEAR(contact.force.normal / kDefaultRotor.euler_load(), 0.42, 0.005) << gap;
    EXPECT_LT(contact.bending_slope, 0.0);
    if (before > 0.0) {
      EXPECT_NEAR(contact.force.normal, before, 1e-4 * before);
    }
    before = contact.force.normal;
  }
}

TEST(ElasticaContact, ForceSetsInAsFarPastTopDeadCentreHoweverLittleThatIs) {
  // At g = 0 the force is in proportion to the distance from top dead centre, also where h rises by less than
  // g is known by before it falls.
  const ElasticaContact law = kDefaultRotor.contact(0.1);
  const auto force = [&](double lateral, double gap) {
    const Pose at{0.01, -lateral, 0.0, 0.0, gap};
    const auto root = law.solve(at, 1.0);
    return root ? law.constraint(at, 1.0, *root, 0.3).force.normal : -1.0;
  };
  const double per_lateral = force(1e-7, 0.0) / 1e-7;
  EXPECT_GT(per_lateral, 0.0);
  for (const double lateral : {1e-8, 4e-10, 1e-12})
    EXPECT_NEAR(force(lateral, -1e-18), per_lateral * lateral, 1e-3 * per_lateral * lateral) << lateral;
  EXPECT_EQ(force(0.0, -1e-18), 0.0) << "head-on the force sets in from zero";
}

TEST(ElasticaContact, ForceWithNextToNoFrictionSetsInNearTheEulerLoad) {
  // The load takes a blade up to where it buckles by less than the first knots of the table bend it.
  const ElasticaContact law = kDefaultRotor.contact(1e-14);
  for (const double gap : {0.0, -1e-18}) {
    const Pose at{0.01, -1e-5, 0.0, 0.0, gap};
    const auto root = law.solve(at, 1.0);
    ASSERT_TRUE(root.has_value());
    EXPECT_NEAR(law.gap_per_deflection(at, 1.0, *root), 0.0, 1e-15);
    const double force = law.constraint(at, 1.0, *root, 0.3).force.normal;
    EXPECT_NEAR(force, kDefaultRotor.euler_load(), 1e-3 * kDefaultRotor.euler_load()) << gap;
  }
}

TEST(ElasticaContact, ColumnJumpsToTheEulerLoadAtTouchDown) {
  const ElasticaContact law = kDefaultRotor.contact(0.0);
  for (const double lateral : {0.0, 1e-3}) {
    const Pose at{0.0098, lateral, 0.0, 0.0, 1e-12};
    const auto root = law.solve(at, 1.0);
    ASSERT_TRUE(root.has_value());
    const double force = law.constraint(at, 1.0, *root, 0.3).force.normal;
    EXPECT_NEAR(force, kDefaultRotor.euler_load(), 1e-6 * kDefaultRotor.euler_load());
  }
}

/// Shortening δ/L at which the exact curve, followed from the unloaded blade, first brings the tip back onto
/// the ring; none where the curve ends before.
std::optional<double> first_shortening_on_the_ring(const std::vector<blade::Equilibrium<long double>>& curve,
                                                   const TestRotor& rotor, const Pose& at, double slip) {
  for (const auto& point : curve) {
    const double a =
        at.radial + rotor.hub_radius + rotor.length * (1 - static_cast<double>(point.shortening));
    const double b = at.tangential - slip * rotor.length * static_cast<double>(point.deflection);
    if (std::hypot(a, b) < rotor.ring_radius) return static_cast<double>(point.shortening);
  }
  return std::nullopt;
}

TEST(ElasticaContact, HasNoRootWhereNoBladeShortenedByThreeQuartersReachesTheRing) {
  // Far out the tip cannot come down to the ring, or not before three quarters of the blade's length are used
  // up; no scene may go so far. Nearer in there always is a root.
  for (const double friction : {0.1, 0.5}) {
    const ElasticaContact law = kDefaultRotor.contact(friction);
    const double beta = std::atan(friction);
    const double largest = 0.999 * std::sqrt((std::numbers::pi - beta) * (std::numbers::pi + beta));
    std::vector<blade::Equilibrium<long double>> curve;
    for (int i = 0; i <= 800; ++i) curve.push_back(blade::equilibrium(friction, largest * i / 800));
    const double table = law.curve().knots().back().shortening;
    int with_root = 0;
    int without_root = 0;
    for (double distance = 0.1; distance < 0.5; distance += 0.02) {
      for (int k = 0; k < 180; ++k) {
        const Pose at = pose_at(law.geometry(), 2 * std::numbers::pi * k / 180,
                                distance * kDefaultRotor.ring_radius, 0.0);
        if (!(at.gap > 0.0)) continue;
        const auto shortening = first_shortening_on_the_ring(curve, kDefaultRotor, at, 1.0);
        const bool root = law.solve(at, 1.0).has_value();
        root ? ++with_root : ++without_root;
        if (distance < 0.23) {
          EXPECT_TRUE(root) << distance << ", " << k;
        }
        if (root) {
          ASSERT_TRUE(shortening.has_value()) << distance << ", " << k;
          EXPECT_LE(*shortening, table + 0.01) << distance << ", " << k;
        } else if (shortening) {
          EXPECT_GT(*shortening, 0.75) << distance << ", " << k;
        }
      }
    }
    EXPECT_GT(with_root, 1000);
    EXPECT_GT(without_root, 300);
  }
}

TEST(ElasticaContact, SlopesOfTheConstraintAreItsDerivatives) {
  for (const double friction : kFrictions) {
    RandomContacts contacts(kDefaultRotor, 0.25, 16);
    const ElasticaContact law = kDefaultRotor.contact(friction);
    const Geometry geometry = law.geometry();
    const double speed = 0.62;
    const double square = geometry.ring_radius * geometry.ring_radius;
    for (int i = 0; i < 1000; ++i) {
      const double cx = 0.02 * (2 * contacts.uniform() - 1);
      const double cy = 0.02 * (2 * contacts.uniform() - 1);
      const double vx = 0.02 * (2 * contacts.uniform() - 1);
      const double vy = 0.02 * (2 * contacts.uniform() - 1);
      const double angle = 6 * contacts.uniform();
      const double bending = 0.01 + 1.5 * contacts.uniform();
      const double slip = i % 2 == 0 ? 1.0 : -1.0;
      const auto pose = [&](double time) {
        return pose_at(geometry, angle + speed * time, cx + vx * time, cy + vy * time, vx, vy);
      };
      const auto residual = [&](double time, double u) {
        return law.residual(pose(time), slip, law.curve_at(u));
      };
      const auto here = law.constraint(pose(0.0), slip, bending, speed);
      // Central differences of fourth order: truncation and rounding meet near 1e-3.
      const auto difference = [](const auto& function, double step) {
        return (8 * (function(step) - function(-step)) - (function(2 * step) - function(-2 * step))) /
               (12 * step);
      };
      const double by_bending =
          difference([&](double step) { return residual(0.0, bending + step); }, 1e-3 * bending);
      const double by_time = difference([&](double step) { return residual(step, bending); }, 1e-3);
      ASSERT_NEAR(here.bending_slope, by_bending, 1e-9 * square) << friction << ", " << i;
      ASSERT_NEAR(here.time_slope, by_time, 1e-10 * square) << friction << ", " << i;
    }
  }
}

TEST(ElasticaContact, MirroredMotionHasTheMirroredForce) {
  // x → −x turns the rotation, the slip and everything across the blade around, to the last bit.
  RandomContacts contacts(kDefaultRotor, 0.25, 17);
  const ElasticaContact law = kDefaultRotor.contact(0.1);
  for (int i = 0; i < 2000; ++i) {
    const Pose at = contacts.next();
    Pose mirrored = at;
    mirrored.tangential = -at.tangential;
    mirrored.tangential_velocity = -at.tangential_velocity;
    const auto root = law.solve(at, 1.0);
    ASSERT_EQ(law.solve(mirrored, -1.0), root);
    EXPECT_EQ(undeformed_slip_velocity(law.geometry(), mirrored, -0.5),
              -undeformed_slip_velocity(law.geometry(), at, 0.5));
    EXPECT_EQ(gap_rate(law.geometry(), mirrored, -0.5), gap_rate(law.geometry(), at, 0.5));
    if (!root) continue;
    const auto one = law.constraint(at, 1.0, *root, 0.5);
    const auto other = law.constraint(mirrored, -1.0, *root, -0.5);
    EXPECT_EQ(other.force.radial, one.force.radial);
    EXPECT_EQ(other.force.tangential, -one.force.tangential);
    EXPECT_EQ(other.force.slip_velocity, -one.force.slip_velocity);
    EXPECT_EQ(law.residual(mirrored, -1.0, law.curve_at(*root)), law.residual(at, 1.0, law.curve_at(*root)));
    EXPECT_EQ(other.bending_slope, one.bending_slope);
    EXPECT_EQ(other.time_slope, one.time_slope);
  }
}

TEST(ElasticaContact, ResponseIsContinuedOddlyBeyondLiftOff) {
  // Runge–Kutta stages may land a little outside; approaching side, where the load goes through zero. The
  // second root starts from the first, so the last digits may differ.
  const ElasticaContact law = kDefaultRotor.contact(0.1);
  for (const double gap : {1e-9, 1e-7}) {
    TipForce inside{};
    TipForce outside{};
    double bending = 0.01;
    ASSERT_TRUE(law.respond({0.0098, 0.001, 0.001, 0.002, gap}, 1.0, 0.3, bending, inside));
    ASSERT_TRUE(law.respond({0.0098, 0.001, 0.001, 0.002, -gap}, 1.0, 0.3, bending, outside));
    EXPECT_NEAR(outside.radial, -inside.radial, 1e-12 * std::abs(inside.radial));
    EXPECT_NEAR(outside.tangential, -inside.tangential, 1e-12 * std::abs(inside.tangential));
    EXPECT_NEAR(outside.normal, -inside.normal, 1e-12 * std::abs(inside.normal));
  }
}

}  // namespace
}  // namespace rubatlas::contact
