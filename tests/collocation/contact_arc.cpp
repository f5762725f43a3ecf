/// Contacts by collocation: the same on every processor, and no worse than its tolerance against the same
/// contacts in steps of the order-8 pair at a far lower tolerance.
#include "collocation/contact_arc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "contact/elastica_contact.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/motion.hpp"
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

Machine machine(std::mt19937_64& generator) {
  const double friction = std::pow(10.0, between(generator, -3.0, 0.3));
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

/// A contact of one blade alone: its touch-down and the event that ends it.
struct Contact {
  modes::Event start;
  modes::Event end;
};

/// Contacts that begin and end within a revolution, in which no other tip touches.
class Contacts final : public modes::MotionListener {
 public:
  explicit Contacts(int open) : open_(open) {}
  void event(const modes::Event& event) override {
    if (event.kind == modes::Guard::touch_down) {
      alone_ = ++open_ == 1;
      if (alone_) start_ = event;
      return;
    }
    if (alone_) found.push_back({start_, event});
    alone_ = false;
    if (event.kind == modes::Guard::lift_off) --open_;
  }
  void drops_open_contacts() { alone_ = false; }
  std::vector<Contact> found;

 private:
  int open_;
  bool alone_ = false;
  modes::Event start_{};
};

template <class Forcing>
std::vector<Contact> contacts_of(const Machine& m, const Forcing& forcing, const rotor::State& start) {
  constexpr double kTolerance = 1e-15;  // [m]
  constexpr int kRevolutions = 5;
  motion::Motion<Law, Forcing> motion(m.rotor, m.blades, m.law, forcing, {kTolerance, 0.5});
  int open = 0;
  for (int k = 0; k < m.blades.count(); ++k) {
    const auto pose =
        rotor::pose_of(m.rotor, m.law.geometry(), m.blades.direction(k, m.blades.first(0.0)), start);
    if (pose.gap > 0.0) ++open;
  }
  Contacts contacts(open);
  if (motion.start(start) != point::PointStatus::done) return {};
  for (int i = 0; i < kRevolutions; ++i) {
    if (motion.revolution(contacts) != point::PointStatus::done) break;
    contacts.drops_open_contacts();
  }
  return contacts.found;
}

struct Solved {
  bool lifts_off;
  double error;  ///< of the state at the lift-off, at the same time [clearances]
};

Solved solve(const Machine& m, const Contact& contact, double tolerance) {
  ContactArc arc(m.rotor, m.blades, m.law, m.unbalance.get(), {tolerance * kClearance, 0.5});
  const rotor::State& start = contact.start.state;
  const auto pose =
      rotor::pose_of(m.rotor, m.law.geometry(),
                     m.blades.direction(contact.start.blade, m.blades.first(contact.start.time)), start);
  const double bending =
      m.law.starts_unloaded(pose, contact.start.slip) ? 0.0 : *m.law.solve(pose, contact.start.slip);
  arc.begin(contact.start.time, start, contact.start.blade, contact.start.slip, bending);
  while (!arc.lifts_off()) {
    if (arc.make() == ContactArc::Outcome::gives_up) return {false, 0.0};
  }
  // In flight from there on, for the moment by which the lift-off is late.
  const rotor::State& end = arc.end().state;
  const double late = contact.end.time - arc.end().time;
  std::complex<double> acceleration = rotor::shaft_acceleration(m.rotor, end, std::complex<double>());
  if (m.unbalance) acceleration += m.unbalance->acceleration(arc.end().time);
  const rotor::State there =
      end + late * rotor::State(end[2], end[3], acceleration.real(), acceleration.imag());
  return {true, (there - contact.end.state).abs().maxCoeff() / kClearance};
}

struct Survey {
  std::vector<double> errors;
  int given_up = 0;         ///< that end by lift-off, and were left to other modes
  int ended_otherwise = 0;  ///< by a slip reversal, or another tip
  int not_noticed = 0;      ///< of those, how many were carried through to a lift-off
  [[nodiscard]] double quantile(double share) {
    std::ranges::sort(errors);
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  }
};

Survey survey(int wanted, double tolerance) {
  std::mt19937_64 generator(7);
  Survey result;
  while (static_cast<int>(result.errors.size()) < wanted) {
    const Machine m = machine(generator);
    rotor::State start;
    for (double& component : start) component = between(generator, -0.01, 0.01);
    const auto contacts =
        m.unbalance ? contacts_of(m, *m.unbalance, start) : contacts_of(m, rotor::NoForcing{}, start);
    // A few of each motion, so that no motion has all the say.
    constexpr std::size_t kMostOfOne = 10;
    for (std::size_t i = 0; i < std::min(contacts.size(), kMostOfOne); ++i) {
      const Solved solved = solve(m, contacts[i], tolerance);
      if (contacts[i].end.kind != modes::Guard::lift_off) {
        ++result.ended_otherwise;
        if (solved.lifts_off) ++result.not_noticed;
      } else if (solved.lifts_off) {
        result.errors.push_back(solved.error);
      } else {
        ++result.given_up;
      }
    }
  }
  return result;
}

void expect_that_errors_follow_the_tolerance(int contacts, double tolerance) {
  Survey found = survey(contacts, tolerance);
  SCOPED_TRACE(::testing::Message() << "tolerance " << tolerance << ": median " << found.quantile(0.5)
                                    << ", 99.9 % " << found.quantile(0.999) << ", largest "
                                    << found.quantile(1.0) << ", given up " << found.given_up << " of "
                                    << found.errors.size() << ", other ends " << found.ended_otherwise);
  EXPECT_LE(found.quantile(0.5), tolerance);
  EXPECT_LE(found.quantile(0.999), 20.0 * tolerance);
  EXPECT_LE(found.quantile(1.0), 100.0 * tolerance);
  EXPECT_EQ(found.not_noticed, 0);
  EXPECT_LE(found.given_up, 0.03 * contacts);
}

TEST(ContactArc, ErrsByItsToleranceInContactsOfAllKinds) {
  for (const double tolerance : {1e-7, 1e-9, 1e-11}) expect_that_errors_follow_the_tolerance(300, tolerance);
}

TEST(ContactArcSlow, ErrsByItsToleranceInTenThousandContacts) {
  for (const double tolerance : {1e-7, 1e-9, 1e-11})
    expect_that_errors_follow_the_tolerance(10000, tolerance);
}

TEST(ContactArc, HasTheSameBitsOnEveryProcessor) {
  using namespace collocation;
  const blade::ElasticaCurve curve(0.1);
  const blade::BendingTable table(curve);
  const double thickness = 1e-3;
  collocation::Contact contact{.reach = 0.1,
                               .ring_radius = 0.11,
                               .closing = -0.0021,
                               .length = 0.1,
                               .load_unit = 206e9 * 0.01 * thickness * thickness * thickness / 12.0 / 0.01,
                               .friction = 0.1,
                               .force_unit = 0.01,
                               .damping_ratio = 0.1,
                               .speed_ratio = 0.37,
                               .misalignment = 0.01001,
                               .slip = 1.0,
                               .forced = true};
  Interval first{};
  // A blade that points down, and a shaft from which its tip just reaches the ring.
  first.blade = {std::cos(-1.2), std::sin(-1.2)};
  const double x = 0.002;
  const double across = x * first.blade[0];
  const double y_from_ring = (-0.1 * first.blade[1] -
                              std::sqrt(std::pow(0.1 * first.blade[1], 2) - (x * x + 0.2 * across - 0.0021)));
  first.start = {x, y_from_ring - contact.misalignment, 0.01, -0.03};
  first.forcing = {1e-5, -2e-5};
  first.chord = {0.004, 0.4};
  first.normal = {-0.012, 0.12};
  for (std::size_t i = 0; i < kNodes; ++i)
    first.deviation[i] = 0.1 * node_tables().node[i] * (1.0 - node_tables().node[i]);
  Interval in_pairs = first;
  Interval here = first;
  const Closeness closeness{1e-12, false};
  ASSERT_TRUE(solve_in_pairs(contact, table, closeness, in_pairs));
  ASSERT_TRUE(interval_solver()(contact, table, closeness, here));
  EXPECT_GT(here.argument.at_end(), 0.2);
  EXPECT_EQ(in_pairs.sweeps, here.sweeps);
  const auto same = [](const AtNodes& a, const AtNodes& b) {
    return std::memcmp(a.value.data(), b.value.data(), sizeof a.value) == 0;
  };
  EXPECT_TRUE(same(in_pairs.x, here.x) && same(in_pairs.vy, here.vy) && same(in_pairs.ax, here.ax));
  EXPECT_TRUE(same(in_pairs.argument, here.argument) && same(in_pairs.elapsed, here.elapsed));
  EXPECT_TRUE(same(in_pairs.gap_measure, here.gap_measure) &&
              same(in_pairs.slip_velocity, here.slip_velocity));
}

TEST(ContactArc, StateAtAnyTimeIsAsAccurateAsTheEndOfAnInterval) {
  std::mt19937_64 generator(3);
  const Machine m = machine(generator);
  std::vector<Contact> contacts;
  while (contacts.empty()) {
    rotor::State start;
    for (double& component : start) component = between(generator, -0.01, 0.01);
    contacts = m.unbalance ? contacts_of(m, *m.unbalance, start) : contacts_of(m, rotor::NoForcing{}, start);
    std::erase_if(contacts, [](const Contact& one) { return one.end.kind != modes::Guard::lift_off; });
  }
  const Contact& contact = contacts.front();
  const double middle = 0.5 * (contact.start.time + contact.end.time);
  const auto state_at = [&](double tolerance) {
    ContactArc arc(m.rotor, m.blades, m.law, m.unbalance.get(), {tolerance * kClearance, 0.5});
    const auto pose = rotor::pose_of(
        m.rotor, m.law.geometry(),
        m.blades.direction(contact.start.blade, m.blades.first(contact.start.time)), contact.start.state);
    const double bending =
        m.law.starts_unloaded(pose, contact.start.slip) ? 0.0 : *m.law.solve(pose, contact.start.slip);
    arc.begin(contact.start.time, contact.start.state, contact.start.blade, contact.start.slip, bending);
    while (arc.end().time < middle) {
      if (arc.make() == ContactArc::Outcome::gives_up) ADD_FAILURE() << "given up";
    }
    return arc.state_at(middle);
  };
  EXPECT_LE((state_at(1e-8) - state_at(1e-13)).abs().maxCoeff(), 1e-8 * kClearance);
}

}  // namespace
}  // namespace rubatlas::test
