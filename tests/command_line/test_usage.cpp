// The program as its user meets it: texts, exit codes, and who says them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "program.hpp"

namespace rubatlas::mpi {
namespace {

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(CommandLine, HelpNamesEveryCommandAndEndsWellOnStandardOutput) {
  const auto ending = Workplace().rubatlas("--help");
  EXPECT_EQ(ending.code, 0);
  EXPECT_EQ(ending.messages, "");
  for (const std::string command : {"run", "status", "explain", "orbit", "analyse", "accuracy", "verify"}) {
    EXPECT_NE(ending.output.find("\n  " + command + " "), std::string::npos) << command;
  }
  EXPECT_NE(ending.output.find("Exit codes: 0 done,"), std::string::npos);
}

TEST(CommandLine, EveryCommandHasItsOwnHelp) {
  const Workplace place;
  for (const std::string command : {"run", "status", "explain", "orbit", "analyse", "accuracy", "verify"}) {
    const auto ending = place.rubatlas(command + " --help");
    EXPECT_EQ(ending.code, 0) << command;
    EXPECT_NE(ending.output.find("Usage: rubatlas " + command), std::string::npos) << ending.output;
  }
}

TEST(CommandLine, VersionNamesCommitCompilerAndLibraries) {
  const auto ending = Workplace().rubatlas("--version");
  EXPECT_EQ(ending.code, 0);
  EXPECT_TRUE(ending.output.starts_with("rubatlas "));
  for (const std::string part : {"\ncommit    ", "\ncompiler  ", "HDF5 ", "MPI ", "FFTW ", "Eigen "}) {
    EXPECT_NE(ending.output.find(part), std::string::npos) << part;
  }
}

TEST(CommandLine, AWrongCallIsOneSentenceAndExitCodeTwo) {
  const Workplace place;
  const auto says = [&](const std::string& arguments) {
    const auto ending = place.rubatlas(arguments);
    EXPECT_EQ(ending.code, 2) << arguments;
    EXPECT_EQ(ending.output, "") << arguments;
    return ending.messages;
  };
  EXPECT_EQ(says(""),
            "rubatlas: no command; commands are run, status, explain, orbit, branch, analyse, edges, "
            "accuracy, verify, merge, pack; rubatlas --help shows what is possible\n");
  EXPECT_EQ(says("rnu s.json"),
            "rubatlas: unknown command rnu; commands are run, status, explain, orbit, branch, analyse, "
            "edges, accuracy, verify, merge, pack; nearest: run\n");
  EXPECT_EQ(says("run s.json"),
            "rubatlas: --output is required; rubatlas run --help shows what is possible\n");
  EXPECT_EQ(says("run -o a.h5"), "rubatlas: SCENE is required; rubatlas run --help shows what is possible\n");
  EXPECT_EQ(says("run s.json -o a.h5 --progress barr"),
            "rubatlas: --progress barr: not one of auto, bar, plain, off; nearest: bar\n");
  EXPECT_NE(says("run s.json -o a.h5 --resume --overwrite").find("--resume"), std::string::npos);
  EXPECT_NE(says("run s.json -o a.h5 --resmue").find("--resmue"), std::string::npos);
  EXPECT_NE(says("explain").find("SCENE is required"), std::string::npos);
  EXPECT_EQ(
      says("--foo"),
      "rubatlas: unknown option --foo; before a command there are --help, -h, --version; commands are run, "
      "status, explain, orbit, branch, analyse, edges, accuracy, verify, merge, pack\n");
  static_cast<void>(place.write("s.json", kSmallScene));
  EXPECT_EQ(says("run s.json -o ''"), "rubatlas: the word after -o is empty; a name or a value is wanted\n");
  EXPECT_EQ(says("run s.json -o a.h5 --part ''"),
            "rubatlas: the word after --part is empty; a name or a value is wanted\n");
  EXPECT_NE(says("explain s.json --measure nan").find("--measure: nan is no number from 0 to"),
            std::string::npos);
  EXPECT_NE(says("verify a.h5 --recompute -1").find("--recompute: -1 is no whole number from 0 to"),
            std::string::npos);
}

TEST(CommandLine, AWrongSceneIsOneSentenceAndExitCodeTwoBeforeAnyFile) {
  const Workplace place;
  static_cast<void>(
      place.write("s.json", R"({"grid": {"speed_ratio": 0.5}, "contact": {"friction": -0.1}})"));
  for (const std::string arguments :
       {"run s.json -o a.h5", "explain s.json", "orbit s.json -o a.h5", "run s.json -o a.h5 --dry-run"}) {
    const auto ending = place.rubatlas(arguments);
    EXPECT_EQ(ending.code, 2) << arguments;
    EXPECT_EQ(ending.messages,
              "rubatlas: /contact/friction: -0.1 is outside [0, 2]; Coulomb coefficient between blade tip "
              "and ring\n");
    EXPECT_FALSE(place.has("a.h5"));
  }
  const auto missing = place.rubatlas("run none.json -o a.h5");
  EXPECT_EQ(missing.code, 2);
  EXPECT_EQ(missing.messages, "rubatlas: cannot read the scene none.json: No such file or directory\n");
}

TEST(CommandLine, AFileThatIsNoAtlasIsNamedForWhatItIsAndIsAWrongCall) {
  const Workplace place;
  static_cast<void>(place.write("s.json", kSmallScene));
  ASSERT_EQ(place.rubatlas("run s.json -o a.h5 --progress off").code, 0);
  ASSERT_EQ(place.rubatlas("analyse a.h5 -o maps.h5 --table t.md").code, 0);
  ASSERT_EQ(place.rubatlas("orbit s.json --at speed_ratio=0.3,damping_ratio=0.1 -o o.h5").code, 0);
  const auto says = [&](const std::string& arguments) {
    const auto ending = place.rubatlas(arguments);
    EXPECT_EQ(ending.code, 2) << arguments;
    EXPECT_EQ(ending.output, "") << arguments;
    return ending.messages;
  };
  const std::string wanted = "; an atlas is wanted here, which rubatlas run makes\n";
  EXPECT_EQ(says("analyse s.json -o m.h5"),
            "rubatlas: s.json holds a text in braces, such as a scene" + wanted);
  EXPECT_EQ(says("analyse maps.h5 -o m.h5"), "rubatlas: maps.h5 holds maps" + wanted);
  EXPECT_EQ(says("status o.h5"), "rubatlas: o.h5 holds an orbit" + wanted);
  EXPECT_EQ(says("verify t.md"), "rubatlas: t.md holds a table" + wanted);
  EXPECT_FALSE(place.has("m.h5"));
  static_cast<void>(place.write("noise.h5", "no HDF5 at all"));
  EXPECT_EQ(place.rubatlas("analyse noise.h5 -o m.h5").code, 3)
      << "what cannot be read may be a damaged atlas";
}

TEST(CommandLine, UnderMpirunOneRankSaysItAndAllEndWithTheCode) {
  const Workplace place;
  const auto wrong_call = place.ranks(3, "rnu");
  EXPECT_EQ(wrong_call.code, 2);
  EXPECT_EQ(occurrences(wrong_call.messages, "rubatlas: unknown command rnu"), 1U) << wrong_call.messages;

  static_cast<void>(place.write("s.json", R"({"grid": {"speed_ratio": []}})"));
  const auto wrong_scene = place.ranks(3, "run s.json -o a.h5");
  EXPECT_EQ(wrong_scene.code, 2);
  EXPECT_EQ(occurrences(wrong_scene.messages, "rubatlas: /grid/speed_ratio: the list is empty"), 1U)
      << wrong_scene.messages;
  EXPECT_FALSE(place.has("a.h5"));

  const auto help = place.ranks(3, "--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(occurrences(help.output, "Exit codes:"), 1U);
}

TEST(CommandLine, AClosedStandardOutputIsTheEnvironmentsFault) {
  const Workplace place;
  static_cast<void>(place.write("s.json", kSmallScene));
  ASSERT_EQ(place.rubatlas("run s.json -o a.h5 --progress off").code, 0);
  for (const std::string arguments :
       {"--version", "run s.json -o b.h5 --dry-run", "status a.h5", "explain s.json --measure 0",
        "verify a.h5", "analyse a.h5 -o m.h5", "edges a.h5 --to 0.05 --progress off", "merge a.h5 -o w.h5",
        "pack a.h5 -o p.h5"}) {
    const auto ending = place.rubatlas(arguments + " >/dev/full");
    EXPECT_EQ(ending.code, 3) << arguments;
    EXPECT_TRUE(ending.messages.ends_with("rubatlas: standard output takes no more text\n"))
        << arguments << ": " << ending.messages;
  }
}

}  // namespace
}  // namespace rubatlas::mpi
