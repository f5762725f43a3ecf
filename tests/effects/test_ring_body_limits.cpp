// The ring as one body, very heavy, very stiff and very light: what it then is like, and how fast it becomes
// so.
#include <gtest/gtest.h>

#include <cmath>

#include "../support/hybrid_motion.hpp"
#include "assembly/blade_tables.hpp"
#include "assembly/make_line_solver.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using rotor::State;

constexpr double kSpeedOfLimits = 0.62;
constexpr contact::Geometry kLimitGeometry{0.1, 0.11};

contact::ElasticaContact elastic_blade() {
  static assembly::BladeTables tables;
  return {kLimitGeometry, {0.1, 1e-3, 206e9 * 0.01 * 1e-9 / 12.0}, tables.curve(0.1)};
}

/// Where the default rotor is after two revolutions from rest (the ring's mass, stiffness and damping in SI).
template <class Law>
State after_two_revolutions(const Law& law, const rotor::Ring& ring = {}, int blades = 3) {
  const rotor::RotorConstants rotor{kSpeedOfLimits, 0.1, 0.01001, 0.01, 0.01};
  const rotor::BladeSet set(blades, rotor.speed_ratio);
  const auto motion = hybrid_motion(machine_of(rotor, set, kNoForcing, ring), law, {1e-15, 0.5});
  EXPECT_EQ(start(*motion, State(State::Zero())), PointStatus::done);
  modes::MotionListener nobody;
  for (int revolution = 0; revolution < 2; ++revolution) {
    EXPECT_EQ(revolve(*motion, nobody), PointStatus::done);
  }
  EXPECT_GE(motion->work().touchdowns, 2U);
  return rotor::shaft(motion->state());
}
template <class Law>
State in_moving_ring(const Law& law, double mass, double stiffness, double damping, int blades = 3) {
  return after_two_revolutions(law, rotor::RingBody(mass, stiffness, damping, 10.0), blades);
}
double farthest(const State& a, const State& b) {
  return (a - b).abs().maxCoeff();
}

/// Goes into the limit in equal steps and asks for the order in which the distance to it falls.
template <class Distance>
void expect_first_order(Distance distance, double first, double factor) {
  const double before = distance(first);
  const double between = distance(first / factor);
  const double after = distance(first / (factor * factor));
  EXPECT_GT(after, 1e-10) << "well above the tolerance of the motions";
  const double order = std::log(before / between) / std::log(factor);
  const double last_order = std::log(between / after) / std::log(factor);
  EXPECT_NEAR(order, 1.0, 0.05);
  EXPECT_NEAR(last_order, 1.0, 0.02) << "the nearer, the better";
}

TEST(RingBody, AsHeavyAsYouLikeIsTheFixedRingToFirstOrder) {
  const auto heavier = [](const auto& law) {
    const State fixed = after_two_revolutions(law);
    const auto at = [&](double inverse_mass) {
      return farthest(in_moving_ring(law, 1.0 / inverse_mass, 1e4, 0.0), fixed);
    };
    expect_first_order(at, 1e-5, 4.0);
  };
  heavier(elastic_blade());
  heavier(contact::ElasticRingContact(kLimitGeometry, 1e4, {0.1}));
}

TEST(RingBody, AsStiffAsYouLikeIsTheFixedRingToFirstOrder) {
  // Critically damped: the ring stands where its spring lets it. Under an inextensible blade, whose force
  // rises at once, the first order shows on a light ring only: the next one is that of its own time,
  // (m_r/kr)^½.
  const auto stiffer = [](const auto& law, double mass, double softest) {
    const State fixed = after_two_revolutions(law);
    const auto at = [&](double compliance) {
      const double stiffness = 1.0 / compliance;
      return farthest(in_moving_ring(law, mass, stiffness, 2.0 * std::sqrt(stiffness * mass)), fixed);
    };
    expect_first_order(at, softest, 10.0);
  };
  stiffer(contact::ElasticRingContact(kLimitGeometry, 1e4, {0.1}), 0.1, 1e-7);
  stiffer(elastic_blade(), 0.001, 1e-7);
}

TEST(RingBody, WithoutMassAndFrictionIsASpringInSeriesWithThatUnderTheTip) {
  // One rigid blade without friction: tip, ring and force are in one line, and the ring's spring adds its
  // compliance to that under the tip. The elastic ring of MODEL 4.7 then is both in one.
  const State series = after_two_revolutions(contact::ElasticRingContact(kLimitGeometry, 5e3, {0.0}), {}, 1);
  const contact::ElasticRingContact tip(kLimitGeometry, 1e4, {0.0});
  // Critically damped at every mass, c_r = 2 (kr m_r)^½: what is left of it lags by c_r/kr.
  const auto at = [&](double lag) {
    const double damping = lag * 1e4;
    return farthest(in_moving_ring(tip, 0.25 * damping * damping / 1e4, 1e4, damping, 1), series);
  };
  expect_first_order(at, 5e-5, 2.0);
}

}  // namespace
}  // namespace rubatlas::test
