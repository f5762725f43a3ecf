/// The contact law of flexible blades whose load has a direction of its own: against the law of the model,
/// and against equilibrium worked out anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "directed_rotors.hpp"

namespace rubatlas::contact {
namespace {

TEST(DirectedElastica, AxialLoadWithCoulombFrictionIsTheLawOfTheModel) {
  int compared = 0;
  for (const TestRotor& rotor : {kDefaultRotor, kRig}) {
    for (const double friction : {0.0, 1e-4, 0.01, 0.1, 0.5, 2.0}) {
      const ElasticaContact model = rotor.contact(friction);
      const auto law = directed(LoadDirection::axial, rotor, Friction::coulomb(friction));
      RandomContacts contacts(rotor, 0.25, 51);
      for (int i = 0; i < 2000; ++i) {
        Pose at = contacts.next();
        // Down to the lightest contacts; and a little beyond lift-off, coming from a contact.
        if (i % 4 == 1) at.gap *= std::pow(10.0, -9 * contacts.uniform());
        const double slip = i % 2 == 0 ? 1.0 : -1.0;
        double bending = 0.1;
        TipForce expected{};
        bool has_force = model.respond(at, slip, 0.5, bending, expected);
        Met met = meet(law, at, slip, 0.5);
        // Where the table of the model's law keeps 1e-12.
        if (std::max(expected.shortening, met.force.shortening) > (friction > 1.0 ? 0.6 : 0.73)) continue;
        ASSERT_EQ(met.found, has_force) << friction << ", " << i;
        if (!has_force) continue;
        if (i % 4 == 2) {
          at.gap *= 1e-5;
          model.respond(at, slip, 0.5, bending, expected);
          at.gap = -at.gap;
          has_force = model.respond(at, slip, 0.5, bending, expected);
          met = meet(law, at, slip, 0.5, met.bending, met.amplitude);
          ASSERT_EQ(met.found, has_force) << friction << ", " << i;
        }
        // A contact too light to bend the blade has no load under one law and that of the smallest bend under
        // the other.
        ASSERT_LE(difference(met.force, expected), 1e-12 * std::abs(expected.normal) + 1e-30)
            << friction << ", " << i;
        ASSERT_NEAR(met.force.shortening, expected.shortening, 1e-12 * expected.shortening + 1e-30);
        ASSERT_NEAR(met.force.root_strain, expected.root_strain, 1e-12 * expected.root_strain + 1e-18);
        ASSERT_NEAR(met.force.slip_velocity, expected.slip_velocity, 1e-15);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 23000);
}

/// What is left over when the blade is integrated from its clamp with nothing but the force on it and the
/// curvature there (EI θ'' = −P sin(θ + b), Runge–Kutta of order 4 in 80 bit).
struct Leftover {
  long double curvature;     ///< θ'(L) L at the free tip
  long double distance;      ///< of the tip from the ring, of R
  long double normal;        ///< force along n plus F, of F
  long double along;         ///< force along t [F]: −c
  long double shortening;    ///< δ/L against the one told
  long double normal_angle;  ///< α
};
Leftover integrated(const TestRotor& rotor, const Pose& at, const Met& met) {
  using Real = long double;
  const Real load = std::hypot(static_cast<Real>(met.force.radial), static_cast<Real>(met.force.tangential)) /
                    static_cast<Real>(rotor.load_unit());
  const Real angle =
      std::atan2(-static_cast<Real>(met.force.tangential), -static_cast<Real>(met.force.radial));
  const Real root = met.force.root_strain * 2 * rotor.length / rotor.thickness;
  constexpr int kSteps = 3000;
  const Real step = Real{1} / kSteps;
  std::array<Real, 4> state = {0, std::copysign(root, static_cast<Real>(met.bending)), 0,
                               0};  // θ, θ', ∫cos, ∫sin
  const auto rate = [&](const std::array<Real, 4>& y) -> std::array<Real, 4> {
    return {y[1], -load * std::sin(y[0] + angle), 2 * std::pow(std::sin(y[0] / 2), Real{2}), std::sin(y[0])};
  };
  const auto moved = [](std::array<Real, 4> y, const std::array<Real, 4>& by, Real share) {
    for (std::size_t k = 0; k < 4; ++k) y[k] += share * by[k];
    return y;
  };
  for (int i = 0; i < kSteps; ++i) {
    const auto k1 = rate(state);
    const auto k2 = rate(moved(state, k1, step / 2));
    const auto k3 = rate(moved(state, k2, step / 2));
    const auto k4 = rate(moved(state, k3, step));
    for (std::size_t k = 0; k < 4; ++k) state[k] += step / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
  }
  const Real a = at.radial + (rotor.hub_radius + rotor.length) - rotor.length * state[2];
  const Real b = at.tangential - rotor.length * state[3];
  const Real distance = std::hypot(a, b);
  const Real force = met.force.normal;
  return {state[1],
          distance / rotor.ring_radius - 1,
          (met.force.radial * a + met.force.tangential * b) / distance / force + 1,
          (met.force.tangential * a - met.force.radial * b) / distance / force,
          state[2] - met.force.shortening,
          std::atan2(b, a)};
}

TEST(DirectedElastica, BladeUnderTheTrueNormalIsInEquilibriumAndTouchesTheRing) {
  int against = 0;
  for (const TestRotor& rotor : {kDefaultRotor, kRig}) {
    for (const double friction : {0.0, 0.01, 0.1, 0.5}) {
      const auto law = directed(LoadDirection::normal, rotor, Friction::coulomb(friction));
      RandomContacts contacts(rotor, 0.2, 52);
      for (int i = 0; i < 60; ++i) {
        Pose at = contacts.next();
        const double slip = i % 2 == 0 ? 1.0 : -1.0;
        // Both sides, where the blade can stand on the second one.
        const double first = law.first_load_angle(at, slip, 0.5);
        const double side = std::copysign(1.0, i % 3 == 2 ? -first : first);
        Met met = meet(law, at, slip, 0.5, 0.3 * side);
        ASSERT_TRUE(met.found);
        const Leftover left = integrated(rotor, at, met);
        ASSERT_NEAR(static_cast<double>(left.curvature), 0.0, 1e-12);
        ASSERT_NEAR(static_cast<double>(left.distance), 0.0, 1e-12);
        ASSERT_NEAR(static_cast<double>(left.shortening), 0.0, 1e-12);
        ASSERT_NEAR(static_cast<double>(left.normal), 0.0, 1e-12) << "the ring pushes inwards";
        ASSERT_NEAR(static_cast<double>(left.along), -slip * friction, 1e-12)
            << "friction is perpendicular to the normal";
        if (met.bending * first < 0.0) ++against;
      }
    }
  }
  EXPECT_GT(against, 30);
}

TEST(DirectedElastica, AtNoPlaceABladeHasNoEquilibriumAndTheSearchEnds) {
  Pose nowhere{};
  nowhere.gap = nowhere.tangential = nowhere.radial = std::numeric_limits<double>::quiet_NaN();
  const DirectedElastica law(LoadDirection::axial, {0.1, 0.11}, {0.1, 0.001, 0.17},
                             Friction::regularised(0.1, 0.05));
  for (const double side : {-1.0, 1.0}) EXPECT_FALSE(law.solve(nowhere, 1.0, 0.5, side));
}

TEST(DirectedElastica, VelocityDependentFrictionIsThatOfTheSlipWhereTheDeformedTipStands) {
  const Friction friction = Friction::stribeck(0.3, 0.1, 0.02, 0.005);
  const auto normal = directed(LoadDirection::normal, kDefaultRotor, friction);
  const auto axial = directed(LoadDirection::axial, kDefaultRotor, friction);
  RandomContacts contacts(kDefaultRotor, 0.15, 53);
  int slow = 0;
  int none = 0;
  for (int i = 0; i < 200; ++i) {
    Pose at = contacts.next();
    at.tangential_velocity = 0.05 * (2 * contacts.uniform() - 1) - 0.5 * kDefaultRotor.length;
    for (const bool follows : {true, false}) {
      const Met met = follows ? meet(normal, at, 1.0, 0.5) : meet(axial, at, 1.0, 0.5);
      if (!met.found) {
        // A tip that nearly sticks, held where only the blade's second mode could stand.
        ++none;
        ASSERT_LT(std::abs(undeformed_slip_velocity(normal.geometry(), at, 0.5)), 0.01) << i;
        continue;
      }
      const double c = friction.coefficient(met.force.slip_velocity, 1.0);
      const double b = 2 * std::asin(met.bending * std::cos(met.amplitude));
      const double load = met.force.normal * std::sqrt(1 + c * c);
      ASSERT_NEAR(std::hypot(met.force.radial, met.force.tangential), load, 1e-12 * load);
      if (follows) {
        const Leftover left = integrated(kDefaultRotor, at, met);
        ASSERT_NEAR(static_cast<double>(left.curvature), 0.0, 1e-11);
        ASSERT_NEAR(static_cast<double>(left.distance), 0.0, 1e-11);
        ASSERT_NEAR(static_cast<double>(left.along), -c, 1e-11);
        ASSERT_NEAR(b, static_cast<double>(left.normal_angle) + std::atan(c), 1e-11);
      } else {
        ASSERT_NEAR(b, std::atan(c), 1e-12);
        if (met.bending * c > 0.0) {
          const Met same =
              meet(directed(LoadDirection::axial, kDefaultRotor, Friction::coulomb(c)), at, 1.0, 0.5);
          ASSERT_LE(difference(met.force, same.force), 1e-10 * load) << i;
        }
      }
      if (std::abs(met.force.slip_velocity) < 0.02) ++slow;
    }
  }
  EXPECT_GT(slow, 150);
  EXPECT_LT(none, 12);
}

TEST(DirectedElastica, SlopesOfTheConstraintAreItsDerivatives) {
  const auto law = directed(LoadDirection::normal, kDefaultRotor, Friction::stribeck(0.3, 0.1, 0.2, 0.05));
  RandomContacts contacts(kDefaultRotor, 0.25, 54);
  for (int i = 0; i < 300; ++i) {
    const Pose at = contacts.next();
    const double modulus = (i % 2 == 0 ? 1.0 : -1.0) * (0.05 + 0.7 * contacts.uniform());
    const double amplitude = 0.1 + 2.5 * contacts.uniform();
    const auto at_bend = [&](double m, double a) { return law.constraint(at, 1.0, 0.5, {m, a}); };
    const auto here = at_bend(modulus, amplitude);
    const auto slope = [](const auto& function) {
      const double step = 1e-3;
      return (8 * (function(step) - function(-step)) - (function(2 * step) - function(-2 * step))) /
             (12 * step);
    };
    const double square = kDefaultRotor.ring_radius * kDefaultRotor.ring_radius;
    EXPECT_NEAR(here.by_modulus.residual,
                slope([&](double d) { return at_bend(modulus + d, amplitude).residual; }), 1e-8 * square);
    EXPECT_NEAR(here.by_amplitude.residual,
                slope([&](double d) { return at_bend(modulus, amplitude + d).residual; }), 1e-8 * square);
    EXPECT_NEAR(here.by_modulus.misdirection,
                slope([&](double d) { return at_bend(modulus + d, amplitude).misdirection; }), 1e-7);
    EXPECT_NEAR(here.by_amplitude.misdirection,
                slope([&](double d) { return at_bend(modulus, amplitude + d).misdirection; }), 1e-7);
  }
}

TEST(DirectedElastica, RootFromANeighbourIsTheRootFromScratch) {
  int compared = 0;
  for (const double friction : {0.0, 0.1, 0.5}) {
    const auto law = directed(LoadDirection::normal, kDefaultRotor, Friction::coulomb(friction));
    RandomContacts contacts(kDefaultRotor, 0.25, 55);
    for (int i = 0; i < 4000; ++i) {
      const Pose at = contacts.next();
      const double slip = contacts.uniform() < 0.8 ? 1.0 : -1.0;
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      const auto root = law.solve(at, slip, 0.5, side);
      const double scatter = std::pow(10.0, -6.0 * contacts.uniform());
      const auto scattered = [&](double value) {
        return value * std::exp(scatter * (2 * contacts.uniform() - 1));
      };
      const blade::Bend guess = root
                                    ? blade::Bend{side * std::min(0.99, scattered(std::abs(root->modulus))),
                                                  std::min(3.1, scattered(root->amplitude))}
                                    : blade::Bend{side * 0.98 * contacts.uniform(), 3.0 * contacts.uniform()};
      blade::Bend near = guess;
      TipForce force{};
      const bool found = law.respond(at, slip, 0.5, near, force) && side * near.modulus > 0.0;
      ASSERT_EQ(found, root.has_value()) << friction << ", " << i;
      if (!root) continue;
      const auto one = law.constraint(at, slip, 0.5, *root);
      const auto other = law.constraint(at, slip, 0.5, near);
      ASSERT_NEAR(other.blade.load.value, one.blade.load.value, 1e-11 * one.blade.load.value)
          << friction << ", " << i;
      ASSERT_NEAR(other.tip.across, one.tip.across, 1e-13) << friction << ", " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 7000);
}

TEST(DirectedElastica, ThereIsOneEquilibriumOnASideOrNone) {
  // Along d = 0, its smallest φ at each κ found by a scan, h changes sign once, from plus to minus, or never.
  const double speed = 0.5;
  for (const double friction : {0.0, 0.1, 0.3}) {
    const auto law = directed(LoadDirection::normal, kRig, Friction::coulomb(friction));
    RandomContacts contacts(kRig, 0.25, 57);
    for (int i = 0; i < 40; ++i) {
      const Pose at = contacts.next();
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      const auto misdirection = [&](double modulus, double amplitude) {
        return side * law.constraint(at, 1.0, speed, {side * modulus, amplitude}).misdirection;
      };
      int falls = 0;
      int rises = 0;
      double before = NAN;
      for (int k = 1; k <= 200; ++k) {
        const double modulus = 0.99 * std::pow(k / 200.0, 2);
        double amplitude = 0.0;
        for (double high = 0.05; high < 3.14; high += 0.05) {
          if (misdirection(modulus, high) > 0.0) continue;
          if (high == 0.05) break;  // no equilibrium with so little bending
          amplitude =
              boost::math::tools::bisect([&](double at_tip) { return misdirection(modulus, at_tip); },
                                         high - 0.05, high, boost::math::tools::eps_tolerance<double>(40))
                  .second;
          break;
        }
        if (amplitude == 0.0) continue;
        const auto there = law.constraint(at, 1.0, speed, {side * modulus, amplitude});
        if (there.blade.shortening.value > 0.75) break;
        if (before > 0.0 && there.residual <= 0.0) ++falls;
        if (before <= 0.0 && there.residual > 0.0) ++rises;
        before = there.residual;
      }
      ASSERT_LE(falls, 1) << friction << ", " << i;
      ASSERT_EQ(rises, 0) << friction << ", " << i;
      const auto root = law.solve(at, 1.0, speed, side);
      if (falls == 1) {
        ASSERT_TRUE(root.has_value()) << friction << ", " << i;
      }
    }
  }
}

TEST(DirectedElastica, MirroredMotionHasTheMirroredForce) {
  const auto law = directed(LoadDirection::normal, kDefaultRotor, Friction::coulomb(0.1));
  RandomContacts contacts(kDefaultRotor, 0.25, 56);
  for (int i = 0; i < 1000; ++i) {
    const Pose at = contacts.next();
    Pose mirrored = at;
    mirrored.tangential = -at.tangential;
    mirrored.tangential_velocity = -at.tangential_velocity;
    const Met one = meet(law, at, 1.0, 0.5);
    const Met other = meet(law, mirrored, -1.0, -0.5);
    ASSERT_EQ(one.found, other.found);
    EXPECT_EQ(other.bending, -one.bending);
    EXPECT_EQ(other.force.radial, one.force.radial);
    EXPECT_EQ(other.force.tangential, -one.force.tangential);
    EXPECT_EQ(other.force.slip_velocity, -one.force.slip_velocity);
  }
}

}  // namespace
}  // namespace rubatlas::contact
