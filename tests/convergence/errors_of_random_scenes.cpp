/// Errors of random scenes with effects against their tolerance, and against what the motion makes of an
/// error at its start.
///
/// The tolerance bounds the error of a step. Those of many steps, and of the hops of a tip that comes to
/// rest, add up: what is bounded here is the error over the number of steps. What exceeds a hundred
/// tolerances is printed; errors.md has the reasons.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "../assembly/random_scene.hpp"
#include "../support/point.hpp"
#include "settings/combinations.hpp"
#include "variation/parts_of_scene.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;

struct ScenesWithEffects {
  std::uint64_t first;
  std::uint64_t scenes;
};

void PrintTo(const ScenesWithEffects& range, std::ostream* out) {
  *out << range.first << "_to_" << range.first + range.scenes - 1;
}

class ErrorsOfRandomScenes : public ::testing::TestWithParam<ScenesWithEffects> {
 protected:
  static constexpr double kReference = 1e-13;
  static constexpr double kMost = 10.0;      ///< tolerances a step
  static constexpr double kPrinted = 100.0;  ///< tolerances of the whole motion
  /// Of a motion [ns of counted work], of which a scene takes up to twenty.
  static constexpr std::int64_t kDearest = 20'000'000;
  /// A motion asks whether to go on after each of its two revolutions, and after each 2 ms of work: one that
  /// has asked so often is dearer for certain.
  static constexpr std::int64_t kMostQuestions = 2 * kDearest / 2'000'000;

  point::PointOutcome end_of(settings::Scene scene, double tolerance, const motion::SectionState& start) {
    scene.accuracy.tolerance = tolerance;
    return run(scene, scene.grid.speed_ratio.front(), start, tables_);
  }
  /// Pending where it is too dear.
  point::PointOutcome reference_of(settings::Scene scene, const motion::SectionState& start) {
    scene.accuracy.tolerance = kReference;
    std::int64_t questions = 0;
    return solver_of(scene, tables_)->run(scene.grid.speed_ratio.front(), start, [&questions] {
      return ++questions <= kMostQuestions;
    });
  }
  /// By how much an error of `size` at the start is larger at the end; 1 where it shrinks. None where it
  /// decides on the status.
  std::optional<double> growth(const settings::Scene& scene, const motion::SectionState& start, double size,
                               const point::PointOutcome& reference) {
    double most = 1.0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      for (const double shift : {size, -size}) {
        motion::SectionState aside = start;
        aside[i] += shift;
        const point::PointOutcome other = end_of(scene, kReference, aside);
        if (other.status != PointStatus::done) return std::nullopt;
        most = std::max(most, largest_difference(other.final_state, reference.final_state) / size);
      }
    }
    return most;
  }
  void compare(settings::Scene scene, const std::string& name) {
    if (settings::combination_of(scene).family->kind == settings::MotionFamily::paper_s_rotor) return;
    scene.observables = {"poincare"};
    scene.protocol = {0, 2, 64};
    const motion::SectionState start{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};
    const point::PointOutcome reference = reference_of(scene, start);
    const bool compares = reference.status == PointStatus::done && reference.work.touchdowns > 0 &&
                          reference.work.price <= kDearest;
    if (!compares) return;
    const double doubt =
        largest_difference(end_of(scene, 10.0 * kReference, start).final_state, reference.final_state);
    const double scale = variation::constants_of(scene, scene.grid.speed_ratio.front()).length_scale;
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      const point::PointOutcome motion = end_of(scene, tolerance, start);
      ++compared_;
      if (motion.status != PointStatus::done) {
        ++ended_;
        std::cout << name << ": tolerance " << tolerance << ", " << ending::text_of(motion.detail) << '\n';
        continue;
      }
      const double unit = std::max(tolerance * scale, 1e-15 * scene.ring.radius);
      const double error = largest_difference(motion.final_state, reference.final_state);
      if (error < kPrinted * unit || doubt > 0.1 * error) continue;
      const auto grown = growth(scene, start, unit, reference);
      if (!grown) continue;
      const auto steps = static_cast<double>(motion.work.steps);
      if (error > kPrinted * unit * *grown) {
        ++exceeding_;
        std::cout << name << ": tolerance " << tolerance << ", error " << error / unit << " tolerances, "
                  << steps << " steps, " << motion.work.touchdowns << " touch-downs, growth of an error "
                  << *grown << '\n';
      }
      EXPECT_LE(error, kMost * steps * unit * *grown) << name << ", tolerance " << tolerance;
    }
  }

  std::shared_ptr<assembly::BladeTables> tables_ = assembly::make_blade_tables();
  int compared_ = 0;
  int ended_ = 0;      ///< with another status than the reference
  int exceeding_ = 0;  ///< more than `kPrinted`
};

TEST_P(ErrorsOfRandomScenes, AreThoseOfTheirStepsTimesWhatTheMotionMakesOfAnError) {
  const auto [first, scenes] = GetParam();
  for (std::uint64_t number = first; number < first + scenes; ++number) {
    const std::uint64_t index = 3 * number + 2;  // rotors that rub
    compare(random_scene(index), "random scene " + std::to_string(index));
  }
  std::cout << compared_ << " motions: " << exceeding_ << " exceed, " << ended_ << " ended\n";
  EXPECT_GT(compared_, static_cast<int>(scenes) / 4);
  EXPECT_LE(exceeding_ + ended_, 1 + compared_ / 20);
}

std::vector<ScenesWithEffects> scenes_with_effects(std::uint64_t shards, std::uint64_t scenes) {
  std::vector<ScenesWithEffects> all;
  for (std::uint64_t i = 0; i < shards; ++i) all.push_back({i * scenes, scenes});
  return all;
}

INSTANTIATE_TEST_SUITE_P(First, ErrorsOfRandomScenes, ::testing::ValuesIn(scenes_with_effects(2, 30)));
INSTANTIATE_TEST_SUITE_P(Slow, ErrorsOfRandomScenes, ::testing::ValuesIn(scenes_with_effects(10, 250)));

}  // namespace
}  // namespace rubatlas::test
