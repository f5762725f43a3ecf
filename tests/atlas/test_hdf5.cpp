#include <sys/stat.h>

#include <array>
#include <chrono>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "atlas/environment_error.hpp"
#include "atlas/hdf5.hpp"
#include "scratch.hpp"

namespace rubatlas::atlas {
namespace {

class Hdf5 : public testing::Scratch {};

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const EnvironmentError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(Hdf5, AFailureNamesTheFileAndTheSystemsReasonAndNothingOfHdf5) {
  const std::string message = message_of([&] { File::open_to_read(file("missing.h5")); });
  EXPECT_EQ(message, file("missing.h5").string() + " cannot be opened: No such file or directory");
}

TEST_F(Hdf5, AMissingDatasetIsNamedWithItsFile) {
  const File created = File::create(file("empty.h5"));
  const std::string message = message_of([&] { static_cast<void>(created.dataset("/nothing")); });
  EXPECT_EQ(message,
            file("empty.h5").string() +
                ": its root cannot be asked for /nothing: it is damaged, or not as this program writes it");
}

TEST_F(Hdf5, AFileThatIsCutShortSaysSo) {
  { File::create(file("short.h5")).create_filled_dataset<double>("/array", {1000}, 1.0); }
  std::filesystem::resize_file(file("short.h5"), 3000);
  EXPECT_EQ(message_of([&] { File::open_to_read(file("short.h5")); }),
            file("short.h5").string() + " cannot be opened: the file is cut short");
}

TEST_F(Hdf5, TextsComeBackAsTheyWere) {
  const std::string text = "Ω and μ,\n\"quoted\", " + std::string(100'000, 'x');
  {
    File created = File::create(file("texts.h5"));
    created.create_text("/long", text).set_text("units", "Ωτ");
    created.create_text("/empty", "");
    created.create_texts("/words", {"x", "", "vx"});
    created.root().set_text("nothing", "");
  }
  const File read = File::open_to_read(file("texts.h5"));
  EXPECT_EQ(read.read_text("/long"), text);
  EXPECT_EQ(read.dataset("/long").text("units"), "Ωτ");
  EXPECT_EQ(read.read_text("/empty"), "");
  EXPECT_EQ(read.root().text("nothing"), "");
  EXPECT_EQ(read.read_texts("/words"), (std::vector<std::string>{"x", "", "vx"}));
}

TEST_F(Hdf5, BlocksOfAnArrayAreWrittenAndReadByTheirPlace) {
  File created = File::create(file("blocks.h5"));
  Dataset array = created.create_sparse_dataset<double>("/group/array", {2, 3, 4});
  const std::array<double, 4> row{1.0, 2.0, 3.0, 4.0};
  array.write_block<double>({1, 2, 0}, {1, 1, 4}, row);
  const auto all = array.read<double>();
  ASSERT_EQ(all.size(), 24U);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(all[i], 0.0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(all[20 + i], row[i]);
  EXPECT_EQ(array.read_block<double>({1, 2, 1}, {1, 1, 2}), (std::vector<double>{2.0, 3.0}));
  EXPECT_EQ(array.shape(), (Shape{2, 3, 4}));
  array.write_bytes({0, 0, 1}, {1, 1, 2}, std::as_bytes(std::span(row).first(2)));
  EXPECT_EQ(array.read_block<double>({0, 0, 0}, {1, 1, 4}), (std::vector<double>{0.0, 1.0, 2.0, 0.0}));
}

TEST_F(Hdf5, ABlockOutsideTheArrayIsAnError) {
  File created = File::create(file("outside.h5"));
  Dataset array = created.create_dataset<std::int32_t>("/array", {3});
  const std::array<std::int32_t, 2> values{1, 2};
  EXPECT_THROW(array.write_block<std::int32_t>({2}, {2}, values), EnvironmentError);
  EXPECT_THROW(array.write_block<std::int32_t>({0}, {3}, values), EnvironmentError)
      << "two values for three places";
  EXPECT_THROW(array.write<std::int32_t>(values), EnvironmentError);
}

TEST_F(Hdf5, AFilledDatasetHoldsItsFillValueUntilItIsWritten) {
  File created = File::create(file("filled.h5"));
  EXPECT_EQ(created.create_filled_dataset<std::int32_t>("/filled", {3}, -1).read<std::int32_t>(),
            (std::vector<std::int32_t>{-1, -1, -1}));
}

TEST_F(Hdf5, LargeDatasetsBeginAtAMultipleOfAMegabyteAndSmallFilesStaySmall) {
  constexpr std::size_t kMegabyte = std::size_t{1} << 20;
  {
    File created = File::create(file("large.h5"));
    created.create_sparse_dataset<double>("/small", {1000});
    created.create_sparse_dataset<double>("/large", {2 * kMegabyte});
    created.create_sparse_dataset<double>("/larger", {3 * kMegabyte + 1});
  }
  const File read = File::open_to_read(file("large.h5"));
  EXPECT_EQ(*read.dataset("/large").offset() % kMegabyte, 0U);
  EXPECT_EQ(*read.dataset("/larger").offset() % kMegabyte, 0U);
  EXPECT_LT(std::filesystem::file_size(file("large.h5")), 42 * kMegabyte) << "40 of data";
  { File::create(file("small.h5")).create_sparse_dataset<double>("/small", {1000}); }
  EXPECT_LT(std::filesystem::file_size(file("small.h5")), 16'000U);
}

TEST_F(Hdf5, ASparseDatasetTakesNoDiskBeforeItIsWritten) {
  constexpr std::size_t kCount = 100'000'000;
  { File::create(file("sparse.h5")).create_sparse_dataset<double>("/array", {kCount}); }
  struct stat status {};
  ASSERT_EQ(::stat(file("sparse.h5").c_str(), &status), 0);
  EXPECT_GE(static_cast<std::size_t>(status.st_size), kCount * sizeof(double));
  EXPECT_LT(status.st_blocks * 512, 1'000'000);
}

TEST_F(Hdf5, EqualContentsGiveEqualBytesAtAnyTime) {
  const auto write = [](const std::filesystem::path& path) {
    File created = File::create(path);
    created.create_group("/group/inner");
    created.create_text("/text", "text").set_number<double>("number", 1.5);
    Dataset scale = created.create_dataset<double>("/scale", {2});
    scale.write<double>(std::array{1.0, 2.0});
    scale.make_scale("scale");
    created.create_sparse_dataset<double>("/group/array", {2}).attach_scale(0, scale);
  };
  write(file("first.h5"));
  // Time stamps count seconds.
  const std::time_t first = std::time(nullptr);
  while (std::time(nullptr) == first) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  write(file("second.h5"));
  EXPECT_EQ(bytes(file("first.h5")), bytes(file("second.h5")));
}

TEST_F(Hdf5, AScaleIsFoundFromTheAxisThatRunsAlongIt) {
  File created = File::create(file("scales.h5"));
  Dataset scale = created.create_dataset<double>("/speed_ratio", {2});
  scale.make_scale("speed_ratio");
  Dataset array = created.create_dataset<double>("/array", {3, 2});
  array.attach_scale(1, scale);
  EXPECT_EQ(array.scale_name(1), "speed_ratio");
  EXPECT_EQ(array.scale_name(0), "");
}

TEST_F(Hdf5, NamesAreListedAndLookedUp) {
  File created = File::create(file("names.h5"));
  created.create_dataset<double>("/b/inner", {1});
  created.create_dataset<double>("/a", {1});
  EXPECT_EQ(created.names(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(created.names("/b"), (std::vector<std::string>{"inner"}));
  EXPECT_TRUE(created.has("/b/inner"));
  EXPECT_TRUE(created.has("a"));
  EXPECT_FALSE(created.has("/c/inner"));
  EXPECT_TRUE(created.dataset("/a").shape() == Shape{1});
}

TEST_F(Hdf5, NumbersAreAttributesOfTheirOwnType) {
  File created = File::create(file("attributes.h5"));
  Object root = created.root();
  root.set_number<std::int64_t>("count", 12);
  root.set_number<double>("tolerance", 1e-6);
  root.set_numbers<std::uint8_t>("flags", std::array<std::uint8_t, 2>{0, 1});
  EXPECT_EQ(root.number("count"), 12.0);
  EXPECT_EQ(root.number("tolerance"), 1e-6);
  EXPECT_TRUE(root.has_attribute("flags"));
  EXPECT_FALSE(root.has_attribute("flag"));
  EXPECT_THROW(static_cast<void>(root.number("flags")), EnvironmentError) << "two numbers are not one";
  EXPECT_THROW(static_cast<void>(root.text("count")), EnvironmentError) << "a number is no text";
}

}  // namespace
}  // namespace rubatlas::atlas
