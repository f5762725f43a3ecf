/// Compliant blades on the receding side, where a contact has several roots: branches, snaps, hysteresis.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "compliant_blades.hpp"

namespace rubatlas::contact {
namespace {

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
  return pressed_tip(given.blade.euler_load() * compliance * 0.1 * std::pow(random.uniform(), 2),
                     -std::min(edge * (0.5 + 0.6 * random.uniform()), 0.25 * kDefaultRotor.ring_radius));
}

/// Bracket of a root of h = 0 at which h falls, from a fine scan beyond the unloaded blade; and the ends of
/// the stretch around the root on which h falls.
struct Scanned {
  double low, high;
  double begin, end;
};
std::vector<Scanned> scan(const ElasticaContact& law, const Pose& at, double slip) {
  constexpr int kPoints = 6000;
  const double first = 1e-4 * law.curve().knots()[1].bending;
  const double ratio = law.curve().end() / first;
  std::vector<Scanned> roots;
  std::vector<double> bendings;
  std::vector<double> residuals;
  for (int i = 0; i <= kPoints; ++i) {
    bendings.push_back(first * std::pow(ratio, static_cast<double>(i) / kPoints));
    residuals.push_back(law.residual(at, slip, law.curve_at(bendings.back())));
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
    const auto law = make(given.blade, Ring{given.ring_stiffness});
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
    const auto law = make(given.blade, Ring{given.ring_stiffness});
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
Swept press_in_and_out(const ElasticaContact& law, double deepest, double lateral, int steps) {
  Swept swept;
  Pose at = pressed_tip(1e-9, lateral);
  double bending = law.solve(at, 1.0).value();
  for (int i = 1; i < 2 * steps; ++i) {
    const bool in = i <= steps;
    at = pressed_tip(deepest * (in ? i : 2 * steps - i) / steps, lateral);
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
  const auto law = make(blade, Ring{1e5});
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
  const auto law = make({0.1, 1.0}, Ring{1e5});
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

}  // namespace
}  // namespace rubatlas::contact
