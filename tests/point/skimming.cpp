/// A tip that skims the ring, in place of hops without end: an overdamped rotor that creeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "assembly/blade_tables.hpp"
#include "assembly/make_line_solver.hpp"
#include "contact/elastica_contact.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::test {
namespace {

constexpr rotor::RotorConstants kCreeping{0.005, 1.0, 0.01001, 0.01, 0.01};
constexpr contact::Geometry kDefaultGeometry{0.1, 0.11};

/// The creeping rotor, which hops on the receding side of each blade's passage.
std::unique_ptr<motion::PointMotion> creeping(double friction, double tolerance) {
  const double bending_stiffness = 206e9 * 0.01 * 1e-9 / 12.0;
  const rotor::RotatingUnbalance unbalance(1e-4, 0.3, kCreeping.speed_ratio, kCreeping.damping_ratio);
  return hybrid_motion(machine_of(kCreeping, rotor::BladeSet(3, kCreeping.speed_ratio), unbalance),
                       contact::ElasticaContact(kDefaultGeometry, {0.1, 0.001, bending_stiffness},
                                                assembly::make_blade_tables()->curve(friction)),
                       {tolerance, 0.5}, true);
}

/// Keeps the states at given times, and the events.
class Spectator final : public modes::MotionListener {
 public:
  explicit Spectator(std::vector<double> times) : times_(std::move(times)) {}
  void piece(trajectory::MotionPiece& piece) override {
    while (states.size() < times_.size() && times_[states.size()] < piece.end()) {
      states.push_back(rotor::as_state(piece.state(times_[states.size()])));
      contacts.push_back(piece.contact_count());
    }
  }
  void event(const modes::Event& event) override { events.push_back(event); }
  std::vector<rotor::State> states;
  std::vector<std::size_t> contacts;
  std::vector<modes::Event> events;

 private:
  std::vector<double> times_;
};

contact::Pose pose_at(double time, const rotor::State& state, int blade) {
  const rotor::BladeSet blades(3, kCreeping.speed_ratio);
  return rotor::pose_of(kCreeping, kDefaultGeometry, blades.direction(blade, blades.first(time)), state);
}

/// The touch-down from which a tip skims, and the lift-off where it ceases to.
std::optional<std::pair<modes::Event, modes::Event>> longest_contact_on_the_receding_side(
    const std::vector<modes::Event>& events) {
  std::optional<std::pair<modes::Event, modes::Event>> longest;
  for (std::size_t i = 1; i < events.size(); ++i) {
    const modes::Event& down = events[i - 1];
    const modes::Event& up = events[i];
    if (down.kind != modes::Guard::touch_down || up.kind != modes::Guard::lift_off) continue;
    if (down.slip * pose_at(down.time, down.state, down.blade).tangential >= 0.0) continue;
    if (!longest || up.time - down.time > longest->second.time - longest->first.time) longest = {down, up};
  }
  return longest;
}

TEST(Skimming, IsTheLimitOfEverSmallerHops) {
  // At 1e-15 m every hop is followed; at 1e-10 and 1e-11 m the tip soon skims. Away from the ring by no more
  // than the hops themselves, the shaft is at the same place.
  const std::vector<double> times{316.0, 317.0, 318.0, 319.0};
  for (const double friction : {0.1, 0.5}) {
    auto hopping = creeping(friction, 1e-15);
    Spectator hops(times);
    hopping->start({});
    ASSERT_EQ(revolve(*hopping, hops), ending::PointStatus::done);
    ASSERT_GT(hops.events.size(), 10000U);
    for (const double tolerance : {1e-10, 1e-11}) {
      auto skimming = creeping(friction, tolerance);
      Spectator skims(times);
      skimming->start({});
      ASSERT_EQ(revolve(*skimming, skims), ending::PointStatus::done);
      EXPECT_LT(skims.events.size(), hops.events.size() / 10);
      for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_EQ(skims.contacts[i], 1U);
        const double apart = (skims.states[i] - hops.states[i]).head<2>().abs().maxCoeff();
        EXPECT_LT(apart, 100.0 * tolerance) << friction << " " << tolerance << " " << times[i];
      }
    }
  }
}

TEST(Skimming, KeepsTheTipOnTheRing) {
  const std::vector<double> times{316.0, 316.9, 317.3, 318.7, 319.6};
  for (const double friction : {0.0, 0.1, 0.5}) {
    auto motion = creeping(friction, 1e-11);
    Spectator witness(times);
    motion->start({});
    ASSERT_EQ(revolve(*motion, witness), ending::PointStatus::done);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const contact::Pose at = pose_at(times[i], witness.states[i], 0);
      EXPECT_LT(std::abs(at.gap), 0.22 * 1e-11);
      EXPECT_LT(std::abs(contact::gap_rate(kDefaultGeometry, at, kCreeping.speed_ratio)), 0.22 * 1e-11);
    }
  }
}

TEST(Skimming, KeepsTheTipOnTheRingFromWhereItBegins) {
  // It touches down from a hop of half of the tolerance's height.
  constexpr double kBegin = 317.0;
  Spectator witness({kBegin});
  auto before = creeping(0.1, 1e-11);
  before->start({});
  ASSERT_EQ(revolve(*before, witness), ending::PointStatus::done);
  const rotor::State on_ring = witness.states.front();
  const contact::BladeDirection er = rotor::BladeSet(3, kCreeping.speed_ratio).first(kBegin);
  for (const double tolerance : {1e-8, 1e-9, 1e-10, 1e-11}) {
    constexpr double kCurvature = 1e-6;  // of g in free motion there, at least
    const double outwards = std::sqrt(2.0 * 0.11 * tolerance * kCurvature) / (2.0 * 0.11);
    motion::PointStart start;
    start.state = rotor::as_array(on_ring);
    start.state[2] += outwards * er.cosine;
    start.state[3] += outwards * er.sine;
    start.time = kBegin;
    start.blade = 0;
    const std::vector<double> times{kBegin + 0.01, kBegin + 0.1, kBegin + 0.2, kBegin + 0.4};
    Spectator skims(times);
    auto motion = creeping(0.1, tolerance);
    ASSERT_EQ(motion->start(start), ending::StatusDetail::none);
    ASSERT_EQ(revolve(*motion, skims), ending::PointStatus::done);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const contact::Pose at = pose_at(times[i], skims.states[i], 0);
      EXPECT_LT(std::abs(at.gap), 0.22 * tolerance) << tolerance << " " << times[i] - kBegin;
      EXPECT_LT(std::abs(contact::gap_rate(kDefaultGeometry, at, kCreeping.speed_ratio)), 0.22 * tolerance);
    }
  }
}

TEST(Skimming, EndsWhereTheFreeMotionLeavesTheRing) {
  // No force is needed any longer: g = 0, g' = 0, and without the blade g'' = 0 too.
  auto motion = creeping(0.1, 1e-11);
  Spectator witness({});
  motion->start({});
  ASSERT_EQ(revolve(*motion, witness), ending::PointStatus::done);
  const auto contact = longest_contact_on_the_receding_side(witness.events);
  ASSERT_TRUE(contact.has_value());
  EXPECT_GT(contact->second.time - contact->first.time, 1.0);
  const auto curvature_without_blade = [](const modes::Event& event) {
    const rotor::BladeSet blades(3, kCreeping.speed_ratio);
    const auto direction = blades.direction(event.blade, blades.first(event.time));
    const rotor::State& s = event.state;
    const rotor::RotatingUnbalance unbalance(1e-4, 0.3, kCreeping.speed_ratio, kCreeping.damping_ratio);
    const std::complex<double> acceleration =
        unbalance.acceleration(event.time) -
        2.0 * kCreeping.damping_ratio * std::complex<double>(s[2], s[3]) - std::complex<double>(s[0], s[1]);
    return contact::gap_curvature(kDefaultGeometry, direction, pose_at(event.time, s, event.blade),
                                  {s[0], s[1] + kCreeping.misalignment}, {s[2], s[3]}, acceleration,
                                  kCreeping.speed_ratio);
  };
  EXPECT_GT(curvature_without_blade(contact->first), 0.0);
  EXPECT_LT(std::abs(curvature_without_blade(contact->second)),
            1e-4 * curvature_without_blade(contact->first));
  const contact::Pose at = pose_at(contact->second.time, contact->second.state, contact->second.blade);
  EXPECT_LT(std::abs(contact::gap_rate(kDefaultGeometry, at, kCreeping.speed_ratio)), 0.22 * 1e-11);
}

TEST(Skimming, IsPassedOverWhereHopsAreResolved) {
  // Chaotic motion at moderate speed touches down on the receding side all the time and never skims: the same
  // bits as if there were no skimming.
  const rotor::RotorConstants rotor{0.5, 0.1, 0.01001, 0.01, 0.01};
  const rotor::RotatingUnbalance unbalance(1e-5, 0.0, rotor.speed_ratio, rotor.damping_ratio);
  const auto motion =
      hybrid_motion(machine_of(rotor, rotor::BladeSet(3, rotor.speed_ratio), unbalance),
                    contact::ElasticaContact(kDefaultGeometry, {0.1, 0.001, 206e9 * 0.01 * 1e-9 / 12.0},
                                             assembly::make_blade_tables()->curve(0.1)),
                    modes::ContactLimits{1e-11, 0.5}, true);
  Spectator witness({});
  motion->start({});
  for (int revolution = 0; revolution < 100; ++revolution)
    ASSERT_EQ(revolve(*motion, witness), ending::PointStatus::done);
  int receding = 0;
  for (const modes::Event& event : witness.events) {
    EXPECT_NE(event.kind, modes::Guard::pressed_in);
    const rotor::BladeSet blades(3, rotor.speed_ratio);
    const auto direction = blades.direction(event.blade, blades.first(event.time));
    if (event.kind == modes::Guard::touch_down &&
        event.slip * rotor::pose_of(rotor, kDefaultGeometry, direction, event.state).tangential < 0.0)
      ++receding;
  }
  EXPECT_GT(receding, 10);
}

}  // namespace
}  // namespace rubatlas::test
