/// Error follows tolerance from random kicked starts, under laws whose forces start and end like a root of
/// the gap: contacts that end on the receding side, several at once, bent sides, a ring that moves.
///
/// One revolution each, against the same motion at a far lower tolerance. A tolerance bounds the error of a
/// step; what the motion makes of an error is its own, and measured from starts a little aside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "../effects/directed_law.hpp"
#include "solve/ring_flight.hpp"

namespace rubatlas::test {
namespace {

using solve::PointStatus;
using solve::State;

constexpr double kTolerances[] = {1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
constexpr double kReference = 1e-14;
constexpr int kKicks = 20;

struct Kicked {
  HardRotor rotor;
  State start;
  double regularising_velocity;  ///< v0 [m per unit τ]
};

/// Speed, friction, number of blades, state; the index is the seed.
Kicked kicked(int index) {
  std::mt19937_64 generator(static_cast<std::uint64_t>(index));
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(generator() >> 11U) * 0x1p-53;
  };
  Kicked result{};
  result.rotor.speed_ratio = between(0.1, 0.9);
  result.rotor.friction = std::pow(10.0, between(-2.0, -0.4));
  result.rotor.blades = between(0.0, 1.0) < 0.25 ? 8 : 3;
  result.regularising_velocity = std::pow(10.0, between(-3.0, -1.0));
  for (const double range : {0.005, 0.04}) {
    for (int axis = 0; axis < 2; ++axis) result.start[axis + (range > 0.01 ? 2 : 0)] = between(-range, range);
  }
  return result;
}

/// `end(rotor, start)` gives status and last state at the rotor's tolerance; `most`: error in tolerances.
template <class End>
void expect_that_error_follows_tolerance(Kicked point, End end) {
  constexpr double kMost = 100.0;   // tolerances
  constexpr double kAside = 1e-10;  // [m], [m per unit τ]
  point.rotor.tolerance = kReference;
  const auto reference = end(point.rotor, point.start);
  double growth = 1.0;
  for (int i = 0; i < 4 && reference.status == PointStatus::done; ++i) {
    State aside = point.start;
    aside[i] += kAside;
    const auto other = end(point.rotor, aside);
    if (other.status != reference.status) continue;
    growth = std::max(growth, (other.state - reference.state).abs().maxCoeff() / kAside);
  }
  for (const double tolerance : kTolerances) {
    SCOPED_TRACE(::testing::Message() << "speed " << point.rotor.speed_ratio << ", tolerance " << tolerance
                                      << ", growth " << growth);
    point.rotor.tolerance = tolerance;
    const auto motion = end(point.rotor, point.start);
    EXPECT_EQ(motion.status, reference.status);
    if (reference.status != PointStatus::done) continue;
    EXPECT_LE((motion.state - reference.state).abs().maxCoeff(),
              kMost * tolerance * point.rotor.clearance() * growth);
  }
}

struct End {
  PointStatus status;
  State state;
};

template <class Law>
End one_revolution(const HardRotor& rotor, const Law& law, const State& start) {
  const auto motion = follow(rotor, law, effects::NoForcing{}, start, 1, [](observables::MotionPiece&) {});
  return {motion.status, motion.sections.back()};
}

TEST(KickedMotion, OfBladesUnderTheNormalLoadErrsByItsTolerance) {
  for (int index = 0; index < kKicks; ++index) {
    SCOPED_TRACE(index);
    expect_that_error_follows_tolerance(kicked(index), [](const HardRotor& rotor, const State& start) {
      const contact::CoulombFriction friction{rotor.friction};
      return one_revolution(
          rotor, directed_law<contact::CoulombFriction, contact::NormalLoad>(rotor, friction), start);
    });
  }
}

TEST(KickedMotion, OfBladesUnderFrictionThatDependsOnTheSlipErrsByItsTolerance) {
  for (int index = 0; index < kKicks; ++index) {
    SCOPED_TRACE(index);
    const Kicked point = kicked(index);
    expect_that_error_follows_tolerance(point, [&](const HardRotor& rotor, const State& start) {
      return one_revolution(
          rotor,
          directed_law(rotor, contact::RegularisedFriction{rotor.friction, point.regularising_velocity}),
          start);
    });
  }
}

TEST(KickedMotion, OfElasticBladesInARingThatMovesErrsByItsTolerance) {
  using Forcing = solve::WithRingBody<effects::NoForcing>;
  for (int index = 0; index < kKicks; ++index) {
    SCOPED_TRACE(index);
    const contact::ElasticaContact law = kicked(index).rotor.elastica();
    expect_that_error_follows_tolerance(kicked(index), [&](const HardRotor& rotor, const State& start) {
      const rotor::RingBody ring(1.0, 1e4, 40.0, 10.0);
      solve::Motion<contact::ElasticaContact, Forcing> motion(
          rotor.constants(), {rotor.blades, rotor.speed_ratio}, law, Forcing{{}, ring}, rotor.limits());
      solve::ShaftAndRing bodies = solve::ShaftAndRing::Zero();
      bodies.head<4>() = start;
      PointStatus status = motion.start(bodies);
      solve::MotionListener nobody;
      if (status == PointStatus::done) status = motion.revolution(nobody);
      return End{status, solve::shaft(motion.state())};
    });
  }
}

}  // namespace
}  // namespace rubatlas::test
