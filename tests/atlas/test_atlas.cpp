#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <random>
#include <span>
#include <utility>

#include "atlas/atlas_reader.hpp"
#include "atlas/atlas_writer.hpp"
#include "atlas/create.hpp"
#include "atlas/environment_error.hpp"
#include "atlas/header_checksum.hpp"
#include "atlas/schema.hpp"
#include "atlas/verify.hpp"
#include "scratch.hpp"
#include "settings/identifier.hpp"

namespace rubatlas::atlas {
namespace {

/// A row whose numbers tell which point and which place they belong to.
point::PointOutcome numbered_outcome(const settings::Scene& scene, std::size_t point) {
  point::PointOutcome outcome;
  outcome.status = ending::PointStatus::done;
  const double base = 1000.0 * static_cast<double>(point + 1);
  for (std::size_t i = 0; i < outcome.final_state.size(); ++i)
    outcome.final_state[i] = base + static_cast<double>(i);
  for (const auto& kept : observables::descriptions(scene)) {
    auto& row = outcome.rows.emplace_back(kept.row_size);
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = base + static_cast<double>(i);
  }
  return outcome;
}

class Atlas : public testing::Scratch {
 protected:
  void SetUp() override {
    Scratch::SetUp();
    create_atlas(path(), {scene_, testing::kSmallScene, testing::kSoftware});
  }
  [[nodiscard]] std::filesystem::path path() const { return file("atlas.h5"); }

  settings::Scene scene_ = testing::small_scene();
};

TEST_F(Atlas, AFreshOneHasEveryAxisAndNoPointDone) {
  const AtlasReader atlas(path());
  EXPECT_EQ(atlas.shape(), (Shape{1, 1, 1, 2, 5}));
  EXPECT_EQ(atlas.axes().back().name, "speed_ratio");
  EXPECT_EQ(atlas.axes().back().values.back(), 0.5);
  EXPECT_EQ(atlas.axes()[3].values, (std::vector<double>{0.05, 0.2}));
  EXPECT_EQ(atlas.status(), std::vector<std::uint8_t>(10, 0));
  EXPECT_EQ(atlas.rows("failed_revolution"), std::vector<double>(10, -1.0));
  EXPECT_EQ(atlas.file().dataset("poincare").shape(), (Shape{1, 1, 1, 2, 5, 3, 4}));
  EXPECT_EQ(atlas.file().dataset("poincare_blade_passing").shape(), (Shape{1, 1, 1, 2, 5, 9, 4}));
  EXPECT_EQ(atlas.file().dataset("max_displacement").shape(), atlas.shape());
  EXPECT_FALSE(atlas.has("max_contact_force")) << "the scene does not ask for it";
}

TEST_F(Atlas, NamesAllThatMayEndAMotion) {
  const AtlasReader atlas(path());
  const Dataset details = atlas.file().dataset("/status_detail");
  const std::string meanings = details.text("flag_meanings");
  std::size_t named = 1;
  for (const char c : meanings) named += c == ' ' ? 1U : 0U;
  EXPECT_EQ(named, ending::kStatusDetails.size());
  for (const auto& entry : ending::kStatusDetails) {
    EXPECT_NE(meanings.find(entry.name), std::string::npos) << entry.name;
    EXPECT_NE(entry.status, ending::PointStatus::pending) << entry.name;
  }
}

TEST_F(Atlas, KeepsTheSceneAsItWasGivenAndAsItWasUnderstood) {
  const AtlasReader atlas(path());
  EXPECT_EQ(atlas.scene(), testing::kSmallScene);
  EXPECT_EQ(atlas.scene_resolved(), settings::resolved_json(scene_));
  EXPECT_EQ(atlas.file().root().text("title"), "small");
  EXPECT_EQ(atlas.file().root().text("creator"), "not stated in the scene");
  EXPECT_EQ(atlas.file().root().text("license"), "not stated in the scene");
  EXPECT_EQ(atlas.file().root().text("identifier"), settings::identifier_of(scene_));
}

TEST_F(Atlas, EveryAxisOfEveryRowRunsAlongItsScale) {
  const AtlasReader atlas(path());
  const Schema schema = schema_of(scene_);
  for (const auto* rows : schema.row_datasets()) {
    const Dataset dataset = atlas.file().dataset(rows->name);
    for (std::size_t axis = 0; axis < schema.axes.size(); ++axis) {
      EXPECT_EQ(dataset.scale_name(axis), schema.axes[axis].name) << rows->name;
    }
    for (std::size_t i = 0; i < rows->inner_axes.size(); ++i) {
      EXPECT_EQ(dataset.scale_name(schema.axes.size() + i), rows->inner_axes[i]) << rows->name;
    }
  }
}

TEST_F(Atlas, ARowIsThereForReadersAsSoonAsItsStatusIsWritten) {
  AtlasWriter writer(path(), scene_);
  writer.add_point(7, {.restarted = true}, numbered_outcome(scene_, 7));
  EXPECT_EQ(AtlasReader(path()).status(), std::vector<std::uint8_t>(10, 0))
      << "it waits for its row to be on the disk";
  writer.commit();
  // The writer is still open.
  const AtlasReader atlas(path());
  auto expected_status = std::vector<std::uint8_t>(10, 0);
  expected_status[7] = 1;
  EXPECT_EQ(atlas.status(), expected_status);
  for (const auto& kept : observables::descriptions(scene_)) {
    const auto row = atlas.row(kept.name, 7);
    ASSERT_EQ(row.size(), kept.row_size);
    for (std::size_t i = 0; i < row.size(); ++i)
      EXPECT_EQ(row[i], 8000.0 + static_cast<double>(i)) << kept.name;
  }
  EXPECT_EQ(atlas.final_state(7), (std::array{8000.0, 8001.0, 8002.0, 8003.0}));
  EXPECT_EQ(atlas.rows("restarted")[7], 1.0);
  EXPECT_EQ(atlas.rows("restarted")[6], 0.0);
}

TEST_F(Atlas, ALineIsReadAsOnePiece) {
  AtlasWriter writer(path(), scene_);
  for (std::size_t point = 0; point < 10; ++point)
    writer.add_point(point, {.restarted = false}, numbered_outcome(scene_, point));
  writer.close();
  const AtlasReader atlas(path());
  EXPECT_EQ(atlas.line_rows("max_displacement", 1), (std::vector<double>{6000, 7000, 8000, 9000, 10000}));
  const auto sections = atlas.line_rows("poincare", 1);
  ASSERT_EQ(sections.size(), 5U * 12U);
  EXPECT_EQ(sections[12], 7000.0);
}

TEST_F(Atlas, APointThatFailedHasNoNumbersWhateverItReached) {
  AtlasWriter writer(path(), scene_);
  auto outcome = numbered_outcome(scene_, 3);
  outcome.status = ending::PointStatus::left_validity;
  outcome.detail = ending::StatusDetail::shaft_at_ring;
  outcome.failed_revolution = 4;
  writer.add_point(3, {.restarted = false}, outcome);
  writer.close();
  const AtlasReader atlas(path());
  EXPECT_EQ(atlas.status()[3], 2);
  EXPECT_EQ(atlas.rows("status_detail")[3], 3.0);
  EXPECT_EQ(atlas.rows("failed_revolution")[3], 4.0);
  for (const auto& kept : observables::descriptions(scene_)) {
    for (const double value : atlas.row(kept.name, 3)) EXPECT_TRUE(std::isnan(value)) << kept.name;
  }
  for (const double value : atlas.final_state(3)) EXPECT_TRUE(std::isnan(value));
}

TEST_F(Atlas, TheOrderInWhichRowsAreWrittenDoesNotShow) {
  create_atlas(file("other.h5"), {scene_, testing::kSmallScene, testing::kSoftware});
  AtlasWriter forward(path(), scene_);
  AtlasWriter backward(file("other.h5"), scene_);
  for (std::size_t point = 0; point < 10; ++point) {
    forward.add_point(point, {.restarted = false}, numbered_outcome(scene_, point));
    backward.add_point(9 - point, {.restarted = false}, numbered_outcome(scene_, 9 - point));
  }
  forward.close();
  backward.close();
  EXPECT_EQ(bytes(path()), bytes(file("other.h5")));
}

TEST_F(Atlas, RowsInMemoryReachTheFileTogetherAndTheirStatusesLater) {
  AtlasWriter writer(path(), scene_);
  for (const std::size_t point : {4U, 3U, 7U, 8U, 2U}) {
    writer.add_point(point, {}, numbered_outcome(scene_, point));
  }
  EXPECT_EQ(AtlasReader(path()).rows("max_displacement"), std::vector<double>(10, 0.0));
  writer.write_rows();
  EXPECT_EQ(AtlasReader(path()).rows("max_displacement"),
            (std::vector<double>{0, 0, 3000, 4000, 5000, 0, 0, 8000, 9000, 0}));
  EXPECT_EQ(AtlasReader(path()).status(), std::vector<std::uint8_t>(10, 0));
  writer.commit();
  EXPECT_EQ(AtlasReader(path()).status(), (std::vector<std::uint8_t>{0, 0, 1, 1, 1, 0, 0, 1, 1, 0}));
  EXPECT_TRUE(damaged_rows(AtlasReader(path())).empty());
}

TEST_F(Atlas, RowsAreGatheredUpToAMegabyteOnly) {
  AtlasWriter writer(path(), scene_);
  const std::size_t row = schema_of(scene_).bytes_per_point();
  std::size_t gathered = 0;
  for (; !writer.is_full(); gathered += row) writer.add_point(0, {}, numbered_outcome(scene_, 0));
  EXPECT_GE(gathered, AtlasWriter::kMostGathered);
  EXPECT_LT(gathered, AtlasWriter::kMostGathered + row);
  writer.write_rows();
  EXPECT_FALSE(writer.is_full());
}

TEST_F(Atlas, PointsAreFoundByTheirParameters) {
  const AtlasReader atlas(path());
  plan::PointParameters wanted{.speed_ratio = 0.3,
                               .damping_ratio = 0.2,
                               .friction = scene_.contact.friction,
                               .unbalance = 0.0,
                               .thickness = scene_.blades.thickness};
  EXPECT_EQ(atlas.find(wanted), 7U);
  wanted.speed_ratio = 0.3 * (1.0 + 1e-12);
  EXPECT_EQ(atlas.find(wanted), 7U) << "typed with fewer digits than stored";
  wanted.speed_ratio = 0.301;
  EXPECT_EQ(atlas.find(wanted), std::nullopt);
}

TEST_F(Atlas, OfSpeedsThatHardlyDifferTheNearestIsFound) {
  const std::string text = R"({"grid": {"speed_ratio": [0.55, 0.55000000001]}})";
  const auto scene = settings::parse_scene(text);
  create_atlas(file("close.h5"), {scene, text, testing::kSoftware});
  const AtlasReader atlas(file("close.h5"));
  for (const std::size_t point : {0U, 1U}) EXPECT_EQ(atlas.find(plan::Grid(scene).parameters(point)), point);
}

TEST_F(Atlas, OfBothDirectionsTheOneAskedForIsFound) {
  auto text = testing::kSmallScene;
  text.insert(1, R"("sweep": "both",)");
  const auto both = settings::parse_scene(text);
  create_atlas(file("both.h5"), {both, text, testing::kSoftware});
  const AtlasReader atlas(file("both.h5"));
  EXPECT_EQ(atlas.shape(), (Shape{2, 1, 1, 1, 2, 5}));
  const plan::PointParameters wanted = plan::Grid(both).parameters(2);
  EXPECT_EQ(atlas.find(wanted, plan::Direction::up), 2U);
  EXPECT_EQ(atlas.find(wanted, plan::Direction::down), 12U);
}

TEST_F(Atlas, ItsSizeIsKnownBeforehand) {
  const Schema schema = schema_of(scene_);
  const std::uint64_t spectrum = 12 * 3 + 1;
  EXPECT_EQ(schema.bytes_per_point(), 1 + 1 + 1 + 2 + 4 + 4 + 8 * (4 + 3 * 4 + 9 * 4 + 1 + spectrum));
  EXPECT_EQ(schema.byte_count(), 10 * schema.bytes_per_point());
}

TEST_F(Atlas, AnotherScenesAtlasIsNotWritten) {
  auto longer = scene_;
  longer.protocol.sampled_revolutions = 4;
  EXPECT_THROW(AtlasWriter(path(), longer), EnvironmentError);
}

TEST_F(Atlas, SomeOtherFileIsNotReadAsOne) {
  { File::create(file("other.h5")).create_dataset<double>("/status", {1}); }
  try {
    AtlasReader atlas(file("other.h5"));
    FAIL() << "was read";
  } catch (const EnvironmentError& error) {
    EXPECT_EQ(std::string(error.what()), file("other.h5").string() + " is not an atlas of rubatlas");
  }
}

TEST_F(Atlas, AppearsUnderItsNameOnlyWhenItIsComplete) {
  // What is to be done before it appears fails: the old atlas stays as it was, and nothing lies beside it.
  const std::string before = bytes(path());
  const auto fail = [&](const std::filesystem::path& unpublished) {
    EXPECT_EQ(bytes(path()), before);
    EXPECT_NO_THROW(AtlasReader{unpublished}) << "it is complete already";
    throw EnvironmentError("no lock");
  };
  EXPECT_THROW(create_atlas({path(), true}, {scene_, testing::kSmallScene, testing::kSoftware}, fail),
               EnvironmentError);
  EXPECT_EQ(bytes(path()), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 1);
}

TEST_F(Atlas, ANewOneDoesNotTakeANameThatHasBeenTakenMeanwhile) {
  const auto take_the_name = [&](const std::filesystem::path&) { std::ofstream(file("late.h5")) << "mine"; };
  EXPECT_THROW(
      create_atlas(file("late.h5"), {scene_, testing::kSmallScene, testing::kSoftware}, take_the_name),
      OutputRefusal);
  EXPECT_EQ(bytes(file("late.h5")), "mine");
}

// Checksums
// ------------------------------------------------------------------------------------------------------

/// The atlas with all its rows.
class FullAtlas : public Atlas {
 protected:
  void SetUp() override {
    Atlas::SetUp();
    AtlasWriter writer(path(), scene_);
    for (std::size_t point = 0; point < 10; ++point) {
      auto outcome = numbered_outcome(scene_, point);
      if (point == 4) outcome.status = ending::PointStatus::left_validity;
      writer.add_point(point, {.restarted = point == 0}, outcome);
    }
    writer.close();
  }
  /// Where a point's first number stands in the file.
  [[nodiscard]] std::uint64_t place(const std::string& dataset, std::size_t point) const {
    const File read = File::open_to_read(path());
    const Dataset rows = read.dataset(dataset);
    return *rows.offset() + point * rows.size() / 10 * rows.number_size();
  }
  void flip(std::uint64_t at) const {
    std::fstream stream(path(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(at));
    const char byte = static_cast<char>(stream.get() ^ 1);
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(byte);
  }
};

TEST_F(FullAtlas, EveryRowHasItsChecksumAndTheHeaderHasOne) {
  EXPECT_TRUE(damaged_rows(AtlasReader(path())).empty());
  EXPECT_EQ(header_damage(path()), "");
}

TEST_F(FullAtlas, TheChecksumIsTheOneOfZlibOverTheRowsBytes) {
  // crc32 of zlib, bit by bit.
  const AtlasReader atlas(path());
  std::uint32_t sum = 0xFFFFFFFF;
  const auto add = [&](const auto& values) {
    for (const std::byte byte : std::as_bytes(std::span(values))) {
      sum ^= static_cast<std::uint32_t>(byte);
      for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1U) != 0 ? 0xEDB88320U : 0U);
    }
  };
  add(std::array<std::uint8_t, 3>{1, 0, 0});  // done, nothing in detail, not restarted
  add(std::array<std::uint16_t, 1>{0});       // the whole protocol was run
  add(std::array<std::int32_t, 1>{-1});
  add(atlas.row("final_state", 6));
  for (const char* name : {"poincare", "poincare_blade_passing", "max_displacement", "spectrum"}) {
    add(atlas.row(name, 6));
  }
  EXPECT_EQ(atlas.file().dataset("row_checksum").read<std::uint32_t>()[6], ~sum);
  EXPECT_EQ(
      atlas.file().dataset("row_checksum").text("order"),
      "status status_detail restarted settled failed_revolution final_state poincare poincare_blade_passing "
      "max_displacement "
      "spectrum");
}

TEST_F(Atlas, IsSoundWhileItIsWrittenAndWhenARunWasKilled) {
  AtlasWriter writer(path(), scene_);
  writer.add_point(3, {.restarted = true}, numbered_outcome(scene_, 3));
  writer.commit();
  std::filesystem::copy(path(), file("killed.h5"));
  for (const auto& atlas : {path(), file("killed.h5")}) {
    EXPECT_EQ(header_damage(atlas), "");
    EXPECT_TRUE(damaged_rows(AtlasReader(atlas)).empty());
  }
}

TEST_F(FullAtlas, OneBitAnywhereInARowIsFound) {
  const Schema schema = schema_of(scene_);
  for (const auto* rows : schema.row_datasets()) {
    if (rows->name == "status") continue;  // one bit makes it pending, and then it has no row
    const std::uint64_t at = place(rows->name, 7);
    flip(at);
    EXPECT_EQ(damaged_rows(AtlasReader(path())), std::vector<std::size_t>{7}) << rows->name;
    flip(at);
  }
  flip(place("status", 4));  // left validity, now integrator failed
  EXPECT_EQ(damaged_rows(AtlasReader(path())), std::vector<std::size_t>{4});
}

TEST_F(FullAtlas, OneBitAnywhereBesidesTheRowsIsFound) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> rows{{20, 24}};  // and HDF5's flags of open files
  const Schema schema = schema_of(scene_);
  for (const auto* dataset : schema.row_datasets()) {
    rows.emplace_back(place(dataset->name, 0), place(dataset->name, 10));
  }
  std::mt19937_64 chance(7);  // any: bits all over the file
  int tried = 0;
  while (tried < 40) {
    const std::uint64_t at = chance() % std::filesystem::file_size(path());
    if (std::ranges::any_of(rows, [&](const auto& range) { return at >= range.first && at < range.second; }))
      continue;
    ++tried;
    flip(at);
    const std::string found = header_damage(path());
    EXPECT_TRUE(found.starts_with(path().string())) << "byte " << at << ": " << found;
    flip(at);
  }
  EXPECT_EQ(header_damage(path()), "");
}

}  // namespace
}  // namespace rubatlas::atlas
