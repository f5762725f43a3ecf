// `orbit`: which point is meant, where it starts, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "atlas/atlas_reader.hpp"
#include "program.hpp"

namespace rubatlas::mpi {
namespace {

class Orbit : public testing::Test {
 protected:
  void SetUp() override { static_cast<void>(place.write("s.json", kSmallScene)); }
  std::string refused(const std::string& arguments) const {
    const auto ending = place.rubatlas("orbit s.json " + arguments);
    EXPECT_EQ(ending.code, 2) << arguments;
    return ending.messages;
  }
  Workplace place;
};

TEST_F(Orbit, WritesOnePointThatNeedNotBeOnTheGrid) {
  const auto ending = place.rubatlas("orbit s.json --at speed_ratio=0.317,damping_ratio=0.123 -o o.h5");
  EXPECT_EQ(ending.code, 0);
  EXPECT_EQ(ending.messages, "rubatlas: o.h5 holds the orbit at Ω = 0.317: 3 revolutions, after 4\n");
  EXPECT_EQ(ending.output, "");
  const auto listing = place.shell("h5ls o.h5");
  EXPECT_NE(listing.output.find("state                    Dataset {768, 4}"), std::string::npos)
      << listing.output;
  EXPECT_NE(listing.output.find("force                    Dataset {768, 3}"), std::string::npos);
  EXPECT_NE(place.shell("h5dump -a damping_ratio o.h5").output.find("0.123"), std::string::npos);
}

TEST_F(Orbit, AxesWithSeveralValuesMustBeNamed) {
  EXPECT_EQ(refused("--at speed_ratio=0.3 -o o.h5"),
            "rubatlas: which damping_ratio? The grid has 0.1, 0.2; add --at damping_ratio=VALUE\n");
  EXPECT_EQ(refused("--at damping_ratio=0.1 -o o.h5"),
            "rubatlas: which speed_ratio? The grid has 0.3, 0.4, 0.5; add --at speed_ratio=VALUE\n");
}

TEST_F(Orbit, MistypedPlacesAreNamed) {
  EXPECT_EQ(refused("--at speed=0.3 -o o.h5"),
            "rubatlas: --at speed=0.3: unknown name speed; names are speed_ratio, damping_ratio, friction, "
            "unbalance, "
            "thickness, direction; nearest: speed_ratio\n");
  EXPECT_EQ(refused("--at zeta=0.1 -o o.h5"),
            "rubatlas: --at zeta=0.1: unknown name zeta; names are speed_ratio, damping_ratio, friction, "
            "unbalance, "
            "thickness, direction; the symbol ζ is that of /rotor/damping_ratio\n");
  EXPECT_EQ(refused("--at speed_ratio=fast -o o.h5"),
            "rubatlas: --at speed_ratio=fast: fast is not a number in [0.0001, 1000]; speed ratio, spin "
            "speed over natural "
            "frequency\n");
  EXPECT_EQ(refused("--at friction=-0.1 -o o.h5"),
            "rubatlas: --at friction=-0.1: -0.1 is not a number in [0, 2]; Coulomb coefficient between blade "
            "tip and ring\n");
  EXPECT_EQ(refused("--at friction=nan -o o.h5"),
            "rubatlas: --at friction=nan: nan is not a number in [0, 2]; Coulomb coefficient between blade "
            "tip and ring\n");
  EXPECT_EQ(refused("--at speed_ratio -o o.h5"),
            "rubatlas: --at speed_ratio: not of the form name=value; names are speed_ratio, damping_ratio, "
            "friction, "
            "unbalance, thickness, direction\n");
  EXPECT_EQ(refused("--at friction=0.1 --at friction=0.2 -o o.h5"), "rubatlas: --at names friction twice\n");
  EXPECT_EQ(refused("--at direction=sideways -o o.h5"),
            "rubatlas: --at direction=sideways: direction is up or down\n");
  EXPECT_EQ(refused("--at speed_ratio=0.3,damping_ratio=0.1,direction=up -o o.h5"),
            "rubatlas: --at direction means a line of an atlas; it needs --from ATLAS\n");
}

TEST_F(Orbit, AnAxisNamedByItsPointerIsChosenByItsNameOrItsPointer) {
  static_cast<void>(place.write("ring.json", R"({"contact": {"law": "elastic_ring"},
    "grid": {"speed_ratio": [0.3, 0.4], "/ring/stiffness": [1e3, 1e4]},
    "protocol": {"transient_revolutions": 4, "sampled_revolutions": 3}})"));
  static_cast<void>(
      place.write("own.json", R"({"contact": {"law": "elastic_ring"}, "ring": {"stiffness": 2e3},
    "grid": {"speed_ratio": [0.3, 0.4]}, "protocol": {"transient_revolutions": 4, "sampled_revolutions": 3}})"));
  ASSERT_EQ(place.rubatlas("orbit own.json --at speed_ratio=0.4 -o own.h5").code, 0);
  // Only the rows of numbers: what stands around them names places in the file.
  const auto states = [&](const std::string& file) {
    return place.shell("h5dump -m %.17g -d state " + file + " | grep '^ *([0-9]*,[0-9]*):'").output;
  };
  const std::string own = states("own.h5");
  ASSERT_GT(own.size(), 1000U);
  for (const std::string name : {"ring_stiffness", "/ring/stiffness"}) {
    const auto ending =
        place.rubatlas("orbit ring.json --at speed_ratio=0.4," + name + "=2e3 -o o.h5 --overwrite");
    ASSERT_EQ(ending.code, 0) << ending.messages;
    EXPECT_TRUE(states("o.h5") == own) << name;
    EXPECT_NE(place.shell("h5dump -a ring_stiffness o.h5").output.find("(0): 2000"), std::string::npos);
  }
  const auto refused_here = [&](const std::string& arguments) {
    return place.rubatlas("orbit ring.json --at speed_ratio=0.4" + arguments + " -o other.h5").messages;
  };
  EXPECT_EQ(refused_here(""),
            "rubatlas: which ring_stiffness? The grid has 1000, 10000; add --at ring_stiffness=VALUE\n");
  EXPECT_EQ(refused_here(",ring_stiffness=1e3,/ring/stiffness=1e4"),
            "rubatlas: --at names ring_stiffness twice\n");
  EXPECT_EQ(refused_here(",/ring/stiffness=0"),
            "rubatlas: --at /ring/stiffness=0: 0 is not a number in (0, 1000000000000000]; stiffness of the "
            "massless ring under a tip, law elastic_ring only\n");
  ASSERT_EQ(place.rubatlas("run ring.json -o a.h5 --progress off").code, 0);
  EXPECT_EQ(
      refused_here(",ring_stiffness=2e3 --from a.h5"),
      "rubatlas: a.h5 has no point at ring_stiffness=2000; it has 1000, 10000; the nearest are 1000 and "
      "10000\n");
  EXPECT_EQ(refused_here(",ring_stiffness=1e4 --from a.h5"),
            "rubatlas: other.h5 holds the orbit at Ω = 0.4: 3 revolutions, after 4\n");
}

TEST_F(Orbit, BladesFitIntoTheRingWhereTheOrbitIs) {
  static_cast<void>(
      place.write("lengths.json", R"({"grid": {"speed_ratio": 0.3, "/ring/radius": [0.105, 0.11]}})"));
  const auto ending = place.rubatlas("orbit lengths.json --at ring_radius=0.09 -o o.h5");
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(
      ending.messages,
      "rubatlas: --at: the blades do not fit into the ring there; radius must be hub_radius + length at "
      "least\n");
}

TEST_F(Orbit, NeverReplacesAFileUnasked) {
  const std::string at = "--at speed_ratio=0.3,damping_ratio=0.1 -o o.h5";
  static_cast<void>(place.write("o.h5", "mine"));
  EXPECT_EQ(refused(at), "rubatlas: o.h5 exists; --overwrite replaces it\n");
  EXPECT_EQ(
      refused(at + " --overwrite"),
      "rubatlas: o.h5 is no file of rubatlas that can be read, and --overwrite replaces an orbit by another "
      "only\n");
  EXPECT_EQ(place.read("o.h5"), "mine");
  std::filesystem::remove(place.path("o.h5"));
  EXPECT_EQ(place.rubatlas("orbit s.json " + at).code, 0);
  const std::string first = place.read("o.h5");
  EXPECT_EQ(place.rubatlas("orbit s.json --at speed_ratio=0.5,damping_ratio=0.1 -o o.h5 --overwrite").code,
            0);
  EXPECT_NE(place.read("o.h5"), first);
  EXPECT_EQ(refused("--at speed_ratio=0.3,damping_ratio=0.1 --overwrite -o s.json"),
            "rubatlas: s.json and s.json are the same file, and an orbit would replace it\n");
  EXPECT_EQ(place.read("s.json"), kSmallScene);
}

TEST_F(Orbit, FromAnAtlasStartsAtTheStoredState) {
  ASSERT_EQ(place.rubatlas("run s.json -o a.h5 --progress off").code, 0);
  const auto ending =
      place.rubatlas("orbit s.json --at speed_ratio=0.4,damping_ratio=0.2 --from a.h5 -o o.h5");
  ASSERT_EQ(ending.code, 0) << ending.messages;
  const atlas::AtlasReader atlas(place.path("a.h5"));
  const auto point =
      atlas.find({.speed_ratio = 0.4, .damping_ratio = 0.2, .friction = 0.1, .thickness = 0.001});
  ASSERT_TRUE(point.has_value());
  const auto stored = atlas.final_state(*point);
  const std::string start = place.shell("h5dump -m %.17g -a start o.h5").output;
  for (const double number : stored) {
    EXPECT_NE(start.find(fmt::format(" {:.17g}", number)), std::string::npos) << start;
  }
}

TEST_F(Orbit, FromAnAtlasRefusesPointsAndScenesThatItDoesNotHave) {
  ASSERT_EQ(place.rubatlas("run s.json -o a.h5 --progress off").code, 0);
  EXPECT_EQ(
      refused("--at speed_ratio=0.45,damping_ratio=0.2 --from a.h5 -o o.h5"),
      "rubatlas: a.h5 has no point at speed_ratio=0.45; it has 0.3, 0.4, 0.5; the nearest are 0.4 and 0.5\n");
  EXPECT_EQ(refused("--at speed_ratio=0.4,damping_ratio=0.3 --from a.h5 -o o.h5"),
            "rubatlas: a.h5 has no point at damping_ratio=0.3; it has 0.1, 0.2; the nearest is 0.2\n");
  EXPECT_EQ(refused("--at speed_ratio=0.4,damping_ratio=0.2,direction=up --from a.h5 -o o.h5"),
            "rubatlas: a.h5 was swept one way; it has no direction to choose\n");
  EXPECT_EQ(refused("--at speed_ratio=0.4,damping_ratio=0.2 --from a.h5 --overwrite -o a.h5"),
            "rubatlas: a.h5 and a.h5 are the same file, and an orbit would replace it\n");
  static_cast<void>(
      place.write("other.json", R"({"rotor": {"mass": 2}, "grid": {"speed_ratio": [0.3, 0.4, 0.5],
    "damping_ratio": [0.1, 0.2]}, "protocol": {"transient_revolutions": 4, "sampled_revolutions": 3}})"));
  const auto ending =
      place.rubatlas("orbit other.json --at speed_ratio=0.4,damping_ratio=0.2 --from a.h5 -o o.h5");
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(
      ending.messages,
      "rubatlas: a.h5 was made from another scene: /rotor/mass is 1 in the first and 2 in the second\n");
  EXPECT_FALSE(place.has("o.h5"));
}

TEST_F(Orbit, FromSomethingThatIsNoAtlasIsTheEnvironmentsFault) {
  static_cast<void>(place.write("a.h5", "no HDF5 at all"));
  const auto ending =
      place.rubatlas("orbit s.json --at speed_ratio=0.4,damping_ratio=0.2 --from a.h5 -o o.h5");
  EXPECT_EQ(ending.code, 3);
  EXPECT_TRUE(ending.messages.starts_with("rubatlas: ")) << ending.messages;
}

TEST_F(Orbit, AMotionThatLeavesTheModelIsAResultThatIsSaid) {
  // From rest the default rotor always leaves between 1.05 and 1.24 (MODEL 5).
  static_cast<void>(place.write("long.json", R"({"grid": {"speed_ratio": 1.15}})"));
  const auto ending = place.rubatlas("orbit long.json -o o.h5");
  EXPECT_EQ(ending.code, 0);
  EXPECT_TRUE(ending.messages.starts_with("rubatlas: the motion left the model's validity in revolution "))
      << ending.messages;
  EXPECT_EQ(ending.messages.find("start"), std::string::npos) << ending.messages;
}

TEST_F(Orbit, AMotionThatLeavesTheModelFromAStartBeyondTheRingSaysSo) {
  static_cast<void>(place.write("beyond.json", R"({"grid": {"speed_ratio": 0.6}, "initial": {"x": 0.09}})"));
  const auto ending = place.rubatlas("orbit beyond.json -o o.h5");
  EXPECT_EQ(ending.code, 0);
  // √(90² + 10.01²) mm from the ring's centre, with a clearance of 10 mm.
  EXPECT_TRUE(
      ending.messages.starts_with("rubatlas: the motion left the model's validity in revolution 0, "
                                  "from a start 80.555 mm beyond the ring: "))
      << ending.messages;
}

}  // namespace
}  // namespace rubatlas::mpi
