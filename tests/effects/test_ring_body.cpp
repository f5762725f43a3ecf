// The ring as one body: its closed form in flight, the search for touch-downs, and what shaft and ring keep
// together.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "../support/section_differences.hpp"
#include "assembly/blade_tables.hpp"
#include "assembly/make_line_solver.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "modes/flight.hpp"
#include "modes/touchdown_search.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using rotor::RingBody;
using rotor::ShaftAndRing;
using rotor::State;

constexpr double kNaturalFrequency = 10.0;
constexpr contact::Geometry kBladeAndRing{0.1, 0.11};

rotor::RotorConstants ring_rotor(double speed, double damping, double misalignment = 0.01001) {
  return {speed, damping, misalignment, 0.01, 0.01};  // m = 1 kg
}

/// Keeps what happens.
class RingWitness final : public modes::MotionListener {
 public:
  void piece(trajectory::MotionPiece& piece) override { most = std::max(most, piece.contact_count()); }
  void event(const modes::Event& event) override { events.push_back(event); }
  std::vector<modes::Event> events;
  std::size_t most = 0;  ///< blades in contact at once
};

std::unique_ptr<motion::Motion> elastic_blades(const rotor::RotorConstants& rotor, const RingBody& ring,
                                               double friction = 0.1, int count = 3,
                                               double tolerance = 1e-16) {
  static assembly::BladeTables tables;
  const contact::ElasticaContact law(kBladeAndRing, {0.1, 1e-3, 206e9 * 0.01 * 1e-9 / 12.0},
                                     tables.curve(friction));
  const rotor::BladeSet blades(count, rotor.speed_ratio);
  return hybrid_motion(machine_of(rotor, blades, kNoForcing, ring), law, {tolerance, 0.5});
}

// --- the ring by itself ---

TEST(RingBody, InFlightIsADampedOscillator) {
  // Underdamped, critical and overdamped, against the eigenvalues of m r'' + c r' + k r = 0.
  for (const double damping : {0.0, 3.0, 200.0, 5000.0}) {
    const double mass = 2.0;
    const double stiffness = 5000.0;
    const RingBody ring(mass, stiffness, damping, kNaturalFrequency);
    const RingBody::State start{1e-3, -2e-3, 5e-3, 1e-3};
    const std::complex<double> root =
        std::sqrt(std::complex<double>(damping * damping - 4.0 * mass * stiffness));
    const std::complex<double> fast = (-damping - root) / (2.0 * mass * kNaturalFrequency);
    const std::complex<double> slow = (-damping + root) / (2.0 * mass * kNaturalFrequency);
    for (const double time : {0.0, 0.01, 0.3, 2.0, 7.0}) {
      const RingBody::State moved = ring.free(start, time);
      for (int axis = 0; axis < 2; ++axis) {
        double position = 0.0;
        double velocity = 0.0;
        if (std::abs(fast - slow) > 1e-6) {
          const std::complex<double> a = (start[axis + 2] - slow * start[axis]) / (fast - slow);
          const std::complex<double> b = start[axis] - a;
          position = (a * std::exp(fast * time) + b * std::exp(slow * time)).real();
          velocity = (a * fast * std::exp(fast * time) + b * slow * std::exp(slow * time)).real();
        } else {
          const double rate = slow.real();
          const double growth = start[axis + 2] - rate * start[axis];
          position = (start[axis] + growth * time) * std::exp(rate * time);
          velocity = (growth + rate * (start[axis] + growth * time)) * std::exp(rate * time);
        }
        EXPECT_NEAR(moved[axis], position, 1e-15) << damping << ", " << time;
        EXPECT_NEAR(moved[axis + 2], velocity, 1e-13) << damping << ", " << time;
      }
    }
  }
}

TEST(RingBody, BoundsOfItsFreeMotionHold) {
  for (const double damping : {0.0, 20.0, 200.0, 2000.0}) {
    const RingBody ring(2.0, 5000.0, damping, kNaturalFrequency);
    const RingBody::State start{1e-3, -2e-3, 5e-3, 1e-3};
    const double norm = ring.energy_norm(start);
    const double step = 1e-4;
    for (int i = 0; i < 2000; ++i) {
      const double time = 1e-3 * i;
      const RingBody::State now = ring.free(start, time);
      EXPECT_LE(ring.energy_norm(now), norm * (1.0 + 1e-14));
      EXPECT_LE(std::abs(ring.acceleration(now, 0.0)), ring.derivative_bounds(norm).second);
      const auto change = ring.acceleration(ring.free(start, time + step), 0.0) - ring.acceleration(now, 0.0);
      EXPECT_LE(std::abs(change) / step, ring.derivative_bounds(norm).third);
    }
  }
}

TEST(RingBody, FliesOnWithoutTheShaftAfterAContact) {
  // The rotor fits into the ring: it is kicked against it, and comes to rest without.
  const RingBody ring(1.0, 1e4, 2.0, kNaturalFrequency);
  auto motion = elastic_blades(ring_rotor(0.62, 0.1, 0.009), ring);
  ASSERT_EQ(start(*motion, rotor::State{1e-3, 0.0, 0.0, 8e-3}), PointStatus::done);
  const double period = 2.0 * std::numbers::pi / 0.62;
  int flights = 0;
  for (int revolution = 0; revolution < 12; ++revolution) {
    RingWitness witness;
    const RingBody::State before = motion->state().tail<4>();
    ASSERT_EQ(revolve(*motion, witness), PointStatus::done);
    const RingBody::State after = motion->state().tail<4>();
    const double departure = (after - ring.free(before, period)).abs().maxCoeff();
    if (witness.most > 0) {
      EXPECT_GT(departure, 1e-7);
    } else {
      EXPECT_GT(before.abs().maxCoeff(), 1e-9) << "it still moves";
      EXPECT_LE(departure, 1e-17);
      ++flights;
    }
  }
  EXPECT_GT(motion->work().touchdowns, 0U);
  EXPECT_GT(flights, 3);
}

// --- search ---

TEST(RingBody, NoTouchdownIsMissedWhereShaftAndRingMoveTowardsEachOther) {
  // The search against a scan of the gaps; the ring is fast, slow, damped and not.
  const rotor::RotorConstants rotor = ring_rotor(0.5, 0.05, 0.007);
  const rotor::BladeSet blades(3, rotor.speed_ratio);
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto part = [&](int prime) { return 2.0 * std::fmod(0.618034 * (trial + 1) * prime, 1.0) - 1.0; };
    const RingBody ring(1.0, 100.0 * std::pow(30.0, 1.0 + part(3)), trial % 2 != 0 ? 0.0 : 20.0,
                        kNaturalFrequency);
    const rotor::Machine machine = machine_of(rotor, blades, kNoForcing, ring);
    modes::Flight flight(machine);
    ShaftAndRing start;
    start << 3e-3 * part(5), 3e-3 * part(7), 4e-3 * part(11), 4e-3 * part(13), 2e-3 * part(17),
        2e-3 * part(19), 2e-3 * ring.frequency() * part(23), 2e-3 * ring.frequency() * part(29);
    flight.start(0.0, start);
    const double until = 2.0 * std::numbers::pi / rotor.speed_ratio;
    modes::WorkMeter meter;
    modes::TouchdownSearch search(flight, {3, kBladeAndRing}, meter);
    const auto largest_gap = [&](double time) {
      double largest = -1.0;
      const State seen = rotor::from_ring(flight.state(time));
      for (int k = 0; k < 3; ++k) {
        largest = std::max(largest,
                           pose_of(rotor, kBladeAndRing, blades.direction(k, blades.first(time)), seen).gap);
      }
      return largest;
    };
    if (largest_gap(0.0) >= 0.0) continue;
    const auto touchdown = search.find(until);
    const double end = touchdown ? touchdown->time : until;
    for (int i = 0; i < 4000; ++i) EXPECT_LT(largest_gap(end * i / 4000), 1e-16) << trial;
    if (!touchdown) continue;
    ++found;
    EXPECT_NEAR(largest_gap(end), 0.0, 1e-15) << trial;
    EXPECT_LT(search.evaluations(), 2000U) << trial;
  }
  EXPECT_GT(found, 50);
}

// --- shaft and ring together ---

TEST(RingBody, WithoutDampingAndFrictionKeepsTheJacobiIntegral) {
  // Centred, and with springs only, shaft and ring know of time by the blades' turning alone: in the frame
  // that turns with them E − Ω L is constant, E the energy of both and of the spring under each tip, L their
  // spin.
  constexpr double kTip = 1e4;
  constexpr double kMass = 0.7;
  constexpr double kSpring = 3000.0;
  const RingBody ring(kMass, kSpring, 0.0, kNaturalFrequency);
  const rotor::RotorConstants rotor = ring_rotor(0.45, 0.0, 0.0);
  const contact::ElasticRingContact law(kBladeAndRing, kTip, {0.0});
  const rotor::BladeSet blades(3, rotor.speed_ratio);
  const auto integral = [&](const ShaftAndRing& s) {
    const double per_time = kNaturalFrequency * kNaturalFrequency;  // from per τ² to per s²
    double energy = 0.5 * per_time * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + s[3] * s[3]) +
                    0.5 * kSpring * (s[4] * s[4] + s[5] * s[5]) +
                    0.5 * kMass * per_time * (s[6] * s[6] + s[7] * s[7]);
    const State seen = rotor::from_ring(s);
    for (int k = 0; k < 3; ++k) {
      const auto at = pose_of(rotor, kBladeAndRing, blades.direction(k, blades.first(0.0)), seen);
      const double depth = std::hypot(at.radial + kBladeAndRing.reach, at.tangential) - 0.11;
      if (depth > 0.0) energy += 0.5 * kTip * depth * depth;
    }
    const double spin = s[0] * s[3] - s[1] * s[2] + kMass * (s[4] * s[7] - s[5] * s[6]);
    return energy - rotor.speed_ratio * per_time * spin;
  };
  const auto motion = hybrid_motion(
      machine_of(rotor, rotor::BladeSet(3, rotor.speed_ratio), kNoForcing, ring), law, {1e-15, 0.5});
  ShaftAndRing start;
  start << 0.008, 0.002, 0.004, 0.009, 1e-4, 0.0, 0.0, 1e-3;
  ASSERT_EQ(test::start(*motion, start), PointStatus::done);
  const double before = integral(start);
  RingWitness witness;
  for (int revolution = 0; revolution < 30; ++revolution) {
    ASSERT_EQ(revolve(*motion, witness), PointStatus::done);
    EXPECT_NEAR(integral(motion->state()), before, 1e-10 * std::abs(before)) << revolution;
  }
  EXPECT_GT(motion->work().touchdowns, 20U);
  EXPECT_GT((motion->state().tail<4>() - start.tail<4>()).abs().maxCoeff(), 1e-5)
      << "the ring has been pushed";
}

TEST(RingBody, PhaseVolumeContractsByTheDampingOfShaftAndRing) {
  const double speed = 0.62;
  const RingBody ring(2.0, 5000.0, 10.0, kNaturalFrequency);
  const auto map = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
    auto motion = elastic_blades(ring_rotor(speed, 0.05), ring);
    RingWitness witness;
    EXPECT_EQ(test::start(*motion, ShaftAndRing(from.array())), PointStatus::done);
    EXPECT_EQ(revolve(*motion, witness), PointStatus::done);
    EXPECT_EQ(motion->work().slip_reversals, 0U);
    EXPECT_GT(motion->work().touchdowns, 0U);
    return motion->state().matrix();
  };
  ShaftAndRing start;
  start << 2e-3, -1e-3, 1e-3, 2e-3, 1e-4, -2e-4, 1e-3, 5e-4;
  // −4ζ of the shaft and −2 c_r/(m_r ωn) of the ring, each per unit τ.
  const double rate = -4.0 * 0.05 - 2.0 * 10.0 / (2.0 * kNaturalFrequency);
  EXPECT_NEAR(-4.0 * ring.damping_ratio() * ring.frequency(), rate + 4.0 * 0.05, 1e-14);
  const double exact = std::exp(rate * 2.0 * std::numbers::pi / speed);
  EXPECT_NEAR(change_of_volume(map, start.matrix(), 5e-8) / exact, 1.0, 1e-5);
}

TEST(RingBody, MirroredWithTheRotorMovesTheMirroredWay) {
  const RingBody ring(1.0, 3000.0, 10.0, kNaturalFrequency);
  const auto follow = [&](double side) {  // mirrored about the x axis: also spin and misalignment
    auto motion = elastic_blades(ring_rotor(side * 0.5, 0.1, side * 0.01001), ring, 0.1, 3, 1e-13);
    ShaftAndRing start;
    start << 1e-3, side * 2e-3, 3e-3, side * -1e-3, 1e-4, side * 2e-4, -1e-3, side * 1e-3;
    EXPECT_EQ(test::start(*motion, start), PointStatus::done);
    RingWitness witness;
    for (int revolution = 0; revolution < 4; ++revolution) {
      EXPECT_EQ(revolve(*motion, witness), PointStatus::done);
    }
    EXPECT_GT(witness.events.size(), 8U);
    return motion->state();
  };
  ShaftAndRing mirrored = follow(-1.0);
  const ShaftAndRing motion = follow(1.0);
  for (const int i : {1, 3, 5, 7}) mirrored[i] = -mirrored[i];
  EXPECT_LE((mirrored - motion).abs().maxCoeff(), 1e-10);
}

TEST(RingBody, CarriesAllBladesInContactTogether) {
  // Two opposite blades press with equal forces: they cancel on the ring, which stays, as the fixed one
  // would. One blade alone pushes it away.
  const rotor::RotorConstants rotor = ring_rotor(0.3, 0.1, 0.0);
  const contact::Geometry tight{0.1101, 0.11};
  const RingBody ring(1.0, 1e3, 5.0, kNaturalFrequency);
  const auto displaced = [&](int count) {
    const contact::ElasticRingContact law(tight, 1e4, {0.0});
    const auto motion = hybrid_motion(
        machine_of(rotor, rotor::BladeSet(count, rotor.speed_ratio), kNoForcing, ring), law, {1e-15, 0.5});
    EXPECT_EQ(start(*motion, ShaftAndRing(ShaftAndRing::Zero())), PointStatus::done);
    RingWitness witness;
    EXPECT_EQ(revolve(*motion, witness), PointStatus::done);
    EXPECT_EQ(witness.most, static_cast<std::size_t>(count));
    return motion->state().tail<4>().head<2>().abs().maxCoeff();
  };
  EXPECT_LE(displaced(2), 1e-16);
  EXPECT_LE(displaced(4), 1e-16);
  EXPECT_GT(displaced(1), 1e-6);
}

}  // namespace
}  // namespace rubatlas::test
