// Blades that are not alike, against blades that are, against each other renumbered, and as a random spread.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/make_line_solver.hpp"
#include "effect_scene.hpp"

namespace rubatlas::test {
namespace {

using effects::BladeError;
using ending::PointStatus;
using motion::SectionState;

settings::Scene equal_blades(settings::ContactLaw law, double speed_ratio) {
  nlohmann::json scene = effect_scene("unequal_blades", speed_ratio, 4);
  scene.erase("unequal_blades");
  scene["contact"]["law"] = law == settings::ContactLaw::elastica ? "elastica" : "elastic_ring";
  scene["observables"] = {"poincare", "poincare_blade_passing"};
  scene["accuracy"]["tolerance"] = 1e-13;
  return parsed(scene);
}

class UnequalBlades : public ::testing::TestWithParam<settings::ContactLaw> {};

TEST_P(UnequalBlades, AllLongerByTheSameAreLongerBlades) {
  settings::Scene errors = equal_blades(GetParam(), 0.45);
  settings::Scene length = errors;
  errors.unequal_blades.emplace().length_errors = {2e-4, 2e-4, 2e-4};
  length.blades.length += 2e-4;
  const auto with_errors = run(errors);
  const auto longer = run(length);
  ASSERT_EQ(longer.status, PointStatus::done);
  EXPECT_EQ(with_errors.work.touchdowns, longer.work.touchdowns);
  EXPECT_LE(largest_difference(with_errors.rows[0], longer.rows[0]), 1e-12);
}

TEST_P(UnequalBlades, AllThickerByTheSameAreThickerBlades) {
  settings::Scene errors = equal_blades(GetParam(), 0.45);
  settings::Scene thickness = errors;
  errors.unequal_blades.emplace().thickness_errors = {1e-4, 1e-4, 1e-4};
  thickness.blades.thickness += 1e-4;
  thickness.grid.thickness = {thickness.blades.thickness};
  const auto with_errors = run(errors);
  const auto thicker = run(thickness);
  ASSERT_EQ(thicker.status, PointStatus::done);
  EXPECT_LE(largest_difference(with_errors.rows[0], thicker.rows[0]), 1e-12);
}

TEST_P(UnequalBlades, RenumberedAndABladeLaterMoveTheSameWay) {
  settings::Scene scene = equal_blades(GetParam(), 0.45);
  auto& errors = scene.unequal_blades.emplace();
  errors.length_errors = {1e-4, 0.0, -3e-4};
  errors.thickness_errors = {0.0, 1e-4, -1e-4};
  errors.angle_errors = {0.01, -0.02, 0.0};
  const auto motion = run(scene, {1e-3, 0.0, 0.0, 1e-3});
  ASSERT_EQ(motion.status, PointStatus::done);
  ASSERT_GT(motion.work.touchdowns, 0U);
  const auto& passings = motion.rows[1];
  const SectionState passing{passings[0], passings[1], passings[2], passings[3]};
  const auto same = run(scene, passing);
  // A blade passing later, each blade stands where the next one stood.
  for (auto* list : {&errors.length_errors, &errors.thickness_errors, &errors.angle_errors}) {
    std::rotate(list->begin(), list->end() - 1, list->end());
  }
  const auto later = run(scene, passing);
  EXPECT_LE(largest_difference(later.rows[1], passings, 0, 4), 1e-11);
  EXPECT_GT(largest_difference(same.rows[1], passings, 0, 4), 1e-6) << "and not with the old numbers";
}

TEST_P(UnequalBlades, OneThatIsLongerTouchesAlone) {
  // Two blades pass the ring at 50 µm, the third overlaps it by 1 µm.
  settings::Scene scene = equal_blades(GetParam(), 0.2);
  scene.rotor.misalignment = 0.00995;
  scene.protocol.sampled_revolutions = 3;
  scene.protocol.samples_per_revolution = 4096;
  scene.unequal_blades.emplace().length_errors = {0.0, 5.1e-5, 0.0};
  const auto orbit = solver_of_first_line(scene)->orbit(0.2, {});
  ASSERT_EQ(orbit.status, PointStatus::done);
  double of_longer = 0.0;
  double of_others = 0.0;
  for (std::size_t i = 0; i < orbit.force.size(); ++i) {
    double& largest = i % 3 == 1 ? of_longer : of_others;
    largest = std::max(largest, orbit.force[i]);
  }
  EXPECT_GT(of_longer, 0.0);
  EXPECT_EQ(of_others, 0.0);
  EXPECT_EQ(run(scene).work.touchdowns, 3U) << "once in each revolution";
  scene.unequal_blades.reset();
  EXPECT_EQ(run(scene).work.touchdowns, 0U);
}

INSTANTIATE_TEST_SUITE_P(Laws, UnequalBlades,
                         ::testing::Values(settings::ContactLaw::elastica,
                                           settings::ContactLaw::elastic_ring),
                         [](const auto& instance) {
                           return instance.param == settings::ContactLaw::elastica ? "elastica"
                                                                                   : "elastic_ring";
                         });

// --- the random spread ---

effects::UnequalBlades spread(int seed) {
  effects::UnequalBlades blades;
  blades.length_spread = 1e-4;
  blades.thickness_spread = 2e-5;
  blades.angle_spread = 0.01;
  blades.seed = seed;
  return blades;
}

std::vector<double> all_errors(const effects::UnequalBlades& blades, int count) {
  std::vector<double> all;
  for (const BladeError& error : blades.errors(count)) {
    all.insert(all.end(), {error.length, error.thickness, error.angle});
  }
  return all;
}

TEST(SpreadOfBlades, TheSameSeedDrawsTheSameErrorsAndAnotherSeedOthers) {
  EXPECT_EQ(all_errors(spread(7), 50), all_errors(spread(7), 50));
  const auto seven = all_errors(spread(7), 50);
  const auto eight = all_errors(spread(8), 50);
  for (std::size_t i = 0; i < seven.size(); ++i) EXPECT_NE(seven[i], eight[i]) << i;
}

TEST(SpreadOfBlades, OneSpreadLeavesTheDrawsOfTheOthersAsTheyAre) {
  auto wider = spread(7);
  wider.length_spread *= 2.0;
  wider.thickness_spread = 0.0;
  const auto before = spread(7).errors(12);
  const auto after = wider.errors(12);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(after[k].length, 2.0 * before[k].length);
    EXPECT_EQ(after[k].thickness, 0.0);
    EXPECT_EQ(after[k].angle, before[k].angle);
  }
}

TEST(SpreadOfBlades, ListsAndSpreadsAddUp) {
  auto both = spread(3);
  both.length_errors = {1e-3, 0.0, -1e-3};
  const auto drawn = spread(3).errors(3);
  const auto sum = both.errors(3);
  EXPECT_EQ(sum[0].length, 1e-3 + drawn[0].length);
  EXPECT_EQ(sum[1].length, drawn[1].length);
  EXPECT_EQ(sum[2].length, -1e-3 + drawn[2].length);
}

TEST(SpreadOfBlades, HasTheMeanAndDeviationOfItsNormalLawAndNoCorrelation) {
  constexpr int kSeeds = 20000;
  double sum[3]{};
  double squares[3]{};
  double products[3]{};  // length of a blade with its thickness, its angle, the next blade's length
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto errors = spread(seed).errors(2);
    const double scaled[3]{errors[0].length / 1e-4, errors[0].thickness / 2e-5, errors[0].angle / 0.01};
    for (int i = 0; i < 3; ++i) {
      sum[i] += scaled[i];
      squares[i] += scaled[i] * scaled[i];
    }
    products[0] += scaled[0] * scaled[1];
    products[1] += scaled[0] * scaled[2];
    products[2] += scaled[0] * errors[1].length / 1e-4;
  }
  const double sigma = 1.0 / std::sqrt(kSeeds);  // of a mean
  for (int i = 0; i < 3; ++i) {
    EXPECT_LE(std::abs(sum[i] / kSeeds), 4.0 * sigma) << i;
    EXPECT_NEAR(squares[i] / kSeeds, 1.0, 4.0 * std::sqrt(2.0) * sigma) << i;
    EXPECT_LE(std::abs(products[i] / kSeeds), 4.0 * sigma) << i;
  }
}

}  // namespace
}  // namespace rubatlas::test
