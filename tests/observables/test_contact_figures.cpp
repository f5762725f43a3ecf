/// Touch-downs, share of contact, largest force and root strain.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "observables/contact_figures.hpp"
#include "synthetic_motion.hpp"

namespace rubatlas::observables {
namespace {

trajectory::State at_rest(double /*time*/) {
  return {0, 0, 0, 0};
}

double value_of(Observable& observable) {
  std::vector<double> row(1);
  observable.write(row);
  return row[0];
}

TEST(TouchdownsPerRevolution, CountsTouchDownsOverTheSampledRevolutions) {
  TouchdownsPerRevolution touchdowns;
  const auto value_after = [&](int touches) {
    touchdowns.begin(point_at(0.5, 3));
    for (int i = 0; i < touches; ++i) touchdowns.touch_down(i % 3);
    for (int r = 0; r < 4; ++r) touchdowns.revolution_ends({});
    return value_of(touchdowns);
  };
  EXPECT_EQ(value_after(6), 1.5);
  EXPECT_EQ(value_after(0), 0.0);
}

TEST(TouchdownsPerRevolution, DoNotCountAContactThatIsOpenAtTheStart) {
  TouchdownsPerRevolution touchdowns;
  touchdowns.begin(point_at(0.5, 3));
  SyntheticPiece open(0.0, 1.0, at_rest, {{0, [](double) { return 1.0; }, [](double) { return 0.0; }}});
  touchdowns.piece(open);
  touchdowns.revolution_ends({});
  EXPECT_EQ(value_of(touchdowns), 0.0);
}

TEST(ContactFraction, IsTheShareOfTimeWithAnyBladeInContact) {
  const trajectory::PointConstants point = point_at(0.5, 3);
  ContactFraction fraction;
  const SyntheticContact contact{1, [](double) { return 1.0; }, [](double) { return 0.0; }};
  fraction.begin(point);
  for (int r = 0; r < 2; ++r) {
    SyntheticPiece flight(0.0, 0.5 * point.period, at_rest);
    SyntheticPiece one(0.5 * point.period, 0.7 * point.period, at_rest, {contact});
    SyntheticPiece two(0.7 * point.period, 0.75 * point.period, at_rest, {contact, contact});
    SyntheticPiece again(0.75 * point.period, point.period, at_rest);
    for (SyntheticPiece* piece : {&flight, &one, &two, &again}) fraction.piece(*piece);
    fraction.revolution_ends({});
  }
  EXPECT_NEAR(value_of(fraction), 0.25, 1e-15);
}

TEST(MaxContactForce, IsTheTopOfTheForceWithinAPiece) {
  // Skew on purpose: the maximum of t e^{1 − t} stands at 1, neither in the middle nor at an end.
  const auto force = [](double t) { return 40.0 * t * std::exp(1 - t); };
  for (const double end : {1.05, 1.7, 2.0, 3.0}) {
    MaxContactForce peak;
    peak.begin(point_at(0.5, 3));
    SyntheticPiece piece(0.0, end, at_rest, {{2, force, [](double) { return 0.0; }}});
    peak.piece(piece);
    EXPECT_NEAR(value_of(peak), 40.0, 1e-10) << end;
  }
}

TEST(MaxContactForce, IsTheLargestOverPiecesAndBlades) {
  MaxContactForce peak;
  peak.begin(point_at(0.5, 3));
  const auto none = [](double) { return 0.0; };
  SyntheticPiece both(
      0.0, 2.0, at_rest,
      {{0, [](double t) { return t; }, none}, {1, [](double t) { return 5.0 - t * t; }, none}});
  SyntheticPiece later(2.0, 3.0, at_rest, {{0, [](double t) { return 7.0 - t; }, none}});
  SyntheticPiece flight(3.0, 4.0, at_rest);
  for (SyntheticPiece* piece : {&both, &later, &flight}) peak.piece(*piece);
  EXPECT_EQ(value_of(peak), 5.0) << "at the start of the second blade's contact and of the later piece";
  peak.begin(point_at(0.5, 3));
  EXPECT_EQ(value_of(peak), 0.0);
}

TEST(MaxContactForce, IsTheHighestOfSeveralTopsWithinAPiece) {
  const auto force = [](double t) { return 10.0 + t + std::sin(4.0 * t); };
  MaxContactForce peak;
  peak.begin(point_at(0.5, 3));
  // The load falls at the start of the piece, then rises and falls twice.
  SyntheticPiece piece(0.6, 4.0, at_rest, {{0, force, [](double) { return 0.0; }}});
  peak.piece(piece);
  const double top = 0.25 * std::acos(-0.25) + std::numbers::pi;
  EXPECT_NEAR(value_of(peak), force(top), 1e-10);
}

TEST(MaxContactForce, StandsAtAnEndWhereTheLoadDoesNotPeakWithin) {
  int evaluations = 0;
  const auto rising = [&evaluations](double t) {
    ++evaluations;
    return 3.0 + t;
  };
  MaxContactForce peak;
  peak.begin(point_at(0.5, 3));
  SyntheticPiece piece(0.0, 2.0, at_rest, {{0, rising, [](double) { return 0.0; }, false}});
  peak.piece(piece);
  EXPECT_EQ(value_of(peak), 5.0);
  EXPECT_EQ(evaluations, 2);
}

TEST(MaxRootStrain, LooksAtTheStrainNotAtTheForce) {
  MaxRootStrain peak;
  peak.begin(point_at(0.5, 3));
  SyntheticPiece piece(0.0, std::numbers::pi, at_rest,
                       {{0, [](double) { return 50.0; }, [](double t) { return 2e-3 * std::sin(t); }}});
  peak.piece(piece);
  EXPECT_NEAR(value_of(peak), 2e-3, 1e-14);
}

TEST(MaxRootStress, IsTheStrainTimesTheModulus) {
  settings::Scene scene;
  scene.blades.youngs_modulus = 70e9;
  MaxRootStress peak(scene);
  peak.begin(point_at(0.5, 3));
  SyntheticPiece piece(0.0, std::numbers::pi, at_rest,
                       {{0, [](double) { return 50.0; }, [](double t) { return 2e-3 * std::sin(t); }}});
  peak.piece(piece);
  EXPECT_NEAR(value_of(peak), 140e6, 1e-3);
}

}  // namespace
}  // namespace rubatlas::observables
