// Borders of a line, and the regions that end or begin at them.
#include "analysis/rules/borders.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "analysis/rules/evidence_text.hpp"
#include "analysis/rules/triggers.hpp"
#include "synthetic_line.hpp"

namespace rubatlas::analysis {
namespace {

std::vector<std::pair<std::size_t, std::size_t>> borders(const std::vector<std::uint8_t>& motion) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const auto& border : find_borders(motion)) found.emplace_back(border.below, border.above);
  return found;
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(Borders, LieBetweenNeighboursOfDifferentClass) {
  EXPECT_EQ(borders({1, 1, 2, 2, 255}), (Pairs{{1, 2}, {3, 4}}));
  EXPECT_EQ(borders({255, 255}), Pairs{});
  EXPECT_EQ(borders({}), Pairs{});
}

TEST(Borders, GoAcrossUnresolvedPointsAndNotAcrossPointsWithoutMotion) {
  EXPECT_EQ(borders({1, 254, 254, 2, 254}), (Pairs{{0, 3}}));
  EXPECT_EQ(borders({255, 254, 255}), Pairs{});
  EXPECT_EQ(borders({1, motion_class::kNone, 2, 3}), (Pairs{{2, 3}}));
}

TEST(Borders, IncludeThoseOfTheModelsValidity) {
  const auto left = motion_class::kLeftValidity;
  EXPECT_EQ(borders({1, left, left, 255}), (Pairs{{0, 1}, {2, 3}}));
  EXPECT_EQ(kind_of_border(1, left), BorderKind::validity);
  EXPECT_EQ(kind_of_border(left, 255), BorderKind::validity);
  EXPECT_EQ(kind_of_border(1, 3), BorderKind::period);
  EXPECT_EQ(kind_of_border(3, 255), BorderKind::onset);
  EXPECT_EQ(kind_of_border(255, 3), BorderKind::end);
}

TEST(Borders, KnowTheRegionsThatEndAndBeginThere) {
  const Line line = line_of(0.05, 901, four_regions());
  const auto triggers = find_triggers(line, kThreeBlades, 1e-8);
  auto regions = find_regions(line, kThreeBlades, triggers);
  std::size_t begins = 0;
  std::size_t ends = 0;
  for (auto& border : find_borders(line.motion)) {
    note_regions(border, line, regions);
    const std::array speeds{line.speed_ratio[border.below], line.speed_ratio[border.above]};
    const std::array motions{line.motion[border.below], line.motion[border.above]};
    const auto edges = edges_of(0, 7, border, EdgeSearch(speeds, motions, 1.0, true));
    ASSERT_EQ(edges.size(), 1U);
    const Edge& edge = edges.front();
    if (edge.region_begins > 0) {
      begins = 10 * begins + edge.region_begins;
      EXPECT_EQ(edge.upper, regions[edge.region_begins - 1U].from);
    }
    if (edge.region_ends > 0) ends = 10 * ends + edge.region_ends;
    narrow_ends(regions, edge);
  }
  EXPECT_EQ(begins, 234U);
  EXPECT_EQ(ends, 23U);  // region 1 ends at a trigger, region 4 with the line
  EXPECT_FALSE(regions[0].to_between.is_known());
  EXPECT_NEAR(regions[1].from_between.upper, 1.0 / 3.0, 1e-3);
  EXPECT_EQ(regions[1].to_between.lower, regions[2].from_between.lower);
}

TEST(Borders, OfSeveralEdgesARegionEndsAtTheFirstAndBeginsAtTheLast) {
  // Of a sweep down: period 1 above, period 2, then aperiodic motion.
  const Border border{.below = 10, .above = 12, .region_ends = 2, .region_begins = 3};
  const EdgeSearch search(std::vector{0.6, 0.59, 0.58}, std::vector<std::uint8_t>{1, 2, 255}, 0.1, true);
  const auto edges = edges_of(4, 7, border, search);
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_EQ(edges[0].lower, 0.58);
  EXPECT_EQ(edges[0].motion_below, 255);
  EXPECT_EQ(edges[0].motion_above, 2);
  EXPECT_EQ(edges[0].kind, BorderKind::end);
  EXPECT_EQ(edges[0].region_ends, 2);
  EXPECT_EQ(edges[0].region_begins, 0);
  EXPECT_EQ(edges[1].upper, 0.6);
  EXPECT_EQ(edges[1].kind, BorderKind::period);
  EXPECT_EQ(edges[1].region_begins, 3);
  EXPECT_EQ(edges[1].border, 7U);
  EXPECT_EQ(edges[1].line, 4U);
}

TEST(Borders, AreQuotedWithTheUncertaintyOfTheirLastDigit) {
  EXPECT_EQ(speed_text({0.4393411, 0.4393419}), "0.4393415(4)");
  EXPECT_EQ(speed_text({0.25, 0.75}), "0.5(3)");
  EXPECT_EQ(speed_text({0.44, 0.44}), "0.44");
  // Rounding included, the interval is covered.
  EXPECT_EQ(speed_text({0.43934055, 0.43934145}), "0.4393410(5)");
}

}  // namespace
}  // namespace rubatlas::analysis
