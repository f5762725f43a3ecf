/// The linearised flow where it is hard to have: at contacts that only just happen, without damping, with
/// several blades at once.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "../support/point.hpp"
#include "../support/section_differences.hpp"

namespace rubatlas::test {
namespace {

constexpr double kSpeedRatio = 0.5;

/// The default rotor with one blade, and the state from which free motion takes its tip through a greatest
/// radius R + `depth`, at `side` from top dead centre [m], a quarter of a revolution later.
struct GrazingRotor {
  settings::Scene scene = default_rotor(1);
  motion::SectionState start{};

  GrazingRotor(double depth, double side) {
    using Complex = std::complex<double>;
    scene.blades.count = 1;
    scene.accuracy.tolerance = 1e-13;
    const double reach = scene.blades.hub_radius + scene.blades.length;
    const double radial = std::sqrt(std::pow(scene.ring.radius + depth, 2) - side * side);
    // The blade points along y there: er = i, et = −1.
    const Complex place = Complex(-side, radial - reach - scene.rotor.misalignment);
    const Complex velocity = Complex(0.0, -side * reach * kSpeedRatio / radial);
    const double damping = scene.rotor.damping_ratio;
    const double duration = -0.5 * std::numbers::pi / kSpeedRatio;
    const double frequency = std::sqrt(1.0 - damping * damping);
    const double growth = std::exp(-damping * duration);
    const double cosine = growth * std::cos(frequency * duration);
    const double sine = growth * std::sin(frequency * duration) / frequency;
    const Complex before = place * cosine + (velocity + damping * place) * sine;
    const Complex rate = velocity * cosine - (place + damping * velocity) * sine;
    start = {before.real(), before.imag(), rate.real(), rate.imag()};
  }
};

TEST(HardTangents, OfContactsThatOnlyJustHappenAreThoseOfTheMotionOnEverySide) {
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    for (const double side : {1e-3, 0.0, -1e-3}) {
      for (const double depth : {1e-5, 1e-6, 1e-7}) {
        GrazingRotor rotor(depth, side);
        rotor.scene.contact.law = law;
        const auto solver = solver_of(rotor.scene);
        const auto map = solver->section_map(kSpeedRatio, rotor.start, 1);
        ASSERT_TRUE(map.differentiable);
        ASSERT_EQ(map.events.size(), 2U) << "one contact";
        const auto expected = differences(*solver, kSpeedRatio, rotor.start, 1, 1e-2 * depth);
        ASSERT_LT(expected.error, 1e-3) << side << ' ' << depth;
        EXPECT_LE((map.jacobian - expected.jacobian).norm(),
                  (1e-6 + 3.0 * expected.error) * expected.jacobian.norm())
            << "side " << side << ", depth " << depth;
      }
    }
  }
}

TEST(HardTangents, OfATouchThatBarelyExistsGrowAsItsSideSays) {
  // The kick d^{1/2} of a grazing on the receding side has a slope that grows like d^{-1/2}; d^{3/2} has
  // none.
  const auto norm = [](double depth, double side) {
    const GrazingRotor rotor(depth, side);
    return solver_of(rotor.scene)->section_map(kSpeedRatio, rotor.start, 1).jacobian.norm();
  };
  EXPECT_NEAR(norm(1e-9, -1e-3) / norm(1e-7, -1e-3), 10.0, 0.2);
  EXPECT_LT(norm(1e-9, 1e-3), 1.1 * norm(1e-7, 1e-3));
}

TEST(HardTangents, AreTheDerivativeOfTheSectionMapForRotorsOfEveryKind) {
  struct Case {
    std::string name;
    settings::Scene scene;
    double speed_ratio;
  };
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, double speed_ratio, auto change) {
    settings::Scene scene = default_rotor(1);
    scene.accuracy.tolerance = 1e-12;
    change(scene);
    cases.push_back({name, scene, speed_ratio});
  };
  add("without damping", 0.3, [](auto& scene) { scene.rotor.damping_ratio = 0.0; });
  add("overdamped", 0.5, [](auto& scene) { scene.rotor.damping_ratio = 2.0; });
  add("critically damped", 0.5, [](auto& scene) { scene.rotor.damping_ratio = 1.0; });
  add("without friction", 0.62, [](auto& scene) { scene.contact.friction = 0.0; });
  add("much friction", 0.62, [](auto& scene) { scene.contact.friction = 1.0; });
  add("fifty blades", 0.2, [](auto& scene) {
    scene.blades.count = 50;
    scene.blades.thickness = 2e-4;
  });
  add("fifty blades on an elastic ring", 0.2, [](auto& scene) {
    scene.blades.count = 50;
    scene.contact.law = settings::ContactLaw::elastic_ring;
  });
  add("several blades at once", 0.3, [](auto& scene) {
    scene.blades.count = 12;
    scene.blades.thickness = 2e-4;
    scene.rotor.misalignment = 0.014;
  });
  add("unbalance", 0.62, [](auto& scene) { scene.unbalance = {.moment = 1e-4}; });
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    const auto solver = solver_of(one.scene);
    int compared = 0;
    // Where a touch-down lies within the steps of the differences the next start is taken.
    for (int revolutions = 20; revolutions < 30 && compared == 0; ++revolutions) {
      const auto start = solver->section_map(one.speed_ratio, {}, revolutions).sections.back();
      const auto map = solver->section_map(one.speed_ratio, start, 1);
      ASSERT_TRUE(map.differentiable);
      const auto expected = differences(*solver, one.speed_ratio, start, 1, 1e-8);
      if (map.events.empty() || !(expected.error < 1e-5)) continue;
      ++compared;
      // Of maps that contract a lot the differences have few digits.
      EXPECT_LE((map.jacobian - expected.jacobian).norm(),
                (1e-6 + expected.error) * expected.jacobian.norm());
      const double damping = one.scene.rotor.damping_ratio;
      const double contraction = -4.0 * damping * 2.0 * std::numbers::pi / one.speed_ratio + map.log_volume;
      const double rounding = 1e-14 * std::pow(map.jacobian.norm(), 4);
      EXPECT_NEAR(determinant(map.jacobian), std::exp(contraction), 1e-9 * std::exp(contraction) + rounding);
    }
    EXPECT_EQ(compared, 1);
  }
}

}  // namespace
}  // namespace rubatlas::test
