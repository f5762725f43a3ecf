/// The linearised flow against what it is the derivative of, and against what it must keep.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "../support/point.hpp"
#include "../support/section_differences.hpp"

namespace rubatlas::test {
namespace {

settings::Scene tight_rotor(double tolerance = 1e-12) {
  settings::Scene scene = default_rotor(1);
  scene.accuracy.tolerance = tolerance;
  return scene;
}
settings::Scene on_elastic_ring() {
  settings::Scene scene = tight_rotor();
  scene.contact.law = settings::ContactLaw::elastic_ring;
  return scene;
}

/// A state that the rotor reaches at a speed after some revolutions from rest.
motion::SectionState reached(point::LineSolver& solver, double speed_ratio, int revolutions) {
  return solver.section_map(speed_ratio, {}, revolutions).sections.back();
}

/// Holds the tangents of a revolution against differences of the same motion. False where the differences do
/// not tell: where a touch-down lies within their steps the motion is not as smooth as they need.
bool are_held_against(const point::SectionMap& found, const Differences& expected, double speed_ratio) {
  EXPECT_TRUE(found.differentiable) << speed_ratio;
  if (!(expected.error < 1e-7)) return false;
  EXPECT_LE((found.jacobian - expected.jacobian).norm(), 1e-6 * expected.jacobian.norm())
      << "speed ratio " << speed_ratio << '\n'
      << found.jacobian << "\n\n"
      << expected.jacobian;
  return true;
}
/// The same of the section map of the shaft.
bool are_held_against_differences(point::LineSolver& solver, double speed_ratio) {
  const motion::SectionState start = reached(solver, speed_ratio, 37);
  return are_held_against(solver.section_map(speed_ratio, start, 1),
                          differences(solver, speed_ratio, start, 1, 1e-6 * 0.01), speed_ratio);
}

TEST(Tangents, AreTheDerivativeOfTheSectionMap) {
  int compared = 0;
  for (const settings::Scene& scene : {tight_rotor(), on_elastic_ring()}) {
    const auto solver = solver_of(scene);
    for (const double speed : {0.3, 0.36, 0.42, 0.5, 0.62, 0.75}) {
      if (are_held_against_differences(*solver, speed)) ++compared;
    }
  }
  EXPECT_GE(compared, 9);
}

TEST(Tangents, ContractPhaseVolumeByDampingAlone) {
  for (const settings::Scene& scene : {tight_rotor(), on_elastic_ring()}) {
    const auto solver = solver_of(scene);
    for (const double speed : {0.3, 0.36, 0.42, 0.5, 0.62, 0.75, 0.9}) {
      const motion::SectionState start = reached(*solver, speed, 20);
      const auto map = solver->section_map(speed, start, 1);
      ASSERT_TRUE(map.differentiable) << speed;
      const double expected =
          std::exp(-4.0 * scene.rotor.damping_ratio * 2.0 * std::numbers::pi / speed + map.log_volume);
      // Digits of a determinant are lost against the product of the norms.
      const double rounding = 1e-14 * std::pow(map.jacobian.norm(), 4);
      EXPECT_NEAR(determinant(map.jacobian), expected, 1e-9 * expected + rounding) << "speed ratio " << speed;
    }
  }
}

TEST(Tangents, OfTwoRevolutionsAreTheProductOfBoth) {
  const auto solver = solver_of(tight_rotor());
  const motion::SectionState start = reached(*solver, 0.36, 37);
  const auto both = solver->section_map(0.36, start, 2);
  const auto first = solver->section_map(0.36, start, 1);
  const auto second = solver->section_map(0.36, first.sections.back(), 1);
  const Eigen::Matrix4d product = second.jacobian * first.jacobian;
  EXPECT_LE((both.jacobian - product).norm(), 1e-9 * product.norm());
}

TEST(Tangents, OfARotorThatNeverTouchesAreThoseOfFreeMotion) {
  settings::Scene scene = tight_rotor();
  scene.rotor.misalignment = 0.0;
  const auto solver = solver_of(scene);
  const double speed = 0.4;
  const auto map = solver->section_map(speed, motion::SectionState{1e-3, 0.0, 0.0, 1e-3}, 1);
  const double duration = 2.0 * std::numbers::pi / speed;
  const double damping = scene.rotor.damping_ratio;
  const double frequency = std::sqrt(1.0 - damping * damping);
  const double decay = std::exp(-damping * duration);
  const double sine = decay * std::sin(frequency * duration) / frequency;
  const double cosine = decay * std::cos(frequency * duration);
  EXPECT_NEAR(map.jacobian(0, 0), cosine + damping * sine, 1e-14);
  EXPECT_NEAR(map.jacobian(0, 2), sine, 1e-14);
  EXPECT_NEAR(map.jacobian(2, 0), -sine, 1e-14);
  EXPECT_NEAR(map.jacobian(3, 3), cosine - damping * sine, 1e-14);
  EXPECT_EQ(map.jacobian(0, 1), 0.0);
}

settings::Scene on_support() {
  settings::Scene scene = tight_rotor();
  // Anisotropic, with a seal, and with damping that turns with the rotor.
  scene.support = effects::Support{.stiffness_xx = 20.0,
                                   .stiffness_xy = 4.0,
                                   .stiffness_yx = -4.0,
                                   .damping_yy = 0.5,
                                   .rotating_damping = 0.3};
  return scene;
}

TEST(Tangents, OnAnySupportAreTheDerivativeOfTheSectionMap) {
  int compared = 0;
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    settings::Scene scene = on_support();
    scene.contact.law = law;
    const auto solver = solver_of(scene);
    for (const double speed : {0.31, 0.45, 0.62, 0.75}) {
      if (are_held_against_differences(*solver, speed)) ++compared;
    }
  }
  EXPECT_GE(compared, 4);
}

/// Rotors whose friction depends on the slip velocity, slowly enough that it does in every contact.
std::vector<settings::Scene> with_friction_that_depends_on_velocity() {
  std::vector<settings::Scene> scenes;
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    settings::Scene regularised = tight_rotor();
    regularised.contact.law = law;
    regularised.regularised_friction = effects::RegularisedFriction{.velocity = 0.4};
    settings::Scene stribeck = tight_rotor();
    stribeck.contact.law = law;
    stribeck.stribeck =
        effects::Stribeck{.static_friction = 0.3, .velocity = 0.5, .regularising_velocity = 0.1};
    scenes.insert(scenes.end(), {regularised, stribeck});
  }
  return scenes;
}

TEST(Tangents, OfBladesThatAreNotAlikeAreTheDerivativeOfTheSectionMap) {
  std::vector<settings::Scene> scenes{tight_rotor(), on_elastic_ring()};
  scenes.push_back(with_friction_that_depends_on_velocity().front());
  for (settings::Scene& scene : scenes) {
    scene.unequal_blades = effects::UnequalBlades{.length_errors = {1e-4, 0.0, -2e-4},
                                                  .thickness_errors = {0.0, 1e-4, 0.0},
                                                  .angle_errors = {0.0, 0.02, -0.05}};
    int compared = 0;
    const auto solver = solver_of(scene);
    for (const double speed : {0.31, 0.42, 0.45, 0.62, 0.75}) {
      if (are_held_against_differences(*solver, speed)) ++compared;
    }
    EXPECT_GE(compared, 3);
  }
}

TEST(Tangents, UnderFrictionThatDependsOnVelocityAreTheDerivativeOfTheSectionMap) {
  for (const settings::Scene& scene : with_friction_that_depends_on_velocity()) {
    int compared = 0;
    const auto solver = solver_of(scene);
    for (const double speed : {0.31, 0.45, 0.62, 0.75}) {
      if (are_held_against_differences(*solver, speed)) ++compared;
    }
    EXPECT_GE(compared, 2);
  }
}

TEST(Tangents, UnderFrictionThatDependsOnVelocityContractPhaseVolumeByItToo) {
  for (const settings::Scene& scene : with_friction_that_depends_on_velocity()) {
    const auto solver = solver_of(scene);
    for (const double speed : {0.31, 0.45, 0.62, 0.75}) {
      const auto map = solver->section_map(speed, reached(*solver, speed, 20), 1);
      ASSERT_TRUE(map.differentiable) << speed;
      EXPECT_GT(std::abs(map.log_volume), 1e-6) << "friction takes part";
      const double damping = -4.0 * scene.rotor.damping_ratio * 2.0 * std::numbers::pi / speed;
      EXPECT_NEAR(std::log(std::abs(determinant(map.jacobian))), damping + map.log_volume, 1e-8)
          << "speed ratio " << speed;
    }
  }
}

settings::Scene in_ring_body(settings::ContactLaw law) {
  settings::Scene scene = tight_rotor();
  scene.contact.law = law;
  scene.unbalance = effects::Unbalance{.moment = 1e-4, .phase = 0.3};
  scene.ring_body = effects::RingBody{.mass = 0.4, .compliance = 2e-4, .damping = 3.0};
  return scene;
}

TEST(Tangents, OfARotorInARingThatIsABodyAreTheDerivativeOfTheMotionOfBoth) {
  int compared = 0;
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    const settings::Scene scene = in_ring_body(law);
    const auto solver = solver_of(scene);
    for (const double speed : {0.31, 0.45, 0.62, 0.75}) {
      // Places of shaft and ring, then their velocities, as the tangents have them.
      const auto map = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
        const std::array<double, 4> ring{from[2], from[3], from[6], from[7]};
        const auto end = solver->run(
            speed, motion::PointStart({from[0], from[1], from[4], from[5]}, motion::Memory(ring)));
        EXPECT_EQ(end.status, ending::PointStatus::done);
        const auto& shaft = end.final_state;
        const auto after = end.final_memory.view();
        return Eigen::Vector<double, 8>(shaft[0], shaft[1], after[0], after[1], shaft[2], shaft[3], after[2],
                                        after[3]);
      };
      Eigen::VectorXd start = Eigen::VectorXd::Zero(8);
      for (int revolution = 0; revolution < 11; ++revolution) start = map(start);
      const std::array<double, 4> ring{start[2], start[3], start[6], start[7]};
      const auto found = solver->section_map(
          speed, motion::PointStart({start[0], start[1], start[4], start[5]}, motion::Memory(ring)), 1);
      if (are_held_against(found, differences(map, start, 1e-6 * 0.01), speed)) ++compared;
    }
  }
  EXPECT_GE(compared, 4);
}

}  // namespace
}  // namespace rubatlas::test
