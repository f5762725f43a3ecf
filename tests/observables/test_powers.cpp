/// Powers and torque of motions that are known exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "observables/powers.hpp"
#include "synthetic_motion.hpp"

namespace rubatlas::observables {
namespace {

using Complex = std::complex<double>;
constexpr double kMass = 2.0;
constexpr double kFrequency = 20.0;

double mean_of(Observable& observable) {
  std::vector<double> row(1);
  observable.write(row);
  return row[0];
}

settings::Scene rotor(double damping_ratio) {
  settings::Scene scene;
  scene.rotor.mass = kMass;
  scene.rotor.natural_frequency = kFrequency;
  scene.rotor.damping_ratio = damping_ratio;
  return scene;
}

trajectory::State state_of(Complex place, Complex velocity) {
  return {place.real(), place.imag(), velocity.real(), velocity.imag()};
}

TEST(ViscousPower, IsTheDampingTimesTheMeanSquareOfTheVelocity) {
  const double speed = 0.62;
  const auto motion = [speed](double time) {
    const Complex forward = std::polar(1e-3, speed * time + 0.2);
    const Complex backward = std::polar(4e-4, -3.0 * speed * time);
    return state_of(forward + backward, Complex(0, speed) * forward - Complex(0, 3.0 * speed) * backward);
  };
  ViscousPower power(rotor(0.15));
  feed(power, point_at(speed, 3), 4, motion);
  const double damping = 2.0 * 0.15 * kMass * kFrequency;  // c [N s/m]
  const double square = kFrequency * kFrequency * speed * speed * (1e-6 + 9.0 * 1.6e-7);
  EXPECT_NEAR(mean_of(power), damping * square, 1e-13 * damping * square);
}

TEST(ViscousPower, OfAnOverdampedShaftThatCreepsBackIsTheEnergyThatItLoses) {
  const double damping_ratio = 5.0;
  const double rate = damping_ratio + std::sqrt(damping_ratio * damping_ratio - 1.0);
  const auto motion = [rate](double time) {
    return state_of(1e-3 * std::exp(-rate * time), -rate * 1e-3 * std::exp(-rate * time));
  };
  const trajectory::PointConstants point = point_at(0.5, 3);
  ViscousPower power(rotor(damping_ratio));
  power.begin(point);
  SyntheticPiece piece(0.0, point.period, motion);
  power.piece(piece);
  const double stiffness = kMass * kFrequency * kFrequency;
  const double energy = 0.5 * stiffness * 1e-6 * (1.0 + rate * rate);
  EXPECT_NEAR(mean_of(power), energy / (point.period / kFrequency), 1e-12 * energy);
}

/// A tip that is pushed and rubs while the shaft moves along a line.
SyntheticContact rubbing(const std::function<trajectory::ContactForce(double)>& action) {
  return {.blade = 0, .force = {}, .strain = {}, .peaks = true, .action = action};
}

TEST(FrictionPower, IsTheMeanOfFrictionTimesSlipOverAllTips) {
  const trajectory::PointConstants point = point_at(0.5, 3);
  const double part = 0.2 * point.period;
  const auto still = [](double) { return trajectory::State{}; };
  // 3 N slips at 0.02 m per unit of time under c = 0.1; the same, and the other way, at another tip.
  const SyntheticContact forward =
      rubbing([](double) { return trajectory::ContactForce{-3.0, 3.0, 0.02, 1.0, 0.1, 0.0}; });
  const SyntheticContact backward =
      rubbing([](double) { return trajectory::ContactForce{-3.0, 3.0, -0.02, -1.0, -0.1, 0.0}; });
  FrictionPower power(rotor(0.1));
  power.begin(point);
  SyntheticPiece both(0.0, part, still, {forward, backward});
  SyntheticPiece flight(part, point.period, still);
  power.piece(both);
  power.piece(flight);
  const double expected = 0.2 * 2.0 * 3.0 * 0.1 * 0.02 * kFrequency;
  EXPECT_NEAR(mean_of(power), expected, 1e-14 * expected);
}

TEST(DeformationPower, IsWhatContactsTakeFromShaftAndDriveLessFriction) {
  const trajectory::PointConstants point = point_at(0.5, 3);
  const auto moving = [](double time) { return trajectory::State{0.01 * time, -0.02 * time, 0.01, -0.02}; };
  const SyntheticContact contact =
      rubbing([](double) { return trajectory::ContactForce{Complex(-3.0, 1.0), 3.0, 0.02, 1.0, 0.1, 0.04}; });
  DeformationPower power(rotor(0.1));
  power.begin(point);
  SyntheticPiece piece(0.0, point.period, moving, {contact});
  power.piece(piece);
  const double expected = -(-3.0 * 0.01 - 1.0 * 0.02 + 0.5 * 0.04) - 0.1 * 3.0 * 0.02;
  EXPECT_NEAR(mean_of(power), kFrequency * expected, 1e-14);
}

TEST(DriveTorque, BearsTheTorqueOfContacts) {
  const trajectory::PointConstants point = point_at(0.5, 3);
  const auto still = [](double) { return trajectory::State{}; };
  const SyntheticContact contact =
      rubbing([](double time) { return trajectory::ContactForce{-1.0, 1.0, 0.02, 1.0, 0.1, -0.3 * time}; });
  DriveTorque torque(rotor(0.1));
  torque.begin(point);
  SyntheticPiece piece(0.0, 1.0, still, {contact});
  SyntheticPiece flight(1.0, point.period, still);
  torque.piece(piece);
  torque.piece(flight);
  torque.revolution_ends({});
  EXPECT_NEAR(mean_of(torque), 0.15 / point.period, 1e-15);
}

/// The steady whirl of an unbalanced shaft: what drives it is lost in the damper.
TEST(DriveTorque, OfASteadyWhirlIsTheViscousPowerOverTheSpeed) {
  for (const double speed : {0.4, 0.97, 1.8}) {
    settings::Scene scene = rotor(0.05);
    scene.unbalance = effects::Unbalance{1e-3, 0.7};
    const Complex response =
        std::polar(1e-3 / kMass, 0.7) * speed * speed / Complex(1.0 - speed * speed, 2.0 * 0.05 * speed);
    const auto motion = [&](double time) {
      const Complex place = response * std::polar(1.0, speed * time);
      return state_of(place, Complex(0.0, speed) * place);
    };
    DriveTorque torque(scene);
    ViscousPower viscous(scene);
    feed(torque, point_at(speed, 3), 3, motion);
    feed(viscous, point_at(speed, 3), 3, motion);
    const double power = mean_of(viscous);
    EXPECT_NEAR(mean_of(torque) * speed * kFrequency, power, 1e-12 * power) << speed;
  }
}

/// Of a motion that does not repeat: u × z'' from its second derivative.
TEST(DriveTorque, OfAnUnbalanceIsItsMomentTimesTheAccelerationAcrossIt) {
  settings::Scene scene = rotor(0.05);
  scene.unbalance = effects::Unbalance{1e-3, 0.7};
  const double speed = 0.6;
  const trajectory::PointConstants point = point_at(speed, 3);
  const double other = 0.37;
  const auto motion = [&](double time) {
    const Complex place = std::polar(2e-3, other * time + 0.1);
    return state_of(place, Complex(0.0, other) * place);
  };
  DriveTorque torque(scene);
  feed(torque, point, 1, motion);
  // Im(conj(u) z'') = −2e-3 other² sin((other − speed) τ + 0.1 − 0.7)
  const double rate = other - speed;
  const double angle = -0.6;
  const double mean = -2e-3 * other * other * (std::cos(angle) - std::cos(angle + rate * point.period)) /
                      (rate * point.period);
  const double expected = 1e-3 * kFrequency * kFrequency * mean;
  EXPECT_NEAR(mean_of(torque), expected, 1e-12 * std::abs(expected));
}

}  // namespace
}  // namespace rubatlas::observables
