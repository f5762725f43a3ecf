/// A directory of its own for each test, gone when the test ends; and a small scene.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "atlas/software.hpp"
#include "settings/reader.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas::testing {

class Scratch : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = std::filesystem::path(::testing::TempDir()) /
                 (std::string("rubatlas_") + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return directory_ / name; }

  static std::string bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::filesystem::path directory_;
};

inline const Software kSoftware{.software_version = "1", .git_commit = "none", .compiler = "none"};

/// Two damping ratios, five speeds, three sampled revolutions, four observables.
inline const std::string kSmallScene = R"({
  "title": "small", "reference": "none",
  "grid": {"speed_ratio": {"from": 0.1, "to": 0.5, "count": 5}, "damping_ratio": [0.05, 0.2]},
  "protocol": {"transient_revolutions": 2, "sampled_revolutions": 3, "samples_per_revolution": 32},
  "observables": ["poincare", "poincare_blade_passing", "max_displacement", "spectrum"]})";

inline settings::Scene small_scene() {
  return settings::parse_scene(kSmallScene);
}

}  // namespace rubatlas::atlas::testing
