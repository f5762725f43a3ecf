/// The list of observables: names, shapes, axes, rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "observables/list.hpp"
#include "observables/recorder.hpp"
#include "settings/observable_names.hpp"
#include "synthetic_motion.hpp"

namespace rubatlas::observables {
namespace {

settings::Scene scene_with(const std::vector<std::string>& observables) {
  settings::Scene scene;
  scene.blades.count = 4;
  scene.protocol.transient_revolutions = 20;
  scene.protocol.sampled_revolutions = 5;
  scene.protocol.samples_per_revolution = 64;
  scene.spectrum.max_order = 16;
  scene.observables = observables;
  return scene;
}

std::vector<std::string> all_names() {
  const auto names = settings::observable_names();
  return {names.begin(), names.end()};
}

TEST(List, GivesEveryWordThatASceneMayUseItsMeaningInTheSameOrder) {
  std::vector<std::string> listed;
  for (const Description& description : descriptions(scene_with(all_names())))
    if (!description.name.starts_with("lyapunov_")) listed.push_back(description.name);
  EXPECT_EQ(listed, all_names());
}

TEST(List, HoldsOnlyWhatTheSceneAsksForInTheListsOrder) {
  std::vector<std::string> listed;
  for (const Description& description :
       descriptions(scene_with({"contact_fraction", "spectrum", "poincare"}))) {
    listed.push_back(description.name);
  }
  EXPECT_EQ(listed, (std::vector<std::string>{"poincare", "spectrum", "contact_fraction"}));
  EXPECT_TRUE(descriptions(scene_with({})).empty());
}

TEST(List, RowSizesAreTheProductsOfTheirAxes) {
  const settings::Scene scene = scene_with(all_names());
  const auto axes = inner_axes(scene);
  for (const Description& description : descriptions(scene)) {
    std::size_t product = 1;
    for (const std::string& name : description.inner_axes) {
      const auto axis =
          std::find_if(axes.begin(), axes.end(), [&](const InnerAxis& a) { return a.name == name; });
      ASSERT_NE(axis, axes.end()) << name;
      product *= axis->size();
    }
    EXPECT_EQ(description.row_size, product) << description.name;
    EXPECT_EQ(description.units.empty(), !description.flags.empty()) << description.name;
    EXPECT_FALSE(description.long_name.empty()) << description.name;
  }
}

TEST(List, AxesCountFromTheStartOfThePoint) {
  const auto axes = inner_axes(scene_with(all_names()));
  const auto axis = [&](const std::string& name) {
    return *std::find_if(axes.begin(), axes.end(), [&](const InnerAxis& a) { return a.name == name; });
  };
  EXPECT_EQ(axes.size(), 7U) << "each once";
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(axis("section").values),
            (std::vector<std::int32_t>{21, 22, 23, 24, 25}));
  const auto passings = std::get<std::vector<std::int32_t>>(axis("passing").values);
  ASSERT_EQ(passings.size(), 20U);
  EXPECT_EQ(passings.front(), 81);
  EXPECT_EQ(passings.back(), 100) << "the last passing is the last section";
  EXPECT_EQ(std::get<std::vector<std::string>>(axis("component").values),
            (std::vector<std::string>{"x", "y", "vx", "vy"}));
  const auto orders = std::get<std::vector<double>>(axis("order").values);
  ASSERT_EQ(orders.size(), 81U);
  EXPECT_EQ(orders.front(), 0.0);
  EXPECT_EQ(orders[1], 0.2);
  EXPECT_EQ(orders.back(), 16.0);
}

TEST(List, ComponentsAreAlwaysThereForTheFinalState) {
  const auto axes = inner_axes(scene_with({"max_displacement"}));
  ASSERT_EQ(axes.size(), 1U);
  EXPECT_EQ(axes[0].name, "component");
}

TEST(Recorder, RowsAreThoseOfTheDescriptionsAndFilledByTheMotion) {
  const settings::Scene scene = scene_with(all_names());
  const trajectory::PointConstants point = point_at(0.5, scene.blades.count);
  Recorder recorder(scene);
  recorder.begin(point);
  const auto motion = [](double time) {
    return trajectory::State{2e-3 * std::cos(0.5 * time), 0, -1e-3 * std::sin(0.5 * time), 0};
  };
  for (int r = 0; r < scene.protocol.sampled_revolutions; ++r) {
    SyntheticPiece flight(0.0, 0.75 * point.period, motion);
    SyntheticPiece contact(0.75 * point.period, point.period, motion,
                           {{0, [](double) { return 12.0; }, [](double) { return 1e-4; }}});
    recorder.piece(flight);
    recorder.touch_down(0);
    recorder.piece(contact);
    recorder.revolution_ends(motion(point.period));
  }
  const Rows rows = recorder.rows(true);
  const auto list = descriptions(scene);
  ASSERT_EQ(rows.size(), list.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].size(), list[i].row_size) << list[i].name;
    // No tip comes near the ring here, and the contact does not end.
    const bool absent = list[i].name == "nearest_miss" || list[i].name == "lightest_touch" ||
                        list[i].name.starts_with("lyapunov");
    for (const double value : rows[i]) EXPECT_EQ(std::isfinite(value), !absent) << list[i].name;
  }
  const auto row = [&](const std::string& name) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Description& d) { return d.name == name; });
    return rows[static_cast<std::size_t>(found - list.begin())];
  };
  EXPECT_NEAR(row("max_displacement")[0], 2e-3, 1e-17);
  EXPECT_NEAR(row("spectrum")[5], 2e-3, 1e-16);
  EXPECT_EQ(row("touchdowns_per_revolution")[0], 1.0);
  EXPECT_EQ(row("max_contact_force")[0], 12.0);
  EXPECT_NEAR(row("contact_fraction")[0], 0.25, 1e-15);
  EXPECT_EQ(row("max_root_strain")[0], 1e-4);
}

TEST(Recorder, RowsOfAPointThatDidNotEndAreNotNumbers) {
  const settings::Scene scene = scene_with(all_names());
  Recorder recorder(scene);
  recorder.begin(point_at(0.5, scene.blades.count));
  recorder.touch_down(0);
  for (const auto& row : recorder.rows(false)) {
    for (const double value : row) EXPECT_TRUE(std::isnan(value));
  }
}

}  // namespace
}  // namespace rubatlas::observables
