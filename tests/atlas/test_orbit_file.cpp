#include "atlas/hdf5.hpp"
#include "atlas/orbit_file.hpp"
#include "scratch.hpp"

namespace rubatlas::atlas {
namespace {

const plan::PointParameters kParameters{0.3, 0.1, 0.1, 0.0, 0.001};

class OrbitFile : public testing::Scratch {
 protected:
  void write(const point::Orbit& orbit) const {
    write_orbit(file("orbit.h5"), testing::small_scene(), testing::kSmallScene, kParameters,
                {1.0, 2.0, 3.0, 4.0}, orbit, testing::kSoftware);
  }
};

TEST_F(OrbitFile, HoldsTimeStateForceAndSections) {
  point::Orbit orbit;
  orbit.status = ending::PointStatus::done;
  orbit.time = {0.0, 0.5};
  orbit.state = {{1.0, 2.0, 3.0, 4.0}, {5.0, 6.0, 7.0, 8.0}};
  orbit.force = {0.0, 10.0, 0.0, 0.0, 0.0, 20.0};
  orbit.sections = {{9.0, 10.0, 11.0, 12.0}};
  orbit.contacts = {{0, 0, 1}, {2, 2, 0}, {0.1, 0.2, 0.3}, {5.0, 6.0, 7.0}, {{1.0}, {2.0}, {3.0}}};
  write(orbit);
  const File read = File::open_to_read(file("orbit.h5"));
  EXPECT_EQ(read.dataset("/time").read<double>(), orbit.time);
  EXPECT_EQ(read.dataset("/state").shape(), (Shape{2, 4}));
  EXPECT_EQ(read.dataset("/state").read<double>()[6], 7.0);
  EXPECT_EQ(read.dataset("/force").shape(), (Shape{2, 3}));
  EXPECT_EQ(read.dataset("/force").read<double>(), orbit.force);
  EXPECT_EQ(read.dataset("/force").scale_name(1), "blade");
  EXPECT_EQ(read.dataset("/sections").shape(), (Shape{1, 4}));
  EXPECT_EQ(read.dataset("/section").read<std::int32_t>(), (std::vector<std::int32_t>{3}))
      << "after two of transient";
  EXPECT_EQ(read.dataset("/contact_number").read<std::int32_t>(), orbit.contacts.number);
  EXPECT_EQ(read.dataset("/contact_blade").read<std::int32_t>(), (std::vector<std::int32_t>{3, 3, 1}))
      << "numbers as in /blade";
  EXPECT_EQ(read.dataset("/contact_time").read<double>(), orbit.contacts.time);
  EXPECT_EQ(read.dataset("/contact_force").read<double>(), orbit.contacts.force);
  EXPECT_EQ(read.dataset("/contact_force").scale_name(0), "contact_sample");
  EXPECT_EQ(read.dataset("/contact_state").shape(), (Shape{3, 4}));
  EXPECT_EQ(read.root().number("speed_ratio"), 0.3);
  EXPECT_EQ(read.root().number("status"), 1.0);
  EXPECT_EQ(read.read_text("/scene"), testing::kSmallScene);
}

TEST_F(OrbitFile, OfAMotionThatFailedSaysSoAndMayBeEmpty) {
  point::Orbit orbit;
  orbit.status = ending::PointStatus::left_validity;
  orbit.failed_revolution = 1;
  write(orbit);
  const File read = File::open_to_read(file("orbit.h5"));
  EXPECT_EQ(read.root().number("status"), 2.0);
  EXPECT_EQ(read.root().number("failed_revolution"), 1.0);
  EXPECT_EQ(read.dataset("/state").shape(), (Shape{0, 4}));
}

}  // namespace
}  // namespace rubatlas::atlas
