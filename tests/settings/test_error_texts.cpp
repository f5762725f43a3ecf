// What the reader says to a mistake: the pointer, what was found, what is allowed.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "scene_error_text.hpp"
#include "settings/linearisation.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::settings {
namespace {

TEST(SceneErrors, AValueOutOfRangeNamesPointerValueRangeAndMeaning) {
  EXPECT_EQ(refusal_with(R"("contact": {"friction": -0.1})"),
            "/contact/friction: -0.1 is outside [0, 2]; Coulomb coefficient between blade tip and ring");
  EXPECT_EQ(refusal_with(R"("contact": {"friction": 2.5})"),
            "/contact/friction: 2.5 is outside [0, 2]; Coulomb coefficient between blade tip and ring");
  EXPECT_EQ(refusal_with(R"("blades": {"thickness": 0})"),
            "/blades/thickness: 0 is outside [1e-12, 1000] m; thickness of a blade in its plane of bending");
  EXPECT_EQ(refusal_with(R"("blades": {"count": 51})"),
            "/blades/count: 51 is outside [1, 50]; number of equally spaced blades");
  EXPECT_EQ(refusal_with(R"("validity": {"max_shortening": 0.61})"),
            "/validity/max_shortening: 0.61 is outside (0, 0.6]; largest axial shortening of a blade, share "
            "of its length");
  EXPECT_EQ(
      refusal_with(R"("rotor": {"damping_ratio": -1e-9})"),
      "/rotor/damping_ratio: -1e-09 is outside [0, 1000]; damping ratio of the shaft, share of critical");
  EXPECT_EQ(
      refusal_with(R"("protocol": {"sampled_revolutions": 0})"),
      "/protocol/sampled_revolutions: 0 is outside [1, 1000000]; revolutions of which sections, spectrum and "
      "extremes are kept");
}

TEST(SceneErrors, ABladeShorterOrThinnerThanAnAtomIsRefusedSinceThePowersOfItsSizeVanish) {
  EXPECT_EQ(refusal_with(R"("blades": {"length": 5e-324})"),
            "/blades/length: 5e-324 is outside [1e-12, 1000] m; length of a blade from hub to tip");
  EXPECT_EQ(
      refusal_with(R"("blades": {"thickness": 5e-324})"),
      "/blades/thickness: 5e-324 is outside [1e-12, 1000] m; thickness of a blade in its plane of bending");
  EXPECT_EQ(refusal_with(R"("blades": {"thickness": 1e-12})"), "accepted");
}

TEST(SceneErrors, AControlCharacterInAKeyIsWrittenAsItsCode) {
  EXPECT_TRUE(
      refusal_with(R"("\u0000": 1)").starts_with("/\\u0000: unknown key, with the value 1; known in a"));
  EXPECT_TRUE(
      refusal_with(R"("rotor": {"ma\u001bss\u007f": 2})")
          .starts_with("/rotor/ma\\u001bss\\u007f: unknown key, with the value 2; known in /rotor: "));
  EXPECT_TRUE(refusal(R"({"grid": {"speed_ratio": 0.5, "/\u0000": 1}})")
                  .starts_with("/grid/~1\\u0000: no quantity that can be swept"));
}

TEST(SceneErrors, AWrongTypeSaysWhatWouldBeRight) {
  EXPECT_EQ(refusal_with(R"("contact": {"friction": "high"})"),
            "/contact/friction: \"high\" is not a number in [0, 2]; Coulomb coefficient between blade tip "
            "and ring");
  EXPECT_EQ(
      refusal_with(R"("contact": {"friction": true})"),
      "/contact/friction: true is not a number in [0, 2]; Coulomb coefficient between blade tip and ring");
  EXPECT_EQ(
      refusal_with(R"("contact": {"friction": null})"),
      "/contact/friction: null is not a number in [0, 2]; Coulomb coefficient between blade tip and ring");
  EXPECT_EQ(refusal_with(R"("blades": {"count": 3.5})"),
            "/blades/count: 3.5 is not a whole number in [1, 50]; number of equally spaced blades");
  EXPECT_EQ(refusal_with(R"("title": 3)"), "/title: 3 is not a text; what this atlas is about");
  EXPECT_EQ(refusal_with(R"("title": "a\u0000b")"),
            R"(/title: "a\u0000b" has a character U+0000; any other is allowed; what this atlas is about)");
  EXPECT_EQ(refusal_with(R"("rotor": [1])"),
            "/rotor: [1] is not a section in braces; point mass on a massless isotropic shaft");
  EXPECT_EQ(refusal("[1, 2]"), "/: [1,2] is not a scene; a scene is a JSON object");
  EXPECT_EQ(refusal("1e999"), "/: 1e999 is more than a number of double precision can be; up to 1.8e+308");
}

TEST(SceneErrors, PiecesAreForLinesThatCanBeCut) {
  EXPECT_EQ(refusal_with(R"("pieces": {"points": 0})"),
            "/pieces/points: 0 is outside [1, 1000000]; points of a piece of a line");
  EXPECT_EQ(refusal_with(R"("sweep": "independent", "pieces": {})"),
            R"(/pieces: the sweep is "independent": its points go to all ranks as they are)");
  EXPECT_EQ(refusal_with(R"("wear": {"rate": 1e-9, "carries_over": true}, "pieces": {})"),
            "/pieces: /wear/carries_over: blades wear along the whole line, which no piece can begin within");
  EXPECT_EQ(refusal_with(R"("wear": {"rate": 1e-9}, "pieces": {"points": 32, "lead_in": 0})"), "accepted");
}

TEST(SceneErrors, AWholeNumberMayBeWrittenWithADecimalPoint) {
  EXPECT_EQ(refusal_with(R"("blades": {"count": 4.0})"), "accepted");
  EXPECT_EQ(refusal_with(R"("rotor": {"mass": 2})"), "accepted");
}

TEST(SceneErrors, AChoiceListsItsWordsAndTheNearestOne) {
  EXPECT_EQ(refusal_with(R"("contact": {"law": "elastic-ring"})"),
            "/contact/law: \"elastic-ring\" is not one of \"elastica\", \"elastic_ring\", \"beam_column\"; "
            "elastica: elastic "
            "blades in a "
            "rigid ring; elastic_ring: rigid blades in an elastic ring; beam_column: as elastica with small "
            "slopes; nearest: \"elastic_ring\"");
  EXPECT_EQ(refusal_with(R"("sweep": 1)"),
            "/sweep: 1 is not one of \"up\", \"down\", \"both\", \"independent\"; where a point starts: from "
            "its lower "
            "neighbour in speed, its upper one, both, or from `initial`");
}

TEST(SceneErrors, AnUnknownKeyNamesTheNearestKnownOne) {
  EXPECT_EQ(refusal_with(R"("contact": {"fricton": 0.1})"),
            "/contact/fricton: unknown key, with the value 0.1; known in /contact: law, friction; nearest "
            "known key: "
            "/contact/friction");
  EXPECT_NE(refusal_with(R"("rotr": {})").find("/rotr: unknown key, with the value {}; known in a scene: "),
            std::string::npos);
  EXPECT_NE(refusal_with(R"("rotr": {})").find("nearest known key: /rotor"), std::string::npos);
  EXPECT_EQ(
      refusal_of_grid(R"("speed_ration": 0.5)"),
      "/grid/speed_ration: unknown key, with the value 0.5; known in /grid: thickness, unbalance, friction, "
      "damping_ratio, speed_ratio, and pointers of other quantities; nearest known key: /grid/speed_ratio");
}

TEST(SceneErrors, AKeyInTheWrongSectionIsSentToItsOwn) {
  EXPECT_EQ(refusal_with(R"("rotor": {"friction": 0.1})"),
            "/rotor/friction: unknown key, with the value 0.1; known in /rotor: mass, natural_frequency, "
            "damping_ratio, "
            "misalignment; nearest known key: /contact/friction");
}

TEST(SceneErrors, ErrorsOfThicknessAreRefusedWhereBladesAreRigid) {
  const std::string rigid = R"("contact": {"law": "elastic_ring"}, "unequal_blades": )";
  EXPECT_EQ(refusal_with(rigid + R"({"thickness_errors": [1e-4, 0, 0]})"),
            "/unequal_blades/thickness_errors: has no effect under the contact law \"elastic_ring\", whose "
            "blades are rigid");
  EXPECT_EQ(refusal_with(rigid + R"({"thickness_spread": 1e-5})"),
            "/unequal_blades/thickness_spread: has no effect under the contact law \"elastic_ring\", whose "
            "blades are rigid");
  EXPECT_EQ(
      refusal(R"({"grid": {"speed_ratio": 0.5, "/unequal_blades/thickness_spread": [0, 1e-5]},
                        "contact": {"law": "elastic_ring"}})"),
      "/grid/~1unequal_blades~1thickness_spread: has no effect under the contact law \"elastic_ring\", whose "
      "blades are rigid");
  EXPECT_EQ(refusal_with(rigid + R"({"length_errors": [1e-4, 0, 0], "thickness_errors": [0, 0, 0]})"),
            "accepted");
  EXPECT_EQ(refusal_with(R"("unequal_blades": {"thickness_errors": [1e-4, 0, 0]})"), "accepted");
}

TEST(SceneErrors, NoSpreadOfAnAxisMakesABladeWithoutLength) {
  const std::string refused =
      "/unequal_blades: a blade would be -0.127702 m long and 0.001 m thick; both are above 0";
  EXPECT_EQ(refusal_with(R"("unequal_blades": {"length_spread": 1.0})"), refused);
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": 0.5, "/unequal_blades/length_spread": [0, 1.0])"), refused);
}

TEST(SceneErrors, PointersEscapeSlashAndTilde) {
  EXPECT_TRUE(refusal_with(R"("a/b~c": 1)").starts_with("/a~1b~0c: unknown key"));
}

TEST(SceneErrors, AKeyThatStandsTwiceIsAnError) {
  EXPECT_EQ(refusal_with(R"("rotor": {"mass": 1, "mass": 2})"),
            "/rotor/mass: the key stands twice in its section; once is allowed");
  EXPECT_EQ(refusal_with(R"("title": "a", "title": "a")"),
            "/title: the key stands twice in its section; once is allowed");
}

TEST(SceneErrors, ALongNumberOrNameComesBackInShort) {
  const std::string digits(5000, '7');
  for (const std::string& text :
       {R"({"rotor": {"mass": )" + digits + "}}", R"({"grid": {"speed_ratio": [0.5, )" + digits + "]}}",
        R"({"rotor": {")" + digits + R"(": 1}})", R"({"title": "a", "sweep": )" + digits + "x}",
        R"({"title": ")" + digits + "\n\"}", R"({"contact": {"law": ")" + digits + R"("}})",
        R"({"a)" + digits + R"(": 1, "a)" + digits + R"(": 1})"}) {
    EXPECT_LT(refusal(text).size(), 700U) << text.substr(0, 30);
    EXPECT_NE(refusal(text).find("777..."), std::string::npos) << refusal(text);
  }
  EXPECT_TRUE(
      refusal(R"({"grid": {"speed_ratio": [0.5, )" + digits + "]}}").starts_with("/grid/speed_ratio/1: 777"));
}

TEST(SceneErrors, AQuantityThatOverflowsWhenScaledIsTheScenesMistake) {
  EXPECT_EQ(
      refusal_with(R"("rotor": {"mass": 1e-300}, "support": {"stiffness_yy": -5})"),
      "/support/stiffness_yy: -5 N/m, divided by mass × natural_frequency² = 1e-298, is more than 1e+150, "
      "with which nothing can be computed");
  EXPECT_TRUE(
      refusal_with(R"("rotor": {"mass": 1e-200, "natural_frequency": 1e-200}, "side_load": {"force": 1})")
          .starts_with("/side_load/force: 1 N, divided by mass × natural_frequency² = 0, "));
  EXPECT_TRUE(refusal(R"({"grid": {"speed_ratio": 0.5, "unbalance": [0, 1e5]}, "rotor": {"mass": 1e-300}})")
                  .starts_with("/grid/unbalance: 100000 kg m, divided by mass = 1e-300, "));
  EXPECT_TRUE(refusal_with(R"("rotor": {"natural_frequency": 1e-9}, "support": {"damping_xx": 1e15})") ==
              "accepted");
  EXPECT_TRUE(refusal_with(R"("rotor": {"mass": 1e-300})") == "accepted") << "nothing is divided by it";
}

TEST(SceneErrors, ASpectrumOfMoreSamplesThanCanBeTransformedIsNamed) {
  const std::string protocol =
      R"("protocol": {"sampled_revolutions": 1000000, "samples_per_revolution": 65536})";
  EXPECT_TRUE(refusal_with(protocol).starts_with(
      "/protocol/sampled_revolutions: 1000000 with 65536 samples_per_revolution are 65536000000 samples"))
      << refusal_with(protocol);
  EXPECT_EQ(refusal_with(protocol + R"(, "observables": ["poincare"])"), "accepted");
}

TEST(SceneErrors, BrokenJsonNamesFileLineAndColumn) {
  EXPECT_EQ(refusal("{\n  \"title\": \"a\"\n  \"sweep\": \"up\"\n}"),
            "scene.json:3:9: not JSON: syntax error while parsing object - unexpected string literal; "
            "expected '}'");
  EXPECT_EQ(refusal(""), "scene.json:1:1: not JSON: the text is empty");
  EXPECT_TRUE(
      refusal("{\"rotor\": {\"mass\": 1e999}}").starts_with("/rotor/mass: 1e999 is more than a number"));
  EXPECT_TRUE(refusal("{\"rotor\": {\"mass\": NaN}}").starts_with("scene.json:1:20: not JSON: syntax error"));
  EXPECT_TRUE(refusal("{\"title\": \"\xff\"}").starts_with("scene.json:1:12: not JSON: syntax error"));
  EXPECT_EQ(refusal(std::string_view("{}\0{}", 5)), "scene.json:1:3: not JSON: a NUL byte");
}

TEST(SceneErrors, DeepNestingIsRefusedInsteadOfExhaustingTheStack) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_TRUE(refusal(deep).find("nested 17 levels deep; a scene has at most 3") != std::string::npos);
}

TEST(SceneErrors, AGridNeedsSpeeds) {
  const std::string missing =
      "/grid/speed_ratio: missing; a number, a list or {\"from\", \"to\", \"count\"} in [0.0001, 1000]; "
      "speed ratio, "
      "spin speed over natural frequency";
  EXPECT_EQ(refusal("{}"), missing);
  EXPECT_EQ(refusal_of_grid(R"("friction": 0.1)"), missing);
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": [])"),
            "/grid/speed_ratio: the list is empty; at least one value is needed; speed ratio, spin speed "
            "over natural "
            "frequency");
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": "all")"),
            "/grid/speed_ratio: \"all\" is not a number, a list of numbers or {\"from\", \"to\", \"count\"} "
            "in [0.0001, "
            "1000]; speed ratio, spin speed over natural frequency");
}

TEST(SceneErrors, GridValuesAscend) {
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": [0.1, 0.3, 0.2])"),
            "/grid/speed_ratio/2: 0.2 comes after 0.3; values are ascending without duplicates");
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": [0.1, 0.1])"),
            "/grid/speed_ratio/1: 0.1 stands twice; values are ascending without duplicates");
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": 0.5, "friction": [0.1, 3])"),
            "/grid/friction/1: 3 is outside [0, 2]; Coulomb coefficient between blade tip and ring");
}

TEST(SceneErrors, ARangeNeedsFromToAndCount) {
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": {"from": 0.1, "to": 0.5})"),
            "/grid/speed_ratio/count: missing; a range of values is from, to and count");
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": {"from": 0.5, "to": 0.1, "count": 3})"),
            "/grid/speed_ratio/to: 0.1 is not above from, 0.5; values are ascending without duplicates");
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": {"from": 0.1, "to": 0.5, "count": 1})"),
            "/grid/speed_ratio/count: 1 is outside [2, 1000000]; number of values from `from` to `to`, both "
            "included");
  EXPECT_EQ(
      refusal_of_grid(R"("speed_ratio": {"from": 0.1, "to": 0.5, "counts": 3})"),
      "/grid/speed_ratio/counts: unknown key, with the value 3; known in /grid/speed_ratio: from, to, count; "
      "nearest known key: /grid/speed_ratio/count");
  EXPECT_EQ(
      refusal_of_grid(R"("speed_ratio": {"from": 0.5, "to": 0.5000000000000002, "count": 9})"),
      "/grid/speed_ratio/count: 9 values from 0.5 to 0.5000000000000002 are closer than numbers can be");
}

TEST(SceneErrors, AGridBeyondAllMeansIsRefused) {
  const std::string thousand = R"({"from": 0.1, "to": 0.5, "count": 2000})";
  EXPECT_EQ(refusal_of_grid(R"("speed_ratio": )" + thousand + R"(, "friction": )" + thousand +
                            R"(, "damping_ratio": )" + thousand),
            "/grid: 8000000000 points; at most 1000000000 are allowed");
}

TEST(SceneErrors, TheRingsStiffnessNeedsTheLawThatReadsIt) {
  EXPECT_EQ(refusal_with(R"("ring": {"stiffness": 10000})"),
            "/ring/stiffness: 10000 has no effect under the contact law \"elastica\"; only \"elastic_ring\" "
            "reads it");
  EXPECT_EQ(refusal_with(R"("ring": {"stiffness": 10000}, "contact": {"law": "elastic_ring"})"), "accepted");
}

TEST(SceneErrors, AKnobIsRefusedWhereTheMethodDoesNotReadIt) {
  EXPECT_EQ(refusal_with(R"("accuracy": {"force_increment": 0.1})"),
            "/accuracy/force_increment: 0.1 has no effect under the accuracy method \"collocation\"; only "
            "\"paper\" reads it");
  EXPECT_EQ(refusal_with(R"("accuracy": {"method": "fixed", "max_step": 0.1})"),
            "/accuracy/max_step: 0.1 has no effect under the accuracy method \"fixed\"; only \"paper\" or "
            "\"located\" reads it");
  EXPECT_EQ(refusal_with(R"("accuracy": {"method": "paper", "step": 0.1})"),
            "/accuracy/step: 0.1 has no effect under the accuracy method \"paper\"; only \"fixed\" reads it");
  EXPECT_EQ(
      refusal_with(R"("accuracy": {"method": "paper", "force_increment": 0})"),
      "/accuracy/force_increment: 0 is outside [1e-06, 1000000] N; step of the upward search for a blade's "
      "force, method paper only");
  for (const std::string knobs :
       {R"("paper", "force_increment": 0.1, "max_step": 0.1)", R"("located", "max_step": 0.1)",
        R"("fixed", "step": 0.1)", R"("hybrid_54", "tolerance": 1e-6)", R"("hybrid_32")"}) {
    EXPECT_EQ(refusal_with(R"("accuracy": {"method": )" + knobs + "}"), "accepted") << knobs;
  }
}

TEST(SceneErrors, BladesMustFitIntoTheRing) {
  EXPECT_EQ(
      refusal_with(R"("ring": {"radius": 0.09})"),
      "/ring/radius: 0.09 is smaller than hub_radius + length = 0.1 m; the blades must fit into the ring");
  EXPECT_EQ(refusal_with(R"("ring": {"radius": 0.1})"), "accepted");
}

TEST(SceneErrors, AKeyThatHasBeenReplacedNamesWhatReplacesIt) {
  const std::string refusal = refusal_with(R"("protocol": {"stop_when_periodic": true})");
  EXPECT_TRUE(refusal.starts_with("/protocol/stop_when_periodic: unknown key, with the value true"))
      << refusal;
  EXPECT_TRUE(
      refusal.ends_with("replaced by /protocol/settle, by whose \"newton\", the default, "
                        "transients of periodic motions end"))
      << refusal;
}

TEST(SceneErrors, TheSpectrumEndsAtHalfTheSamples) {
  EXPECT_EQ(refusal_with(R"("spectrum": {"max_order": 33}, "protocol": {"samples_per_revolution": 64})"),
            "/spectrum/max_order: 33 is outside [1, 32], half of samples_per_revolution; highest order of "
            "the spin speed "
            "that the spectrum keeps");
}

TEST(SceneErrors, AllSamplesOfASignalAreTransformedAtOnce) {
  for (const std::string name : {"spectrum", "full_spectrum"}) {
    const std::string scene = R"("observables": [")" + name +
                              R"("], "protocol": {"samples_per_revolution": 65536, "sampled_revolutions": )";
    EXPECT_EQ(refusal_with(scene + "32767}"), "accepted");
    EXPECT_EQ(
        refusal_with(scene + "32768}"),
        "/protocol/sampled_revolutions: 32768 with 65536 samples_per_revolution are 2147483648 samples of a "
        "spectrum; at most 2147483647 are allowed, more without the observables \"spectrum\" and "
        "\"full_spectrum\"");
  }
}

TEST(SceneErrors, ObservablesComeFromTheirList) {
  const std::string list =
      "\"poincare\", \"poincare_blade_passing\", \"max_displacement\", \"spectrum\", "
      "\"touchdowns_per_revolution\", "
      "\"max_contact_force\", \"contact_fraction\", \"max_root_strain\", \"clearance_growth\", "
      "\"nearest_miss\", \"lightest_touch\", \"grazing_side\", \"lyapunov\", \"full_spectrum\", "
      "\"friction_power\", "
      "\"viscous_power\", \"deformation_power\", \"drive_torque\", \"touchdowns_of_blades\", "
      "\"contact_fraction_of_blades\", "
      "\"impulse_of_blades\", \"max_contact_force_of_blades\", \"approach_speed\", \"max_root_stress\"";
  EXPECT_EQ(refusal_with(R"("observables": ["poincare", "spectrm"])"),
            "/observables/1: \"spectrm\" is not one of " + list + "; nearest: \"spectrum\"");
  EXPECT_EQ(refusal_with(R"("observables": [3])"), "/observables/0: 3 is not one of " + list);
  EXPECT_EQ(refusal_with(R"("observables": "spectrum")"),
            "/observables: \"spectrum\" is not a list of " + list);
  EXPECT_EQ(refusal_with(R"("observables": ["spectrum", "spectrum"])"),
            "/observables/1: \"spectrum\" stands twice; once is allowed");
}

TEST(SceneErrors, ExponentsAreRefusedWhereTheMotionHasNoLinearisedFlow) {
  EXPECT_EQ(
      refusal_with(R"("wear": {"rate": 1e-9}, "observables": ["lyapunov"])"),
      "/observables: \"lyapunov\" is not to be had; /wear: the motion under this effect has no linearised "
      "flow here; effects that have one: /unbalance, /gravity, /side_load, /support, "
      "/unequal_blades, /regularised_friction, /stribeck, /ring_body");
  EXPECT_EQ(
      refusal_with(R"("contact": {"law": "elastic_ring"}, "ring_body": {"mass": 0.0},
                            "observables": ["lyapunov"])"),
      "/observables: \"lyapunov\" is not to be had; /ring_body/mass: a ring without mass stands where the "
      "blades push it, and has no linearised flow here; allowed: a mass above 0");
  EXPECT_EQ(
      refusal_with(R"("accuracy": {"method": "fixed"}, "observables": ["lyapunov"])"),
      "/observables: \"lyapunov\" is not to be had; /accuracy/method: its steps do not follow the path of "
      "a contact; a linearised flow needs \"collocation\", \"hybrid\", \"hybrid_54\" or \"hybrid_32\"");
}

TEST(SceneErrors, OrbitsFoundByShootingNameNoEffectThatShootingRefuses) {
  const Scene scene = parse_scene(R"({"wear": {"rate": 1e-9}, "grid": {"speed_ratio": 0.5}})");
  EXPECT_EQ(refusal_of_shooting(scene).value_or("accepted"),
            "/wear: the motion under this effect has no linearised flow here; effects that have one: "
            "/unbalance, /gravity, /side_load, /support, /regularised_friction, /stribeck");
}

TEST(SceneErrors, ObservablesThatTheRotorDoesNotHaveAreRefused) {
  EXPECT_EQ(refusal_with(R"("contact": {"law": "elastic_ring"}, "observables": ["max_root_stress"])"),
            "/observables: \"max_root_stress\" is that of blades that bend; under the contact law "
            "\"elastic_ring\" they are rigid");
  EXPECT_EQ(refusal_with(R"("support": {"stiffness_xx": 10.0}, "observables": ["drive_torque"])"),
            "/observables: \"drive_torque\" does not know what the matrices of /support take and give");
  EXPECT_EQ(refusal_with(R"("support": {"stiffness_xx": 10.0}, "observables": ["viscous_power"])"),
            "/observables: \"viscous_power\" does not know what the matrices of /support take and give");
  EXPECT_EQ(refusal_with(R"("speed_ripple": {"amplitude": 0.1}, "observables": ["deformation_power"])"),
            "/observables: \"deformation_power\" is that of a constant speed, not of /speed_ripple");
}

TEST(SceneErrors, LongValuesAreCutInMessages) {
  const std::string text = refusal_with(R"("sweep": ")" + std::string(1000, 'u') + "\"");
  EXPECT_NE(text.find(std::string(59, 'u') + "... is not one of"), std::string::npos) << text;
}

TEST(SceneErrors, AFileThatCannotBeReadSaysWhy) {
  const auto why = [](const std::filesystem::path& path) -> std::string {
    try {
      read_text(path);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "read";
  };
  EXPECT_EQ(why("no/such/scene.json"), "cannot read the scene no/such/scene.json: No such file or directory");
  EXPECT_EQ(why("/"), "cannot read the scene /: it is a directory");
  EXPECT_EQ(why("/dev/zero"), "cannot read the scene /dev/zero: it is longer than 64 MiB");
}

}  // namespace
}  // namespace rubatlas::settings
