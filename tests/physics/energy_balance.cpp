/// Powers and drive torque of real motions: what the drive gives is lost in the damper, at the tips, and in
/// what contacts bend, or is stored.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numeric>
#include <random>

#include "../support/point.hpp"
#include "assembly/blade_tables.hpp"
#include "blade/elastica.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "modes/seen_tip.hpp"
#include "observables/list.hpp"

namespace rubatlas::test {
namespace {

using Row = std::vector<double>;

/// The rows of a point by their names.
std::map<std::string, Row> rows_of(settings::Scene scene, double speed_ratio,
                                   const motion::SectionState& start = {}) {
  scene.observables = {"poincare",
                       "max_contact_force",
                       "touchdowns_per_revolution",
                       "friction_power",
                       "viscous_power",
                       "deformation_power",
                       "drive_torque",
                       "impulse_of_blades",
                       "touchdowns_of_blades",
                       "max_contact_force_of_blades"};
  const auto outcome = run(scene, speed_ratio, start);
  EXPECT_EQ(outcome.status, ending::PointStatus::done);
  std::map<std::string, Row> rows;
  const auto descriptions = observables::descriptions(scene);
  for (std::size_t i = 0; i < descriptions.size(); ++i) rows[descriptions[i].name] = outcome.rows[i];
  return rows;
}

/// What a scene of the default rotor changes.
struct Case {
  const char* name;
  settings::ContactLaw law;
  double speed_ratio;
  double unbalance;  ///< me [kg m]
  int revolutions;   ///< of which sections are looked at
};
std::ostream& operator<<(std::ostream& stream, const Case& c) {
  return stream << c.name;
}

settings::Scene scene_of(const Case& c) {
  settings::Scene scene = default_rotor(c.revolutions);
  scene.contact.law = c.law;
  scene.accuracy.tolerance = 1e-12;
  if (c.unbalance > 0.0) scene.unbalance = effects::Unbalance{c.unbalance, 0.4};
  return scene;
}

/// Energy of shaft and disc [J], the centre of mass at me/m from the shaft's centre, less what is constant.
double energy_of(const settings::Scene& scene, double speed_ratio, const motion::SectionState& state) {
  const double unit = scene.rotor.mass * std::pow(scene.rotor.natural_frequency, 2);
  double energy = 0.0;
  for (const double component : state) energy += 0.5 * unit * component * component;
  if (scene.unbalance) {
    const double turning = scene.unbalance->moment * std::pow(scene.rotor.natural_frequency, 2) * speed_ratio;
    energy +=
        turning * (std::cos(scene.unbalance->phase) * state[3] - std::sin(scene.unbalance->phase) * state[2]);
  }
  return energy;
}

constexpr auto kElastica = settings::ContactLaw::elastica;
constexpr auto kElasticRing = settings::ContactLaw::elastic_ring;

class EnergyBalance : public testing::TestWithParam<Case> {};

TEST_P(EnergyBalance, OfAPeriodicMotionClosesToNineDigits) {
  const Case& c = GetParam();
  settings::Scene scene = scene_of(c);
  scene.protocol.transient_revolutions = 600;
  const auto rows = rows_of(scene, c.speed_ratio);
  // The motion repeats, so that nothing is stored: what is left is the rounding of the sections.
  const Row& sections = rows.at("poincare");
  const auto first = section(sections, 0);
  const std::size_t last = static_cast<std::size_t>(c.revolutions) - 1;
  bool repeats = false;
  for (std::size_t k = 1; k <= last; ++k)
    repeats |=
        largest_difference(section(sections, k), first) < 1e-11 && c.revolutions % static_cast<int>(k) == 0;
  ASSERT_TRUE(repeats);
  ASSERT_GT(rows.at("touchdowns_per_revolution")[0], 0.0);

  const double drive = rows.at("drive_torque")[0] * c.speed_ratio * scene.rotor.natural_frequency;
  const double friction = rows.at("friction_power")[0];
  const double viscous = rows.at("viscous_power")[0];
  const double deformation = rows.at("deformation_power")[0];
  EXPECT_GT(friction, 0.0);
  EXPECT_GT(viscous, 0.0);
  EXPECT_NEAR(drive, friction + viscous + deformation, 1e-9 * drive);
  if (c.law == kElasticRing) {
    EXPECT_NEAR(deformation, 0.0, 1e-9 * drive) << "the ring is a spring, and gives back what it has taken";
  }
  std::printf("%-28s drive %.12g W: friction %.6g, viscous %.6g, deformation %.3g, left %.2g of it\n", c.name,
              drive, friction, viscous, deformation, (drive - friction - viscous - deformation) / drive);
}

INSTANTIATE_TEST_SUITE_P(Motions, EnergyBalance,
                         testing::Values(Case{"elastica", kElastica, 0.62, 0.0, 12},
                                         Case{"elastica_slower", kElastica, 0.36, 0.0, 12},
                                         Case{"elastica_unbalance", kElastica, 0.62, 1e-5, 12},
                                         Case{"elastic_ring", kElasticRing, 0.62, 0.0, 12},
                                         Case{"elastic_ring_unbalance", kElasticRing, 0.62, 1e-5, 12}),
                         [](const auto& test) { return test.param.name; });

/// From rest, chaotic or not.
TEST(EnergyOfAnyMotion, GrowsByWhatTheDriveGivesAndIsNotLost) {
  for (const Case& c :
       {Case{"elastica", kElastica, 0.5, 0.0, 40}, Case{"unbalance", kElastica, 0.7, 1e-4, 40},
        Case{"elastic_ring", kElasticRing, 0.7, 1e-4, 40}}) {
    SCOPED_TRACE(c.name);
    const settings::Scene scene = scene_of(c);
    const motion::SectionState start{1e-3, -2e-3, 4e-3, 1e-3};
    const auto rows = rows_of(scene, c.speed_ratio, start);
    const double frequency = scene.rotor.natural_frequency;
    const double duration = c.revolutions * 2.0 * std::numbers::pi / (c.speed_ratio * frequency);  // [s]
    const auto end = section(rows.at("poincare"), static_cast<std::size_t>(c.revolutions) - 1);
    const double stored =
        (energy_of(scene, c.speed_ratio, end) - energy_of(scene, c.speed_ratio, start)) / duration;
    const double drive = rows.at("drive_torque")[0] * c.speed_ratio * frequency;
    const double lost =
        rows.at("friction_power")[0] + rows.at("viscous_power")[0] + rows.at("deformation_power")[0];
    EXPECT_NEAR(drive, lost + stored, 1e-9 * std::abs(drive));
    EXPECT_GT(std::abs(stored), 1e-6 * std::abs(drive));
    std::printf("%s: left %.2g of the drive\n", c.name, (drive - lost - stored) / drive);
  }
}

TEST(FiguresOfBlades, AddUpToThoseOfTheRotor) {
  const Case c{"elastica", kElastica, 0.5, 0.0, 40};
  const auto rows = rows_of(scene_of(c), c.speed_ratio, {1e-3, -2e-3, 4e-3, 1e-3});
  const Row& touchdowns = rows.at("touchdowns_of_blades");
  EXPECT_NEAR(std::accumulate(touchdowns.begin(), touchdowns.end(), 0.0),
              rows.at("touchdowns_per_revolution")[0], 1e-14);
  EXPECT_EQ(std::ranges::max(rows.at("max_contact_force_of_blades")), rows.at("max_contact_force")[0]);
  EXPECT_GT(std::ranges::min(rows.at("impulse_of_blades")), 0.0);
}

/// The torque of a contact is that of its force at the deformed tip, seen from the shaft's centre.
TEST(TorqueOfAContact, HasTheDeformedTipForItsLever) {
  std::mt19937_64 generator(5);
  const auto between = [&generator](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(generator);
  };
  const contact::Geometry geometry{0.1, 0.11};
  const double length = 0.1;
  const double friction = 0.3;
  const contact::ElasticaContact elastic(geometry, {length, 1e-3, 1.7}, shared_tables()->curve(friction));
  const contact::ElasticRingContact rigid(geometry, 1e4, {friction});
  const contact::BladeDirection er{std::cos(0.4), std::sin(0.4)};
  for (int i = 0; i < 100; ++i) {
    const contact::Pose at = contact::pose(geometry, er, between(0.0, 0.02), between(0.0, 0.02),
                                           between(-0.02, 0.02), between(-0.02, 0.02));
    const double speed = between(0.1, 1.5);
    const double slip = i % 2 == 0 ? 1.0 : -1.0;
    const auto expect = [&](const contact::TipForce& force, double along, double across, double coefficient) {
      const auto found = modes::contact_force(force, slip, coefficient, er, at, speed);
      const double size = std::abs(found.on_rotor) * length;
      EXPECT_NEAR(found.torque, along * force.tangential - across * force.radial, 1e-14 * size);
      EXPECT_EQ(found.friction_power(), coefficient * force.normal * force.slip_velocity);
    };
    const double bending = between(0.01, 1.5);
    const auto bent = elastic.constraint(at, slip, bending, speed).force;
    const auto exact = blade::equilibrium(friction, bending);
    expect(bent, length * (1.0 - static_cast<double>(exact.shortening)),
           -slip * length * static_cast<double>(exact.deflection), slip * friction);
    expect(rigid.force(at, slip, speed), geometry.reach, 0.0, slip * friction);
  }
}

}  // namespace
}  // namespace rubatlas::test
