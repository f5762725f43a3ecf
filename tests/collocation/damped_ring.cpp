/// Elastic blades on a ring with a damper under each tip, by collocation and in steps of the order-8
/// pair, held against such steps at a thousandth of the tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <random>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "collocation/interval.hpp"
#include "contact/damped_ring.hpp"
#include "lone_contacts.hpp"
#include "modes/phase.hpp"
#include "several_blades.hpp"

namespace rubatlas::test {
namespace {

constexpr unsigned kSeedOnDampers = 11;
constexpr double kToleranceOnDampers = 1e-9;
constexpr double kFineOnDampers = 1e-12;

/// How long blades touch, and how long of that on arcs [τ].
class TimeOnArcs final : public modes::MotionListener {
 public:
  void piece(trajectory::MotionPiece& piece) override {
    if (piece.contact_count() == 0) return;
    in_contact += piece.end() - piece.begin();
    if (dynamic_cast<modes::Phase*>(&piece) != nullptr) on_arcs += piece.end() - piece.begin();
  }
  double in_contact = 0.0;
  double on_arcs = 0.0;
};

struct ElasticOnDampers {
  Rotor rotor;
  contact::ElasticBladeOnDampedRing law;
  rotor::State kick;
};
/// Soft rings to stiff, with dampers from a hundredth of the critical one to three times that.
ElasticOnDampers elastic_on_dampers(std::mt19937_64& generator) {
  const Rotor rotor = random_rotor(generator);
  const double stiffness = std::pow(10.0, uniform(generator, 2.0, 5.0));
  const double critical = 2.0 * std::sqrt(stiffness / rotor.constants.force_unit);
  const double damping = critical * std::pow(10.0, uniform(generator, -2.0, 0.5));
  return {rotor, {rotor.law, stiffness, damping}, random_start(generator)};
}

struct Revolution {
  std::optional<trajectory::State> end;  ///< where the motion can be computed
  ending::StatusDetail detail;           ///< why not
};
Revolution revolution(const ElasticOnDampers& m, double tolerance, bool collocates, TimeOnArcs& time) {
  const auto motion = hybrid_motion(machine_of(m.rotor.constants, m.rotor.blades), m.law,
                                    {tolerance * kClearanceOfSeveral, 0.5}, collocates);
  ending::StatusDetail why = motion->start(rotor::as_array(m.kick));
  if (why == ending::StatusDetail::none) why = motion->revolution(time, {}, 0);
  if (why != ending::StatusDetail::none) return {std::nullopt, why};
  return {rotor::as_array(rotor::shaft(motion->state())), ending::StatusDetail::none};
}

/// In tolerances.
double error_on_dampers(const trajectory::State& state, const trajectory::State& exact) {
  double largest = 0.0;
  for (std::size_t i = 0; i < state.size(); ++i) largest = std::max(largest, std::abs(state[i] - exact[i]));
  return largest / (kToleranceOnDampers * kClearanceOfSeveral);
}

/// A blade under a load that jumps has no equilibrium, or is shortened too much, as last digits have it.
ending::StatusDetail end_of_model(ending::StatusDetail detail) {
  using enum ending::StatusDetail;
  return detail == shortening_limit ? no_equilibrium : detail;
}

void expect_errors_within_tolerance_on_dampers(std::size_t wanted) {
  std::mt19937_64 generator(kSeedOnDampers);
  std::vector<double> by_collocation;
  std::vector<double> by_steps;
  TimeOnArcs time;
  TimeOnArcs others;
  while (by_steps.size() < wanted) {
    const ElasticOnDampers m = elastic_on_dampers(generator);
    const auto [exact, exact_detail] = revolution(m, kFineOnDampers, false, others);
    const auto [steps, steps_detail] = revolution(m, kToleranceOnDampers, false, others);
    const auto [collocated, collocated_detail] = revolution(m, kToleranceOnDampers, true, time);
    // Steps alone may run out of work, where the ring follows a load in far less time than the shaft does.
    if (exact_detail != ending::StatusDetail::contact_work) {
      EXPECT_EQ(end_of_model(exact_detail), end_of_model(collocated_detail));
    }
    if (!exact || !steps || !collocated || *steps == *collocated) continue;  // it has not touched
    by_collocation.push_back(error_on_dampers(*collocated, *exact));
    by_steps.push_back(error_on_dampers(*steps, *exact));
  }
  std::ranges::sort(by_collocation);
  std::ranges::sort(by_steps);
  // Motions that tumble from contact to contact magnify errors.
  struct Quantile {
    double share, most;  // tolerances
  };
  for (const auto& [share, most] : {Quantile{0.5, 1.0}, Quantile{0.9, 20.0}, Quantile{0.99, 200.0}}) {
    const auto place = static_cast<std::size_t>(share * static_cast<double>(wanted - 1));
    EXPECT_LE(by_collocation[place], most) << share;
    EXPECT_LE(by_steps[place], most) << share << ", in steps";
  }
  constexpr double kLeastOnArcs = 0.95;
  EXPECT_GE(time.on_arcs, kLeastOnArcs * time.in_contact);
}

TEST(BladesOnDampedRing, ErrByTheToleranceAsInSteps) {
  expect_errors_within_tolerance_on_dampers(25);
}
TEST(BladesOnDampedRingSlow, ErrByTheToleranceInAThousandMotions) {
  expect_errors_within_tolerance_on_dampers(1000);
}

/// Those of the random motions, which are counted from 1.
std::vector<ElasticOnDampers> random_motions(const std::vector<int>& numbers) {
  std::mt19937_64 generator(kSeedOnDampers);
  std::vector<ElasticOnDampers> motions;
  for (int i = 1; motions.size() < numbers.size(); ++i) {
    const ElasticOnDampers m = elastic_on_dampers(generator);
    if (std::ranges::find(numbers, i) != numbers.end()) motions.push_back(m);
  }
  return motions;
}
void expect_followed(const std::vector<int>& numbers) {
  constexpr double kMostTolerances = 10.0;
  TimeOnArcs time;
  for (const ElasticOnDampers& m : random_motions(numbers)) {
    const auto [collocated, detail] = revolution(m, kToleranceOnDampers, true, time);
    const auto [exact, exact_detail] = revolution(m, kFineOnDampers, false, time);
    EXPECT_EQ(detail, exact_detail);
    ASSERT_TRUE(collocated && exact);
    EXPECT_LE(error_on_dampers(*collocated, *exact), kMostTolerances);
  }
}

TEST(BladesOnDampedRing, AreFollowedWhereTheyTurnOutwardsInsideItAsAnotherContactBegins) {
  expect_followed({441, 511, 538});
}
TEST(BladesOnDampedRing, SlipOnAsTheyBendWhereTheirSlipReverses) {
  // The tip of an unbent blade sets out by how it bends, not by how a straight one would go.
  expect_followed({191, 221});
}
TEST(BladesOnDampedRing, AreFollowedWhereTheyBendOnIt) {
  expect_followed({16, 165});
}
TEST(BladesOnDampedRing, ErrByTheToleranceWhereTheRingYieldsToASteepLoad) {
  expect_followed({260, 276, 439, 572, 606, 660});
}
/// By collocation the blade is found beyond the limit of the shortening, by steps it has no equilibrium.
TEST(BladesOnDampedRing, LeaveTheModelWhereTheLoadThatBendsThemJumpsBelowTheirOwn) {
  TimeOnArcs time;
  for (const ElasticOnDampers& m : random_motions({107, 129})) {
    for (const bool collocates : {true, false})
      EXPECT_EQ(ending::status_of(revolution(m, kToleranceOnDampers, collocates, time).detail),
                ending::PointStatus::left_validity);
  }
}

TEST(BladesOnDampedRing, HaveTheSameBitsOnEveryProcessor) {
  using namespace collocation;
  const blade::ElasticaCurve curve(0.1);
  const collocation::Machine machine = machine_at_ring();
  collocation::Blade blade = blade_at_ring();
  blade.table = &curve.over_asinh();
  blade.length = 0.1;
  blade.load_unit = 20.0;
  blade.friction = 0.1;
  blade.ring_stiffness = 2000.0;
  blade.ring_damping = 200.0;
  Interval in_pairs = interval_at_ring(machine.misalignment, blade);
  in_pairs.leader().slip = -1.0;  // the blade approaches its deepest place
  Interval here = in_pairs;
  const Closeness closeness{1e-12, false};
  ASSERT_TRUE(solver_in_pairs().solve(machine, closeness, in_pairs));
  ASSERT_TRUE(interval_solver().solve(machine, closeness, here));
  EXPECT_EQ(in_pairs.sweeps, here.sweeps);
  const auto same = [](const AtNodes& a, const AtNodes& b) {
    return std::memcmp(a.value.data(), b.value.data(), sizeof a.value) == 0;
  };
  EXPECT_TRUE(same(in_pairs.shaft.vy, here.shaft.vy) &&
              same(in_pairs.leader().yielding, here.leader().yielding) &&
              same(in_pairs.leader().gap_measure, here.leader().gap_measure));
  EXPECT_GT(here.leader().yielding.at_end(), 0.0);
}

}  // namespace
}  // namespace rubatlas::test
