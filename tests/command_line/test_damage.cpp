// Bytes of an atlas that are not what was written. The commands are called within this process, what they say
// is what the program would say: a hundred damaged files take as long as some starts of the program.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstddef>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <string_view>

#include "analysis/analyse.hpp"
#include "mpi/commands/command_line.hpp"
#include "mpi/commands/preparation.hpp"
#include "mpi/commands/run.hpp"
#include "mpi/commands/verify_command.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/failure.hpp"
#include "mpi/version.hpp"
#include "program.hpp"

namespace rubatlas::mpi {
namespace {

struct Said {
  int code = 0;
  std::string text;  ///< on standard error, paths without their folder
};

std::string without(std::string text, const std::string& part) {
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at))
    text.erase(at, part.size());
  return text;
}

/// A command of the program, as `main` carries it out.
Said carried_out(const Workplace& place, const std::function<int()>& command) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Said said;
  try {
    said.code = command();
  } catch (...) {
    said.code = report_failure(std::current_exception());
  }
  static_cast<void>(testing::internal::GetCapturedStdout());
  said.text = without(testing::internal::GetCapturedStderr(), place.path("").string());
  return said;
}

/// One sentence that names the file and nothing of the library or of our sources.
void expect_one_sentence(const Said& said, const std::string& name) {
  EXPECT_EQ(said.code, exit_code::kEnvironment) << said.text;
  EXPECT_TRUE(said.text.starts_with("rubatlas: ") && said.text.find(name) != std::string::npos) << said.text;
  EXPECT_EQ(said.text.find('\n'), said.text.size() - 1) << said.text;
  for (const std::string_view internal : {"HDF5", "H5", "src/", ".cpp", "errno"}) {
    EXPECT_EQ(without(said.text, ".h5").find(internal), std::string::npos) << said.text;
  }
}

/// So many copies of an atlas, in which bytes are changed.
void expect_random_damage_found(int trials) {
  const Workplace place;
  static_cast<void>(
      place.write("scene.json", R"({"grid": {"speed_ratio": {"from": 0.2, "to": 0.9, "count": 12},
    "damping_ratio": [0.1, 0.15, 0.2]}, "spectrum": {"max_order": 4}, "protocol": {"transient_revolutions": 10,
    "sampled_revolutions": 8, "samples_per_revolution": 32}})"));
  ASSERT_EQ(place.rubatlas("run scene.json -o atlas.h5 --progress off").code, 0);
  const std::string whole = place.read("atlas.h5");

  // A point may become pending, which is no damage; and nobody looks at HDF5's flags of open files.
  const std::string statuses(36, '\x01');
  const std::size_t begin = whole.find(statuses);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_EQ(whole.find(statuses, begin + 1), std::string::npos);
  std::set<std::size_t> harmless{20, 21, 22, 23};
  for (std::size_t i = 0; i < statuses.size(); ++i) harmless.insert(begin + i);

  std::mt19937 random(3);
  std::uniform_int_distribution<std::size_t> anywhere(0, whole.size() - 1);
  std::uniform_int_distribution<int> change(1, 255);
  int accepted = 0;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(trial);
    std::string bytes = whole;
    for (int left = trial % 3 == 0 ? 8 : 1; left > 0; --left) {
      std::size_t at = anywhere(random);
      while (harmless.contains(at)) at = anywhere(random);
      bytes[at] =
          static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ static_cast<unsigned>(change(random)));
    }
    if (bytes == whole) continue;  // the same byte twice
    const std::string name = "bad" + std::to_string(trial) + ".h5";
    const auto atlas = place.path(name);
    static_cast<void>(place.write(name, bytes));

    RunOptions options;
    options.scene = place.path("scene.json");
    options.atlas = atlas;
    options.resume = true;
    const Said resumed = carried_out(place, [&] {
      static_cast<void>(prepare(options, software()));
      return exit_code::kDone;
    });
    expect_one_sentence(resumed, name);
    const Said verified = carried_out(place, [&] { return verify({.atlas = atlas, .recompute = 0}); });
    EXPECT_EQ(verified.code, exit_code::kEnvironment) << verified.text;
    EXPECT_TRUE(verified.text.starts_with("rubatlas: ")) << verified.text;
    const Said analysed = carried_out(place, [&] {
      analysis::analyse(atlas, place.path("maps" + std::to_string(trial) + ".h5"), std::nullopt, false);
      return exit_code::kDone;
    });
    if (analysed.code == exit_code::kDone) {
      ++accepted;
    } else {
      expect_one_sentence(analysed, name);
    }
    EXPECT_EQ(place.read(name), bytes) << "nobody has written into it";
  }
  EXPECT_LT(accepted, trials) << "rows at least are looked at";
  // A length that is damaged lets HDF5 ask for any number of bytes, in the process that looks first.
  rusage looked{};
  ASSERT_EQ(::getrusage(RUSAGE_CHILDREN, &looked), 0);
  EXPECT_LT(looked.ru_maxrss, 1'500'000) << "kB";
}

TEST(Damage, RandomBytesAreFoundWhereverTheyAre) {
  expect_random_damage_found(30);
}
TEST(DamageSlow, RandomBytesAreFoundWhereverTheyAre) {
  expect_random_damage_found(300);
}

}  // namespace
}  // namespace rubatlas::mpi
