// The search for an edge, on motions that are prescribed.
#include "analysis/rules/edge_search.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {
namespace {

constexpr double kResolution = 1e-6;

/// The class that a sweep finds at a speed, arriving from another one with another class.
using Finds = std::function<std::uint8_t(double speed, double from, std::uint8_t motion_there)>;

/// Carries a search out to its end; returns the number of rounds.
std::size_t carry_out(EdgeSearch& search, std::vector<double> speeds, std::vector<std::uint8_t> motions,
                      const Finds& finds) {
  std::size_t rounds = 0;
  for (auto requests = search.next(); !requests.empty(); requests = search.next()) {
    std::vector<std::uint8_t> found;
    for (const auto& [speed, from] : requests) {
      found.push_back(finds(speed, speeds.at(from), motions.at(from)));
      speeds.push_back(speed);
      motions.push_back(found.back());
    }
    search.take(found);
    ++rounds;
  }
  return rounds;
}

FoundEdge only_edge(const EdgeSearch& search) {
  EXPECT_EQ(search.edges().size(), 1U);
  return search.edges().front();
}

Finds by_speed(const std::function<std::uint8_t(double)>& motion) {
  return [motion](double speed, double, std::uint8_t) { return motion(speed); };
}

TEST(EdgeSearch, FindsAnEdgeToTheResolution) {
  for (const double edge : {0.4400001, 0.4403337, 0.4408999}) {
    const std::vector<double> speeds{0.44, 0.441};
    const std::vector<std::uint8_t> motions{1, 255};
    EdgeSearch search(speeds, motions, kResolution, true);
    EXPECT_EQ(search.expected_points(), 15U);
    carry_out(search, speeds, motions, by_speed([&](double speed) { return speed < edge ? 1 : 255; }));
    EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::sharp);
    EXPECT_LT(only_edge(search).near_speed, edge);
    EXPECT_GE(only_edge(search).far_speed, edge);
    EXPECT_LE(only_edge(search).far_speed - only_edge(search).near_speed, kResolution);
    EXPECT_LE(search.points(), 16U);  // five rounds of three, and once more from next to the edge
    EXPECT_EQ(search.expected_points(), 0U);
  }
}

TEST(EdgeSearch, OfASweepDownArrivesFromAbove) {
  const std::vector<double> speeds{0.441, 0.44};
  const std::vector<std::uint8_t> motions{1, 255};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, [](double speed, double from, std::uint8_t) -> std::uint8_t {
    EXPECT_GT(from, speed);
    return speed > 0.4402 ? 1 : 255;
  });
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::sharp);
  EXPECT_GT(only_edge(search).near_speed, 0.4402);
  EXPECT_LE(only_edge(search).far_speed, 0.4402);
}

TEST(EdgeSearch, AsksForNothingWhereTheGridIsFineEnough) {
  EdgeSearch search(std::vector{0.44, 0.441}, std::vector<std::uint8_t>{1, 2}, 1e-3 + 1e-12, true);
  EXPECT_TRUE(search.next().empty());
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::sharp);
  EXPECT_EQ(search.points(), 0U);
}

TEST(EdgeSearch, FollowsAMotionThatOnlyShortStepsKeep) {
  // The motion lives up to 0.4408, but the closer to its end, the shorter the step that does not lose it.
  const std::vector<double> speeds{0.44, 0.441};
  const std::vector<std::uint8_t> motions{1, 255};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, [](double speed, double from, std::uint8_t there) -> std::uint8_t {
    const bool keeps = there == 1 && speed < 0.4408 && speed - from < 0.3 * (0.4408 - from) + kResolution;
    return keeps ? 1 : 255;
  });
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::sharp);
  EXPECT_NEAR(only_edge(search).near_speed, 0.4408, 2.0 * kResolution);
  EXPECT_LE(only_edge(search).far_speed - only_edge(search).near_speed, kResolution);
}

TEST(EdgeSearch, SaysWhereShorterStepsPassTheLastSpeed) {
  const std::vector<double> speeds{0.44, 0.441};
  const std::vector<std::uint8_t> motions{1, 255};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, [](double speed, double from, std::uint8_t there) -> std::uint8_t {
    return there == 1 && speed - from < 8e-4 ? 1 : 255;
  });
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::overrun);
  EXPECT_EQ(only_edge(search).far_speed, 0.441);
}

TEST(EdgeSearch, SaysWhereShorterStepsFindAThirdMotionAtTheLastSpeed) {
  const std::vector<double> speeds{0.44, 0.441};
  const std::vector<std::uint8_t> motions{1, 255};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions,
            by_speed([](double speed) -> std::uint8_t { return speed < 0.4403 ? 1 : 3; }));
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::overrun);
  EXPECT_NEAR(only_edge(search).near_speed, 0.4403, kResolution);
  EXPECT_EQ(only_edge(search).far_motion, 255);
}

TEST(EdgeSearch, SaysWhereTheLastSpeedIsUnresolvedInShorterSteps) {
  const std::vector<double> speeds{0.44, 0.441};
  const std::vector<std::uint8_t> motions{1, 255};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, by_speed([](double speed) -> std::uint8_t {
              return speed < 0.441 ? 1 : motion_class::kUnresolved;
            }));
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::slow);
  EXPECT_EQ(only_edge(search).near_motion, 1);
  EXPECT_EQ(only_edge(search).far_motion, 255);
  EXPECT_NEAR(only_edge(search).near_speed, 0.441, kResolution);
  EXPECT_EQ(only_edge(search).far_speed, 0.441);
}

TEST(EdgeSearch, WithoutASweepTriesNoSpeedTwice) {
  const std::vector<double> speeds{0.44, 0.441};
  const std::vector<std::uint8_t> motions{1, 255};
  EdgeSearch search(speeds, motions, kResolution, false);
  carry_out(search, speeds, motions, by_speed([](double speed) { return speed < 0.4401 ? 1 : 255; }));
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::sharp);
  EXPECT_EQ(search.points(), 15U);
}

TEST(EdgeSearch, ReportsMotionsThatSettleTooSlowlyWithTheirExtent) {
  const std::vector<double> speeds{0.66, 0.661};
  const std::vector<std::uint8_t> motions{1, 2};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, by_speed([](double speed) -> std::uint8_t {
              if (std::abs(speed - 0.66043) < 2e-5) return motion_class::kUnresolved;
              return speed < 0.66043 ? 1 : 2;
            }));
  // Seen only if a quarter, or a quarter of it, falls there.
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::slow);
  EXPECT_NEAR(only_edge(search).near_speed, 0.66041, kResolution);
  EXPECT_NEAR(only_edge(search).far_speed, 0.66045, kResolution);
}

TEST(EdgeSearch, FindsTheEdgesOfACascadeWithinOneStepOfTheGrid) {
  const std::vector<double> speeds{0.5, 0.501};
  const std::vector<std::uint8_t> motions{1, 255};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, by_speed([](double speed) -> std::uint8_t {
              if (speed < 0.50021) return 1;
              if (speed < 0.50067) return 2;
              return speed < 0.50077 ? 4 : 255;
            }));
  const auto edges = search.edges();
  ASSERT_EQ(edges.size(), 3U);
  const std::array places{0.50021, 0.50067, 0.50077};
  const std::array<std::uint8_t, 3> behind{2, 4, 255};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(edges[i].outcome, EdgeOutcome::sharp);
    EXPECT_LT(edges[i].near_speed, places[i]);
    EXPECT_GE(edges[i].far_speed, places[i]);
    EXPECT_LE(edges[i].far_speed - edges[i].near_speed, kResolution);
    EXPECT_EQ(edges[i].far_motion, behind[i]);
  }
}

TEST(EdgeSearch, ReportsABorderThatGoesOnDividingWithItsExtent) {
  // Between 0.50021 and 0.50083 windows of period 3 and of period 1 follow each other closely.
  const std::vector<double> speeds{0.5, 0.501};
  const std::vector<std::uint8_t> motions{1, 255};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, by_speed([](double speed) -> std::uint8_t {
              if (speed < 0.50021) return 1;
              if (speed >= 0.50083) return 255;
              const double place = (speed - 0.50021) / 3.1e-5;
              return place - std::floor(place) < 0.6 ? 3 : 1;
            }));
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::divided);
  EXPECT_NEAR(only_edge(search).near_speed, 0.50021, kResolution);
  EXPECT_NEAR(only_edge(search).far_speed, 0.50083, kResolution);
  EXPECT_LT(search.points(), EdgeSearch::kMostPoints);
}

TEST(EdgeSearch, TellsNothingFromAMotionThatIsUnresolvedForAWhile) {
  const std::vector<double> speeds{0.5, 0.501};
  const std::vector<std::uint8_t> motions{255, 1};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, by_speed([](double speed) -> std::uint8_t {
              if (speed > 0.50022 && speed < 0.50028) return motion_class::kUnresolved;
              return speed < 0.50067 ? 255 : 1;
            }));
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::sharp);
  EXPECT_NEAR(only_edge(search).near_speed, 0.50067, kResolution);
}

TEST(EdgeSearch, TakesUnresolvedPointsOfTheGridForWhatTheyAre) {
  const std::vector<double> speeds{0.50, 0.51, 0.52, 0.53};
  const std::vector<std::uint8_t> motions{1, 254, 254, 2};
  EdgeSearch search(speeds, motions, kResolution, true);
  carry_out(search, speeds, motions, by_speed([](double speed) -> std::uint8_t {
              if (speed < 0.503) return 1;
              return speed < 0.5222 ? motion_class::kUnresolved : 2;
            }));
  EXPECT_EQ(only_edge(search).outcome, EdgeOutcome::slow);
  EXPECT_NEAR(only_edge(search).near_speed, 0.503, kResolution);
  EXPECT_NEAR(only_edge(search).far_speed, 0.5222, kResolution);
}

TEST(EdgeSearch, EndsWhereEverySpeedHasAMotionOfItsOwn) {
  const std::vector<double> speeds{0.5, 0.6};
  const std::vector<std::uint8_t> motions{1, 255};
  std::uint8_t turn = 0;
  EdgeSearch search(speeds, motions, 1e-9, true);
  carry_out(search, speeds, motions, [&](double, double, std::uint8_t) -> std::uint8_t {
    turn = static_cast<std::uint8_t>((turn + 1) % 3);
    return turn == 0 ? 1 : turn == 1 ? 255 : 3;
  });
  EXPECT_LE(search.points(), EdgeSearch::kMostPoints + 6);
  EXPECT_NE(only_edge(search).outcome, EdgeOutcome::sharp);
}

TEST(EdgeSearch, RefusesWhatIsNoBorder) {
  const std::vector<double> speeds{0.5, 0.6};
  EXPECT_THROW(EdgeSearch(speeds, std::vector<std::uint8_t>{1, 1}, 1e-6, true), std::invalid_argument);
  EXPECT_THROW(EdgeSearch(speeds, std::vector<std::uint8_t>{1}, 1e-6, true), std::invalid_argument);
  EXPECT_THROW(EdgeSearch(speeds, std::vector<std::uint8_t>{1, 2}, 0.0, true), std::invalid_argument);
  EdgeSearch search(speeds, std::vector<std::uint8_t>{1, 2}, 1e-6, true);
  EXPECT_THROW(search.take(std::vector<std::uint8_t>{1}), std::invalid_argument);
}

}  // namespace
}  // namespace rubatlas::analysis
