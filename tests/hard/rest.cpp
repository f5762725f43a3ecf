/// Tips at rest, searched: whether a tip rests, turns round or comes loose depends neither on the steps nor
/// on the last digits of a motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

/// A kick against the spin, as slow rotors need it for a tip to come to rest.
struct Start {
  settings::Scene scene;
  double speed_ratio;
  motion::SectionState state;
};

Start random_start(std::uint64_t seed, bool sticks) {
  std::mt19937_64 bits(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits() >> 11U) * 0x1p-53;
  };
  Start start{default_rotor(1), uniform(0.03, 0.6), {}};
  settings::Scene& scene = start.scene;
  scene.contact.friction = uniform(0.2, 0.8);
  scene.rotor.damping_ratio = uniform(0.02, 0.3);
  scene.rotor.misalignment = uniform(0.0, 0.012);
  scene.blades.count = 1 + static_cast<int>(uniform(0.0, 8.0));
  scene.blades.thickness = uniform(0.0008, 0.0016);
  if (sticks) scene.stick.emplace();
  for (std::size_t i = 0; i < 2; ++i) start.state[i] = uniform(-0.005, 0.005);
  for (std::size_t i = 2; i < 4; ++i) start.state[i] = uniform(-0.04, 0.04);
  return start;
}

/// How far tips at rest have been met, and where their motion was another one at another tolerance.
struct Found {
  int resting = 0;
  int out_of_work = 0;  ///< at one tolerance or more
  std::string differing;
};

/// The motions from one start, at any tolerance, and shifted along one of its four components.
class Motions {
 public:
  Motions(std::uint64_t seed, bool sticks) : start_(random_start(seed, sticks)) {}

  /// `shift`: in clearances.
  point::PointOutcome at(double tolerance, std::size_t component = 0, double shift = 0.0) const {
    settings::Scene scene = start_.scene;
    scene.accuracy.tolerance = tolerance;
    motion::SectionState state = start_.state;
    state[component] += shift * scene.clearance();
    return run(scene, start_.speed_ratio, state);
  }
  /// In clearances.
  double apart(const point::PointOutcome& a, const point::PointOutcome& b) const {
    return largest_difference(a.final_state, b.final_state) / start_.scene.clearance();
  }
  /// Of the outcomes with that shift forwards and backwards along each component, the one farthest away.
  double farthest(const point::PointOutcome& from, double tolerance, double shift) const {
    double most = 0.0;
    for (std::size_t component = 0; component < 4; ++component) {
      for (const double signed_shift : {shift, -shift}) {
        const auto outcome = at(tolerance, component, signed_shift);
        most = std::max(most, outcome.detail == from.detail ? apart(outcome, from) : 1.0);
      }
    }
    return most;
  }

 private:
  Start start_;
};

bool is_out_of_work(const point::PointOutcome& outcome) {
  return outcome.detail == ending::StatusDetail::contact_work;
}

/// Compares the motion at other tolerances with the one at the finest that its bound of work lets end.
void look_at(std::uint64_t seed, bool sticks, Found& found) {
  const Motions motions(seed, sticks);
  std::array<double, 5> tolerances{1e-12, 1e-11, 1e-10, 1e-9, 1e-8};
  point::PointOutcome finest;
  std::size_t first = 0;
  for (; first < tolerances.size(); ++first) {
    finest = motions.at(tolerances[first]);
    const auto& work = finest.work;
    if ((sticks ? work.slip_reversals : work.slip_accumulations) == 0) return;
    if (!is_out_of_work(finest)) break;
  }
  if (first > 0) ++found.out_of_work;
  if (first + 1 >= tolerances.size()) return;
  constexpr double kShift = 1e-10;
  constexpr double kChaotic = 1e5;
  const double growth = std::max(1.0, motions.farthest(finest, tolerances[first], kShift) / kShift);
  if (!(growth <= kChaotic)) return;
  ++found.resting;
  // Errors of steps and events add up, and each grows.
  constexpr double kOfSteps = 1e3;
  constexpr double kOfAnEvent = 20.0;
  const auto& work = finest.work;
  const auto events = static_cast<double>(work.touchdowns + work.liftoffs + work.slip_reversals);
  for (std::size_t i = first + 1; i < tolerances.size(); ++i) {
    const double error = std::max(kOfSteps, kOfAnEvent * events) * tolerances[i];
    const auto outcome = motions.at(tolerances[i]);
    const bool same = outcome.detail == finest.detail;
    if (same && motions.apart(outcome, finest) <= growth * error) continue;
    // Another event comes first, or one more: it does so too from a start that is off by such an error.
    if (motions.farthest(finest, tolerances[first], error) >= (same ? motions.apart(outcome, finest) : 1.0))
      continue;
    found.differing += std::to_string(seed) + " at " + std::to_string(std::log10(tolerances[i])) + ", ";
  }
}

void expect_the_same_at_every_tolerance(bool sticks, std::uint64_t starts) {
  Found found;
  for (std::uint64_t seed = 1; seed <= starts; ++seed) look_at(seed, sticks, found);
  EXPECT_EQ(found.differing, "") << "seeds, and logarithms of the tolerance";
  EXPECT_GT(found.resting, static_cast<int>(starts) / 20) << "a search that meets no rest searches nothing";
  EXPECT_LT(found.out_of_work, std::max(2, found.resting / 10)) << "motions that no fine tolerance shows";
}

TEST(Rest, WhereReversalsAccumulateIsTheSameAtFiveTolerances) {
  expect_the_same_at_every_tolerance(false, 80);
}
TEST(Rest, OfTipsThatMayStickIsTheSameAtFiveTolerances) {
  expect_the_same_at_every_tolerance(true, 80);
}
TEST(Rest, OfATipThatComesLooseAndIsDraggedAgainstItsFrictionIsTheSameAtFiveTolerances) {
  Found found;
  for (const std::uint64_t seed : {113, 624, 741, 1910}) look_at(seed, false, found);
  EXPECT_EQ(found.differing, "");
  EXPECT_EQ(found.resting, 4);
}
TEST(Rest, OfATipThatSticksLastsUntilFrictionCannotHoldItAtFiveTolerances) {
  // Located by the tolerance, the end of rest is a little early: the tip could not slip yet.
  Found found;
  for (const std::uint64_t seed : {1024, 1849, 1908, 1951}) look_at(seed, true, found);
  EXPECT_EQ(found.differing, "");
  EXPECT_GT(found.resting, 2);
}
TEST(Rest, OfAnAllButStraightBladeEndsWhereItsPlaceIsLostAtFiveTolerances) {
  // Sweeps have to find its load closer than the shaft's velocity asks for.
  Found found;
  for (const std::uint64_t seed : {173, 531, 1173, 1407}) look_at(seed, false, found);
  for (const std::uint64_t seed : {641, 762}) look_at(seed, true, found);
  EXPECT_EQ(found.differing, "");
  EXPECT_EQ(found.resting, 6);
}
TEST(Rest, WhoseEndIsFirstSeenFarBeyondItIsTheSameAtFiveTolerances) {
  Found found;
  for (const std::uint64_t seed : {112, 971}) look_at(seed, false, found);
  EXPECT_EQ(found.differing, "");
  EXPECT_EQ(found.resting, 2);
}
TEST(Rest, OfMotionsSideBySideEndsAlike) {
  // Where the tip all but turns about its place on the ring its load follows the shaft's velocity a billion
  // times as steeply: of an end of rest that hangs on last digits, some of a hundred motions go another way.
  constexpr double kFarthest = 1e-6;  // in clearances, 10⁴ times as far as they begin
  for (const std::uint64_t seed : {173, 531, 1173, 1407, 971}) {
    const Motions motions(seed, false);
    const point::PointOutcome finest = motions.at(1e-12);
    for (const double tolerance : {1e-12, 1e-10, 1e-9}) {
      for (int i = 1; i <= 25; ++i) {
        const std::size_t component = static_cast<std::size_t>(i) % 4;
        for (const double shift : {-4e-12 * i, 4e-12 * i}) {
          const auto beside = motions.at(tolerance, component, shift);
          ASSERT_EQ(beside.detail, finest.detail) << seed << " at " << tolerance << " off by " << shift;
          EXPECT_LT(motions.apart(beside, finest), kFarthest)
              << seed << " at " << tolerance << " off by " << shift;
        }
      }
    }
  }
}
TEST(RestSlow, WhereReversalsAccumulateIsTheSameAtFiveTolerancesFromTwoThousandStarts) {
  expect_the_same_at_every_tolerance(false, 2000);
}
TEST(RestSlow, OfTipsThatMayStickIsTheSameAtFiveTolerancesFromTwoThousandStarts) {
  expect_the_same_at_every_tolerance(true, 2000);
}

TEST(Rest, OfOneTipLeavesAnotherToReverseItsSlipWhereItsVelocityIsZero) {
  // While blade 0 rests blade 1 slips against its v, as it does without a tip at rest.
  const Start start = random_start(113, false);
  settings::Scene scene = start.scene;
  scene.protocol.sampled_revolutions = 1;
  std::array<motion::SectionState, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    scene.accuracy.tolerance = i == 0 ? 1e-8 : 1e-12;
    const auto outcome = run(scene, start.speed_ratio, start.state);
    EXPECT_GE(outcome.work.slip_accumulations, 2U);
    ends[i] = outcome.final_state;
  }
  EXPECT_LE(largest_difference(ends[0], ends[1]), 1e-5 * scene.clearance());
}

}  // namespace
}  // namespace rubatlas::test
