#include <gtest/gtest.h>

#include "plan/pieces.hpp"

namespace rubatlas::plan {
namespace {

settings::Scene line_of(std::size_t points, int piece, int lead_in) {
  settings::Scene scene;
  scene.grid.speed_ratio.assign(points, 0.0);
  scene.pieces = settings::Pieces{.points = piece, .lead_in = lead_in};
  return scene;
}

TEST(Pieces, CoverTheLineOnceAndTheLastMayBeShorter) {
  const Pieces pieces(line_of(150, 64, 8));
  ASSERT_EQ(pieces.per_line(), 3U);
  EXPECT_EQ(pieces.begin(0), 0U);
  EXPECT_EQ(pieces.end(0), 64U);
  EXPECT_EQ(pieces.begin(2), 128U);
  EXPECT_EQ(pieces.end(2), 150U);
  EXPECT_EQ(pieces.of_visit(127), 1U);
  EXPECT_EQ(pieces.of_visit(128), 2U);
}

TEST(Pieces, ARunBeginsBeforeItsPieceButNotBeforeItsLine) {
  const Pieces pieces(line_of(150, 64, 8));
  EXPECT_EQ(pieces.run_begin(0), 0U);
  EXPECT_EQ(pieces.run_begin(1), 56U);
  EXPECT_EQ(Pieces(line_of(150, 64, 100)).run_begin(1), 0U);
}

TEST(Pieces, ALineWithoutThemOrAsShortAsOneIsOnePiece) {
  EXPECT_EQ(Pieces(line_of(64, 64, 8)).per_line(), 1U);
  settings::Scene scene = line_of(150, 64, 8);
  scene.pieces.reset();
  EXPECT_EQ(Pieces(scene).per_line(), 1U);
  EXPECT_EQ(Pieces(scene).end(0), 150U);
}

TEST(Pieces, IndependentPointsHaveNone) {
  settings::Scene scene = line_of(150, 64, 8);
  scene.sweep = settings::Sweep::independent;
  EXPECT_EQ(Pieces(scene).per_line(), 1U);
}

}  // namespace
}  // namespace rubatlas::plan
