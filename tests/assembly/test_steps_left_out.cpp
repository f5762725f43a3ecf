// The default method without phases in steps: the same bytes wherever arcs end their contacts by themselves.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "assembly/blade_tables.hpp"
#include "assembly/methods.hpp"
#include "motion/point_start.hpp"
#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"
#include "point/line_solver.hpp"
#include "settings/combinations.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::test {
namespace {

std::unique_ptr<modes::Phase> no_phase(modes::Form /*form*/, const modes::ContactSetup& /*setup*/) {
  return nullptr;
}

/// First and last line of a scene, thinned out.
std::vector<settings::Scene> lines_of(settings::Scene scene) {
  scene.protocol.transient_revolutions = 30;
  scene.protocol.sampled_revolutions = 10;
  scene.observables = {"poincare"};
  const plan::Grid grid(scene);
  std::vector<settings::Scene> lines;
  for (const std::size_t line : {std::size_t{0}, grid.line_count() - 1})
    lines.push_back(plan::scene_of_line(scene, grid.parameters(grid.point(line, 0))));
  return lines;
}

TEST(StepsLeftOut, ChangeNothingInTheShippedScenes) {
  constexpr std::size_t kSpeeds = 4;
  assembly::BladeTables tables;
  int points = 0;
  for (const auto& file : std::filesystem::directory_iterator(RUBATLAS_SOURCE_DIR "/jobs")) {
    if (file.path().extension() != ".json") continue;
    SCOPED_TRACE(file.path());
    const settings::Scene scene = settings::parse_scene(settings::read_text(file.path().string()));
    if (scene.accuracy.method != settings::Method::collocation) continue;
    for (const settings::Scene& line : lines_of(scene)) {
      const assembly::LineRequest request{line, tables, settings::combination_of(line)};
      const auto& speeds = scene.grid.speed_ratio;
      for (std::size_t i = 0; i < kSpeeds; ++i) {
        const double speed_ratio = speeds[i * (speeds.size() - 1) / (kSpeeds - 1)];
        const auto with = assembly::hybrid_solver(request)->run(speed_ratio, motion::PointStart{});
        const auto without =
            assembly::hybrid_solver(request, no_phase)->run(speed_ratio, motion::PointStart{});
        EXPECT_EQ(with.detail, without.detail) << "speed ratio " << speed_ratio;
        EXPECT_EQ(with.failed_revolution, without.failed_revolution) << "speed ratio " << speed_ratio;
        // Of a point that has failed they are not a number.
        if (with.detail == ending::StatusDetail::none) {
          EXPECT_EQ(with.rows, without.rows) << "speed ratio " << speed_ratio;
        }
        ++points;
      }
    }
  }
  EXPECT_GT(points, 300);
}

}  // namespace
}  // namespace rubatlas::test
