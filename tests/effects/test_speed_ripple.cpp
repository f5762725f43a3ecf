// A speed that ripples: its closed forms, its symmetries, and that no touch-down is missed under it.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <random>
#include <utility>

#include "../support/hybrid_motion.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "effect_scene.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/linear_support.hpp"
#include "rotor/rippled_unbalance.hpp"

namespace rubatlas::test {
namespace {

using Complex = std::complex<double>;
using effects::SpeedRipple;
using ending::PointStatus;
using rotor::BladeSet;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Uniform draws.
class Draw {
 public:
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1p-53;
  }

 private:
  std::mt19937_64 bits_{20161};
};

SpeedRipple random_ripple(Draw& draw) {
  return {draw(0.0, 0.9), 1 + static_cast<int>(draw(0.0, 9.0)), draw(-4.0, 4.0)};
}

TEST(SpeedRipple, TheUnbalancesSideBandsAreItsAccelerationAtEveryInstant) {
  // −(me/m) d²/dτ² e^{i(φ+γ)} = (me/m) (φ'² − iφ'') e^{i(φ+γ)}
  Draw draw;
  for (int trial = 0; trial < 300; ++trial) {
    const SpeedRipple ripple = random_ripple(draw);
    const double speed = draw(0.05, 2.0);
    const double phase = draw(-3.0, 3.0);
    const double moment = draw(1e-6, 1e-3);
    const rotor::Harmonics forcing(rotor::rippled_unbalance(ripple, moment, phase, speed, 0.1));
    const BladeSet blades(rotor::equal_angles(1), speed, ripple);
    for (int sample = 0; sample < 10; ++sample) {
      const double time = draw(0.0, kTurn / speed);
      const double rate = blades.angular_speed(time);
      const Complex exact = moment * Complex(rate * rate, -blades.angular_acceleration(time)) *
                            std::polar(1.0, blades.angle(time) + phase);
      const double scale = moment * speed * speed * (1.0 + ripple.order);
      EXPECT_LE(std::abs(forcing.acceleration(time) - exact), 2e-13 * scale)
          << "a " << ripple.amplitude << ", p " << ripple.order << ", Ω " << speed << ", τ " << time;
    }
  }
}

TEST(SpeedRipple, TheDeepestHasNoMoreSideBandsThanAnySupportTakes) {
  for (int order = 1; order <= 1000; ++order) {
    const auto bands = rotor::rippled_unbalance({0.9, order, 0.3}, 1e-4, 0.0, 0.5, 0.1);
    EXPECT_LT(bands.size(), rotor::LinearSupport::kMostTerms) << "one is left for static loads; p " << order;
  }
}

TEST(SpeedRipple, OfNoAmplitudeLeavesTheUnbalanceAsItIs) {
  const SpeedRipple none{0.0, 3, 0.7};
  const rotor::Harmonics rippled(rotor::rippled_unbalance(none, 1e-4, 0.4, 0.62, 0.1));
  const rotor::RotatingUnbalance plain(1e-4, 0.4, 0.62, 0.1);
  EXPECT_EQ(rippled.amplitude(), plain.amplitude());
  for (const double time : {0.0, 0.3, 2.0, 9.0}) {
    EXPECT_EQ(rippled.acceleration(time), plain.acceleration(time));
  }
}

TEST(SpeedRipple, OfNoAmplitudeLeavesTheBladesWhereASteadyRotorHasThem) {
  Draw draw;
  for (int trial = 0; trial < 100; ++trial) {
    const double speed = draw(-2.0, 2.0);
    const BladeSet rippling(rotor::equal_angles(5), speed, {0.0, 3, 0.7});
    const rotor::BladeSet steady(5, speed);
    const double time = draw(0.0, 20.0);
    const auto first = steady.first(time);
    for (int blade = 0; blade < 5; ++blade) {
      const auto one = rippling.direction(blade, rippling.first(time));
      const auto other = steady.direction(blade, first);
      EXPECT_EQ(std::pair(one.cosine, one.sine), std::pair(other.cosine, other.sine));
    }
    EXPECT_EQ(rippling.angular_speed(time), steady.angular_speed(time));
    EXPECT_EQ(rippling.angular_acceleration(time), 0.0);
    EXPECT_EQ(rippling.slowest(), std::abs(speed));
  }
}

TEST(SpeedRipple, ARevolutionTakesTheSameTimeAndEndsWhereItBegan) {
  Draw draw;
  for (int trial = 0; trial < 100; ++trial) {
    const double speed = draw(0.05, 2.0);
    const BladeSet blades(rotor::equal_angles(3), speed, random_ripple(draw));
    EXPECT_EQ(blades.angle(0.0), 0.0);
    EXPECT_NEAR(blades.angle(kTurn / speed), kTurn, 1e-13);
  }
}

TEST(SpeedRipple, SpeedAndAccelerationAreDerivativesOfTheAngleAndWithinTheirBounds) {
  Draw draw;
  for (int trial = 0; trial < 100; ++trial) {
    const SpeedRipple ripple = random_ripple(draw);
    const double speed = draw(0.05, 2.0);
    const BladeSet blades(rotor::equal_angles(3), speed, ripple);
    const double step = 1e-4 / (speed * ripple.order);
    const auto slope = [&](auto&& function, double time) {  // of order 4
      return (8.0 * (function(time + step) - function(time - step)) -
              (function(time + 2.0 * step) - function(time - 2.0 * step))) /
             (12.0 * step);
    };
    double fastest = 0.0;
    double strongest = 0.0;
    double sharpest = 0.0;
    for (int sample = 0; sample < 4000; ++sample) {
      const double time = kTurn / speed * sample / 4000;
      const double rate = slope([&](double t) { return blades.angle(t); }, time);
      const double change = slope([&](double t) { return blades.angular_speed(t); }, time);
      const double jerk = slope([&](double t) { return blades.angular_acceleration(t); }, time);
      EXPECT_NEAR(blades.angular_speed(time), rate, 1e-9 * speed * ripple.order);
      EXPECT_NEAR(blades.angular_acceleration(time), change,
                  1e-9 * blades.speed_bound() * speed * ripple.order);
      EXPECT_LE(blades.angular_speed(time), blades.speed_bound() * (1.0 + 1e-15));
      EXPECT_LE(std::abs(blades.angular_acceleration(time)),
                blades.angular_acceleration_bound() * (1.0 + 1e-15));
      EXPECT_LE(std::abs(jerk), blades.angular_jerk_bound() * (1.0 + 1e-7));
      fastest = std::max(fastest, blades.angular_speed(time));
      strongest = std::max(strongest, std::abs(blades.angular_acceleration(time)));
      sharpest = std::max(sharpest, std::abs(jerk));
    }
    EXPECT_GT(fastest, 0.999 * blades.speed_bound()) << "bounds that are met cost no steps";
    EXPECT_GT(strongest, 0.999 * blades.angular_acceleration_bound());
    EXPECT_GT(sharpest, 0.999 * blades.angular_jerk_bound());
  }
}

// --- motions ---

/// Looks at every piece of flight 500 times, and keeps the largest gap that a blade has there [m²].
template <class Blades>
class GapWatch final : public modes::MotionListener {
 public:
  GapWatch(const rotor::RotorConstants& rotor, const contact::Geometry& geometry, const Blades& blades)
      : rotor_(rotor), geometry_(geometry), blades_(blades) {}

  void piece(trajectory::MotionPiece& piece) override {
    if (piece.contact_count() > 0) return;
    for (int i = 1; i < kSamples; ++i) {
      const double time = piece.begin() + (piece.end() - piece.begin()) * i / kSamples;
      const auto state = piece.state(time);
      const auto first = blades_.first(time);
      for (int k = 0; k < blades_.count(); ++k) {
        largest = std::max(
            largest,
            rotor::pose_of(rotor_, geometry_, blades_.direction(k, first), rotor::State(state.data())).gap);
      }
    }
  }
  void event(const modes::Event& event) override {
    if (event.kind == modes::Guard::touch_down) ++touchdowns;
  }

  double largest = -1.0;
  int touchdowns = 0;

 private:
  static constexpr int kSamples = 500;
  rotor::RotorConstants rotor_;
  contact::Geometry geometry_;
  Blades blades_;
};

TEST(SpeedRipple, NoTouchdownIsMissed) {
  const contact::Geometry geometry{0.1, 0.11};
  const contact::ElasticRingContact blade(geometry, 1e4, {0.1});
  Draw draw;
  int touchdowns = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const SpeedRipple ripple = random_ripple(draw);
    const rotor::RotorConstants rotor{draw(0.05, 0.9), draw(0.02, 0.3), draw(0.0098, 0.0103), 0.01, 0.01};
    const BladeSet blades(rotor::equal_angles(3), rotor.speed_ratio, ripple);
    const rotor::Harmonics forcing(
        rotor::rippled_unbalance(ripple, 1e-4, 0.0, rotor.speed_ratio, rotor.damping_ratio));
    const auto motion = hybrid_motion(rotor, blades, blade, forcing, {1e-11, 0.5});
    GapWatch<BladeSet> watch(rotor, geometry, blades);
    PointStatus status = start(*motion, rotor::State{draw(-1e-3, 1e-3), draw(-1e-3, 1e-3), 0.0, 0.0});
    for (int revolution = 0; revolution < 6 && status == PointStatus::done; ++revolution) {
      status = revolve(*motion, watch);
    }
    EXPECT_NE(status, PointStatus::integrator_failed) << trial;
    EXPECT_LE(watch.largest, 1e-15 * geometry.ring_radius) << trial;
    touchdowns += watch.touchdowns;
  }
  EXPECT_GT(touchdowns, 300);
}

class Rippling : public ::testing::TestWithParam<settings::ContactLaw> {
 protected:
  static settings::Scene rotor(int order) {
    nlohmann::json scene = effect_scene("speed_ripple", 0.4, 6);
    scene["speed_ripple"] = {{"amplitude", 0.1}, {"order", order}, {"phase", 0.6}};
    scene["observables"] = {"poincare", "poincare_blade_passing"};
    scene["accuracy"]["tolerance"] = 1e-13;
    scene["contact"]["law"] = GetParam() == settings::ContactLaw::elastica ? "elastica" : "elastic_ring";
    return parsed(scene);
  }
  /// How far a motion that starts one blade passing later is from the motion itself [m].
  static double departure(int order) {
    const settings::Scene scene = rotor(order);
    const auto motion = run(scene, {1e-3, 0.0, 0.0, 1e-3});
    EXPECT_EQ(motion.status, PointStatus::done);
    const auto& passings = motion.rows[1];
    const auto later = run(scene, {passings[0], passings[1], passings[2], passings[3]});
    return largest_difference(later.rows[1], passings, 0, 4);
  }
};

TEST_P(Rippling, AsOftenAsBladesPassKeepsBladePassingsAlike) {
  EXPECT_LE(departure(3), 1e-11);
  EXPECT_LE(departure(6), 1e-11);
  EXPECT_GT(departure(1), 1e-6) << "and once a revolution it does not";
  EXPECT_GT(departure(2), 1e-6);
}

TEST_P(Rippling, TooLittleToMatterGivesTheMotionAtConstantSpeed) {
  settings::Scene scene = rotor(2);
  scene.speed_ripple->amplitude = 1e-300;
  const auto rippling = run(scene);
  scene.speed_ripple.reset();
  const auto constant = run(scene);
  ASSERT_EQ(constant.status, PointStatus::done);
  ASSERT_GT(constant.work.touchdowns, 0U);
  EXPECT_EQ(rippling.work.touchdowns, constant.work.touchdowns);
  EXPECT_LE(largest_difference(rippling.rows[0], constant.rows[0]), 1e-12);
}

TEST_P(Rippling, IsTheSameForPhasesAFullTurnApart) {
  settings::Scene scene = rotor(2);
  const auto motion = run(scene);
  scene.speed_ripple->phase += kTurn;
  EXPECT_LE(largest_difference(run(scene).rows[0], motion.rows[0]), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Laws, Rippling,
                         ::testing::Values(settings::ContactLaw::elastica,
                                           settings::ContactLaw::elastic_ring),
                         [](const auto& instance) {
                           return instance.param == settings::ContactLaw::elastica ? "elastica"
                                                                                   : "elastic_ring";
                         });

}  // namespace
}  // namespace rubatlas::test
