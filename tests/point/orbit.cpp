/// The contacts of an orbit: whole, close enough for the eye, and with the peaks that they have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

using test::run;  // also where another source of this folder has a `run` of its own

constexpr double kPeriodicSpeed = 0.62;
constexpr motion::SectionState kStandingStill{};

struct Contact {
  int blade = 0;
  std::vector<double> time;
  std::vector<double> force;
  [[nodiscard]] double peak() const { return *std::ranges::max_element(force); }
};

std::map<int, Contact> contacts_of(const point::Orbit& orbit) {
  const auto& samples = orbit.contacts;
  std::map<int, Contact> contacts;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    auto& contact = contacts[samples.number[i]];
    contact.blade = samples.blade[i];
    contact.time.push_back(samples.time[i]);
    contact.force.push_back(samples.force[i]);
  }
  return contacts;
}

settings::Scene five_revolutions() {
  settings::Scene scene;
  scene.observables = {"max_contact_force", "touchdowns_per_revolution", "contact_fraction"};
  scene.protocol = {200, 5, 256, settings::Settle::never};
  return scene;
}

TEST(OrbitContacts, ThreeEqualBladesPeakAlikeInAPeriodicMotion) {
  const auto orbit = solver_of(five_revolutions())->orbit(kPeriodicSpeed, kStandingStill);
  ASSERT_EQ(orbit.status, ending::PointStatus::done);
  const auto contacts = contacts_of(orbit);
  ASSERT_EQ(contacts.size(), 15U) << "three a revolution";
  const double first = contacts.begin()->second.peak();
  for (const auto& [number, contact] : contacts) EXPECT_NEAR(contact.peak(), first, 1e-6 * first);

  // The uniform samples pass by the peaks, and not by the same distance.
  double least = first;
  for (int blade = 0; blade < 3; ++blade) {
    double largest = 0.0;
    for (std::size_t i = static_cast<std::size_t>(blade); i < orbit.force.size(); i += 3)
      largest = std::max(largest, orbit.force[i]);
    EXPECT_LE(largest, first * (1.0 + 1e-9));
    least = std::min(least, largest);
  }
  EXPECT_LT(least, 0.99 * first);
}

TEST(OrbitContacts, AgreeWithTheObservablesOfTheSamePoint) {
  for (const double speed_ratio : {0.36, 0.5, kPeriodicSpeed, 0.75}) {
    SCOPED_TRACE(speed_ratio);
    auto scene = five_revolutions();
    scene.protocol.transient_revolutions = 20;
    const auto orbit = solver_of(scene)->orbit(speed_ratio, kStandingStill);
    const auto point = run(scene, speed_ratio);
    ASSERT_EQ(point.status, ending::PointStatus::done);
    const auto row = [&](std::size_t i) { return point.rows.at(i).at(0); };
    const auto contacts = contacts_of(orbit);
    double peak = 0.0;
    double duration = 0.0;
    for (const auto& [number, contact] : contacts) {
      peak = std::max(peak, contact.peak());
      duration += contact.time.back() - contact.time.front();
      EXPECT_TRUE(std::ranges::is_sorted(contact.time)) << number;
      EXPECT_GE(contact.time.size(), 9U) << number;
      EXPECT_GE(*std::ranges::min_element(contact.force), -1e-9 * contact.peak()) << number;
    }
    EXPECT_EQ(std::ranges::is_sorted(contacts, {}, [](const auto& one) { return one.second.time.front(); }),
              true);
    EXPECT_DOUBLE_EQ(peak, row(1));
    const double sampled = 2.0 * std::numbers::pi / speed_ratio * scene.protocol.sampled_revolutions;
    EXPECT_NEAR(static_cast<double>(contacts.size()) / scene.protocol.sampled_revolutions, row(0), 0.21)
        << "one may be open at the start";
    EXPECT_NEAR(duration / sampled, row(2), 1e-9) << "no two blades at once at these speeds";
  }
}

TEST(OrbitContacts, StatesAreThoseOfTheOrbitBetweenItsSamples) {
  const auto orbit = solver_of(five_revolutions())->orbit(kPeriodicSpeed, kStandingStill);
  const auto& samples = orbit.contacts;
  ASSERT_EQ(samples.state.size(), samples.time.size());
  std::size_t near = 0;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const auto after = std::ranges::lower_bound(orbit.time, samples.time[i]);
    if (after == orbit.time.end()) continue;
    const double step = *after - samples.time[i];
    const auto& state = orbit.state[static_cast<std::size_t>(after - orbit.time.begin())];
    // One uniform sample is 0.04 in τ apart: velocity times time is what the place may differ by, and a
    // contact of 23 N accelerates by 0.23 m.
    for (const std::size_t axis : {0U, 1U}) {
      EXPECT_NEAR(samples.state[i][axis] + step * samples.state[i][axis + 2], state[axis],
                  0.5 * 0.25 * step * step + 1e-12);
    }
    ++near;
  }
  EXPECT_GT(near, 100U);
}

TEST(OrbitContacts, OfAMotionWithoutAny) {
  auto scene = five_revolutions();
  scene.rotor.misalignment = 0.0;
  const auto orbit = solver_of(scene)->orbit(kPeriodicSpeed, kStandingStill);
  EXPECT_EQ(orbit.contacts.time.size(), 0U);
  EXPECT_EQ(orbit.time.size(), 5U * 256U);
}

}  // namespace
}  // namespace rubatlas::test
