#include <sys/stat.h>

#include <string>

#include "atlas/create.hpp"
#include "atlas/environment_error.hpp"
#include "atlas/hdf5.hpp"
#include "atlas/output.hpp"
#include "atlas/publish.hpp"
#include "scratch.hpp"

namespace rubatlas::atlas {
namespace {

class Outputs : public testing::Scratch {
 protected:
  [[nodiscard]] std::string refusal(const std::string& name, FileKind kind, Existing if_there,
                                    const std::vector<std::filesystem::path>& others = {},
                                    const char* instead = "") const {
    try {
      static_cast<void>(permitted({file(name), kind, if_there, instead}, others));
    } catch (const OutputRefusal& refused) {
      return std::string(refused.what()).substr(file("").string().size());
    }
    return "";
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }
  void write_atlas(const std::string& name) const {
    create_atlas(file(name), {testing::small_scene(), testing::kSmallScene, testing::kSoftware});
  }
  [[nodiscard]] auto files() const {
    return std::distance(std::filesystem::directory_iterator(directory_), {});
  }
};

TEST_F(Outputs, AFreeNameIsGranted) {
  EXPECT_EQ(refusal("a.h5", FileKind::atlas, Existing::refuse), "");
}

TEST_F(Outputs, WhatIsThereStaysUnasked) {
  write("a.h5", "mine");
  EXPECT_EQ(refusal("a.h5", FileKind::maps, Existing::refuse), "a.h5 exists; --overwrite replaces it");
  EXPECT_EQ(refusal("a.h5", FileKind::atlas, Existing::refuse, {}, "--resume completes it, "),
            "a.h5 exists; --resume completes it, --overwrite replaces it");
}

TEST_F(Outputs, OnlyTheSameKindIsReplaced) {
  write_atlas("a.h5");
  write("letter.txt", "dear reader");
  write("table.md", std::string(kTableMark) + "\n# title\n");
  write("record.json", std::string(kRecordMark) + "\n]}\n");
  EXPECT_EQ(refusal("a.h5", FileKind::atlas, Existing::replace), "");
  EXPECT_EQ(refusal("table.md", FileKind::table, Existing::replace), "");
  EXPECT_EQ(refusal("record.json", FileKind::record, Existing::replace), "");
  EXPECT_EQ(refusal("a.h5", FileKind::maps, Existing::replace),
            "a.h5 is an atlas, and --overwrite replaces maps by maps only");
  EXPECT_EQ(refusal("table.md", FileKind::atlas, Existing::replace),
            "table.md is a table, and --overwrite replaces an atlas by another only");
  EXPECT_EQ(
      refusal("letter.txt", FileKind::table, Existing::replace),
      "letter.txt is no file of rubatlas that can be read, and --overwrite replaces a table by another only");
}

TEST_F(Outputs, KindsOfFilesThatDoNotSayTheirsAreKnownByTheirDatasets) {
  {
    File old = File::create(file("maps.h5"));
    old.root().set_text("software", "rubatlas");
    old.create_dataset<std::uint8_t>("/class", {1});
    File foreign = File::create(file("foreign.h5"));
    foreign.create_dataset<std::uint8_t>("/class", {1});
  }
  EXPECT_EQ(kind_of(file("maps.h5")), FileKind::maps);
  EXPECT_EQ(kind_of(file("foreign.h5")), std::nullopt);
}

TEST_F(Outputs, NothingButAFileIsWritten) {
  std::filesystem::create_directory(file("directory"));
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/null", file("device"));
  std::filesystem::create_symlink("nowhere", file("dangling"));
  for (const auto if_there : {Existing::refuse, Existing::replace, Existing::keep}) {
    EXPECT_EQ(refusal("directory", FileKind::atlas, if_there),
              "directory is a directory; the output must be a file");
    EXPECT_EQ(refusal("pipe", FileKind::atlas, if_there), "pipe is a pipe; the output must be a file");
    EXPECT_EQ(refusal("device", FileKind::atlas, if_there), "device is a device; the output must be a file");
    EXPECT_EQ(refusal("dangling", FileKind::atlas, if_there),
              "dangling is a link that leads to no file: No such file or directory");
  }
}

TEST_F(Outputs, ANameThatNoFileCanHaveIsRefusedBeforehand) {
  const std::string name(300, 'a');
  EXPECT_EQ(refusal(name, FileKind::atlas, Existing::refuse),
            name + ": its name is too long for the file system");
}

TEST_F(Outputs, WhatIsReadIsNotWrittenByWhateverPath) {
  write_atlas("a.h5");
  std::filesystem::create_hard_link(file("a.h5"), file("hard.h5"));
  std::filesystem::create_symlink("a.h5", file("soft.h5"));
  for (const char* name : {"a.h5", "hard.h5", "soft.h5"}) {
    EXPECT_NE(refusal(name, FileKind::atlas, Existing::replace, {file("a.h5")}).find("are the same file"),
              std::string::npos)
        << name;
  }
  EXPECT_NE(
      refusal("new.md", FileKind::table, Existing::replace, {file("x/../new.md")}).find("are the same file"),
      std::string::npos)
      << "two outputs of one command";
}

TEST_F(Outputs, ALinkStaysAndTheFileThatItLeadsToIsReplaced) {
  write("table.md", kTableMark);
  std::filesystem::create_symlink("table.md", file("link.md"));
  publish_text(permitted({file("link.md"), FileKind::table, Existing::replace}, {}), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(file("link.md")));
  EXPECT_EQ(bytes(file("table.md")), "new");
}

TEST_F(Outputs, TemporaryFilesAreTheirOwnAndGoWhenTheyAreNotPublished) {
  {
    const Publication one(file("a.h5"));
    const Publication other(file("a.h5"));
    EXPECT_NE(one.name(), other.name());
    EXPECT_EQ(files(), 2);
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(Outputs, ATemporaryFileThatWasReplacedByALinkIsNotPublished) {
  write("victim", "mine");
  Publication publication(file("a.h5"));
  std::filesystem::remove(publication.name());
  std::filesystem::create_symlink("victim", publication.name());
  EXPECT_THROW(publication.publish(), EnvironmentError);
  EXPECT_EQ(bytes(file("victim")), "mine");
  EXPECT_FALSE(std::filesystem::exists(file("a.h5")));
}

TEST_F(Outputs, OfTwoThatFindTheSameFreeNameOneIsRefused) {
  Publication one(file("a.h5"));
  Publication other(file("a.h5"));
  one.publish();
  EXPECT_THROW(other.publish(), OutputRefusal);
}

}  // namespace
}  // namespace rubatlas::atlas
