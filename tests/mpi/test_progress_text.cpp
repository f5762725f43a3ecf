#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mpi/job/progress.hpp"
#include "mpi/job/run_record.hpp"

namespace rubatlas::mpi {
namespace {

TEST(ProgressText, DurationsAreReadAtAGlance) {
  EXPECT_EQ(readable_duration(0.04), "0.0 s");
  EXPECT_EQ(readable_duration(59.9), "59.9 s");
  EXPECT_EQ(readable_duration(59.96), "1 min 00 s");
  EXPECT_EQ(readable_duration(3599.0), "59 min 59 s");
  EXPECT_EQ(readable_duration(3661.0), "1 h 01 min");
}

TEST(ProgressText, TheBarShowsPointsRateTimeLeftAndFailures) {
  const Standing standing{.total = 200,
                          .finished = 50,
                          .outside = 2,
                          .failed = 3,
                          .computed = 50,
                          .seconds = 10.0,
                          .seconds_left = 90.0};
  EXPECT_EQ(
      bar_line(standing, 100),
      "[##########..............................]  50/200 points  5/s  ETA 1 min 30 s  2 outside  3 failed");
}

TEST(ProgressText, TheBarGivesWayToTheNumbersAndTheNumbersToTheWidth) {
  const Standing standing{.total = 200, .finished = 50, .failed = 0, .computed = 50, .seconds = 10.0};
  EXPECT_EQ(bar_line(standing, 35), "[###..........]  50/200 points  5/s");
  for (std::size_t width = 0; width < 120; ++width) EXPECT_LE(bar_line(standing, width).size(), width);
  EXPECT_EQ(bar_line(standing, 10), "50/200 poi");
}

TEST(ProgressText, AResumedJobCountsWhatIsThereButNotInItsRate) {
  const Standing standing{
      .total = 200, .finished = 150, .outside = 30, .failed = 2, .computed = 50, .seconds = 10.0};
  EXPECT_EQ(plain_line(standing), " 75 %  150/200 points  5/s  30 outside  2 failed");
  EXPECT_EQ(summary_line(standing),
            "150 of 200 points: 118 done, 30 outside the model, 2 failed; 50 computed in 10.0 s, 5 points/s");
}

TEST(ProgressText, TheRateOfAFastJobIsReadAtAGlance) {
  const Standing standing{.total = 5460, .finished = 5460, .failed = 0, .computed = 5460, .seconds = 5.0};
  EXPECT_EQ(
      summary_line(standing),
      "5460 of 5460 points: 5460 done, 0 outside the model, 0 failed; 5460 computed in 5.0 s, 1092 points/s");
}

TEST(ExitCode, PointsOutsideTheModelAreAResultAndFailedOnesAreNot) {
  constexpr std::uint8_t kPending = 0;
  constexpr std::uint8_t kDone = 1;
  constexpr std::uint8_t kOutside = 2;
  constexpr std::uint8_t kFailed = 3;
  const auto ends_with = [](const std::vector<std::uint8_t>& status) {
    return exit_code_of(standing_of(status));
  };
  EXPECT_EQ(ends_with({kDone, kDone}), 0);
  EXPECT_EQ(ends_with({kDone, kOutside}), 0);
  EXPECT_EQ(ends_with({kOutside, kOutside}), 0);
  EXPECT_EQ(ends_with({kDone, kFailed, kOutside}), 10);
  EXPECT_EQ(ends_with({kFailed}), 10);
  EXPECT_EQ(ends_with({kFailed, kPending}), 75) << "an atlas that is not complete is to be resumed";
}

TEST(ProgressText, AJobIsNotCalledCompleteBeforeItsLastPoint) {
  EXPECT_EQ(plain_line({.total = 1000, .finished = 999}).substr(0, 5), " 99 %");
}

TEST(RunRecord, KeepsWhateverAHostIsCalled) {
  const auto directory = std::filesystem::path(testing::TempDir()) / "rubatlas_run_record";
  std::filesystem::create_directories(directory);
  const auto atlas = directory / "atlas.h5";
  const std::string quoted = "a \"name\" \\ Ω\nb\t";
  const std::string no_utf8 = "node\xff";
  RunRecord(record_output(atlas, {directory / "scene.json"}),
            {.started = {}, .part = {}, .hosts = {quoted, no_utf8}}, {})
      .update({});
  std::ifstream file(atlas.string() + ".run.json");
  const auto hosts = nlohmann::json::parse(file).at("runs").at(0).at("host_of_rank");
  EXPECT_EQ(hosts.at(0), quoted);
  EXPECT_EQ(hosts.at(1), "node\uFFFD") << "JSON holds UTF-8 alone: any other byte is replaced";
  std::filesystem::remove_all(directory);
}

}  // namespace
}  // namespace rubatlas::mpi
