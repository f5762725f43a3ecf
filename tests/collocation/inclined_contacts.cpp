/// Contacts under an inclined load by collocation: no worse than the tolerance against the same contacts in
/// steps of the order-8 pair at a far lower one, for every direction of the load and every friction law.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "collocation/contact_arc.hpp"
#include "collocation/inclined_law.hpp"
#include "contact/directed_elastica.hpp"
#include "lone_contacts.hpp"

namespace rubatlas::test {
namespace {

using collocation::ContactArc;
using contact::LoadDirection;

constexpr double kGap = 0.01;  ///< clearance [m]
constexpr double kMaxShortening = 0.5;
constexpr std::size_t kMostOfOneRotor = 10;  ///< contacts that are compared

double drawn(std::mt19937_64& generator, double least, double most) {
  return least + (most - least) * static_cast<double>(generator() >> 11U) * 0x1p-53;
}

/// A rotor whose contacts are compared. Numbers from a seed: thin blades to thick, little friction to much.
struct InclinedRotor {
  rotor::RotorConstants rotor;
  rotor::BladeSet blades;
  contact::DirectedElastica law;
};
template <class MakeFriction>
InclinedRotor inclined_rotor(std::mt19937_64& generator, LoadDirection direction,
                             MakeFriction make_friction) {
  const double friction = std::pow(10.0, drawn(generator, -2.0, -0.15));
  const double thickness = std::pow(10.0, drawn(generator, -3.5, -2.7));
  const double damping = std::pow(10.0, drawn(generator, -3.0, -0.3));
  const double speed = drawn(generator, 0.05, 1.0);
  const double velocity = std::pow(10.0, drawn(generator, -2.5, -1.5));
  const double stiffness = 206e9 * 0.01 * thickness * thickness * thickness / 12.0;
  return InclinedRotor{
      {speed, damping, kGap * drawn(generator, 0.5, 1.5), 0.01, kGap},
      {3, speed},
      {direction, {0.1, 0.11}, {0.1, thickness, stiffness}, make_friction(friction, velocity)}};
}

contact::Pose pose_at(const InclinedRotor& m, int blade, double time, const rotor::State& state) {
  return rotor::pose_of(m.rotor, m.law.geometry(), m.blades.direction(blade, m.blades.first(time)), state);
}

std::vector<LoneContact> contacts_of(const InclinedRotor& m, const rotor::State& start) {
  constexpr double kTolerance = 1e-14;  // [m]
  const auto motion =
      hybrid_motion(m.rotor, m.blades, m.law, kNoForcing, modes::ContactLimits{kTolerance, kMaxShortening});
  int open = 0;
  for (int k = 0; k < m.blades.count(); ++k) {
    if (pose_at(m, k, 0.0, start).gap > 0.0) ++open;
  }
  return lone_contacts(*motion, start, open, kMostOfOneRotor);
}

modes::Guard end_of(const ContactArc& arc) {
  switch (arc.ending().guard) {
    case ContactArc::Guard::touch_down:
      return modes::Guard::touch_down;
    case ContactArc::Guard::slip_reversal:
      return modes::Guard::slip_reversal;
    case ContactArc::Guard::fold:
    case ContactArc::Guard::chart_end:
      return modes::Guard::snap;
    default:
      return modes::Guard::lift_off;
  }
}

struct InclinedSurvey {
  std::vector<double> errors;  ///< [tolerances] of states at the end, at the same time
  int given_up = 0;            ///< contacts that were left to other modes
  int ends_differ = 0;         ///< contacts that ended in another way
  int ended_otherwise = 0;     ///< than by lift-off
  int differ_at_start = 0;     ///< blades that were found bent otherwise than by the law itself
};

template <class MakeFriction>
InclinedSurvey survey(int wanted, double tolerance, LoadDirection direction, MakeFriction make_friction) {
  std::mt19937_64 generator(7);
  InclinedSurvey result;
  while (static_cast<int>(result.errors.size()) < wanted) {
    const auto m = inclined_rotor(generator, direction, make_friction);
    rotor::State kick;
    for (double& component : kick) component = drawn(generator, -kGap, kGap);
    const auto contacts = contacts_of(m, kick);
    const rotor::Machine machine =
        machine_of(m.rotor, m.blades, rotor::Harmonics(std::vector<rotor::Harmonic>{}));
    collocation::InclinedLaw law(laws_of(m.law, m.blades.count()));
    ContactArc arc(machine, law, tolerance * kGap, kMaxShortening);
    for (std::size_t i = 0; i < std::min(contacts.size(), kMostOfOneRotor); ++i) {
      const auto& [start, end] = contacts[i];
      const contact::Pose at = pose_at(m, start.blade, start.time, start.state);
      auto touch = law.in_equilibrium({start.blade, start.slip, 0.0}, {at, m.rotor.speed_ratio});
      blade::Bend bend{};
      contact::TipForce force{};
      const bool stands = m.law.respond(at, start.slip, m.rotor.speed_ratio, bend, force);
      // Where g is a rounding error, so is the force.
      const double same = 1e-8 * m.law.load_unit();
      if (stands != touch.has_value() ||
          (stands && std::abs(law.force(*touch, {at, m.rotor.speed_ratio}).normal - force.normal) > same))
        ++result.differ_at_start;
      if (!touch) continue;
      arc.begin(start.time, rotor::shaft_and_ring(start.state), std::span(&*touch, 1));
      bool made = true;
      do {
        made = arc.make() == ContactArc::Outcome::made;
      } while (made && arc.ending().guard == ContactArc::Guard::none);
      if (!made) {
        ++result.given_up;
        continue;
      }
      if (end_of(arc) != end.kind) ++result.ends_differ;
      if (end.kind != modes::Guard::lift_off) ++result.ended_otherwise;
      const rotor::State state = rotor::shaft(arc.end().bodies);
      // Both at the time where the steps end; after a lift-off without a force.
      std::complex<double> force_then;
      if (end.kind != modes::Guard::lift_off) {
        force_then = contact::on_rotor(arc.force(arc.touch_of(start.blade, arc.end()), arc.end()),
                                       m.blades.direction(start.blade, m.blades.first(arc.end().time)));
      }
      const auto acceleration = rotor::shaft_acceleration(m.rotor, state, force_then);
      const double late = end.time - arc.end().time;
      const rotor::State then =
          state + late * rotor::State(state[2], state[3], acceleration.real(), acceleration.imag());
      result.errors.push_back((then - end.state).abs().maxCoeff() / (kGap * tolerance));
    }
  }
  std::ranges::sort(result.errors);
  return result;
}

void expect_contacts_within_tolerance(const InclinedSurvey& found) {
  const auto quantile = [&](double share) {
    return found.errors[static_cast<std::size_t>(share * static_cast<double>(found.errors.size() - 1))];
  };
  SCOPED_TRACE(::testing::Message() << "median " << quantile(0.5) << ", 99 % " << quantile(0.99)
                                    << ", largest " << quantile(1.0) << " tolerances; other ends "
                                    << found.ended_otherwise << ", given up " << found.given_up);
  EXPECT_LE(quantile(0.5), 1.0);
  EXPECT_LE(quantile(0.99), 20.0);
  EXPECT_LE(quantile(1.0), 200.0);
  EXPECT_EQ(found.ends_differ, 0);
  EXPECT_EQ(found.differ_at_start, 0);
  EXPECT_LE(found.given_up, 0.003 * static_cast<double>(found.errors.size()));
}

void expect_contacts_of_all_laws_within_tolerance(int each, double tolerance) {
  const auto coulomb = [](double friction, double /*velocity*/) {
    return contact::Friction::coulomb(friction);
  };
  const auto regularised = [](double friction, double velocity) {
    return contact::Friction::regularised(friction, velocity);
  };
  const auto stribeck = [](double friction, double velocity) {
    return contact::Friction::stribeck(3.0 * friction, friction, 0.03, 0.2 * velocity);
  };
  expect_contacts_within_tolerance(survey(each, tolerance, LoadDirection::normal, coulomb));
  for (const LoadDirection direction : {LoadDirection::axial, LoadDirection::normal}) {
    expect_contacts_within_tolerance(survey(each, tolerance, direction, regularised));
    expect_contacts_within_tolerance(survey(each, tolerance, direction, stribeck));
  }
}

TEST(InclinedContacts, ErrByTheToleranceWhereverTheyEnd) {
  expect_contacts_of_all_laws_within_tolerance(100, 1e-9);
}

TEST(InclinedContactsSlow, ErrByTheToleranceInTwoThousandContactsOfEachLaw) {
  for (const double tolerance : {1e-7, 1e-9, 1e-11})
    expect_contacts_of_all_laws_within_tolerance(2000, tolerance);
}

TEST(InclinedContacts, HaveTheSameBitsOnEveryProcessor) {
  using namespace collocation;
  const double thickness = 1e-3;
  const collocation::Machine machine = machine_at_ring();
  collocation::Blade blade = blade_at_ring();
  blade.length = 0.1;
  blade.load_unit = 206e9 * 0.01 * thickness * thickness * thickness / 12.0 / 0.01;
  InclinedLoad load{true, contact::Friction::stribeck(0.3, 0.1, 0.03, 0.002)};
  blade.strain_unit = 0.005;
  Interval first = interval_at_ring(machine.misalignment, blade);
  first.start_angular_speed = machine.speed_ratio;
  const double x = first.shaft.start[0];
  const double y_from_ring = first.shaft.start[1] + machine.misalignment;
  const double angle = std::atan(0.1) + std::asin((y_from_ring * first.blade[0] - x * first.blade[1]) / 0.11);
  load.scale = 2.0 * std::sin(0.5 * angle);
  TipInTime& leader = first.leader();
  leader.load = &load;
  leader.start_lean = std::sin(0.5 * angle);
  leader.lean.value.fill(leader.start_lean);
  // A further blade in the same place, and just so bent.
  first.tips.push_back(leader);
  TipInTime& further = first.tips[1];
  for (std::size_t i = 0; i < kNodes; ++i) further.square[i] = 0.05 * kNodeTables.node[i];
  Interval in_pairs = first;
  Interval here = first;
  const Closeness closeness{1e-12, false};
  ASSERT_TRUE(solver_in_pairs().solve_inclined(machine, closeness, in_pairs));
  ASSERT_TRUE(interval_solver().solve_inclined(machine, closeness, here));
  EXPECT_GT(here.argument.at_end(), 0.2);
  EXPECT_EQ(in_pairs.sweeps, here.sweeps);
  const auto same = [](const AtNodes& a, const AtNodes& b) {
    return std::memcmp(a.value.data(), b.value.data(), sizeof a.value) == 0;
  };
  EXPECT_TRUE(same(in_pairs.shaft.vy, here.shaft.vy) && same(in_pairs.argument, here.argument) &&
              same(in_pairs.leader().lean, here.leader().lean));
  EXPECT_TRUE(same(in_pairs.leader().gap_measure, here.leader().gap_measure) &&
              same(in_pairs.leader().slip_velocity, here.leader().slip_velocity) &&
              same(in_pairs.leader().normal_force, here.leader().normal_force) &&
              same(in_pairs.leader().root_strain, here.leader().root_strain));
  EXPECT_TRUE(same(in_pairs.tips[1].square, here.tips[1].square) &&
              same(in_pairs.tips[1].lean, here.tips[1].lean) &&
              same(in_pairs.tips[1].firmness, here.tips[1].firmness));
  for (std::size_t i = 0; i < kNodes; ++i)
    EXPECT_NEAR(here.tips[1].square[i], here.argument[i] * here.argument[i], 1e-9) << i;
  Bounds bounds_in_pairs{};
  Bounds bounds_here = bounds_in_pairs;
  solver_in_pairs().bounds(machine, in_pairs, bounds_in_pairs);
  interval_solver().bounds(machine, here, bounds_here);
  EXPECT_EQ(bounds_in_pairs, bounds_here);
}

}  // namespace
}  // namespace rubatlas::test
