/// The hybrid integrator against what one would write first: a fixed small step, no events, force from the
/// formulas.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "../support/point.hpp"

namespace rubatlas::test {
namespace {

using State = std::array<double, 4>;

/// MODEL 1, 2, 4.3 and 4.7 literally; no part of the solver is used.
class PlainRotor {
 public:
  PlainRotor(const settings::Scene& scene, double speed_ratio) : scene_(scene), speed_(speed_ratio) {}

  State after(int revolutions, int steps_per_revolution) const {
    State z{};
    const double step = 2.0 * std::numbers::pi / speed_ / steps_per_revolution;
    for (long i = 0; i < static_cast<long>(revolutions) * steps_per_revolution; ++i) {
      const double time = step * static_cast<double>(i % steps_per_revolution);
      const State k1 = rate(z, time);
      const State k2 = rate(add(z, k1, step / 2), time + step / 2);
      const State k3 = rate(add(z, k2, step / 2), time + step / 2);
      const State k4 = rate(add(z, k3, step), time + step);
      for (std::size_t j = 0; j < 4; ++j) z[j] += step / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
    }
    return z;
  }

 private:
  static State add(const State& z, const State& k, double step) {
    return {z[0] + step * k[0], z[1] + step * k[1], z[2] + step * k[2], z[3] + step * k[3]};
  }

  [[nodiscard]] State rate(const State& z, double time) const {
    const settings::Rotor& rotor = scene_.rotor;
    double fx = 0.0;
    double fy = 0.0;
    for (int k = 0; k < scene_.blades.count; ++k) {
      const double angle = speed_ * time + 2.0 * std::numbers::pi * k / scene_.blades.count;
      const double reach = scene_.blades.hub_radius + scene_.blades.length;
      const double tip_x = z[0] + reach * std::cos(angle);
      const double tip_y = z[1] + rotor.misalignment + reach * std::sin(angle);
      if (tip_x * tip_x + tip_y * tip_y <= scene_.ring.radius * scene_.ring.radius) continue;
      const double distance = std::hypot(tip_x, tip_y);
      const double load = scene_.ring.stiffness * (distance - scene_.ring.radius);
      const double nx = tip_x / distance;
      const double ny = tip_y / distance;
      // Slip is forward throughout these motions: s = +1.
      fx += -load * nx + scene_.contact.friction * load * ny;
      fy += -load * ny - scene_.contact.friction * load * nx;
    }
    const double unit = 1.0 / (rotor.mass * rotor.natural_frequency * rotor.natural_frequency);
    const double forcing = scene_.unbalance ? scene_.unbalance->moment / rotor.mass * speed_ * speed_ : 0.0;
    const double phase = speed_ * time + (scene_.unbalance ? scene_.unbalance->phase : 0.0);
    return {z[2], z[3], fx * unit - 2.0 * rotor.damping_ratio * z[2] - z[0] + forcing * std::cos(phase),
            fy * unit - 2.0 * rotor.damping_ratio * z[3] - z[1] + forcing * std::sin(phase)};
  }

  settings::Scene scene_;
  double speed_;
};

TEST(PlainRotor, AgreesOnRigidBladesInAnElasticRing) {
  for (const int blades : {3, 4, 7}) {
    settings::Scene scene = default_rotor(3);
    scene.contact.law = settings::ContactLaw::elastic_ring;
    scene.blades.count = blades;
    scene.unbalance = settings::Unbalance{1e-4, 0.7};
    scene.accuracy.tolerance = 1e-12;
    const double speed = 0.45;
    const auto outcome = run(scene, speed);
    ASSERT_EQ(outcome.status, ending::PointStatus::done);
    ASSERT_GT(outcome.work.touchdowns, 3U);
    ASSERT_EQ(outcome.work.slip_reversals, 0U);
    const State plain = PlainRotor(scene, speed).after(3, 400000);
    for (std::size_t i = 0; i < 4; ++i) {
      // The kink of the force at each touch-down leaves the plain method an error of order step², here up to
      // 5e-11.
      EXPECT_NEAR(outcome.final_state[i], plain[i], 1e-10) << blades << " blades, component " << i;
    }
  }
}

}  // namespace
}  // namespace rubatlas::test
