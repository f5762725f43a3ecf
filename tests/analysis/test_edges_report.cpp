// What is told of the edges of motions.
#include <gtest/gtest.h>

#include <string>
#include <utility>
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

/// What is told of region 3, which a sweep in shorter steps no longer finds, from this speed to the last.
std::string lost_from(double speed) {
  const Edge edge{.motion_below = 1,
                  .motion_above = 2,
                  .region_begins = 3,
                  .lower = speed,
                  .upper = 0.7,
                  .outcome = EdgeOutcome::overrun};
  return edge_sentences(found_with({edge})).front();
}

TEST(EdgesReport, OfAMotionThatIsLostInShorterStepsNamesTheSpeedsBetween) {
  EXPECT_EQ(
      lost_from(0.65),
      "region 3 begins between Ω = 0.650000 and 0.700000, or behind it: a sweep in shorter steps finds at "
      "Ω = 0.7 another motion than the atlas: period 1 below, period 2 above.");
}

TEST(EdgesReport, OfAMotionThatIsLostAtTheLastSpeedNamesThatSpeedAlone) {
  EXPECT_EQ(
      lost_from(0.7),
      "region 3 begins at Ω = 0.7, or behind it: a sweep in shorter steps finds at Ω = 0.7 another motion "
      "than the atlas: period 1 below, period 2 above.");
}

}  // namespace
}  // namespace rubatlas::analysis
