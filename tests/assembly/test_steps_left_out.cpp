// The default method without phases in steps: the same bytes wherever arcs end their contacts by themselves.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>

#include <nlohmann/json.hpp>

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

/// A line's sweep up through all its speeds, each from where the one before has ended.
std::size_t swept_without_steps(const settings::Scene& line, assembly::BladeTables& tables) {
  const assembly::LineRequest request{line, tables, settings::combination_of(line)};
  motion::PointStart start;
  for (const double speed_ratio : line.grid.speed_ratio) {
    const auto with = assembly::hybrid_solver(request)->run(speed_ratio, start);
    const auto without = assembly::hybrid_solver(request, no_phase)->run(speed_ratio, start);
    EXPECT_EQ(with.detail, without.detail) << "speed ratio " << speed_ratio;
    EXPECT_EQ(with.failed_revolution, without.failed_revolution) << "speed ratio " << speed_ratio;
    const bool done = with.detail == ending::StatusDetail::none;
    // Of a point that has failed they are not a number.
    if (done) {
      EXPECT_EQ(with.rows, without.rows) << "speed ratio " << speed_ratio;
    }
    start = done ? motion::PointStart{with.final_state, with.final_memory} : motion::PointStart{};
  }
  return line.grid.speed_ratio.size();
}

TEST(StepsLeftOut, ChangeNothingWhereTipsSkimAndRestOnALightRing) {
  // An overdamped rotor that creeps, whose tips skim, and a ring of two grams that bounces, on which a tip
  // skims beside another blade, and rests as a stiff strut between hub and ring.
  const nlohmann::json creeping = {{"rotor", {{"damping_ratio", 1.0}}},
                                   {"unbalance", {{"moment", 1e-4}}},
                                   {"grid", {{"speed_ratio", 0.005}}}};
  const nlohmann::json bouncing = {
      {"ring_body", {{"mass", 1.718e-3}, {"compliance", 1.72e-3}, {"damping", 3.822}}},
      {"contact", {{"friction", 0.1297}}},
      {"initial", {{"x", -5.234e-3}, {"y", 3.763e-3}, {"vx", 0.04395}, {"vy", -0.02827}}},
      {"grid", {{"speed_ratio", 0.3016}}}};
  assembly::BladeTables tables;
  for (nlohmann::json document : {creeping, bouncing}) {
    document["protocol"] = {{"transient_revolutions", 0}, {"sampled_revolutions", 1}};
    const settings::Scene scene = settings::parse_scene(document.dump());
    const assembly::LineRequest request{scene, tables, settings::combination_of(scene)};
    const motion::PointStart start{{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy}};
    const auto with = assembly::hybrid_solver(request)->run(scene.grid.speed_ratio.front(), start);
    const auto without =
        assembly::hybrid_solver(request, no_phase)->run(scene.grid.speed_ratio.front(), start);
    EXPECT_EQ(with.detail, ending::StatusDetail::none);
    EXPECT_EQ(without.detail, ending::StatusDetail::none);
    EXPECT_EQ(with.final_state, without.final_state);
    EXPECT_GT(without.work.touchdowns, 100U);
  }
}

TEST(StepsLeftOut, ChangeNothingInSweepsOfTheTestRig) {
  // Its soft blades often touch two at a time: with the jumps that sweeps leave at the start of an interval
  // 14 of these points needed steps.
  assembly::BladeTables tables;
  settings::Scene scene = settings::parse_scene(settings::read_text(RUBATLAS_SOURCE_DIR "/jobs/rig.json"));
  scene.protocol.transient_revolutions = 60;
  scene.protocol.sampled_revolutions = 20;
  scene.observables = {"poincare"};
  const plan::Grid grid(scene);
  std::size_t points = 0;
  for (std::size_t number = 0; number < grid.line_count(); ++number) {
    settings::Scene line = plan::scene_of_line(scene, grid.parameters(grid.point(number, 0)));
    line.grid.speed_ratio = scene.grid.speed_ratio;
    points += swept_without_steps(line, tables);
  }
  EXPECT_GT(points, 100U);
}

}  // namespace
}  // namespace rubatlas::test
