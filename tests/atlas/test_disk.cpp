#include <sys/file.h>
#include <sys/resource.h>

#include <fcntl.h>

#include <cerrno>
#include <chrono>
#include <string>

#include "atlas/environment_error.hpp"
#include "atlas/free_space.hpp"
#include "atlas/lock.hpp"
#include "scratch.hpp"

namespace rubatlas::atlas {
namespace {

class Disk : public testing::Scratch {
 protected:
  [[nodiscard]] std::string refusal(std::uint64_t size) const {
    try {
      require_space(file("atlas.h5"), size);
    } catch (const EnvironmentError& error) {
      return error.what();
    }
    return "";
  }
};

class Lock : public testing::Scratch {
 protected:
  void SetUp() override {
    Scratch::SetUp();
    std::ofstream(file("atlas.h5")) << "atlas";
  }
};

TEST_F(Disk, WhatFitsIsNotRefused) {
  EXPECT_EQ(refusal(1000), "");
}

TEST_F(Disk, WhatDoesNotFitIsRefusedWithBothNumbers) {
  const std::string message = refusal(2'000'000'000'000'000'000);
  EXPECT_NE(message.find("will take 2 EB"), std::string::npos) << message;
  EXPECT_NE(message.find("has room for "), std::string::npos) << message;
}

TEST_F(Disk, AProcessThatMayNotWriteSuchAFileIsToldBeforeTheSignal) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 5000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string large = refusal(6000);
  const std::string fitting = refusal(4000);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_NE(large.find("files of up to 5 kB"), std::string::npos) << large;
  EXPECT_EQ(fitting, "");
}

TEST_F(Disk, AMissingDirectoryIsNamed) {
  EXPECT_THROW(require_space(file("nowhere") / "atlas.h5", 1), EnvironmentError);
}

TEST_F(Disk, BytesAreWrittenWithThreeDigits) {
  EXPECT_EQ(readable_bytes(0), "0 B");
  EXPECT_EQ(readable_bytes(999), "999 B");
  EXPECT_EQ(readable_bytes(999'999), "1 MB");
  EXPECT_EQ(readable_bytes(1'234'000'000), "1.23 GB");
}

TEST_F(Lock, ASecondRunIsRefusedUntilTheFirstIsThrough) {
  {
    const AtlasLock first(file("atlas.h5"));
    EXPECT_THROW(AtlasLock(file("atlas.h5")), EnvironmentError);
  }
  EXPECT_NO_THROW(AtlasLock(file("atlas.h5")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 1)
      << "nothing lies beside it";
}

TEST_F(Lock, AnotherPathToTheAtlasDoesNotLetASecondRunIn) {
  std::filesystem::create_hard_link(file("atlas.h5"), file("hard.h5"));
  std::filesystem::create_symlink(file("atlas.h5"), file("soft.h5"));
  const AtlasLock first(file("atlas.h5"));
  EXPECT_THROW(AtlasLock(file("hard.h5")), EnvironmentError);
  EXPECT_THROW(AtlasLock(file("soft.h5")), EnvironmentError);
}

TEST_F(Lock, ReadersAreWelcomeAndWritersAreKeptOut) {
  const AtlasLock run(file("atlas.h5"));
  const int other = ::open(file("atlas.h5").c_str(), O_RDONLY);
  ASSERT_GE(other, 0);
  EXPECT_NE(::flock(other, LOCK_EX | LOCK_NB), 0) << "what h5py does for r+";
  EXPECT_EQ(::flock(other, LOCK_SH | LOCK_NB), 0) << "what h5py does for r";
  ::close(other);
}

TEST_F(Lock, AReaderThatClosesTheAtlasTakesNoLockAway) {
  const AtlasLock run(file("atlas.h5"));
  ::close(::open(file("atlas.h5").c_str(), O_RDONLY));  // as each AtlasReader of the same process
  EXPECT_THROW(AtlasLock(file("atlas.h5")), EnvironmentError);
}

TEST_F(Lock, AnAtlasThatIsBeingWrittenByOthersIsRefused) {
  const int other = ::open(file("atlas.h5").c_str(), O_RDONLY);
  ASSERT_GE(other, 0);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_THROW(AtlasLock(file("atlas.h5")), EnvironmentError);
  ::close(other);
}

TEST_F(Lock, AnAtlasThatIsMovedOrReplacedIsNotInItsPlaceAnyMore) {
  const AtlasLock run(file("atlas.h5"));
  EXPECT_TRUE(run.is_in_place());
  std::filesystem::rename(file("atlas.h5"), file("moved.h5"));
  EXPECT_FALSE(run.is_in_place());
  std::ofstream(file("atlas.h5")) << "another";
  EXPECT_FALSE(run.is_in_place());
}

// Without locks
// ------------------------------------------------------------------------------------------------------

int no_locks(int /*descriptor*/) {
  return ENOLCK;
}

class NoLocks : public Lock {
 protected:
  [[nodiscard]] AtlasLock taken() const { return {file("atlas.h5"), file("atlas.h5"), no_locks}; }
  [[nodiscard]] std::string refusal() const {
    try {
      static_cast<void>(taken());
    } catch (const EnvironmentError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] std::filesystem::path side() const { return file("atlas.h5.lock"); }
};

TEST_F(NoLocks, ASideFileWithHostAndProcessKeepsASecondRunOut) {
  {
    const AtlasLock first = taken();
    EXPECT_NE(first.remark().find("takes no lock (No locks available); " + side().string()),
              std::string::npos)
        << first.remark();
    EXPECT_NE(bytes(side()).find("process " + std::to_string(::getpid())), std::string::npos);
    const std::string message = refusal();
    EXPECT_NE(message.find("another run is filling"), std::string::npos) << message;
    EXPECT_NE(message.find("process " + std::to_string(::getpid()) + ", renewed "), std::string::npos)
        << message;
  }
  EXPECT_FALSE(std::filesystem::exists(side())) << "nothing is left behind";
  EXPECT_EQ(refusal(), "");
}

TEST_F(NoLocks, ASideFileThatNobodyRenewsIsTakenOver) {
  std::ofstream(side()) << "host elsewhere, process 1\n";
  EXPECT_NE(refusal().find("host elsewhere, process 1, renewed "), std::string::npos);
  std::filesystem::last_write_time(
      side(), std::filesystem::file_time_type::clock::now() - 2 * AtlasLock::kLeftBehind);
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 1);
}

TEST_F(NoLocks, WhereThereAreLocksThereIsNoSideFile) {
  const AtlasLock locked(file("atlas.h5"));
  EXPECT_EQ(locked.remark(), "");
  EXPECT_FALSE(std::filesystem::exists(side()));
}

}  // namespace
}  // namespace rubatlas::atlas
