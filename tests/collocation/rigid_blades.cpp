/// Rigid blades on a ring that yields under each tip, by collocation, held against steps of the order-8 pair
/// at a ten thousandth of the tolerance: for every friction law, with a damper beside the spring, and in a
/// ring without mass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "collocation/interval.hpp"
#include "contact/damped_ring.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "lone_contacts.hpp"
#include "modes/phase.hpp"
#include "several_blades.hpp"

namespace rubatlas::test {
namespace {

class CountedGuards final : public modes::MotionListener {
 public:
  void event(const modes::Event& event) override {
    reversals += event.kind == modes::Guard::slip_reversal ? 1 : 0;
    touchdowns += event.kind == modes::Guard::touch_down ? 1 : 0;
  }
  int reversals = 0;
  int touchdowns = 0;
};

/// What tips at rest do in the pieces of motion that are found by collocation.
class TipsAtRest final : public modes::MotionListener {
 public:
  TipsAtRest(double tip_speed, double largest_coefficient)
      : tip_speed_(tip_speed), largest_coefficient_(largest_coefficient) {}
  void piece(trajectory::MotionPiece& piece) override {
    if (dynamic_cast<modes::Phase*>(&piece) == nullptr || piece.contact_count() != 1) return;
    for (const double share : {0.1, 0.5, 0.9, 1.0}) {
      const double time = piece.begin() + share * (piece.end() - piece.begin());
      const trajectory::ContactForce there = piece.contact_force(0, time);
      if (there.slip != 0.0) return;
      slip = std::max(slip, std::abs(there.slip_velocity) / tip_speed_);
      share_of_cone = std::max(share_of_cone, std::abs(there.friction) / largest_coefficient_);
    }
    ++pieces;
  }
  void event(const modes::Event& event) override {
    loosenings += event.kind == modes::Guard::comes_loose ? 1 : 0;
  }
  int pieces = 0;
  int loosenings = 0;
  double slip = 0.0;           ///< largest |v| over ΩR [-]
  double share_of_cone = 0.0;  ///< largest |c|/μs [-]

 private:
  double tip_speed_, largest_coefficient_;
};

struct RigidRotor {
  rotor::RotorConstants rotor;
  int blade_count;
  rotor::State kick;
  contact::Geometry geometry;
  double stiffness;  ///< kr [N/m]
  double friction;   ///< μ [-]
  rotor::Ring ring;
};
/// Soft rings to stiff, of which one blade or several touch. `length` [m]: the ring is larger by the
/// clearance; the tips of short blades are slow, so that their slip reverses.
RigidRotor rigid_rotor(std::mt19937_64& generator, double length) {
  return {{uniform(generator, 0.1, 1.0), std::pow(10.0, uniform(generator, -2.0, -0.3)),
           kClearanceOfSeveral * uniform(generator, 0.5, 1.5), 0.01, kClearanceOfSeveral},
          2 + static_cast<int>(uniform(generator, 0.0, 7.0)),
          random_start(generator),
          {length, length + kClearanceOfSeveral},
          std::pow(10.0, uniform(generator, 2.0, 5.0)),
          std::pow(10.0, uniform(generator, -2.0, -0.3)),
          {}};
}

/// The state after a revolution, where the motion can be computed.
template <class Law>
std::optional<trajectory::State> after_revolution(const RigidRotor& m, const Law& law, double tolerance,
                                                  bool collocates, CountedGuards& events) {
  const rotor::BladeSet blades(m.blade_count, m.rotor.speed_ratio);
  const auto motion = hybrid_motion(machine_of(m.rotor, blades, kNoForcing, m.ring), law,
                                    {tolerance * kClearanceOfSeveral, 0.5}, collocates);
  if (motion->start(rotor::as_array(m.kick)) != ending::StatusDetail::none) return std::nullopt;
  if (motion->revolution(events, {}, 0) != ending::StatusDetail::none) return std::nullopt;
  return rotor::as_array(rotor::shaft(motion->state()));
}

/// Of 100 motions 99 err after a revolution by less than the tolerance times what they magnify a change of
/// their start by, of which those that tumble from contact to contact make millions. Returns the number of
/// slip reversals.
template <class MakeLaw>
int expect_errors_within_tolerance(int wanted, double length, MakeLaw make_law, bool ring_follows = false) {
  constexpr double kTolerance = 1e-9;
  constexpr double kFine = 1e-13;
  constexpr double kUnit = kTolerance * kClearanceOfSeveral;
  std::mt19937_64 generator(11);
  std::vector<double> errors;
  CountedGuards events;
  CountedGuards others;
  while (static_cast<int>(errors.size()) < wanted) {
    RigidRotor m = rigid_rotor(generator, length);
    if (ring_follows) m.ring = rotor::FollowingRing{m.stiffness * uniform(generator, 0.2, 5.0)};
    RigidRotor beside = m;
    beside.kick += kUnit;
    const auto law = make_law(m);
    const int touchdowns = events.touchdowns;
    const auto collocated = after_revolution(m, law, kTolerance, true, events);
    const auto exact = after_revolution(m, law, kFine, false, others);
    const auto exact_beside = after_revolution(beside, law, kFine, false, others);
    EXPECT_EQ(exact.has_value(), collocated.has_value());
    if (!exact || !exact_beside || !collocated || events.touchdowns == touchdowns) continue;
    const auto apart = [&](const trajectory::State& state) {
      double largest = 0.0;
      for (std::size_t i = 0; i < state.size(); ++i)
        largest = std::max(largest, std::abs(state[i] - (*exact)[i]));
      return largest / kUnit;
    };
    errors.push_back(apart(*collocated) / std::max(1.0, apart(*exact_beside)));
  }
  std::ranges::sort(errors);
  const auto quantile = [&](double share) {
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  };
  EXPECT_LE(quantile(0.5), 0.1);
  EXPECT_LE(quantile(0.99), 1.0);
  return events.reversals;
}

constexpr double kLong = 0.1;    // [m]
constexpr double kShort = 0.02;  // [m]
constexpr int kFew = 100;
constexpr int kMany = 10000;

contact::ElasticRingContact law_of(const RigidRotor& m, const contact::Friction& friction) {
  return {m.geometry, m.stiffness, friction};
}

int expect_springs_within_tolerance(int wanted) {
  return expect_errors_within_tolerance(
      wanted, kLong, [](const RigidRotor& m) { return law_of(m, contact::Friction::coulomb(m.friction)); });
}
int expect_dampers_within_tolerance(int wanted) {
  return expect_errors_within_tolerance(wanted, kLong, [](const RigidRotor& m) {
    const double critical = 2.0 * std::sqrt(m.stiffness / m.rotor.force_unit);
    return contact::ElasticRingContact(m.geometry, m.stiffness, {m.friction}, 0.1 * critical);
  });
}
int expect_rings_without_mass_within_tolerance(int wanted, double length) {
  return expect_errors_within_tolerance(
      wanted, length, [](const RigidRotor& m) { return law_of(m, contact::Friction::coulomb(m.friction)); },
      true);
}
int expect_reversals_within_tolerance(int wanted) {
  return expect_errors_within_tolerance(
      wanted, kShort, [](const RigidRotor& m) { return law_of(m, contact::Friction::coulomb(m.friction)); });
}
int expect_rests_within_tolerance(int wanted) {
  return expect_errors_within_tolerance(wanted, kShort, [](const RigidRotor& m) {
    return law_of(m, contact::Friction::sticking(m.friction, m.friction));
  });
}
int expect_smooth_reversals_within_tolerance(int wanted) {
  return expect_errors_within_tolerance(wanted, kShort, [](const RigidRotor& m) {
    return law_of(m, contact::Friction::stribeck(2.0 * m.friction, m.friction, 0.03, 0.005));
  });
}

TEST(RigidBlades, OnSpringsErrByTheTolerance) {
  expect_springs_within_tolerance(kFew);
}
TEST(RigidBlades, OnDampersErrByTheTolerance) {
  expect_dampers_within_tolerance(kFew);
}
TEST(RigidBlades, InARingWithoutMassErrByTheTolerance) {
  expect_rings_without_mass_within_tolerance(kFew, kLong);
}
TEST(RigidBlades, WhoseSlipReversesInARingWithoutMassErrByTheTolerance) {
  EXPECT_GT(expect_rings_without_mass_within_tolerance(kFew, kShort), 0);
}
TEST(RigidBlades, WhoseSlipReversesErrByTheTolerance) {
  EXPECT_GT(expect_reversals_within_tolerance(kFew), kFew / 2);
}
TEST(RigidBlades, WhoseTipsRestErrByTheTolerance) {
  EXPECT_GT(expect_rests_within_tolerance(kFew), kFew / 2);
}
TEST(RigidBlades, WhoseFrictionDependsOnTheVelocityErrByTheTolerance) {
  expect_smooth_reversals_within_tolerance(kFew);
}

TEST(RigidBlades, AtRestDoNotSlipUntilTheyLeaveTheConeOfFriction) {
  constexpr double kTolerance = 1e-9;
  std::mt19937_64 generator(11);
  int pieces = 0;
  int loosenings = 0;
  for (int i = 0; i < 3 * kFew; ++i) {
    const RigidRotor m = rigid_rotor(generator, kShort);
    TipsAtRest tips(m.rotor.speed_ratio * m.geometry.ring_radius, m.friction);
    const rotor::BladeSet blades(m.blade_count, m.rotor.speed_ratio);
    const auto motion = hybrid_motion(machine_of(m.rotor, blades),
                                      law_of(m, contact::Friction::sticking(m.friction, m.friction)),
                                      {kTolerance * kClearanceOfSeveral, 0.5}, true);
    if (motion->start(rotor::as_array(m.kick)) != ending::StatusDetail::none) continue;
    if (motion->revolution(tips, {}, 0) != ending::StatusDetail::none) continue;
    pieces += tips.pieces;
    loosenings += tips.loosenings;
    EXPECT_LT(tips.slip, kTolerance) << i;
    EXPECT_LT(tips.share_of_cone, 1.0 + 1e-6) << i;
  }
  EXPECT_GT(pieces, kFew / 10);
  EXPECT_GT(loosenings, 0);
  RecordProperty("pieces", pieces);
  RecordProperty("loosenings", loosenings);
}

TEST(RigidBladesSlow, ErrByTheToleranceInTenThousandMotions) {
  expect_springs_within_tolerance(kMany);
  expect_dampers_within_tolerance(kMany);
  expect_rings_without_mass_within_tolerance(kMany, kLong);
  expect_rings_without_mass_within_tolerance(kMany, kShort);
  expect_reversals_within_tolerance(kMany);
  expect_rests_within_tolerance(kMany);
  expect_smooth_reversals_within_tolerance(kMany);
}

void expect_same_bits(const collocation::Machine& machine, double damping,
                      const contact::Friction& friction) {
  using namespace collocation;
  collocation::Blade blade = blade_at_ring();
  blade.ring_stiffness = 2000.0;
  blade.ring_damping = damping;
  Interval first{};
  first.start_argument = 1.0;
  first.blade = {std::cos(-1.2), std::sin(-1.2)};
  first.start_angular_speed = machine.speed_ratio;
  first.shaft.start = {0.002, -0.01, 0.01, -0.03};
  first.chord = {0.3, 0.0};
  first.normal = {0.0, 1.0};
  first.tips.resize(2);
  for (TipInTime& tip : first.tips) tip.blade = &blade;
  first.tips[1].offset = {0.5, std::sqrt(0.75)};
  Interval in_pairs = first;
  Interval here = first;
  const Closeness closeness{1e-12, false};
  ASSERT_TRUE(solver_in_pairs().solve_rigid(machine, friction, closeness, in_pairs));
  ASSERT_TRUE(interval_solver().solve_rigid(machine, friction, closeness, here));
  EXPECT_EQ(in_pairs.sweeps, here.sweeps);
  const auto same = [](const AtNodes& a, const AtNodes& b) {
    return std::memcmp(a.value.data(), b.value.data(), sizeof a.value) == 0;
  };
  EXPECT_TRUE(same(in_pairs.ring.vy, here.ring.vy) && same(in_pairs.ring.ax, here.ring.ax));
  EXPECT_TRUE(same(in_pairs.shaft.vy, here.shaft.vy) &&
              same(in_pairs.leader().gap_measure, here.leader().gap_measure) &&
              same(in_pairs.leader().slip_velocity, here.leader().slip_velocity) &&
              same(in_pairs.leader().normal_force, here.leader().normal_force) &&
              same(in_pairs.tips[1].square, here.tips[1].square));
  Bounds bounds_in_pairs{};
  Bounds bounds_here = bounds_in_pairs;
  solver_in_pairs().bounds(machine, in_pairs, bounds_in_pairs);
  interval_solver().bounds(machine, here, bounds_here);
  EXPECT_EQ(bounds_in_pairs, bounds_here);
}
TEST(RigidBlades, HaveTheSameBitsOnEveryProcessor) {
  collocation::Machine machine = machine_at_ring();
  expect_same_bits(machine, 20.0, contact::Friction::stribeck(0.3, 0.1, 0.03, 0.02));
  machine.ring = {.moves = true, .spring = 3000.0};
  expect_same_bits(machine, 0.0, contact::Friction::coulomb(0.2));
}

/// The state in which the first contact of a kicked rotor with one blade ends, and how long it lasts.
struct FirstContact {
  rotor::State begin, end;
  double duration;
};
FirstContact first_contact(double stiffness) {
  class Keeper final : public modes::MotionListener {
   public:
    void event(const modes::Event& event) override {
      if (event.kind != modes::Guard::slip_reversal) events.push_back(event);
    }
    std::vector<modes::Event> events;
  } keeper;
  const rotor::RotorConstants rotor{0.3, 0.1, 0.01001, 0.01, 0.01};
  const auto motion =
      hybrid_motion(machine_of(rotor, rotor::BladeSet(1, rotor.speed_ratio)),
                    contact::ElasticRingContact({0.1, 0.11}, stiffness, {0.1}), {1e-11, 0.5}, true);
  start(*motion, rotor::State(0.0, 0.0, 0.02, 0.004));
  revolve(*motion, keeper);
  const modes::Event& down = keeper.events.at(0);
  const modes::Event& up = keeper.events.at(1);
  return {down.state, up.state, up.time - down.time};
}

TEST(RigidBlades, WhoseContactIsShorterThanTimesAreRoundedRebound) {
  const FirstContact impact = first_contact(1e33);
  EXPECT_EQ(impact.duration, 0.0);
  EXPECT_EQ(impact.begin[0], impact.end[0]);
  EXPECT_EQ(impact.begin[1], impact.end[1]);
  EXPECT_GT((impact.end - impact.begin).abs().maxCoeff(), 0.01) << "the tip comes with some speed";
  // The limit of ever stiffer rings.
  double apart_before = 1.0;
  for (const double stiffness : {1e8, 1e10, 1e12}) {
    const FirstContact contact = first_contact(stiffness);
    EXPECT_GT(contact.duration, 0.0);
    const double apart = (contact.end - impact.end).abs().maxCoeff();
    EXPECT_LT(apart, 0.2 * apart_before) << stiffness;  // as the root of 1/kr
    apart_before = apart;
  }
  EXPECT_LT(apart_before, 1e-6);
}

}  // namespace
}  // namespace rubatlas::test
