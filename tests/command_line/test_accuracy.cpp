// `accuracy`: what is in the study, that it repeats, that it agrees with `run` and `analyse`, what is
// refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "atlas/atlas_reader.hpp"
#include "program.hpp"

namespace rubatlas::mpi {
namespace {

/// Two periodic speeds and a chaotic one. Whatever the scene says the study runs all revolutions, as `never`
/// does.
const std::string kScene = R"({"title": "three speeds", "grid": {"speed_ratio": [0.3, 0.4, 0.75]},
  "protocol": {"transient_revolutions": 40, "sampled_revolutions": 40, "settle": "never"}, "sweep": ")";
constexpr std::size_t kPoints = 3;
constexpr double kRevolutions = 80.0;

class Accuracy : public testing::Test {
 protected:
  void SetUp() override { static_cast<void>(place.write("s.json", kScene + "independent\"}")); }

  atlas::File study(const std::string& options, const std::string& scene = "s.json") const {
    const auto ending =
        place.rubatlas("accuracy " + scene + " -o a.h5 --overwrite --progress off " + options);
    EXPECT_EQ(ending.code, 0) << ending.messages;
    EXPECT_EQ(ending.output + ending.messages, "");
    return atlas::File::open_to_read(place.path("a.h5"));
  }
  std::string refused(const std::string& arguments) const {
    const auto ending = place.rubatlas("accuracy " + arguments);
    EXPECT_EQ(ending.code, 2) << arguments;
    return ending.messages;
  }
  Workplace place;
};

std::vector<double> numbers(const atlas::File& file, const std::string& name) {
  return file.dataset(name).read<double>();
}

TEST_F(Accuracy, KeepsErrorTimeAndWorkOfEverySettingAtEveryPoint) {
  const auto file = study("--methods hybrid --tolerances 1e-7,1e-8 --repeats 2");
  EXPECT_EQ(file.read_texts("/method"), (std::vector<std::string>{"hybrid", "hybrid", "hybrid"}));
  EXPECT_EQ(numbers(file, "/tolerance"), (std::vector<double>{1e-9, 1e-7, 1e-8})) << "the reference first";
  for (const std::string name :
       {"trajectory_error", "cpu_time_min", "cpu_time_median", "right_hand_sides", "elastica_evaluations",
        "steps", "rejected_steps", "touchdowns", "status", "class"}) {
    EXPECT_EQ(file.dataset(name).shape(), (atlas::Shape{3, 1, 1, 1, 1, kPoints})) << name;
    EXPECT_EQ(file.dataset(name).scale_name(0), "setting") << name;
    EXPECT_EQ(file.dataset(name).scale_name(5), "speed_ratio") << name;
    EXPECT_FALSE(file.dataset(name).text("long_name").empty()) << name;
  }
  EXPECT_EQ(file.dataset("first_sections").shape(), (atlas::Shape{3, 1, 1, 1, 1, kPoints, 10, 4}));
  EXPECT_EQ(file.dataset("last_sections").shape(), (atlas::Shape{3, 1, 1, 1, 1, kPoints, 11, 4}));
  EXPECT_EQ(file.dataset("last_section").read<std::int32_t>().back(), 80);
  const auto least = numbers(file, "/cpu_time_min");
  const auto median = numbers(file, "/cpu_time_median");
  for (std::size_t i = 0; i < least.size(); ++i) {
    EXPECT_GT(least[i], 0.0);
    EXPECT_LE(least[i], median[i]);
  }
}

TEST_F(Accuracy, ErrorsAreThoseOfTheMotionAsFarAsItCanBePredicted) {
  const auto file = study("--methods hybrid --tolerances 1e-8,1e-10,1e-12 --repeats 1");
  const auto horizon = numbers(file, "/horizon");
  EXPECT_EQ(horizon[0], kRevolutions) << "periodic at 0.30";
  EXPECT_EQ(horizon[1], kRevolutions) << "periodic at 0.40";
  // Two nearby motions part by a factor of exp(0.4) in each revolution at 0.75, on average.
  EXPECT_GE(horizon[2], 1.0);
  EXPECT_LE(horizon[2], 20.0);
  const auto error = numbers(file, "/trajectory_error");
  const auto tolerance = numbers(file, "/tolerance");
  for (std::size_t setting = 0; setting < tolerance.size(); ++setting) {
    for (std::size_t point = 0; point < 2; ++point) {
      const double found = error[setting * kPoints + point];
      EXPECT_LE(found, 100.0 * tolerance[setting]) << "setting " << setting << " point " << point;
      EXPECT_EQ(found == 0.0, setting == 0) << "only the reference itself has none";
    }
    EXPECT_TRUE(std::isfinite(error[setting * kPoints + 2]));
  }
  EXPECT_GT(error[kPoints + 2], error[2 * kPoints + 2]);
  EXPECT_GT(error[2 * kPoints + 2], error[3 * kPoints + 2]);
}

TEST_F(Accuracy, AllButTheTimesIsTheSameEachTime) {
  const std::string options = "--methods hybrid --tolerances 1e-7,1e-8 --repeats 1";
  const auto contents = [&] {
    const auto file = study(options);
    std::vector<std::pair<std::string, std::vector<double>>> all;
    for (const auto& name : file.names()) {
      if (name.starts_with("scene") || name == "component" || name == "method" ||
          name.starts_with("cpu_time"))
        continue;
      auto values = numbers(file, name);
      // A knob that is not read is NaN, which equals nothing.
      std::replace_if(
          values.begin(), values.end(), [](double value) { return std::isnan(value); }, -1e300);
      all.emplace_back(name, values);
    }
    return all;
  };
  const auto once = contents();
  EXPECT_GT(once.size(), 20U);
  EXPECT_EQ(once, contents());
}

TEST_F(Accuracy, AMapIsTheOneThatRunAndAnalyseMake) {
  static_cast<void>(place.write("run.json", kScene + R"(independent", "accuracy": {"tolerance": 1e-7}})"));
  ASSERT_EQ(place.rubatlas("run run.json -o run.h5 --progress off").code, 0);
  ASSERT_EQ(place.rubatlas("analyse run.h5 -o maps.h5").code, 0);
  const auto file = study("--methods collocation --tolerances 1e-7 --repeats 1");
  const auto classes = numbers(file, "/class");
  const auto displacement = numbers(file, "/max_displacement");
  const std::vector<double> of_run(classes.begin() + kPoints, classes.end());
  EXPECT_EQ(of_run, numbers(atlas::File::open_to_read(place.path("maps.h5")), "/class"));
  EXPECT_EQ(of_run[0], 4.0) << "period 4 at 0.30";
  EXPECT_EQ(of_run[2], 255.0) << "chaos";
  EXPECT_EQ((std::vector<double>(displacement.begin() + kPoints, displacement.end())),
            numbers(atlas::File::open_to_read(place.path("run.h5")), "/max_displacement"));
}

TEST_F(Accuracy, PointsStartWhereTheSweepOfTheReferenceHasComeWithBladesAsWorn) {
  const std::string wear = R"(, "wear": {"rate": 1e-6, "carries_over": true})";
  for (const std::string& effect : {std::string(), wear}) {
    static_cast<void>(place.write("down.json", kScene + "down\"" + effect + "}"));
    static_cast<void>(place.write(
        "run.json", kScene + R"(down", "accuracy": {"method": "hybrid", "tolerance": 1e-8})" + effect + "}"));
    ASSERT_EQ(place.rubatlas("run run.json -o run.h5 --overwrite --progress off").code, 0);
    const auto start =
        numbers(study("--methods hybrid --tolerances 1e-7 --repeats 1", "down.json"), "/start");
    const auto final = numbers(atlas::File::open_to_read(place.path("run.h5")), "/final_state");
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(start[2 * 4 + i], 0.0) << "the highest speed begins at rest";
      EXPECT_EQ(start[4 + i], final[2 * 4 + i]);
      EXPECT_EQ(start[i], final[4 + i]);
    }
  }
}

TEST_F(Accuracy, AMotionThatLeavesTheModelIsAResultThatIsCounted) {
  // From rest the default rotor always leaves between 1.05 and 1.24 (MODEL 5).
  static_cast<void>(
      place.write("far.json", R"({"grid": {"speed_ratio": [0.3, 1.15]}, "sweep": "independent"})"));
  const auto ending = place.rubatlas(
      "accuracy far.json -o a.h5 --methods hybrid --tolerances 1e-6 --repeats 1 --progress plain");
  EXPECT_EQ(ending.code, 0);
  EXPECT_NE(ending.messages.find("4 of 4 points: 2 done, 2 outside the model, 0 failed"), std::string::npos)
      << ending.messages;
  const auto file = atlas::File::open_to_read(place.path("a.h5"));
  EXPECT_EQ(numbers(file, "/status"), (std::vector<double>{1.0, 2.0, 1.0, 2.0}));
  EXPECT_TRUE(std::isnan(numbers(file, "/trajectory_error")[1]));
  EXPECT_EQ(numbers(file, "/horizon")[1], 0.0);
}

TEST_F(Accuracy, WhatCannotBeStudiedIsRefusedInOneSentenceBeforeAnyFile) {
  EXPECT_NE(refused("s.json -o a.h5 --methods hybird").find("--methods hybird: not one of hybrid"),
            std::string::npos);
  EXPECT_EQ(
      refused("s.json -o a.h5 --tolerances 1e-6,0.1"),
      "rubatlas: --tolerances 0.1: outside [1e-14, 0.01]; largest local error of a step, relative to the "
      "clearance\n");
  EXPECT_EQ(refused("s.json -o a.h5 --tolerances 1e-14"),
            "rubatlas: --tolerances 1e-14: below 1e-13; the reference run is 10 times tighter\n");
  EXPECT_EQ(refused("s.json -o a.h5 --repeats 0"),
            "rubatlas: --repeats: 0 is no whole number from 1 to 1000; rubatlas accuracy --help shows what "
            "is possible\n");
  EXPECT_EQ(refused("s.json -o s.json --overwrite"),
            "rubatlas: s.json and s.json are the same file, and a study of accuracy would replace it\n");
  EXPECT_NE(refused("s.json -o a.h5 --progress barr").find("nearest: bar"), std::string::npos);
  EXPECT_FALSE(place.has("a.h5"));
  static_cast<void>(place.write("a.h5", "mine"));
  EXPECT_EQ(refused("s.json -o a.h5"), "rubatlas: a.h5 exists; --overwrite replaces it\n");
  EXPECT_EQ(place.read("a.h5"), "mine");
}

}  // namespace
}  // namespace rubatlas::mpi
