/// Contacts by collocation err by their tolerance against the same contacts in steps of the order-8 pair at a
/// far lower tolerance.
#include "collocation/contact_arc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "arc_of_rotor.hpp"
#include "contact/elastica_contact.hpp"
#include "lone_contacts.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::test {
namespace {

using collocation::ContactArc;
using Law = contact::ElasticaContact;

constexpr double kClearance = 0.01;  // [m]

/// A rotor whose contacts are compared. Numbers from a seed: thin blades to thick, little friction to much.
struct Machine {
  rotor::RotorConstants rotor;
  rotor::BladeSet blades;
  Law law;
  std::unique_ptr<rotor::RotatingUnbalance> unbalance;  ///< null: none
};

double between(std::mt19937_64& generator, double least, double most) {
  return least + (most - least) * static_cast<double>(generator() >> 11U) * 0x1p-53;
}

Machine machine(std::mt19937_64& generator, bool rubs = true) {
  const double friction = rubs ? std::pow(10.0, between(generator, -3.0, 0.3)) : 0.0;
  const double thickness = std::pow(10.0, between(generator, -3.7, -2.5));
  const double damping = std::pow(10.0, between(generator, -3.0, -0.3));
  const double speed = between(generator, 0.05, 1.0);
  const double stiffness = 206e9 * 0.01 * thickness * thickness * thickness / 12.0;
  Machine result{{speed, damping, kClearance * between(generator, 0.5, 1.5), 0.01, kClearance},
                 {3, speed},
                 {{0.1, 0.11}, {0.1, thickness, stiffness}, std::make_shared<blade::ElasticaCurve>(friction)},
                 nullptr};
  if (between(generator, 0.0, 1.0) < 0.5) {
    result.unbalance = std::make_unique<rotor::RotatingUnbalance>(
        std::pow(10.0, between(generator, -6.0, -3.0)), between(generator, 0.0, 6.28), speed, damping);
  }
  return result;
}

template <class Forcing>
std::vector<LoneContact> contacts_of(const Machine& m, const Forcing& forcing, const rotor::State& start) {
  constexpr double kTolerance = 1e-15;  // [m]
  const auto motion = hybrid_motion(m.rotor, m.blades, m.law, forcing, modes::ContactLimits{kTolerance, 0.5});
  int open = 0;
  for (int k = 0; k < m.blades.count(); ++k) {
    const auto pose =
        rotor::pose_of(m.rotor, m.law.geometry(), m.blades.direction(k, m.blades.first(0.0)), start);
    if (pose.gap > 0.0) ++open;
  }
  return lone_contacts(*motion, start, open);
}

/// Error of a state at its lift-off, at the time when the contact ends [clearances]: in flight from there on,
/// for the moment by which the lift-off is late.
double error_at_end(const Machine& m, const LoneContact& contact, double time, const rotor::State& state) {
  const double late = contact.end.time - time;
  std::complex<double> acceleration = rotor::shaft_acceleration(m.rotor, state, std::complex<double>());
  if (m.unbalance) acceleration += m.unbalance->acceleration(time);
  const rotor::State there =
      state + late * rotor::State(state[2], state[3], acceleration.real(), acceleration.imag());
  return (there - contact.end.state).abs().maxCoeff() / kClearance;
}

struct Solved {
  ContactArc::Guard end;  ///< none: it gives up
  double error;           ///< of the state at the lift-off, at the same time [clearances]
  [[nodiscard]] bool lifts_off() const {
    return end == ContactArc::Guard::unbent || end == ContactArc::Guard::under_load;
  }
};

/// The contact by collocation, where it begins.
std::unique_ptr<ArcOfRotor> arc_of(const Machine& m, const LoneContact& contact, double tolerance) {
  auto arc = std::make_unique<ArcOfRotor>(m.rotor, m.blades.count(), m.law, m.unbalance.get(),
                                          tolerance * kClearance);
  const modes::Event& start = contact.start;
  const auto pose = rotor::pose_of(m.rotor, m.law.geometry(),
                                   m.blades.direction(start.blade, m.blades.first(start.time)), start.state);
  const double bending = m.law.starts_unloaded(pose, start.slip) ? 0.0 : *m.law.solve(pose, start.slip);
  std::array touching{collocation::Touch{start.blade, start.slip, bending}};
  arc->begin(start.time, start.state, touching);
  return arc;
}

Solved solve(const Machine& m, const LoneContact& contact, double tolerance) {
  const auto held = arc_of(m, contact, tolerance);
  ContactArc& arc = held->arc;
  while (arc.ending().guard == ContactArc::Guard::none) {
    if (arc.make() != ContactArc::Outcome::made) break;
  }
  return {arc.ending().guard, error_at_end(m, contact, arc.end().time, held->end_state())};
}

/// The lift-off of one blade.
class LiftOff final : public modes::MotionListener {
 public:
  explicit LiftOff(int blade) : blade_(blade) {}
  void event(const modes::Event& event) override {
    if (!found && event.kind == modes::Guard::lift_off && event.blade == blade_) found = event;
  }
  std::optional<modes::Event> found;

 private:
  int blade_;
};

/// The same contact in steps of the order-8 pair, on a rotor without unbalance. Nothing where it does not end
/// by its lift-off.
std::optional<double> error_of_hybrid(const Machine& m, const LoneContact& contact, double tolerance) {
  // The revolution starts with the contact, its blades turned as far as they are there.
  const double from = contact.start.time;
  std::vector<double> angles = rotor::equal_angles(m.blades.count());
  for (double& angle : angles) angle += m.rotor.speed_ratio * from;
  const auto motion = hybrid_motion(m.rotor, rotor::BladeSet(angles, m.rotor.speed_ratio), m.law, kNoForcing,
                                    modes::ContactLimits{tolerance * kClearance, 0.5});
  LiftOff lift_off(contact.start.blade);
  if (motion->start(rotor::as_array(contact.start.state)) != ending::StatusDetail::none) return std::nullopt;
  if (revolve(*motion, lift_off) != ending::PointStatus::done || !lift_off.found) return std::nullopt;
  return error_at_end(m, contact, from + lift_off.found->time, lift_off.found->state);
}

struct Survey {
  std::vector<double> errors;
  std::vector<double> errors_of_hybrid;  ///< of the contacts without unbalance
  int given_up = 0;                      ///< that end by lift-off, and were left to other modes
  int ended_otherwise = 0;               ///< by a slip reversal, or another tip
  int not_noticed = 0;                   ///< of those, how many were carried through to a lift-off
  int reversals = 0;                     ///< that end by a slip reversal
  int reversals_given_up = 0;            ///< of those, how many were left to other modes
};

double quantile(std::vector<double> errors, double share) {
  std::ranges::sort(errors);
  return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
}

Survey survey(int wanted, double tolerance, bool with_hybrid, bool rubs = true) {
  std::mt19937_64 generator(7);
  Survey result;
  while (static_cast<int>(result.errors.size()) < wanted) {
    const Machine m = machine(generator, rubs);
    rotor::State start;
    for (double& component : start) component = between(generator, -0.01, 0.01);
    const auto contacts =
        m.unbalance ? contacts_of(m, *m.unbalance, start) : contacts_of(m, kNoForcing, start);
    // A few of each motion, so that no motion has all the say.
    constexpr std::size_t kMostOfOne = 10;
    for (std::size_t i = 0; i < std::min(contacts.size(), kMostOfOne); ++i) {
      const Solved solved = solve(m, contacts[i], tolerance);
      if (contacts[i].end.kind != modes::Guard::lift_off) {
        ++result.ended_otherwise;
        if (solved.lifts_off()) ++result.not_noticed;
        if (contacts[i].end.kind == modes::Guard::slip_reversal) {
          ++result.reversals;
          if (solved.end != ContactArc::Guard::slip_reversal) ++result.reversals_given_up;
        }
      } else if (solved.lifts_off()) {
        result.errors.push_back(solved.error);
        if (!with_hybrid || m.unbalance) continue;
        if (const auto error = error_of_hybrid(m, contacts[i], tolerance))
          result.errors_of_hybrid.push_back(*error);
      } else {
        ++result.given_up;
      }
    }
  }
  return result;
}

void expect_that_errors_follow_the_tolerance(const Survey& found, double tolerance) {
  const auto in_tolerances = [&](double share) { return quantile(found.errors, share) / tolerance; };
  const ::testing::Message errors =
      ::testing::Message() << std::setprecision(3) << "tolerance " << tolerance << ": median "
                           << in_tolerances(0.5) << ", 99.9 % " << in_tolerances(0.999) << ", largest "
                           << in_tolerances(1.0) << " tolerances, given up " << found.given_up << " of "
                           << found.errors.size() << ", other ends " << found.ended_otherwise;
  std::cout << errors << '\n';
  SCOPED_TRACE(errors);
  EXPECT_LE(in_tolerances(0.5), 0.1);
  EXPECT_LE(in_tolerances(0.999), 5.0);
  EXPECT_LE(in_tolerances(1.0), 20.0);
  EXPECT_EQ(found.not_noticed, 0);
  EXPECT_LE(found.given_up, 0.03 * static_cast<double>(found.errors.size()));
  EXPECT_LE(found.reversals_given_up, 0.1 * found.reversals);
}

TEST(ContactArc, ErrsByItsToleranceInContactsOfAllKinds) {
  for (const double tolerance : {1e-7, 1e-9, 1e-11})
    expect_that_errors_follow_the_tolerance(survey(300, tolerance, false), tolerance);
}

TEST(ContactArc, OfColumnsErrsByItsTolerance) {
  for (const double tolerance : {1e-7, 1e-9, 1e-11})
    expect_that_errors_follow_the_tolerance(survey(300, tolerance, false, false), tolerance);
}

/// Measured at 1e-7, 1e-9, 1e-11, 99.9 % in tolerances: 2.7, 1.3, 2.6 by arcs; 2.7, 3.7, 5.9 by steps, which
/// solve for the force of each stage. At 1e-9 the largest: 5.4 and 52; of columns 12 and, in steps, 180,
/// whose force jumps where a contact begins.
void expect_that_those_in_steps_do(const Survey& found, double tolerance) {
  EXPECT_LE(quantile(found.errors_of_hybrid, 0.999), 20.0 * tolerance) << tolerance;
}

TEST(ContactArcSlow, OfColumnsErrsByItsToleranceInTenThousandContactsAsDoSteps) {
  const double tolerance = 1e-9;
  const Survey found = survey(10000, tolerance, true, false);
  expect_that_errors_follow_the_tolerance(found, tolerance);
  expect_that_those_in_steps_do(found, tolerance);
}

TEST(ContactArcSlow, ErrsByItsToleranceInTenThousandContactsAsDoSteps) {
  for (const double tolerance : {1e-7, 1e-9, 1e-11}) {
    const Survey found = survey(10000, tolerance, true);
    expect_that_errors_follow_the_tolerance(found, tolerance);
    expect_that_those_in_steps_do(found, tolerance);
    EXPECT_LE(quantile(found.errors_of_hybrid, 1.0), 100.0 * tolerance) << tolerance;
  }
}

/// The first contact, of rotors from a seed, that ends by lift-off.
struct OneContact {
  Machine machine;
  LoneContact contact;
  /// The arc up to the interval in which `reached` holds.
  template <class Reached>
  [[nodiscard]] std::unique_ptr<ArcOfRotor> arc(double tolerance, Reached reached) const {
    auto held = arc_of(machine, contact, tolerance);
    while (!reached(held->arc)) {
      if (held->arc.make() != ContactArc::Outcome::made) break;
      if (held->arc.ending().guard != ContactArc::Guard::none) break;
    }
    EXPECT_TRUE(reached(held->arc));
    return held;
  }
};
OneContact contact_of(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  OneContact result{machine(generator), {}};
  const Machine& m = result.machine;
  std::vector<LoneContact> contacts;
  while (contacts.empty()) {
    rotor::State start;
    for (double& component : start) component = between(generator, -0.01, 0.01);
    contacts = m.unbalance ? contacts_of(m, *m.unbalance, start) : contacts_of(m, kNoForcing, start);
    std::erase_if(contacts, [](const LoneContact& one) { return one.end.kind != modes::Guard::lift_off; });
  }
  result.contact = contacts.front();
  return result;
}

TEST(ContactArc, StateAtAnyTimeIsAsAccurateAsTheEndOfAnInterval) {
  const OneContact one = contact_of(3);
  const double middle = 0.5 * (one.contact.start.time + one.contact.end.time);
  const auto state_at = [&](double tolerance) {
    const auto held = one.arc(tolerance, [&](const ContactArc& arc) { return arc.end().time >= middle; });
    return held->arc.solved_at(middle).bodies;
  };
  EXPECT_LE((state_at(1e-8) - state_at(1e-13)).abs().maxCoeff(), 1e-8 * kClearance);
}

/// Calls `use` with each interval of contacts at 1e-9 of many rotors, and with the contact.
template <class Use>
void for_each_interval(Use use) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const OneContact one = contact_of(seed);
    const auto first = one.arc(1e-9, [](const ContactArc&) { return true; });
    ContactArc& arc = first->arc;
    while (arc.make() == ContactArc::Outcome::made) {
      use(arc, one);
      if (arc.ending().guard != ContactArc::Guard::none) break;
    }
  }
}

TEST(ContactArc, SlipVelocitiesAreThoseOfTheStatesThatAreFound) {
  double largest = 0.0;
  for_each_interval([&](const ContactArc& arc, const OneContact& one) {
    if (arc.ending().guard != ContactArc::Guard::none) return;  // its place is moved to where the gap is zero
    const Machine& m = one.machine;
    const auto& [blade, slip] = std::pair(one.contact.start.blade, one.contact.start.slip);
    const auto er = m.blades.direction(blade, m.blades.first(arc.end().time));
    const auto pose = rotor::pose_of(m.rotor, m.law.geometry(), er, rotor::shaft(arc.end().bodies));
    const auto there =
        m.law.constraint(pose, slip, arc.touch_of(blade, arc.end()).bending, m.rotor.speed_ratio);
    largest = std::max(largest, std::abs(arc.tip(blade).slip_velocity.at_end() - there.force.slip_velocity));
  });
  EXPECT_LE(largest, 1e-9 * kClearance);
  EXPECT_GT(largest, 0.0);
}

TEST(ContactArc, PlacesBetweenTheNodesErrAsVelocitiesMayThere) {
  double largest = 0.0;
  for_each_interval([&](ContactArc& arc, const OneContact&) {
    for (int i = 1; i < 40; ++i) {
      const double time = arc.start().time + (arc.end().time - arc.start().time) * i / 40;
      const auto place = arc.place_at(arc.fraction_at(time));
      const rotor::ShaftAndRing solved = arc.solved_at(time).bodies;
      largest = std::max({largest, std::abs(place[0] - solved[0]), std::abs(place[1] - solved[1])});
    }
  });
  // 0.54 ε^(9/14) of the clearance for velocities, over less than a unit of time.
  EXPECT_LE(largest, 0.54 * std::pow(1e-9, 9.0 / 14.0) * 1.5 * kClearance);
  EXPECT_GT(largest, 0.0);
}

TEST(ContactArc, TheLargestDisplacementIsAsAccurateAsTheEndOfAnInterval) {
  int inside = 0;
  for_each_interval([&](ContactArc& arc, const OneContact&) {
    const double begin = arc.start().time;
    const double end = arc.end().time;
    const auto distance = [&](double time) {
      const rotor::ShaftAndRing state = arc.solved_at(time).bodies;
      return std::hypot(state[0], state[1]);
    };
    constexpr int kParts = 32;
    const auto time_of = [&](int part) { return begin + (end - begin) * part / kParts; };
    double expected = 0.0;
    int farthest = 0;
    for (int part = 0; part <= kParts; ++part) {
      const double there = distance(time_of(part));
      if (there > expected) farthest = part;
      expected = std::max(expected, there);
    }
    const double top = -boost::math::tools::brent_find_minima([&](double time) { return -distance(time); },
                                                              time_of(std::max(farthest - 1, 0)),
                                                              time_of(std::min(farthest + 1, kParts)), 26)
                            .second;
    if (top > expected) ++inside;
    expected = std::max(expected, top);
    EXPECT_NEAR(arc.largest_displacement(begin, end, 0.0), expected, 1e-9 * kClearance);
    EXPECT_EQ(arc.largest_displacement(begin, end, 2.0 * expected), 2.0 * expected);
  });
  EXPECT_GT(inside, 5);
}

}  // namespace
}  // namespace rubatlas::test
