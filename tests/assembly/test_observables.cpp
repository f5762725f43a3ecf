// Every observable of random scenes, under every method and effect, against dense samples of the same motion.
//
// An observable looks at few places of a motion, and proves or assumes that nothing lies between them. Dense
// samples assume nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "../support/point.hpp"
#include "dense_figures.hpp"
#include "observables/list.hpp"
#include "random_scene.hpp"
#include "settings/combinations.hpp"

namespace rubatlas::test {
namespace {

using settings::Method;

/// Of the size of an observable: what locating a largest value and sums over places leave, and how many
/// tolerances a sum may be off, whose places are those of steps.
constexpr double kCloseness = 1e-6;
constexpr double kTolerances = 100.0;
/// Of a motion with its observables [ns of counted work], times its blades: dense samples take fifty times as
/// long.
constexpr std::int64_t kDearest = 60'000'000;
/// A motion asks whether to go on after each revolution, and after each 2 ms of work: one that has asked so
/// often, beside its few revolutions, is dearer for certain.
constexpr std::int64_t kMostQuestions = 2 * kDearest / 2'000'000;

/// The methods by which a scene can be computed that differ in what they tell their observables.
std::vector<Method> methods_of(const settings::Scene& scene) {
  const bool plain = settings::combination_of(scene).family->kind == settings::MotionFamily::paper_s_rotor;
  return plain ? std::vector{Method::hybrid, Method::collocation} : std::vector{scene.accuracy.method};
}

struct ObservedScenes {
  std::uint64_t first;
  std::uint64_t scenes;
};

void PrintTo(const ObservedScenes& range, std::ostream* out) {
  *out << range.first << "_to_" << range.first + range.scenes - 1;
}

class Observables : public ::testing::TestWithParam<ObservedScenes> {
 protected:
  /// Compares one motion; how far each observable is from its samples, in its size.
  void compare(const settings::Scene& scene) {
    const double speed_ratio = scene.grid.speed_ratio.front();
    const motion::SectionState start{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};
    const auto solver = solver_of(scene, tables_);
    std::int64_t questions = 0;
    const point::PointOutcome outcome =
        solver->run(speed_ratio, start, [&questions] { return ++questions <= kMostQuestions; });
    if (outcome.status != ending::PointStatus::done) return;
    if (outcome.work.price * scene.blades.count > kDearest) return;
    DenseFigures dense(scene, speed_ratio);
    ASSERT_EQ(solver->listen(speed_ratio, start, dense), outcome.status);
    ++motions_;
    if (outcome.work.touchdowns > 0) ++touching_;
    for (const std::string& contradiction : dense.contradictions()) ADD_FAILURE() << contradiction;
    if (dense.only_brushes() || dense.hardly_moves()) return;
    const double closeness = kCloseness + kTolerances * scene.accuracy.tolerance;
    const auto descriptions = observables::descriptions(scene);
    for (std::size_t i = 0; i < descriptions.size(); ++i) {
      const auto figure = dense.figure(descriptions[i].name);
      constexpr double kSmallest = 1e-150;  // the square of a smaller number is zero
      if (!figure || figure->size < kSmallest) continue;
      const std::vector<double>& row = outcome.rows[i];
      ASSERT_EQ(row.size(), figure->values.size()) << descriptions[i].name;
      for (std::size_t j = 0; j < row.size(); ++j) {
        const double expected = figure->values[j];
        if (std::isnan(expected) && std::isnan(row[j])) continue;
        const double difference = std::abs(row[j] - expected);
        EXPECT_LE(difference, closeness * figure->size)
            << descriptions[i].name << '[' << j << "]: " << row[j] << " against " << expected;
        double& worst = worst_[descriptions[i].name];
        if (figure->size > 0.0) worst = std::max(worst, difference / figure->size);
      }
    }
  }

  std::shared_ptr<assembly::BladeTables> tables_ = assembly::make_blade_tables();
  std::map<std::string, double> worst_;
  int motions_ = 0;
  int touching_ = 0;
};

TEST_P(Observables, AreThoseOfDenseSamplesOfTheMotion) {
  const auto [first, scenes] = GetParam();
  for (std::uint64_t number = first; number < first + scenes; ++number) {
    const std::uint64_t index = 3 * number + 2;  // rotors that rub
    settings::Scene scene = random_scene(index);
    for (const Method method : methods_of(scene)) {
      scene.accuracy.method = method;
      SCOPED_TRACE("random scene " + std::to_string(index) + " by method " +
                   (method == Method::hybrid ? "hybrid: " : "collocation: ") + random_scene_text(index));
      compare(scene);
    }
  }
  for (const auto& [name, worst] : worst_) RecordProperty(name, std::to_string(worst));
  // Scenes that never touch, or never end as done, would compare nothing.
  EXPECT_GT(motions_, static_cast<int>(scenes) / 4);
  EXPECT_GT(touching_, static_cast<int>(scenes) / 4);
}

std::vector<ObservedScenes> observed_scenes(std::uint64_t shards, std::uint64_t scenes) {
  std::vector<ObservedScenes> all;
  for (std::uint64_t i = 0; i < shards; ++i) all.push_back({i * scenes, scenes});
  return all;
}

INSTANTIATE_TEST_SUITE_P(First, Observables, ::testing::ValuesIn(observed_scenes(4, 10)));
INSTANTIATE_TEST_SUITE_P(Slow, Observables, ::testing::ValuesIn(observed_scenes(10, 50)));

}  // namespace
}  // namespace rubatlas::test
