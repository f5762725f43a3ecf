/// Phase volume: the map of a revolution contracts it by e^{−4ζT} and by nothing else (forces depend on
/// position only, and the jumps of the force at lift-off and at a touch-down on the receding side have
/// determinant one).
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <ostream>

#include "../support/point.hpp"
#include "../support/section_differences.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using motion::SectionState;

struct VolumeCase {
  const char* name;
  settings::ContactLaw law;
  int blades;
  double speed;
  double damping;
  double friction;
  double unbalance;
  SectionState start;
  void (*effects)(settings::Scene&) = [](settings::Scene&) {};
};

/// gtest: the name of a case in the list of tests.
void PrintTo(const VolumeCase& volume_case, std::ostream* out) {
  *out << volume_case.name;
}

class PhaseVolume : public ::testing::TestWithParam<VolumeCase> {};

TEST_P(PhaseVolume, ContractsByTheDampingAlone) {
  const VolumeCase& c = GetParam();
  settings::Scene scene = default_rotor(1);
  scene.contact = {c.law, c.friction};
  scene.blades.count = c.blades;
  scene.rotor.damping_ratio = c.damping;
  if (c.unbalance > 0.0) scene.unbalance = settings::Unbalance{c.unbalance, 0.4};
  c.effects(scene);
  scene.accuracy.tolerance = 1e-14;
  std::uint64_t touchdowns = 0;
  const auto map = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
    const auto outcome = run(scene, c.speed, {from[0], from[1], from[2], from[3]});
    EXPECT_EQ(outcome.status, PointStatus::done);
    EXPECT_EQ(outcome.work.slip_reversals, 0U);
    touchdowns = outcome.work.touchdowns;
    return rotor::as_state(outcome.final_state).matrix();
  };
  const double exact = std::exp(-4.0 * c.damping * 2.0 * std::numbers::pi / c.speed);
  EXPECT_NEAR(change_of_volume(map, rotor::as_state(c.start).matrix(), 5e-8) / exact, 1.0, 1e-6);
  EXPECT_GT(touchdowns, 0U);
}

constexpr auto kOfTheBlades = settings::ContactLaw::elastica;
constexpr auto kOfTheRing = settings::ContactLaw::elastic_ring;

// Loads that are fixed or prescribed in time, and blades of any shape, leave the forces a function of
// position.

void lean(settings::Scene& scene) {
  scene.gravity = effects::Gravity{0.1, 0.3};
}
void push(settings::Scene& scene) {
  scene.side_load = effects::SideLoad{0.1, 1.2};
}
void ripple(settings::Scene& scene) {
  scene.speed_ripple = effects::SpeedRipple{0.1, 2, 0.5};
}
void spread(settings::Scene& scene) {
  auto& blades = scene.unequal_blades.emplace();
  blades.length_spread = 1e-4;
  blades.thickness_spread = 5e-5;
  blades.angle_spread = 0.02;
}
void all_at_once(settings::Scene& scene) {
  for (const auto effect : {lean, push, ripple, spread}) effect(scene);
}

INSTANTIATE_TEST_SUITE_P(
    Effects, PhaseVolume,
    ::testing::Values(
        VolumeCase{"gravity", kOfTheBlades, 3, 0.62, 0.05, 0.1, 0.0, {2e-3, -1e-3, 1e-3, 2e-3}, lean},
        VolumeCase{"side_load", kOfTheBlades, 3, 0.45, 0.05, 0.3, 1e-4, {1e-3, 0.0, 0.0, -1e-3}, push},
        VolumeCase{"speed_ripple", kOfTheBlades, 3, 0.62, 0.05, 0.1, 1e-4, {2e-3, -1e-3, 1e-3, 2e-3}, ripple},
        VolumeCase{"unequal_blades", kOfTheBlades, 5, 0.5, 0.05, 0.3, 0.0, {-1e-3, 2e-3, 1e-3, 0.0}, spread},
        VolumeCase{
            "elastic_ring", kOfTheRing, 3, 0.45, 0.05, 0.3, 1e-4, {1e-3, 0.0, 0.0, -1e-3}, all_at_once},
        VolumeCase{"elastica", kOfTheBlades, 3, 0.45, 0.05, 0.1, 1e-4, {1e-3, 0.0, 0.0, -1e-3}, all_at_once}),
    [](const auto& instance) { return std::string(instance.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Motions, PhaseVolume,
    ::testing::Values(
        VolumeCase{"undamped", kOfTheBlades, 3, 0.62, 0.0, 0.1, 0.0, {2e-3, -1e-3, 1e-3, 2e-3}},
        VolumeCase{"well_damped", kOfTheBlades, 3, 0.9, 0.2, 0.1, 0.0, {0.0, 2e-3, 0.0, 4e-3}},
        VolumeCase{"unbalanced", kOfTheBlades, 3, 0.45, 0.05, 0.1, 1e-4, {1e-3, 0.0, 0.0, -1e-3}},
        VolumeCase{"without_friction", kOfTheBlades, 3, 0.62, 0.05, 0.0, 0.0, {2e-3, -1e-3, 1e-3, 2e-3}},
        VolumeCase{"much_friction", kOfTheBlades, 3, 0.62, 0.05, 1.0, 0.0, {1e-3, 0.0, 0.0, 1e-3}},
        VolumeCase{"five_blades", kOfTheBlades, 5, 0.5, 0.05, 0.3, 0.0, {-1e-3, 2e-3, 1e-3, 0.0}},
        VolumeCase{
            "five_blades_in_an_elastic_ring", kOfTheRing, 5, 0.5, 0.05, 0.1, 0.0, {-1e-3, 2e-3, 1e-3, 0.0}},
        VolumeCase{
            "unbalanced_in_an_elastic_ring", kOfTheRing, 3, 0.45, 0.0, 0.3, 1e-4, {1e-3, 0.0, 0.0, -1e-3}}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace rubatlas::test
