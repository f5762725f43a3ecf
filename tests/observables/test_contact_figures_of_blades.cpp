/// Touch-downs, share of contact, impulse and largest force of each blade, and speeds of approach.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "observables/approach_speed.hpp"
#include "observables/contact_figures_of_blades.hpp"
#include "synthetic_motion.hpp"

namespace rubatlas::observables {
namespace {

using Row = std::vector<double>;

trajectory::State standing(double /*time*/) {
  return {0, 0, 0, 0};
}

settings::Scene three_blades(int revolutions) {
  settings::Scene scene;
  scene.blades.count = 3;
  scene.rotor.natural_frequency = 20.0;
  scene.protocol.sampled_revolutions = revolutions;
  return scene;
}

Row row_of_blades(Observable& observable) {
  Row row(3);
  observable.write(row);
  return row;
}

/// Two revolutions with blade 1 in contact for a tenth of each, and blade 2 for a tenth of the first. The
/// force rises and falls like a square root, with an impulse of π/8 r² over the time r.
void two_revolutions(Observable& observable, const trajectory::PointConstants& point) {
  observable.begin(point);
  const double part = 0.1 * point.period;
  const auto touches = [part](int blade, double begin) {
    const auto force = [part, begin](double t) {
      return std::sqrt(std::fmax(0.0, (t - begin) * (begin + part - t)));
    };
    return SyntheticPiece(begin, begin + part, standing, {{blade, force, [](double) { return 0.0; }}});
  };
  for (int r = 0; r < 2; ++r) {
    SyntheticPiece first = touches(1, 0.0);
    observable.touch_down(1);
    observable.piece(first);
    observable.lift_off(1);
    if (r == 0) {
      SyntheticPiece second = touches(2, part);
      observable.touch_down(2);
      observable.piece(second);
      observable.lift_off(2);
    }
    SyntheticPiece flight((r == 0 ? 2 : 1) * part, point.period, standing);
    observable.piece(flight);
    observable.revolution_ends({});
  }
}

TEST(ContactFiguresOfBlades, TellTheBladesApart) {
  const trajectory::PointConstants point = point_at(0.5, 3);
  const double part = 0.1 * point.period;
  const settings::Scene scene = three_blades(2);
  TouchdownsOfBlades touchdowns(scene);
  two_revolutions(touchdowns, point);
  EXPECT_EQ(row_of_blades(touchdowns), (Row{0.0, 1.0, 0.5}));
  ContactFractionOfBlades fraction(scene);
  two_revolutions(fraction, point);
  ImpulseOfBlades impulse(scene);
  two_revolutions(impulse, point);
  MaxContactForceOfBlades peak(scene);
  two_revolutions(peak, point);
  const double whole = std::numbers::pi / 8.0 * part * part / scene.rotor.natural_frequency;
  for (const int blade : {0, 1, 2}) {
    const auto k = static_cast<std::size_t>(blade);
    const double share = 1.0 - 0.5 * std::abs(blade - 1) - (blade == 0 ? 0.5 : 0.0);
    EXPECT_NEAR(row_of_blades(fraction)[k], 0.1 * share, 1e-15);
    EXPECT_NEAR(row_of_blades(impulse)[k], whole * share, 1e-9 * whole);
    EXPECT_NEAR(row_of_blades(peak)[k], blade == 0 ? 0.0 : 0.5 * part, 1e-10);
  }
  fraction.begin(point);
  SyntheticPiece flight(0.0, point.period, standing);
  fraction.piece(flight);
  EXPECT_EQ(row_of_blades(fraction), (Row{0.0, 0.0, 0.0})) << "the point before is forgotten";
}

TEST(ApproachSpeed, IsTheLargestRateOfATipWhereItTouchesDown) {
  ApproachSpeed speed(three_blades(1));
  speed.begin(point_at(0.5, 3));
  const auto piece = [&speed](double begin, double end, double rate_of_blade_1) {
    SyntheticPiece stretch(begin, end, standing);
    stretch.set_tips([=](int blade, double time) {
      return trajectory::Tip{0.0, blade == 1 ? rate_of_blade_1 - (time - begin) : 1.0, 0.0};
    });
    speed.piece(stretch);
  };
  const auto value = [&speed] {
    Row row(1);
    speed.write(row);
    return row[0];
  };
  piece(0.0, 1.0, 0.9);
  EXPECT_EQ(value(), 0.0) << "no tip has touched";
  speed.touch_down(1);
  piece(1.0, 2.0, 0.25);
  speed.lift_off(1);
  piece(2.0, 3.0, 0.8);
  EXPECT_EQ(value(), 5.0) << "20 rad/s times 0.25 m per unit of dimensionless time";
  speed.touch_down(1);
  piece(3.0, 4.0, 0.125);
  EXPECT_EQ(value(), 5.0);
}

}  // namespace
}  // namespace rubatlas::observables
