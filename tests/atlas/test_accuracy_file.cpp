#include "atlas/accuracy_file.hpp"

#include <cmath>

#include "atlas/hdf5.hpp"
#include "plan/grid.hpp"
#include "scratch.hpp"

namespace rubatlas::atlas {
namespace {

const Software kSoftware{.software_version = "1", .git_commit = "none", .compiler = "none"};

/// Two settings at every point of the small scene; the last run of all has left the model.
class AccuracyFileLayout : public testing::Scratch {
 protected:
  AccuracyFileLayout() : points_(plan::Grid(testing::small_scene()).point_count()) {
    study_.settings = {{.method = "hybrid", .tolerance = 1e-10}, {.method = "fixed", .step = 0.01}};
    study_.points.resize(points_);
    study_.points[1].start.state = {1.0, 2.0, 3.0, 4.0};
    study_.points[1].horizon = 7;
    study_.changes.resize(2);
    study_.changes[1].any = 0.5;
    study_.horizon_tolerance = 1e-6;
    study_.runs.resize(2 * points_);
    for (std::size_t i = 0; i < study_.runs.size(); ++i) {
      auto& run = study_.runs[i];
      run.status = ending::PointStatus::done;
      run.work.right_hand_sides = 100 + i;
      run.trajectory_error = 1e-3 * static_cast<double>(i);
      run.first_sections = {{0.0, 1.0, 2.0, 3.0}, {4.0, 5.0, 6.0, 7.0}};
      run.last_sections = {{8.0, 9.0, 10.0, 11.0}};
    }
    auto& lost = study_.runs.back();
    lost = {};
    lost.status = ending::PointStatus::left_validity;
    lost.failed_revolution = 2;
  }

  void SetUp() override {
    Scratch::SetUp();
    write_accuracy(file("accuracy.h5"), testing::small_scene(), testing::kSmallScene, study_, kSoftware);
  }

  std::size_t points_;
  AccuracyStudy study_;
};

TEST_F(AccuracyFileLayout, SettingsComeFirstThenTheAxesOfTheGrid) {
  const File read = File::open_to_read(file("accuracy.h5"));
  const Dataset error = read.dataset("/trajectory_error");
  EXPECT_EQ(error.scale_name(0), "setting");
  const plan::Grid grid(testing::small_scene());
  for (std::size_t axis = 0; axis < grid.axes().size(); ++axis) {
    EXPECT_EQ(error.scale_name(axis + 1), grid.axes()[axis].name);
    EXPECT_EQ(error.shape()[axis + 1], grid.axes()[axis].values.size());
  }
  EXPECT_EQ(error.read<double>()[points_ + 1], study_.run(1, 1).trajectory_error);
  EXPECT_EQ(read.dataset("/right_hand_sides").read<std::int64_t>()[points_],
            100 + static_cast<std::int64_t>(points_));
  EXPECT_EQ(read.dataset("/start").read<double>()[5], 2.0);
  EXPECT_EQ(read.dataset("/horizon").read<std::int32_t>()[1], 7);
  EXPECT_EQ(read.dataset("/horizon").number("tolerance"), 1e-6);
  EXPECT_EQ(read.dataset("/map_error").read<double>(), (std::vector<double>{0.0, 0.5}));
}

TEST_F(AccuracyFileLayout, AKnobThatIsNotReadAndASectionThatIsNotThereAreNaN) {
  const File read = File::open_to_read(file("accuracy.h5"));
  EXPECT_EQ(read.read_texts("/method"), (std::vector<std::string>{"hybrid", "fixed"}));
  EXPECT_TRUE(std::isnan(read.dataset("/tolerance").read<double>()[1]));
  EXPECT_TRUE(std::isnan(read.dataset("/step").read<double>()[0]));
  EXPECT_EQ(read.dataset("/step").read<double>()[1], 0.01);
  const auto first = read.dataset("/first_sections").read<double>();
  EXPECT_EQ(first.size(), 2 * points_ * 2 * 4);
  EXPECT_EQ(first[7], 7.0);
  EXPECT_TRUE(std::isnan(first.back()));
  EXPECT_EQ(read.dataset("/status").read<std::uint8_t>().back(), 2);
  EXPECT_EQ(read.dataset("/failed_revolution").read<std::int32_t>().back(), 2);
}

TEST_F(AccuracyFileLayout, EveryDatasetSaysWhatItIsAndTimesThatTheyAreMeasured) {
  const File read = File::open_to_read(file("accuracy.h5"));
  for (const auto& name : read.names()) {
    EXPECT_FALSE(read.dataset(name).text("long_name").empty()) << name;
  }
  EXPECT_NE(read.dataset("/cpu_time_min").text("comment").find("measured"), std::string::npos);
  EXPECT_NE(read.root().text("comment").find("cpu_time_median"), std::string::npos);
  EXPECT_EQ(read.root().number("reference_setting"), 0.0);
  EXPECT_EQ(read.root().text("schema_version"), kSchemaVersion);
}

}  // namespace
}  // namespace rubatlas::atlas
