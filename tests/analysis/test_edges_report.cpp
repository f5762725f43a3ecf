// What is told of the edges of motions.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "analysis/edges_report.hpp"
#include "plan/grid.hpp"
#include "settings/reader.hpp"

namespace rubatlas::analysis {
namespace {

/// Of a line from 0.6 to 0.7.
Findings found_with(std::vector<Edge> edges) {
  Findings found;
  found.scene = settings::parse_scene(R"({"grid": {"speed_ratio": [0.6, 0.7]}})");
  found.axes = plan::Grid(found.scene).axes();
  found.lines.resize(1);
  found.edges = EdgeTable{1e-6, false, std::move(edges)};
  return found;
}

TEST(EdgesReport, SaysThatThereAreNoBorders) {
  EXPECT_EQ(edge_sentences(found_with({})), std::vector<std::string>{"Edges: none; there are no borders."});
}

TEST(EdgesReport, OfAMotionThatIsLostInShorterStepsNamesTheSpeedsBetween) {
  const Edge edge{.motion_below = 1,
                  .motion_above = 2,
                  .region_begins = 3,
                  .lower = 0.65,
                  .upper = 0.7,
                  .outcome = EdgeOutcome::overrun};
  EXPECT_EQ(
      edge_sentences(found_with({edge})).front(),
      "region 3 begins between Ω = 0.650000 and 0.700000, or behind it: a sweep in shorter steps finds at "
      "Ω = 0.7 another motion than the atlas: period 1 below, period 2 above.");
}

TEST(EdgesReport, OfAMotionThatIsLostAtTheLastSpeedNamesThatSpeedAlone) {
  const Edge edge{.motion_below = 1,
                  .motion_above = 2,
                  .region_begins = 3,
                  .lower = 0.7,
                  .upper = 0.7,
                  .outcome = EdgeOutcome::overrun};
  EXPECT_EQ(
      edge_sentences(found_with({edge})).front(),
      "region 3 begins at Ω = 0.7, or behind it: a sweep in shorter steps finds at Ω = 0.7 another motion "
      "than the atlas: period 1 below, period 2 above.");
}

}  // namespace
}  // namespace rubatlas::analysis
