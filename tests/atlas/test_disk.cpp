#include <sys/file.h>
#include <sys/resource.h>

#include <fcntl.h>

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
    const FileLock first = FileLock::beside(file("atlas.h5"));
    EXPECT_THROW(FileLock::beside(file("atlas.h5")), EnvironmentError);
  }
  EXPECT_NO_THROW(FileLock::beside(file("atlas.h5")));
  EXPECT_FALSE(std::filesystem::exists(file("atlas.h5.lock"))) << "nothing is left behind";
}

TEST_F(Lock, ALockFileThatAKilledRunLeftBehindDoesNotMatter) {
  std::ofstream(file("atlas.h5.lock")) << "";
  EXPECT_NO_THROW(FileLock::beside(file("atlas.h5")));
}

TEST_F(Lock, ReadersAreWelcomeAndWritersAreKeptOut) {
  const FileLock run = FileLock::shared_on(file("atlas.h5"));
  const int other = ::open(file("atlas.h5").c_str(), O_RDONLY);
  ASSERT_GE(other, 0);
  EXPECT_NE(::flock(other, LOCK_EX | LOCK_NB), 0) << "what h5py does for r+";
  EXPECT_EQ(::flock(other, LOCK_SH | LOCK_NB), 0) << "what h5py does for r";
  ::close(other);
}

TEST_F(Lock, AnAtlasThatIsBeingWrittenByOthersIsRefused) {
  const int other = ::open(file("atlas.h5").c_str(), O_RDONLY);
  ASSERT_GE(other, 0);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_THROW(FileLock::shared_on(file("atlas.h5")), EnvironmentError);
  ::close(other);
}

}  // namespace
}  // namespace rubatlas::atlas
