// The command: from an atlas to its text, its Markdown and its maps.
#include "analysis/analyse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <string>

#include "analysis/report.hpp"
#include "analysis/report_parts.hpp"
#include "analysis/text_layout.hpp"
#include "atlas/environment_error.hpp"
#include "atlas/hdf5.hpp"
#include "settings/reader.hpp"
#include "synthetic_atlas.hpp"
#include "tests/atlas/scratch.hpp"

namespace rubatlas::analysis {
namespace {

const std::string kScene = R"({
  "title": "synthetic", "reference": "none",
  "grid": {"speed_ratio": {"from": 0.05, "to": 0.95, "count": 91}, "damping_ratio": [0.1, 0.3]},
  "protocol": {"transient_revolutions": 2, "sampled_revolutions": 40, "samples_per_revolution": 32},
  "observables": ["poincare", "poincare_blade_passing", "max_displacement"]})";

std::string with(std::string text, const std::string& old_part, const std::string& new_part) {
  const auto at = text.find(old_part);
  EXPECT_NE(at, std::string::npos) << old_part;
  return text.replace(at, old_part.size(), new_part);
}

class Analyse : public atlas::testing::Scratch {
 protected:
  /// What the command prints.
  std::string run(const std::string& name, const std::optional<std::filesystem::path>& table = std::nullopt) {
    return analyse(file(name), file("maps.h5"), table, true);
  }
};

TEST_F(Analyse, WritesTheClassOfEveryPointOnTheAxesOfTheAtlas) {
  write_atlas(file("atlas.h5"), kScene, papers_point);
  run("atlas.h5");
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  const auto classes = maps.dataset("class");
  EXPECT_EQ(classes.shape(), (atlas::Shape{1, 1, 1, 2, 91}));
  const auto values = classes.read<std::uint8_t>();
  const auto speeds = maps.dataset("speed_ratio").read<double>();
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(values[i], papers_point({.speed_ratio = speeds[i % 91]}).motion);
  }
  const std::array names{"thickness", "unbalance", "friction", "damping_ratio", "speed_ratio"};
  for (std::size_t axis = 0; axis < names.size(); ++axis) EXPECT_EQ(classes.scale_name(axis), names[axis]);
  EXPECT_DOUBLE_EQ(classes.number("relative_tolerance"), 1e-6);
  EXPECT_DOUBLE_EQ(classes.number("absolute_tolerance"), 100.0 * 1e-9 * 0.01);
  EXPECT_EQ(maps.dataset("class_blade_passing").shape(), classes.shape());
  EXPECT_EQ(maps.dataset("max_displacement").read<double>()[0], 1e-4);
}

TEST_F(Analyse, WritesOneRowOfTheTablePerLine) {
  write_atlas(file("atlas.h5"), kScene, papers_point);
  run("atlas.h5");
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  const auto column = [&](const std::string& name) { return maps.dataset("table1/" + name).read<double>(); };
  EXPECT_EQ(column("at_damping_ratio"), (std::vector<double>{0.1, 0.3}));
  EXPECT_EQ(column("at_friction"), (std::vector<double>{0.1, 0.1}));
  EXPECT_EQ(column("at_unbalance"), (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(column("at_thickness"), (std::vector<double>{1e-3, 1e-3}));
  EXPECT_NEAR(column("region_2_from")[0], 0.34, 1e-12);
  EXPECT_NEAR(column("region_2_to")[0], 0.54, 1e-12);
  EXPECT_DOUBLE_EQ(column("region_2_aperiodic_share")[0], 1.0);
  EXPECT_DOUBLE_EQ(column("region_2_peak_displacement")[0], 1e-2);
  EXPECT_NEAR(column("region_4_from")[1], 0.67, 1e-12);
  EXPECT_NEAR(column("trigger_1_speed_ratio")[0], 0.335, 1e-12);
  EXPECT_NEAR(column("trigger_1_rise")[0], 9.9e-3, 1e-12);
  EXPECT_EQ(maps.dataset("table1/region_3_presence").read<std::uint8_t>(), (std::vector<std::uint8_t>{2, 2}));
  EXPECT_EQ(maps.dataset("table1/region_1_from").scale_name(0), "table1/line");
}

/// A text on one line, whatever the width of its paragraphs.
std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char letter : text) {
    const bool blank = letter == ' ' || letter == '\n';
    if (!blank || (!line.empty() && line.back() != ' ')) line += blank ? ' ' : letter;
  }
  return line;
}

const std::string kStarts = R"({
  "grid": {"speed_ratio": [0.3, 0.4], "/initial/x": [-1e-3, 0, 1e-3]}, "sweep": "independent",
  "protocol": {"transient_revolutions": 2, "sampled_revolutions": 40, "samples_per_revolution": 32},
  "observables": ["poincare", "max_displacement"]})";

/// At the lower speed the shaft at rest alone leads to period 1; at the higher one all do.
PrescribedPoint from_start(const plan::PointParameters& at) {
  if (at.speed_ratio < 0.35 && at.swept.front() != 0.0) return {3, 1e-3};
  return {1, 2e-3};
}

TEST_F(Analyse, FindsTheAttractorsThatInitialStatesLeadToAndTheirShares) {
  write_atlas(file("atlas.h5"), kStarts, from_start);
  const auto text = on_one_line(run("atlas.h5"));
  for (const auto* part :
       {"BASINS OF ATTRACTION",
        "Ω = 0.3: attractor 1, period 3, from 66.7 % ± 27.2 %, up to 1 mm; attractor 2, period 1, from 33.3 "
        "% "
        "± 27.2 %, up to 2 mm.",
        "All initial states lead to one attractor at 1 of the 2 combinations of the other parameters."}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  }
  EXPECT_EQ(text.find("REGIONS AND TRIGGERS"), std::string::npos) << "these are about lines from one state";
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  const auto attractor = maps.dataset("attractor");
  EXPECT_EQ(attractor.shape(), (atlas::Shape{3, 1, 1, 1, 1, 2}));
  EXPECT_EQ(attractor.scale_name(0), "initial_x");
  EXPECT_EQ(attractor.read<std::int32_t>(), (std::vector<std::int32_t>{1, 1, 2, 1, 1, 1}));
  EXPECT_DOUBLE_EQ(attractor.number("relative_tolerance"), 1e-4);
  EXPECT_DOUBLE_EQ(attractor.number("absolute_tolerance"), 100.0 * 100.0 * 1e-9 * 0.01);
  EXPECT_EQ(attractor.number("standard_errors"), 2.0);
  EXPECT_EQ(maps.dataset("basins/at_speed_ratio").read<double>(), (std::vector<double>{0.3, 0.3, 0.4}));
  EXPECT_EQ(maps.dataset("basins/attractor").read<std::int32_t>(), (std::vector<std::int32_t>{1, 2, 1}));
  EXPECT_EQ(maps.dataset("basins/class").read<std::uint8_t>(), (std::vector<std::uint8_t>{3, 1, 1}));
  EXPECT_EQ(maps.dataset("basins/points").read<std::int32_t>(), (std::vector<std::int32_t>{2, 1, 3}));
  EXPECT_DOUBLE_EQ(maps.dataset("basins/share").read<double>()[0], 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(maps.dataset("basins/standard_error").read<double>()[0], std::sqrt(2.0 / 27.0));
  EXPECT_EQ(maps.dataset("basins/standard_error").read<double>()[2], 0.0);
  EXPECT_EQ(maps.dataset("table1/at_initial_x").read<double>(), (std::vector<double>{-1e-3, 0.0, 1e-3}));
}

TEST_F(Analyse, AnAtlasWithoutDisplacementsHasNoAttractorsAndSaysSo) {
  write_atlas(file("atlas.h5"), with(kStarts, R"(, "max_displacement")", ""), from_start);
  const auto text = on_one_line(run("atlas.h5"));
  EXPECT_NE(text.find("The atlas has not both `poincare` and `max_displacement`: no attractors."),
            std::string::npos)
      << text;
}

TEST_F(Analyse, FindsWhereTheSweepsUpAndDownEndOnOtherMotions) {
  const auto scene = with(with(with(kStarts, R"("independent")", R"("both")"),
                               R"(, "/initial/x": [-1e-3, 0, 1e-3])", R"(, "damping_ratio": [0.1, 0.2])"),
                          "[0.3, 0.4]", R"({"from": 0.3, "to": 0.8, "count": 6})");
  std::size_t point = 0;
  write_atlas(file("atlas.h5"), scene, [&](const plan::PointParameters& at) -> PrescribedPoint {
    const bool down = point++ >= 12;
    const bool within = at.damping_ratio > 0.15 && at.speed_ratio > 0.45 && at.speed_ratio < 0.65;
    if (within) return {static_cast<std::uint8_t>(down ? 5 : 2), down ? 3e-3 : 1e-3};
    return {1, 1e-3};
  });
  const auto text = on_one_line(run("atlas.h5", file("table.md")));
  const std::string range = "ζ = 0.2, Ω from 0.5 to 0.6 (2 points): up period 2, down period 5.";
  EXPECT_NE(text.find("WHERE UP AND DOWN DIFFER The same motion at 10 of 12 points compared. " + range),
            std::string::npos)
      << text;
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  EXPECT_EQ(maps.dataset("hysteresis/at_damping_ratio").read<double>(), (std::vector<double>{0.2}));
  EXPECT_EQ(maps.dataset("hysteresis/from").read<double>(), (std::vector<double>{0.5}));
  EXPECT_EQ(maps.dataset("hysteresis/to").read<double>(), (std::vector<double>{0.6}));
  EXPECT_EQ(maps.dataset("hysteresis/points").read<std::int32_t>(), (std::vector<std::int32_t>{2}));
  EXPECT_EQ(maps.dataset("hysteresis/up").read<std::uint8_t>(), (std::vector<std::uint8_t>{2}));
  EXPECT_EQ(maps.dataset("hysteresis/down").read<std::uint8_t>(), (std::vector<std::uint8_t>{5}));
  const auto attractor = maps.dataset("attractor").read<std::int32_t>();
  EXPECT_EQ(std::ranges::count(attractor, 2), 2) << "the down sweep's, where it differs";
}

TEST_F(Analyse, AnAxisNamedByItsPointerIsAParameterAsAnyOther) {
  const auto scene =
      with(with(kScene, R"("damping_ratio": [0.1, 0.3])", R"("/ring/stiffness": [1e3, 1e4])"),
           R"("reference": "none",)", R"("reference": "none", "contact": {"law": "elastic_ring"},)");
  write_atlas(file("atlas.h5"), scene, [](const plan::PointParameters& at) {
    return at.swept.front() < 5e3 && at.speed_ratio > 1.0 / 3.0 ? PrescribedPoint{1, 1e-3} : papers_point(at);
  });
  const auto text = run("atlas.h5");
  for (const auto* part : {"Contact law: elastic_ring, 1000 to 10000 N/m", "kr = 1000 N/m, 10000 N/m",
                           "As kr grows (h = 1 mm, me = 0 kg m, μ = 0.1, ζ = 0.1)",
                           "region 2   absent at kr = 1000 N/m; 0.340-0.540 at kr = 10000 N/m"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  }
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  EXPECT_EQ(maps.dataset("class").shape(), (atlas::Shape{2, 1, 1, 1, 1, 91}));
  EXPECT_EQ(maps.dataset("class").scale_name(0), "ring_stiffness");
  EXPECT_EQ(maps.root().text("atlas_identifier"),
            atlas::File::open_to_read(file("atlas.h5")).root().text("identifier"));
  EXPECT_EQ(maps.dataset("table1/at_ring_stiffness").read<double>(), (std::vector<double>{1e3, 1e4}));
  EXPECT_EQ(maps.dataset("table1/at_ring_stiffness").text("units"), "N/m");
  EXPECT_EQ(maps.dataset("table1/region_2_presence").read<std::uint8_t>(), (std::vector<std::uint8_t>{1, 2}));
}

TEST_F(Analyse, TheClosingToleranceFollowsASweptClearance) {
  write_atlas(file("atlas.h5"),
              with(kScene, R"("damping_ratio": [0.1, 0.3])", R"("/ring/radius": [0.11, 0.12, 0.15])"),
              papers_point);
  const auto found = examine(atlas::AtlasReader(file("atlas.h5")));
  ASSERT_EQ(found.tolerance.size(), 3U);
  const std::array clearances{0.01, 0.02, 0.05};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.tolerance[i].floor, 100.0 * 1e-9 * clearances[i], 1e-20);
  }
}

TEST_F(Analyse, PrintsRegionsAndSensitivitiesAndWritesThemAsMarkdown) {
  write_atlas(file("atlas.h5"), kScene, [](const plan::PointParameters& at) {
    return at.damping_ratio > 0.2 && at.speed_ratio > 1.0 / 3.0 ? PrescribedPoint{1, 1e-3} : papers_point(at);
  });
  const auto text = run("atlas.h5", file("table.md"));
  for (const auto* part :
       {"Contact law: elastica (elastic blades, stiff ring); 3 blades.", "Points: 182 of 182 done.",
        "0.340-0.540", "As ζ grows (h = 1 mm, me = 0 kg m, μ = 0.1)",
        "region 2   absent at ζ = 0.3; 0.340-0.540 at ζ = 0.1"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  }
  const auto markdown = bytes(file("table.md"));
  for (const auto* part :
       {"# synthetic", "| ζ | region 1 | trigger 1 | region 2 | region 3 | trigger 2 | region 4 |",
        "| 0.1 | (0.050)-0.330<br>0 %, 0.1 mm |", "| region 2 | absent at ζ = 0.3;"}) {
    EXPECT_NE(markdown.find(part), std::string::npos) << part << "\nin\n" << markdown;
  }
}

TEST_F(Analyse, SaysWhatBendsAndWhatYieldsUnderEachContactLaw) {
  for (const auto& [section, said] :
       {std::pair{R"("contact": {"law": "elastic_ring"})",
                  "elastic_ring, 10000 N/m (rigid blades, yielding ring)"},
        std::pair{R"("contact": {"law": "beam_column"})",
                  "beam_column (elastic blades of small slopes, stiff ring)"},
        std::pair{R"("yielding_ring": {"compliance": 1e-3})", "elastica (elastic blades, yielding ring)"}}) {
    write_atlas(file("atlas.h5"), with(kScene, R"("reference": "none")", section), papers_point);
    const auto text = run("atlas.h5");
    EXPECT_NE(text.find(said), std::string::npos) << said << "\nin\n" << text;
    std::filesystem::remove(file("atlas.h5"));
    std::filesystem::remove(file("maps.h5"));
  }
}

TEST_F(Analyse, SaysWhereBladesTouch) {
  const auto scene = with(with(kScene, R"("reference": "none",)", R"("rotor": {"mass": 2},)"),
                          R"("max_displacement"])", R"("max_displacement", "contact_fraction"])");
  write_atlas(file("atlas.h5"), scene, [](const plan::PointParameters& at) {
    auto point = papers_point(at);
    if (at.damping_ratio > 0.2 || at.speed_ratio < 0.305) point.displacement = 0.0;  // so is the contact
    return point;
  });
  const auto text = on_one_line(run("atlas.h5", file("table.md")));
  const auto markdown = bytes(file("table.md"));
  for (const auto* part : {"Contact: at 65 of 182 points, none at 117.", "ζ = 0.1: first contact at Ω = 0.31",
                           "ζ = 0.3: no contact"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
    EXPECT_NE(markdown.find(part), std::string::npos) << part << "\nin\n" << markdown;
  }
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  EXPECT_EQ(maps.root().text("schema_version"), "6");
  const auto contact = maps.dataset("contact").read<std::uint8_t>();
  EXPECT_EQ(std::ranges::count(contact, 2), 65);
  EXPECT_EQ(std::ranges::count(contact, 1), 117);
  EXPECT_NEAR(maps.dataset("table1/first_contact").read<double>()[0], 0.31, 1e-12);
  EXPECT_EQ(maps.dataset("table1/region_1_presence").read<std::uint8_t>()[1], 1) << "absent";
}

TEST_F(Analyse, TheMapsSayHowManyPointsTheAtlasHadFinished) {
  write_atlas(file("atlas.h5"), kScene, [](const plan::PointParameters& at) {
    return PrescribedPoint{1, at.damping_ratio > 0.2 ? 1e-4 : 2e-3};
  });
  static_cast<void>(run("atlas.h5"));
  const auto finished =
      std::ranges::count_if(atlas::AtlasReader(file("atlas.h5")).status(), [](auto one) { return one != 0; });
  EXPECT_EQ(atlas::File::open_to_read(file("maps.h5")).root().number("points_finished"),
            static_cast<double>(finished));
}

TEST_F(Analyse, SaysBeforeWhichLimitSignsWereFoundLineByLine) {
  const auto scene = with(with(kScene, R"("count": 91)", R"("count": 181)"), R"("max_displacement"])",
                          R"("max_displacement", "spectrum"])");
  write_atlas(file("atlas.h5"), scene, [](const plan::PointParameters& at) {
    if (at.damping_ratio > 0.2) return PrescribedPoint{1, 1e-4};
    return PrescribedPoint{1, at.speed_ratio < 0.2975 ? 1e-4 : at.speed_ratio < 0.3975 ? 2e-3 : 8e-3};
  });
  const auto text = on_one_line(run("atlas.h5", file("table.md")));
  EXPECT_NE(
      text.find("ζ = 0.1: 5 mm passed at Ω = 0.400: 3× line from 0.310 (22.5 % earlier), broad band from"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("ζ = 0.3: 5 mm never passed."), std::string::npos) << text;
  EXPECT_NE(bytes(file("table.md")).find("## Signs before the limit"), std::string::npos);
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  EXPECT_NEAR(maps.dataset("signature/limit").read<double>()[1], 5e-3, 1e-15);
  EXPECT_NEAR(maps.dataset("signature/announced_speed_ratio").read<double>()[0], 0.31, 1e-9);
  EXPECT_EQ(maps.dataset("signs/passing_line").shape(), (atlas::Shape{1, 1, 1, 2, 181}));
  const auto other = examine(atlas::AtlasReader(file("atlas.h5")), *parse_limit("1 mm"));
  EXPECT_NEAR(other.signatures[0].limit_speed_ratio, 0.3, 1e-9);
}

TEST_F(Analyse, SaysThatSignsAreNotCoveredWhereNothingIsKnownBelowTheLimit) {
  const auto scene = with(kScene, R"("max_displacement"])", R"("max_displacement", "spectrum"])");
  write_atlas(file("atlas.h5"), scene, [](const plan::PointParameters& at) {
    const bool starts_beyond = at.damping_ratio < 0.2;
    if (!starts_beyond && at.speed_ratio < 0.355) return PrescribedPoint{motion_class::kNone};
    return PrescribedPoint{1, starts_beyond || at.speed_ratio > 0.395 ? 8e-3 : 1e-4};
  });
  const auto text = on_one_line(run("atlas.h5"));
  EXPECT_NE(text.find("ζ = 0.1: 5 mm passed at Ω = 0.050 at the latest: signs before are not covered."),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("ζ = 0.3: 5 mm passed at Ω = 0.400: signs before are not covered."), std::string::npos)
      << text;
}

TEST_F(Analyse, DoesNotSayThatALimitIsNeverPassedWhereSpeedsArePending) {
  const auto scene = with(kScene, R"("max_displacement"])", R"("max_displacement", "spectrum"])");
  write_atlas(file("atlas.h5"), scene, [](const plan::PointParameters& at) {
    const bool is_pending = at.damping_ratio < 0.2 && at.speed_ratio > 0.8;
    return PrescribedPoint{is_pending ? motion_class::kNone : std::uint8_t{1}, 1e-4};
  });
  const auto text = on_one_line(run("atlas.h5"));
  EXPECT_NE(text.find("ζ = 0.1: 5 mm passed at no speed that is done; some are not."), std::string::npos)
      << text;
  EXPECT_NE(text.find("ζ = 0.3: 5 mm never passed."), std::string::npos) << text;
}

TEST_F(Analyse, SaysNothingOfSignsOnALineWithoutAPoint) {
  const auto scene = with(kScene, R"("max_displacement"])", R"("max_displacement", "spectrum"])");
  const auto said = [&](const std::string& name, double least_damping) {
    write_atlas(file(name), scene, [&](const plan::PointParameters& at) {
      PrescribedPoint point{1, 1e-4};
      if (at.damping_ratio > least_damping) point.status = ending::PointStatus::left_validity;
      return point;
    });
    return on_one_line(run(name));
  };
  const auto half = said("half.h5", 0.2);
  EXPECT_NE(half.find("ζ = 0.1: 5 mm never passed."), std::string::npos) << half;
  EXPECT_EQ(half.find("5 mm passed at"), std::string::npos) << half;
  EXPECT_EQ(said("none.h5", 0.0).find("SIGNS BEFORE"), std::string::npos);
}

TEST_F(Analyse, KeepsToTheWidthOfATerminal) {
  write_atlas(file("atlas.h5"), kScene, papers_point);
  std::istringstream text(run("atlas.h5"));
  for (std::string line; std::getline(text, line);) EXPECT_LE(character_count(line), 110U) << line;
}

TEST_F(Analyse, CopesWithPendingAndFailedPoints) {
  write_atlas(file("atlas.h5"), kScene, [](const plan::PointParameters& at) {
    auto point = papers_point(at);
    if (at.damping_ratio > 0.2) point.motion = motion_class::kNone;                 // pending
    if (at.speed_ratio > 0.805) point.status = ending::PointStatus::left_validity;  // 15 speeds
    if (std::abs(at.speed_ratio - 0.2) < 1e-9) point.status = ending::PointStatus::integrator_failed;
    return point;
  });
  const auto text = run("atlas.h5");
  EXPECT_NE(
      text.find(
          "Points: 75 of 182 done, 91 pending, 15 left the model's validity, 1 failed in the integrator."),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("0.670-(0.800)"), std::string::npos) << text;
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  const auto values = maps.dataset("class").read<std::uint8_t>();
  const auto displacement = maps.dataset("max_displacement").read<double>();
  for (const std::size_t i : {15U, 76U, 90U, 91U, 181U}) {
    EXPECT_EQ(values[i], motion_class::kNone) << i;
    EXPECT_TRUE(std::isnan(displacement[i])) << i;
  }
  EXPECT_EQ(maps.dataset("table1/region_1_presence").read<std::uint8_t>(), (std::vector<std::uint8_t>{2, 0}));
  EXPECT_EQ(maps.dataset("table1/region_4_open").read<std::uint8_t>(), (std::vector<std::uint8_t>{2, 0}));
}

TEST(NotesOnEffects, AStaticSagIsTheLargestOfAnyLineAndLooksAtThoseAloneThatMoveIt) {
  const auto note = [](const std::string& axes) {
    const auto notes = notes_on_effects(settings::parse_scene(
        R"({"gravity": {"acceleration": 0.2}, "sweep": "independent", "grid": {"speed_ratio": 0.3)" + axes +
        "}}"));
    return notes.empty() ? "none" : notes.front().substr(0, notes.front().find(" and part"));
  };
  EXPECT_EQ(note(""), "f, the static sag, is up to 2 mm");
  EXPECT_EQ(note(R"(, "/gravity/acceleration": [0.01, 0.3, 0.5])"), "f, the static sag, is up to 5 mm");
  EXPECT_EQ(note(R"(, "/gravity/acceleration": [0.01, 0.05])"), "none");
  const auto begin = std::clock();
  EXPECT_EQ(
      note(R"(, "/gravity/acceleration": [0.3, 0.4], "/initial/x": {"from": 0, "to": 1e-4, "count": 300},
                 "damping_ratio": {"from": 0.05, "to": 0.3, "count": 1000})"),
      "f, the static sag, is up to 4 mm");
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_LT(seconds, 0.2) << "600 000 lines, of which two have a sag of their own";
}

TEST_F(Analyse, CopesWithAnAtlasOfWhichNothingIsDone) {
  write_atlas(file("atlas.h5"), kScene, [](const auto&) { return PrescribedPoint{motion_class::kNone}; });
  EXPECT_NE(run("atlas.h5").find("Points: 0 of 182 done, 182 pending."), std::string::npos);
}

TEST_F(Analyse, CopesWithASinglePoint) {
  const auto scene =
      with(with(kScene, R"({"from": 0.05, "to": 0.95, "count": 91})", "0.3"), "[0.1, 0.3]", "0.1");
  write_atlas(file("atlas.h5"), scene, papers_point);
  const auto text = run("atlas.h5");
  EXPECT_NE(text.find("Grid: Ω = 0.3; h = 1 mm;"), std::string::npos) << text;
  EXPECT_NE(text.find("not covered"), std::string::npos);
}

TEST_F(Analyse, CopesWithAnAtlasWithoutSectionsOrDisplacements) {
  write_atlas(file("atlas.h5"),
              with(kScene, R"("poincare", "poincare_blade_passing", "max_displacement")", R"("spectrum")"),
              papers_point);
  const auto text = run("atlas.h5");
  EXPECT_NE(text.find("no classes, and no regions"), std::string::npos) << text;
  EXPECT_NE(text.find("no triggers, and no displacements"), std::string::npos) << text;
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  for (const auto value : maps.dataset("class").read<std::uint8_t>()) EXPECT_EQ(value, motion_class::kNone);
  EXPECT_FALSE(maps.has("class_blade_passing"));
  EXPECT_FALSE(maps.has("max_displacement"));
}

TEST_F(Analyse, TreatsTheDirectionsOfASweepAsLines) {
  const auto scene =
      with(with(kScene, "[0.1, 0.3]", "0.1"), "\"protocol\"", "\"sweep\": \"both\", \"protocol\"");
  write_atlas(file("atlas.h5"), scene, papers_point);
  const auto text = run("atlas.h5");
  EXPECT_NE(text.find("\nup  "), std::string::npos) << text;
  EXPECT_NE(text.find("\ndown  "), std::string::npos) << text;
  EXPECT_EQ(text.find("As direction grows"), std::string::npos);
  const auto maps = atlas::File::open_to_read(file("maps.h5"));
  EXPECT_EQ(maps.dataset("class").shape(), (atlas::Shape{2, 1, 1, 1, 1, 91}));
  EXPECT_EQ(maps.dataset("table1/at_direction").read<double>(), (std::vector<double>{0.0, 1.0}));
}

TEST_F(Analyse, GivesTheSameBytesForTheSameAtlas) {
  write_atlas(file("atlas.h5"), kScene, papers_point);
  run("atlas.h5");
  const auto first = bytes(file("maps.h5"));
  run("atlas.h5");
  EXPECT_EQ(bytes(file("maps.h5")), first);
}

TEST_F(Analyse, RefusesToReplaceTheAtlas) {
  write_atlas(file("atlas.h5"), kScene, papers_point);
  const auto before = bytes(file("atlas.h5"));
  std::filesystem::create_symlink(file("atlas.h5"), file("link.h5"));
  EXPECT_THROW(analyse(file("atlas.h5"), file("atlas.h5"), std::nullopt, true), atlas::OutputRefusal);
  EXPECT_THROW(analyse(file("atlas.h5"), file("link.h5"), std::nullopt, true), atlas::OutputRefusal);
  EXPECT_THROW(analyse(file("atlas.h5"), file("maps.h5"), file("atlas.h5"), true), atlas::OutputRefusal);
  EXPECT_EQ(bytes(file("atlas.h5")), before);
}

TEST_F(Analyse, SaysWhatCannotBeReadOrWritten) {
  EXPECT_THROW(run("missing.h5"), atlas::EnvironmentError);
  write_atlas(file("atlas.h5"), kScene, papers_point);
  EXPECT_THROW(analyse(file("atlas.h5"), file("no/such/directory/maps.h5"), std::nullopt, false),
               atlas::EnvironmentError);
  EXPECT_THROW(run("atlas.h5", file("no/such/directory/table.md")), atlas::EnvironmentError);
}

/// Standard output of a Python program, or what it complained about.
std::string python(const std::string& program, const std::filesystem::path& script) {
  std::ofstream(script) << program;
  const auto command = "/usr/bin/python3 " + script.string() + " 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) output += buffer.data();
  ::pclose(pipe);
  return output;
}

TEST_F(Analyse, WritesMapsThatH5pyAndXarrayRead) {
  write_atlas(file("atlas.h5"), kScene, papers_point);
  run("atlas.h5");
  const auto output = python(R"(
import h5py, numpy, xarray
path = ")" + file("maps.h5").string() +
                                 R"("
with h5py.File(path) as maps:
    flags = maps["class"].attrs
    print(maps["class"].dtype, flags["flag_values"].dtype, len(flags["flag_meanings"].split()))
    print(maps["effects/text"][0].decode())
    print(maps["doublings/line"][:], maps["doublings/at_speed_ratio"][:].round(3), maps["doublings/period"][:])
    print(maps["doublings"].attrs["long_name"])
with xarray.open_dataset(path, engine="h5netcdf") as maps:
    print(int(maps["class"].sel(damping_ratio=0.3, speed_ratio=0.4, method="nearest").squeeze()))
table = xarray.open_dataset(path, engine="h5netcdf", group="table1").to_dataframe()
print(table.loc[1, "at_damping_ratio"], round(table.loc[1, "region_3_to"], 6))
print(len(xarray.open_dataset(path, engine="h5netcdf", group="effects")["subject"]))
)",
                             file("read.py"));
  EXPECT_EQ(output,
            "uint8 uint8 19\nknown as (0.050)-0.330 at every ζ\n[0 1] [0.655 0.655] [1 1]\n"
            "where the period of the map over a blade passing doubles\n255\n0.3 0.66\n6\n");
}

}  // namespace
}  // namespace rubatlas::analysis
