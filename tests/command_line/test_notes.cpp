// What a scene is doubted for, without being stopped.
#include <gtest/gtest.h>

#include <string>

#include "mpi/notes.hpp"
#include "program.hpp"
#include "scene/reader.hpp"

namespace rubatlas::mpi {
namespace {

/// All doubts about the default rotor with some sections changed, one a line.
std::string doubts(const std::string& sections) {
  std::string text;
  for (const auto& doubt :
       doubts_about(scene::parse_scene(R"({"grid": {"speed_ratio": 0.5}, )" + sections + "}"))) {
    text += doubt + "\n";
  }
  return text;
}

TEST(Notes, TheDefaultRotorIsNotDoubted) {
  EXPECT_EQ(doubts(R"("title": "default")"), "");
}

TEST(Notes, AModulusInAnotherUnitIsNamed) {
  EXPECT_EQ(doubts(R"("blades": {"youngs_modulus": 206})"),
            "E = 206 Pa is far below any solid; is it 206 GPa, that is 2.06e+11 Pa?\n");
  EXPECT_EQ(doubts(R"("blades": {"youngs_modulus": 206000})"),
            "E = 206000 Pa is far below any solid; is it 206000 MPa, that is 2.06e+11 Pa?\n");
  EXPECT_EQ(doubts(R"("blades": {"youngs_modulus": 1e-5})"), "E = 1e-05 Pa is far below any solid\n");
  EXPECT_EQ(doubts(R"("blades": {"youngs_modulus": 206}, "contact": {"law": "elastic_ring"})"), "")
      << "rigid blades have no modulus";
}

TEST(Notes, AThickBladeIsNoBeam) {
  EXPECT_EQ(doubts(R"("blades": {"thickness": 0.021})"),
            "h = 21 mm is more than a fifth of L = 100 mm: such a blade is no slender beam, as which it is "
            "computed\n");
}

TEST(Notes, ADampingRatioInPerCentIsNamed) {
  EXPECT_EQ(doubts(R"("rotor": {"damping_ratio": 5})"),
            "ζ = 5 is a share of critical damping, beyond 1 the shaft creeps back without vibrating; 5 % is "
            "0.05\n");
}

TEST(Notes, AStaticLoadThatPushesTheShaftThroughTheClearanceIsNamed) {
  EXPECT_EQ(doubts(R"("gravity": {})"),
            "the static load alone moves the shaft by 98.1 mm, more than the clearance of 10 mm\n");
  EXPECT_EQ(doubts(R"("side_load": {"force": 0.9})"), "") << "9 mm";
}

TEST(Notes, WhyEveryPointLeavesTheModelIsSaidWhereItCanBeSeen) {
  const auto reason = [](const std::string& sections) {
    return likely_reason_to_leave(scene::parse_scene(R"({"grid": {"speed_ratio": 0.5}, )" + sections + "}"));
  };
  EXPECT_EQ(
      reason(R"("rotor": {"misalignment": 0.07})"),
      "a blade that passes overlaps the ring by 60 mm, and may be shortened by 50 mm (max_shortening 0.5 "
      "of L)");
  EXPECT_EQ(reason(R"("initial": {"x": 0.2})"),
            "`initial` puts the shaft 200.25 mm from the ring's centre, and the ring has a radius of 110 mm");
  EXPECT_EQ(reason(R"("title": "default")"), "");
}

TEST(Notes, ARunSaysThemBeforeItBeginsAndTheReasonWhereEveryPointHasLeft) {
  const Workplace place;
  static_cast<void>(
      place.write("s.json", R"({"grid": {"speed_ratio": [0.3, 0.5]}, "rotor": {"misalignment": 0.07,
    "damping_ratio": 3}, "protocol": {"transient_revolutions": 2, "sampled_revolutions": 1}})"));
  const auto ending = place.rubatlas("run s.json -o a.h5 --progress off");
  EXPECT_EQ(ending.code, 0);
  EXPECT_TRUE(ending.messages.starts_with("rubatlas: note: ζ = 3 is a share of critical damping"))
      << ending.messages;
  EXPECT_NE(ending.messages.find("\nrubatlas: every point left the model, 2 of 2 since "), std::string::npos)
      << ending.messages;
  EXPECT_NE(ending.messages.find("overlaps the ring by 60 mm"), std::string::npos) << ending.messages;
}

}  // namespace
}  // namespace rubatlas::mpi
