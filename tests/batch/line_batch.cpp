// Points in a batch against the same points alone.
#include "batch/line_batch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "batch/contact_lanes.hpp"
#include "settings/reader.hpp"

namespace rubatlas::batch {
namespace {

/// Damping ratios of which the lowest leaves the model's validity at some speeds; with and without unbalance.
settings::Scene eight_lines() {
  return settings::parse_scene(R"({
    "grid": {"damping_ratio": [0.02, 0.05, 0.1, 0.2], "unbalance": [0.0, 1e-4],
             "speed_ratio": [0.3, 0.36, 0.5, 0.62, 0.9, 1.1]},
    "protocol": {"transient_revolutions": 12, "sampled_revolutions": 6, "samples_per_revolution": 32},
    "observables": ["poincare", "max_displacement", "spectrum", "max_contact_force", "max_root_strain"]
  })");
}

void expect_same(const point::PointOutcome& one, const point::PointOutcome& other) {
  EXPECT_EQ(one.status, other.status);
  EXPECT_EQ(one.failed_revolution, other.failed_revolution);
  EXPECT_EQ(std::memcmp(one.final_state.data(), other.final_state.data(), sizeof one.final_state), 0);
  EXPECT_EQ(std::memcmp(&one.work, &other.work, sizeof one.work), 0) << "the same work too";
  ASSERT_EQ(one.rows.size(), other.rows.size());
  for (std::size_t row = 0; row < one.rows.size(); ++row) {
    ASSERT_EQ(one.rows[row].size(), other.rows[row].size());
    EXPECT_EQ(
        std::memcmp(one.rows[row].data(), other.rows[row].data(), one.rows[row].size() * sizeof(double)), 0);
  }
}

/// All points of a grid from rest, on so many seats; by index.
class Played {
 public:
  Played(const settings::Scene& scene, const Width& width) : scene_(scene), grid_(scene_), width_(width) {
    outcomes.resize(grid_.point_count());
    solvers_.resize(static_cast<std::size_t>(width.seats));
    point_on_.resize(solvers_.size());
    batch = make_line_batch(width);
  }

  void play() {
    std::size_t next = 0;
    std::size_t ended = 0;
    for (std::size_t seat = 0; seat < solvers_.size() && next < outcomes.size(); ++seat) begin(seat, next++);
    while (ended < outcomes.size()) {
      Finished finished = batch->advance({});
      const auto seat = static_cast<std::size_t>(finished.seat);
      EXPECT_GT(finished.seconds, 0.0);
      revolutions += finished.outcome.work.revolutions;
      outcomes[point_on_[seat]] = std::move(finished.outcome);
      ++ended;
      if (next < outcomes.size()) begin(seat, next++);
    }
  }

  std::vector<point::PointOutcome> outcomes;
  std::size_t revolutions = 0;
  std::unique_ptr<LineBatch> batch;

 private:
  void begin(std::size_t seat, std::size_t point) {
    const auto parameters = grid_.parameters(point);
    solvers_[seat] = make_line_solver(width_, scene_, parameters, tables_);
    point_on_[seat] = point;
    batch->begin(static_cast<int>(seat), *solvers_[seat], parameters.speed_ratio, {});
  }

  settings::Scene scene_;
  plan::Grid grid_;
  Width width_;
  std::shared_ptr<assembly::BladeTables> tables_ = assembly::make_blade_tables();
  std::vector<std::unique_ptr<point::LineSolver>> solvers_;
  std::vector<std::size_t> point_on_;
};

TEST(LineBatch, EveryPointHasTheBitsThatItHasAlone) {
  const settings::Scene scene = eight_lines();
  const plan::Grid grid(scene);
  const auto tables = assembly::make_blade_tables();
  std::vector<point::PointOutcome> alone;
  std::size_t failed = 0;
  std::size_t revolutions = 0;
  for (std::size_t point = 0; point < grid.point_count(); ++point) {
    const auto parameters = grid.parameters(point);
    alone.push_back(assembly::make_line_solver(scene, parameters, tables)->run(parameters.speed_ratio, {}));
    revolutions += alone.back().work.revolutions;
    if (alone.back().status != point::PointStatus::done) ++failed;
  }
  EXPECT_GT(failed, 0U) << "some points leave the model, which hurts nobody else";
  EXPECT_LT(failed, alone.size());
  for (int seats = 1; seats <= width_of(scene).seats; ++seats) {
    SCOPED_TRACE(seats);
    Played played(scene, {seats, "asked for"});
    played.play();
    for (std::size_t i = 0; i < alone.size(); ++i) {
      SCOPED_TRACE(i);
      expect_same(alone[i], played.outcomes[i]);
    }
    EXPECT_EQ(played.revolutions, revolutions);
    const LaneCounts counts = played.batch->counts();
    EXPECT_EQ(counts.in_lanes > counts.batches, seats > 1) << "one seat has nobody to share with";
  }
}

TEST(LineBatch, AnElasticRingIsComputedLineByLine) {
  settings::Scene scene = eight_lines();
  scene.contact.law = settings::ContactLaw::elastic_ring;
  EXPECT_EQ(width_of(scene).seats, 1);
  EXPECT_FALSE(width_of(scene).reason.empty());
}

TEST(LineBatch, OtherLawsAndEffectsAreComputedLineByLine) {
  for (const auto* const more :
       {R"("contact": {"law": "beam_column"})", R"("gravity": {"acceleration": 0.01})",
        R"("load_direction": {"along_normal": true})"}) {
    const auto scene = settings::parse_scene(
        std::string(R"({"grid": {"speed_ratio": 0.5, "damping_ratio": [0.1, 0.2]}, )") + more + "}");
    EXPECT_EQ(width_of(scene).seats, 1) << more;
  }
}

TEST(LineBatch, LinesOnWhichAnEffectHasNoStrengthShareTheLanes) {
  const std::string plain = R"({"grid": {"speed_ratio": 0.5, "damping_ratio": [0.1, 0.2]})";
  const auto weightless = settings::parse_scene(plain + R"(, "gravity": {"acceleration": 0}})");
  EXPECT_EQ(width_of(weightless).seats, width_of(settings::parse_scene(plain + "}")).seats);
  EXPECT_EQ(width_of(weightless).reason, width_of(settings::parse_scene(plain + "}")).reason);
}

TEST(LineBatch, EffectsThatOnlyTheGridNamesAreComputedLineByLine) {
  const auto scene =
      settings::parse_scene(R"({"grid": {"speed_ratio": 0.5, "/gravity/acceleration": [0, 0.01]}})");
  EXPECT_EQ(width_of(scene).seats, 1);
}

TEST(LineBatch, OtherMethodsAreComputedLineByLine) {
  settings::Scene scene = eight_lines();
  scene.accuracy.method = settings::Method::hybrid_54;
  EXPECT_EQ(width_of(scene).seats, 1);
}

TEST(LineBatch, ABatchIsNoWiderThanAsked) {
  EXPECT_LE(width_of(eight_lines(), 2).seats, 2);
}

/// A solver that fails after some revolutions, as one out of memory would.
class Broken final : public point::LineSolver {
 public:
  point::PointOutcome run(double, const motion::PointStart&, const modes::GoOn& go_on) override {
    for (int i = 0; i < 3 && go_on; ++i) go_on();
    throw std::runtime_error("out of order");
  }
  point::Orbit orbit(double, const motion::PointStart&) override { return {}; }
};

TEST(LineBatch, WhatASolverThrowsReachesTheCallerWhoeverIsUnderWay) {
  const settings::Scene scene = eight_lines();
  const plan::Grid grid(scene);
  const auto tables = assembly::make_blade_tables();
  for (int seats = 1; seats <= width_of(scene).seats; ++seats) {
    SCOPED_TRACE(seats);
    const Width width{seats, "asked for"};
    std::vector<std::unique_ptr<point::LineSolver>> sound;
    Broken broken;
    const auto batch = make_line_batch(width);
    batch->begin(seats / 2, broken, 0.5, {});
    for (int seat = 0; seat < seats; ++seat) {
      if (seat == seats / 2) continue;
      sound.push_back(make_line_solver(width, scene, grid.parameters(6U * sound.size()), tables));
      batch->begin(seat, *sound.back(), 0.36, {});
    }
    EXPECT_THROW(batch->advance({}), std::runtime_error);
  }
}

TEST(LineBatch, APointMayBeginWhereverASeatIsFree) {
  const settings::Scene scene = eight_lines();
  const plan::Grid grid(scene);
  const Width width = width_of(scene);
  const auto tables = assembly::make_blade_tables();
  const auto first = make_line_solver(width, scene, grid.parameters(0), tables);
  const auto second = make_line_solver(width, scene, grid.parameters(6), tables);
  const auto batch = make_line_batch(width);
  batch->begin(0, *first, 0.36, {});
  int revolutions = 0;
  bool second_began = false;
  const auto begin_second = [&](int seat) {
    second_began = true;
    batch->begin(seat, *second, 0.5, {});
  };
  std::array<point::PointOutcome, 2> outcomes;
  for (std::size_t ended = 0; ended < 2; ++ended) {
    Finished finished = batch->advance([&] {
      if (++revolutions == 5 && width.seats > 1) begin_second(1);
      return true;
    });
    outcomes[width.seats > 1 ? static_cast<std::size_t>(finished.seat) : ended] = std::move(finished.outcome);
    if (!second_began) begin_second(0);
  }
  const auto alone = [&](std::size_t point, double speed_ratio) {
    return assembly::make_line_solver(scene, grid.parameters(point), tables)->run(speed_ratio, {});
  };
  expect_same(outcomes[0], alone(0, 0.36));
  expect_same(outcomes[1], alone(6, 0.5));
}

TEST(LineBatch, APointThatIsGivenUpIsPendingAndTheOthersGoOn) {
  const settings::Scene scene = eight_lines();
  const plan::Grid grid(scene);
  const Width width = width_of(scene);
  const auto tables = assembly::make_blade_tables();
  const auto first = make_line_solver(width, scene, grid.parameters(0), tables);
  const auto second = make_line_solver(width, scene, grid.parameters(6), tables);
  const auto batch = make_line_batch(width);
  batch->begin(0, *first, 0.36, {});
  if (width.seats > 1) batch->begin(1, *second, 0.5, {});
  int asked = 0;
  const Finished given_up = batch->advance([&] { return ++asked != 3; });
  EXPECT_EQ(given_up.outcome.status, point::PointStatus::pending);
  EXPECT_EQ(given_up.outcome.failed_revolution, -1);
  EXPECT_EQ(asked, 3);
  if (width.seats == 1) return;
  expect_same(batch->advance({}).outcome,
              assembly::make_line_solver(scene, grid.parameters(given_up.seat == 0 ? 6 : 0), tables)
                  ->run(given_up.seat == 0 ? 0.5 : 0.36, {}));
}

}  // namespace
}  // namespace rubatlas::batch
