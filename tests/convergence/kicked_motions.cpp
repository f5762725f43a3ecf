/// Error follows tolerance from random kicked starts, under laws whose forces start and end like a root of
/// the gap: contacts that end on the receding side, several at once, bent sides, a ring that moves.
///
/// One revolution each, against the same motion at a far lower tolerance. A tolerance bounds the error of a
/// step; what the motion makes of an error is its own: measured from starts a little aside, and, of errors
/// that are made within a contact, by the saltation of its end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "../effects/directed_law.hpp"
#include "../support/hybrid_motion.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using rotor::State;

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

struct End {
  PointStatus status;
  State state;
  double saltation = 1.0;  ///< largest of the revolution's contacts
};

/// `end_of(rotor, start)` gives an `End` at the rotor's tolerance.
template <class EndOf>
void expect_that_error_follows_tolerance(Kicked point, EndOf end_of) {
  constexpr double kMost = 100.0;   // tolerances
  constexpr double kAside = 1e-10;  // [m], [m per unit τ]
  point.rotor.tolerance = kReference;
  const End reference = end_of(point.rotor, point.start);
  double growth = 1.0;
  for (int i = 0; i < 4 && reference.status == PointStatus::done; ++i) {
    State aside = point.start;
    aside[i] += kAside;
    const End other = end_of(point.rotor, aside);
    if (other.status != reference.status) continue;
    growth = std::max(growth, (other.state - reference.state).abs().maxCoeff() / kAside);
  }
  // A tolerance of position where a force ends is that times the saltation in velocity.
  const double most = std::max(kMost, reference.saltation);
  for (const double tolerance : kTolerances) {
    SCOPED_TRACE(::testing::Message() << "speed " << point.rotor.speed_ratio << ", tolerance " << tolerance
                                      << ", growth " << growth);
    point.rotor.tolerance = tolerance;
    const End motion = end_of(point.rotor, point.start);
    EXPECT_EQ(motion.status, reference.status);
    if (reference.status != PointStatus::done) continue;
    EXPECT_LE((motion.state - reference.state).abs().maxCoeff(),
              most * tolerance * point.rotor.clearance() * growth);
  }
}

template <class Law>
End one_revolution(const HardRotor& rotor, const Law& law, const State& start) {
  const auto motion = follow(rotor, law, kNoForcing, start, 1, [](trajectory::MotionPiece&) {});
  return {motion.status, motion.sections.back()};
}

TEST(KickedMotion, OfBladesUnderTheNormalLoadErrsByItsTolerance) {
  for (int index = 0; index < kKicks; ++index) {
    SCOPED_TRACE(index);
    expect_that_error_follows_tolerance(kicked(index), [](const HardRotor& rotor, const State& start) {
      const contact::Friction friction = contact::Friction::coulomb(rotor.friction);
      return one_revolution(rotor, directed_law(rotor, friction, contact::LoadDirection::normal), start);
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
          directed_law(rotor, contact::Friction::regularised(rotor.friction, point.regularising_velocity)),
          start);
    });
  }
}

/// What an error of position within a contact becomes in velocity at its end, since the force F ends earlier
/// or later: of the saltation matrix 1 + (f+ − f−) ∇gᵀ/ġ at g = 0 the largest entry.
class SaltationOfLiftOffs final : public modes::MotionListener {
 public:
  /// `force_unit`: acceleration of the shaft from the ring per newton.
  SaltationOfLiftOffs(const HardRotor& rotor, const motion::Motion& motion, double force_unit)
      : rotor_(&rotor), motion_(&motion), force_unit_(force_unit), forces_(rotor.blades) {}

  void piece(trajectory::MotionPiece& piece) override {
    for (std::size_t i = 0; i < piece.contact_count(); ++i)
      forces_[static_cast<std::size_t>(piece.blade(i))] = piece.normal_force(i, piece.end());
  }
  void event(const modes::Event& event) override {
    if (event.kind != modes::Guard::lift_off) return;
    const contact::Pose at = pose_at(*rotor_, event.blade, event.time, rotor::from_ring(motion_->state()));
    const double gap_rate = contact::gap_rate(rotor_->geometry(), at, rotor_->speed_ratio);
    const double approach = std::abs(gap_rate) / (2.0 * rotor_->ring_radius);
    const double force = forces_[static_cast<std::size_t>(event.blade)];
    largest_ = std::max(largest_, 1.0 + force_unit_ * force / approach);
  }
  [[nodiscard]] double largest() const { return largest_; }

 private:
  const HardRotor* rotor_;
  const motion::Motion* motion_;
  double force_unit_;  ///< [m/N]
  std::vector<double> forces_;
  double largest_ = 1.0;
};

TEST(KickedMotion, OfElasticBladesInARingThatMovesErrsByItsTolerance) {
  for (int index = 0; index < kKicks; ++index) {
    SCOPED_TRACE(index);
    const contact::ElasticaContact law = kicked(index).rotor.elastica();
    expect_that_error_follows_tolerance(kicked(index), [&](const HardRotor& rotor, const State& start) {
      const rotor::RingBody ring(1.0, 1e4, 40.0, 10.0);
      const rotor::BladeSet blades(rotor.blades, rotor.speed_ratio);
      const auto motion =
          hybrid_motion(machine_of(rotor.constants(), blades, kNoForcing, ring), law, rotor.limits());
      SaltationOfLiftOffs listener(rotor, *motion, rotor.force_unit + ring.force_unit());
      PointStatus status = test::start(*motion, start);
      if (status == PointStatus::done) status = revolve(*motion, listener);
      return End{status, rotor::shaft(motion->state()), listener.largest()};
    });
  }
}

}  // namespace
}  // namespace rubatlas::test
