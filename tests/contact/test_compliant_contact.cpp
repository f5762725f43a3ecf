/// The elastica law with axial compliance, in a yielding ring, as a beam-column, and released at the fold.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "contact/elastic_ring_contact.hpp"
#include "rotors.hpp"

namespace rubatlas::contact {
namespace {

using blade::Theory;
using InAnyRing = ElasticBladeContact<AnyRing>;
constexpr AnyRing kReleasedAtFold{.release = Release::at_fold};

constexpr double kYoungsModulus = 206e9;
constexpr double kWidth = 0.01;

/// A blade of the default rotor; `share` of its full axial compliance ε = h²/(12 L²).
struct BladeCase {
  double friction = 0.1;
  double share = 0.0;
  Theory theory = Theory::elastica;
  double thickness = kDefaultRotor.thickness;

  [[nodiscard]] double axial_stiffness() const {
    return kYoungsModulus * kWidth * thickness / share;
  }  ///< EA
  [[nodiscard]] double load_unit() const {
    return kYoungsModulus * kWidth * std::pow(thickness, 3) / 12 / std::pow(kDefaultRotor.length, 2);
  }
  [[nodiscard]] double euler_load() const { return blade::kEulerLoad * load_unit(); }
};

template <class Law = ElasticaContact, class... Ring>
Law make(const BladeCase& blade, Ring... ring) {
  const double length = kDefaultRotor.length;
  const double compliance = blade.share * blade.thickness * blade.thickness / (12 * length * length);
  return {kDefaultRotor.geometry(),
          {length, blade.thickness, blade.load_unit() * length * length},
          std::make_shared<const blade::ElasticaCurve>(blade.friction, blade.theory, compliance),
          ring...};
}

/// Tip at ct = `lateral`, `penetration` beyond the ring along the radius.
Pose pressed(double penetration, double lateral = 0.0) {
  const double radius = kDefaultRotor.ring_radius;
  const double outward = std::sqrt(std::pow(radius + penetration, 2) - lateral * lateral);
  return {outward - kDefaultRotor.geometry().reach, lateral, 0.001, 0.002,
          penetration * (2 * radius + penetration)};
}

/// Force of a contact that has just opened (`bending` 0), or of a contact that is followed from `bending`.
template <class Law>
TipForce force_at(const Law& law, const Pose& at, double slip = 1.0, double bending = 0.0) {
  TipForce force{};
  if constexpr (Law::kHasBending) {
    if (bending == 0.0) bending = law.solve(at, slip).value_or(0.0);
  }
  EXPECT_TRUE(law.respond(at, slip, 0.3, bending, force));
  return force;
}

TEST(AxialCompliance, MakesTheHeadOnForceProportionalToThePenetration) {
  for (const Theory theory : {Theory::elastica, Theory::beam_column}) {
    const BladeCase blade{0.1, 1.0, theory};
    const ElasticaContact law = make(blade);
    double before = 0.0;
    for (const double penetration : {1e-11, 1e-12, 1e-13, 1e-14}) {
      const double straight = blade.axial_stiffness() / kDefaultRotor.length * penetration;
      const double departure = 1.0 - force_at(law, pressed(penetration)).normal / straight;
      EXPECT_GT(departure, 0.0) << "bending adds to what the blade yields";
      // Bending shortens the blade by the square of the load, so that its share falls with the load.
      if (before > 0.0) {
        EXPECT_NEAR(before / departure, 10.0, 0.4) << penetration;
      }
      before = departure;
    }
    EXPECT_LT(before, 1e-5);
  }
}

TEST(AxialCompliance, VanishesToFirstOrderWithItsShare) {
  RandomContacts contacts(kDefaultRotor, 0.2, 21);
  const ElasticaContact inextensible = make({0.1, 0.0});
  std::vector<ElasticaContact> laws;
  for (const double share : {1.0, 0.1, 0.01}) laws.push_back(make({0.1, share}));
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    Pose at = contacts.next();
    if (at.gap < 1e-4 || at.tangential < 0.0) continue;  // lighter contacts would need even smaller shares
    const auto root = inextensible.solve(at, 1.0);
    if (!root) continue;
    const double exact = inextensible.constraint(at, 1.0, *root, 0.3).force.normal;
    std::array<double, 3> difference{};
    for (std::size_t k = 0; k < laws.size(); ++k) {
      const auto with = laws[k].solve(at, 1.0);
      ASSERT_TRUE(with.has_value());
      difference[k] = exact - laws[k].constraint(at, 1.0, *with, 0.3).force.normal;
    }
    EXPECT_GT(difference[2], 0.0);
    EXPECT_NEAR(difference[0] / difference[1], 10.0, 0.1) << i;
    EXPECT_NEAR(difference[1] / difference[2], 10.0, 0.1) << i;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(AxialCompliance, CompressesTheColumnStraightUpToItsEulerLoad) {
  const BladeCase blade{0.0, 1.0};
  const ElasticaContact law = make(blade);
  EXPECT_FALSE(law.carried());
  const double stiffness = blade.axial_stiffness() / kDefaultRotor.length;
  const double buckling = blade.euler_load() / stiffness;  // penetration [m]
  for (const double part : {-0.5, 1e-9, 0.3, 0.999}) {
    const TipForce force = force_at(law, pressed(part * buckling));
    EXPECT_NEAR(force.normal, part * blade.euler_load(), 1e-12 * std::abs(force.normal)) << part;
    EXPECT_NEAR(force.shortening * kDefaultRotor.length, part * buckling, 1e-12 * std::abs(part) * buckling);
    EXPECT_EQ(force.root_strain, 0.0) << "straight";
  }
  // At buckling the load is continuous; beyond buckling it is nearly constant.
  const double before = force_at(law, pressed(buckling * (1 - 1e-9))).normal;
  const TipForce after = force_at(law, pressed(buckling * (1 + 1e-9)));
  EXPECT_NEAR(after.normal / before, 1.0, 1e-8);
  EXPECT_GT(after.root_strain, 0.0) << "bent";
  const double beyond = force_at(law, pressed(3 * buckling)).normal;
  EXPECT_GT(beyond, blade.euler_load());
  EXPECT_LT(beyond, blade.euler_load() * (1 + 1e-4));
  // The tip of a bent column lies on the ring too.
  const auto root = law.solve(pressed(3 * buckling), 1.0);
  ASSERT_TRUE(root.has_value());
  EXPECT_NEAR(law.constraint(pressed(3 * buckling), 1.0, *root, 0.3).residual, 0.0, 1e-17);
}

TEST(AxialCompliance, LetsTheForceStartFromZeroALittlePastTopDeadCentre) {
  // Within 3εR/μ of top dead centre the axial shortening of a light contact exceeds what friction adds to the
  // tip's penetration.
  const BladeCase blade{0.1, 1.0};
  const ElasticaContact law = make(blade);
  const double edge = 3 * std::pow(blade.thickness / kDefaultRotor.length, 2) / 12 / blade.friction *
                      kDefaultRotor.ring_radius;
  for (const double part : {0.9, 1.1}) {
    const Pose at = pressed(1e-16, -part * edge);
    EXPECT_EQ(law.starts_unloaded(at, 1.0), part < 1.0);
    const auto root = law.solve(at, 1.0);
    ASSERT_TRUE(root.has_value());
    const double force = law.constraint(at, 1.0, *root, 0.3).force.normal;
    if (part < 1.0) {
      EXPECT_LT(force, 1e-6 * blade.euler_load());
    } else {
      EXPECT_GT(force, 1e-5 * blade.euler_load());
    }
  }
}

TEST(YieldingRing, HoldsTheTipWhereItYieldsTo) {
  for (const double friction : {0.0, 0.01, 0.1, 0.5}) {
    for (const double share : {0.0, 1.0}) {
      for (const double stiffness : {1e2, 1e4, 1e6}) {
        const InAnyRing law = make<InAnyRing>({friction, share}, AnyRing{stiffness});
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
          if (law.carried()) {
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
  std::vector<InAnyRing> laws;
  for (const double stiffness : {1e7, 1e8, 1e9}) laws.push_back(make<InAnyRing>({0.1}, AnyRing{stiffness}));
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
  constexpr double kStiffness = 1e4;
  RandomContacts contacts(kDefaultRotor, 0.1, 24);
  const ElasticRingContact ring(kDefaultRotor.geometry(), kStiffness, 0.0);
  const InAnyRing column = make<InAnyRing>({0.0, 0.0, Theory::elastica, 0.01}, AnyRing{kStiffness});
  // With friction a blade bends by μF L³/(3 EI); the thicker blades below bend less and less.
  const ElasticRingContact rubbed(kDefaultRotor.geometry(), kStiffness, 0.1);
  const InAnyRing stiff = make<InAnyRing>({0.1, 0.0, Theory::elastica, 0.05}, AnyRing{kStiffness});
  const InAnyRing stiffer = make<InAnyRing>({0.1, 0.0, Theory::elastica, 0.5}, AnyRing{kStiffness});
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
  constexpr double kStiffness = 1e7;
  const BladeCase column{0.0, 1.0};
  const BladeCase rubbed{0.1, 1.0};
  const double compliance = kDefaultRotor.length / column.axial_stiffness() + 1 / kStiffness;
  const InAnyRing straight = make<InAnyRing>(column, AnyRing{kStiffness});
  const InAnyRing bent = make<InAnyRing>(rubbed, AnyRing{kStiffness});
  for (const double penetration : {1e-12, 1e-14}) {
    EXPECT_NEAR(force_at(straight, pressed(penetration)).normal * compliance / penetration, 1.0, 1e-10);
    EXPECT_NEAR(force_at(bent, pressed(penetration)).normal * compliance / penetration, 1.0,
                2e7 * penetration);
    // Away from top dead centre the lateral compliance L³/(3 EI) adds to this, times μ s ct/R.
    const double lateral = 1e-3;
    const double side =
        0.1 * lateral / kDefaultRotor.ring_radius * kDefaultRotor.length / 3 / rubbed.load_unit();
    EXPECT_NEAR(force_at(bent, pressed(penetration, lateral)).normal * (compliance + side) / penetration, 1.0,
                1e-4);
  }
}

TEST(YieldingRing, SlopesOfTheConstraintAreItsDerivatives) {
  const InAnyRing law = make<InAnyRing>({0.1, 1.0}, AnyRing{1e3});
  RandomContacts contacts(kDefaultRotor, 0.2, 25);
  for (int i = 0; i < 500; ++i) {
    const Pose at = contacts.next();
    const double bending = 0.01 + 1.2 * contacts.uniform();
    const double slip = i % 2 == 0 ? 1.0 : -1.0;
    const auto h = [&](double u) { return law.constraint(at, slip, u, 0.3).residual; };
    const double step = 1e-3 * bending;
    const double difference =
        (8 * (h(bending + step) - h(bending - step)) - (h(bending + 2 * step) - h(bending - 2 * step))) /
        (12 * step);
    EXPECT_NEAR(law.constraint(at, slip, bending, 0.3).bending_slope, difference, 1e-9 * 0.11 * 0.11);
  }
}

TEST(ReleaseAtFold, HoldsTheTipBeyondTheRingAsLongAsThereIsAForce) {
  for (const double friction : {0.0, 0.01, 0.1, 0.5}) {
    const InAnyRing law = make<InAnyRing>({friction}, kReleasedAtFold);
    for (const double lateral : {-1e-4, -1e-3, -5e-3}) {
      // From the ring outwards to the fold, which the root approaches like a square root.
      double gap = 0.0;
      auto root = law.solve(pressed(0.0, lateral), 1.0);
      ASSERT_TRUE(root.has_value());
      const double at_ring = *root;
      double step = 1e-4;
      double last = *root;
      while (step > 1e-18) {
        Pose at = pressed(0.0, lateral);
        at.gap = gap - step;
        root = law.solve(at, 1.0);
        if (!root) {
          step *= 0.5;
          continue;
        }
        gap -= step;
        EXPECT_LT(*root, last);
        last = *root;
        const auto there = law.constraint(at, 1.0, last, 0.3);
        EXPECT_NEAR(there.residual, 0.0, 1e-16);
        // The search from a neighbouring root finds the same root.
        EXPECT_NEAR(law.solve_near(at, 1.0, at_ring).value_or(-1.0), last,
                    1e-12 * at_ring + 1e-16 / std::abs(there.bending_slope));
      }
      EXPECT_LT(gap, 0.0);
      Pose fold = pressed(0.0, lateral);
      fold.gap = gap;
      EXPECT_GT(last, 0.1 * at_ring) << "a finite force at release";
      const double slope = law.constraint(fold, 1.0, last, 0.3).bending_slope;
      Pose ring = pressed(0.0, lateral);
      EXPECT_LT(std::abs(slope), 1e-4 * std::abs(law.constraint(ring, 1.0, at_ring, 0.3).bending_slope));
    }
  }
}

TEST(ReleaseAtFold, IsTheSameLawWhileTheTipIsInTheRing) {
  for (const double friction : {0.0, 0.1}) {
    const InAnyRing fold = make<InAnyRing>({friction}, kReleasedAtFold);
    const ElasticaContact ring = make({friction});
    RandomContacts contacts(kDefaultRotor, 0.35, 26);
    for (int i = 0; i < 1000; ++i) {
      const Pose at = contacts.next();
      EXPECT_EQ(fold.solve(at, 1.0), ring.solve(at, 1.0));
      EXPECT_EQ(fold.solve_near(at, -1.0, 0.3), ring.solve_near(at, -1.0, 0.3));
    }
  }
}

TEST(ReleaseAtFold, NeverHoldsATipOnTheApproachingSide) {
  const InAnyRing law = make<InAnyRing>({0.1}, kReleasedAtFold);
  const auto yielding = make<InAnyRing>({0.1, 1.0}, AnyRing{1e4, Release::at_fold});
  for (const double lateral : {1e-6, 1e-3, 5e-3}) {
    for (const double gap : {-1e-15, -1e-9, -1e-6}) {
      Pose at = pressed(0.0, lateral);
      at.gap = gap;
      EXPECT_FALSE(law.solve(at, 1.0).has_value());
      EXPECT_FALSE(yielding.solve(at, 1.0).has_value());
    }
  }
}

/// Blades and rings of large and of small compliance; the tips are on the receding side.
struct CompliantCase {
  BladeCase blade;
  double ring_stiffness;
};
constexpr std::array kCompliantCases{
    CompliantCase{{0.1, 1.0}, 1e5},    CompliantCase{{0.1, 0.0}, 1e4},
    CompliantCase{{0.1, 1000.0}, 1e5}, CompliantCase{{0.1, 300.0, Theory::beam_column}, 1e5},
    CompliantCase{{0.02, 1.0}, 1e5},   CompliantCase{{0.3, 1.0}, 1e4},
    CompliantCase{{0.0, 1.0}, 1e5},    CompliantCase{{0.0, 50.0}, 1e6}};

/// A light contact on the receding side: the penetration is up to a tenth of the yielding under the Euler
/// load, and ct is near the place beyond which the force no longer starts from zero. Here a blade may be
/// compressed or bent.
Pose receding(const CompliantCase& given, RandomContacts& random) {
  const double length = kDefaultRotor.length;
  const double compliance = 1.0 / given.ring_stiffness + length / given.blade.axial_stiffness();
  const double friction = std::max(given.blade.friction, 0.1);
  const double edge =
      3.0 / friction * kDefaultRotor.ring_radius * compliance * given.blade.load_unit() / length;
  return pressed(given.blade.euler_load() * compliance * 0.1 * std::pow(random.uniform(), 2),
                 -std::min(edge * (0.5 + 0.6 * random.uniform()), 0.25 * kDefaultRotor.ring_radius));
}

/// Bracket of a root of h = 0 at which h falls, from a fine scan beyond the unloaded blade; and the ends of
/// the stretch around the root on which h falls.
struct Scanned {
  double low, high;
  double begin, end;
};
std::vector<Scanned> scan(const InAnyRing& law, const Pose& at, double slip) {
  constexpr int kPoints = 6000;
  const double first = 1e-4 * law.curve().knots()[1].bending;
  const double ratio = law.curve().end() / first;
  std::vector<Scanned> roots;
  std::vector<double> bendings;
  std::vector<double> residuals;
  for (int i = 0; i <= kPoints; ++i) {
    bendings.push_back(first * std::pow(ratio, static_cast<double>(i) / kPoints));
    residuals.push_back(law.constraint(at, slip, bendings.back(), 0.3).residual);
  }
  for (std::size_t i = 1; i < bendings.size(); ++i) {
    if (!(residuals[i - 1] > 0.0 && residuals[i] <= 0.0)) continue;
    std::size_t begin = i - 1;
    while (begin > 0 && residuals[begin - 1] > residuals[begin]) --begin;
    std::size_t end = i;
    while (end + 1 < bendings.size() && residuals[end + 1] < residuals[end]) ++end;
    roots.push_back({bendings[i - 1], bendings[i], bendings[begin], bendings[end]});
  }
  return roots;
}

TEST(Branches, LoadIncreasedFromZeroMeetsTheRootOfANewContactFirst) {
  int several = 0;
  for (const CompliantCase& given : kCompliantCases) {
    const auto law = make<InAnyRing>(given.blade, AnyRing{given.ring_stiffness});
    RandomContacts random(kDefaultRotor, 0.2, 31);
    for (int i = 0; i < 60; ++i) {
      const Pose at = receding(given, random);
      const auto root = law.solve(at, 1.0);
      if (root && *root == 0.0) {
        // The column stands straight; this takes less load than any bending.
        EXPECT_EQ(given.blade.friction, 0.0);
        EXPECT_LE(force_at(law, at).normal, given.blade.euler_load());
        continue;
      }
      const auto scanned = scan(law, at, 1.0);
      ASSERT_EQ(root.has_value(), !scanned.empty()) << at.gap << ", " << at.tangential;
      if (!root) continue;
      EXPECT_GE(*root, scanned[0].low * (1 - 1e-12)) << at.gap << ", " << at.tangential;
      EXPECT_LE(*root, scanned[0].high * (1 + 1e-12)) << at.gap << ", " << at.tangential;
      EXPECT_LE(scanned.size(), 2);
      if (scanned.size() == 2) ++several;
    }
  }
  EXPECT_GT(several, 40);
}

TEST(Branches, ARootIsFollowedOnItsOwnBranchFromAnywhereOnIt) {
  int followed = 0;
  for (const CompliantCase& given : kCompliantCases) {
    if (given.blade.friction == 0.0) continue;
    const auto law = make<InAnyRing>(given.blade, AnyRing{given.ring_stiffness});
    RandomContacts random(kDefaultRotor, 0.2, 32);
    for (int i = 0; i < 60; ++i) {
      const Pose at = receding(given, random);
      const auto scanned = scan(law, at, 1.0);
      if (scanned.size() < 2) continue;
      for (const Scanned& root : scanned) {
        for (const double part : {0.01, 0.3, 0.7, 0.99}) {
          const double guess = root.begin * std::pow(root.end / root.begin, part);
          const auto found = law.solve_near(at, 1.0, guess);
          ASSERT_TRUE(found.has_value());
          EXPECT_GE(*found, root.low * (1 - 1e-12)) << "from " << guess;
          EXPECT_LE(*found, root.high * (1 + 1e-12)) << "from " << guess;
          ++followed;
        }
      }
    }
  }
  EXPECT_GT(followed, 200);
}

/// Presses a blade in and draws it out again in steps, each of which may be a snap.
struct Swept {
  double largest_before_snap = 0.0;  ///< load before it first snaps [N]
  double snap_in = 0.0;              ///< cr of the last snap on the way in [m]
  double snap_out = 0.0;             ///< cr of the last snap on the way out [m]
  int snaps = 0;
};
Swept press_in_and_out(const InAnyRing& law, double deepest, double lateral, int steps) {
  Swept swept;
  Pose at = pressed(1e-9, lateral);
  double bending = law.solve(at, 1.0).value();
  for (int i = 1; i < 2 * steps; ++i) {
    const bool in = i <= steps;
    at = pressed(deepest * (in ? i : 2 * steps - i) / steps, lateral);
    at.radial_velocity = in ? 1.0 : -1.0;
    at.tangential_velocity = 0.0;
    if (const auto same = law.solve_near(at, 1.0, bending)) {
      bending = *same;
    } else {
      const auto next = law.snap(at, 1.0, bending, 0.0);
      EXPECT_TRUE(next.has_value());
      EXPECT_EQ(*next > bending, in) << "the way it moves";
      bending = next.value_or(0.0);
      ++swept.snaps;
      (in ? swept.snap_in : swept.snap_out) = at.radial;
    }
    TipForce force{};
    double unchanged = bending;
    EXPECT_TRUE(law.respond(at, 1.0, 0.0, unchanged, force));
    EXPECT_NEAR(unchanged, bending, 1e-11 * bending);
    if (swept.snaps == 0) swept.largest_before_snap = force.normal;
  }
  return swept;
}

TEST(Branches, AColumnOnTheRecedingSideBucklesAtItsEulerLoadAndStraightensBelowIt) {
  const BladeCase blade{0.0, 1.0};
  const auto law = make<InAnyRing>(blade, AnyRing{1e5});
  constexpr double kLateral = -3e-3;
  constexpr double kDeepest = 1e-3;
  constexpr int kSteps = 4000;
  const Swept swept = press_in_and_out(law, kDeepest, kLateral, kSteps);
  EXPECT_EQ(swept.snaps, 2);
  const double step = kDeepest / kSteps;
  const double per_step = step * 1e5;  // the most that a step adds to the load
  EXPECT_NEAR(swept.largest_before_snap, blade.euler_load(), per_step);
  EXPECT_LT(swept.snap_out, swept.snap_in - 20 * step) << "it stays bent on the way out: hysteresis";
  // Approaching, it bends and straightens through its Euler load without a snap.
  EXPECT_EQ(press_in_and_out(law, kDeepest, -kLateral, kSteps).snaps, 0);
}

TEST(Branches, ABladeThatBendsSnapsBothWaysWithHysteresis) {
  const auto law = make<InAnyRing>({0.1, 1.0}, AnyRing{1e5});
  constexpr double kLateral = -3.985e-3;
  constexpr double kDeepest = 4e-5;
  constexpr int kSteps = 4000;
  const Swept swept = press_in_and_out(law, kDeepest, kLateral, kSteps);
  EXPECT_EQ(swept.snaps, 2);
  EXPECT_LT(swept.snap_out, swept.snap_in - 5 * kDeepest / kSteps);
  // A tenth of the steps gives the same, within the length of one step.
  const Swept coarse = press_in_and_out(law, kDeepest, kLateral, kSteps / 10);
  EXPECT_EQ(coarse.snaps, 2);
  EXPECT_NEAR(coarse.snap_in, swept.snap_in, 10.1 * kDeepest / kSteps);
  EXPECT_NEAR(coarse.snap_out, swept.snap_out, 10.1 * kDeepest / kSteps);
}

/// The paper's stepping of the force ends at most one increment above the root.
template <class Law>
void expect_steps_up_to_the_root(const Law& law, double increment) {
  RandomContacts contacts(kDefaultRotor, 0.1, 27);
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose at = contacts.next();
    const auto root = law.solve(at, 1.0);
    if (!root) continue;  // small slopes taken too far
    const double exact = force_at(law, at, 1.0, *root).normal;
    TipForce stepped{};
    if (!law.respond_upwards(at, 1.0, 0.3, increment, stepped)) continue;
    EXPECT_GT(stepped.normal, exact - 0.06 * increment) << i;
    EXPECT_LT(stepped.normal, exact + 1.06 * increment) << i;
    ++compared;
  }
  EXPECT_GT(compared, 250);
}

TEST(CompliantBlades, ForceSteppedUpwardsEndsAtTheRoot) {
  for (const double friction : {0.0, 0.1}) {
    for (const Theory theory : {Theory::elastica, Theory::beam_column}) {
      expect_steps_up_to_the_root(make({friction, 1.0, theory}), 0.3);
      expect_steps_up_to_the_root(make({friction, 0.0, theory}), 0.3);
      expect_steps_up_to_the_root(make<InAnyRing>({friction, 1.0, theory}, AnyRing{1e4}), 0.3);
    }
  }
}

}  // namespace
}  // namespace rubatlas::contact
