/// Sticking of a rigid blade's tip: the friction that keeps the slip velocity at rest, and the stick-slip
/// oscillator that everybody knows as its limit.
#include "contact/sticking.hpp"

#include <gtest/gtest.h>

#include <boost/math/differentiation/autodiff.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>

#include "contact/elastic_ring_contact.hpp"
#include "rotors.hpp"

namespace rubatlas::contact {
namespace {

/// dv/dτ by automatic differentiation of v = r'·t along a motion of the shaft's centre with the given
/// acceleration (in the fixed frame, the blade at angle 0).
double differentiated_slip(const Geometry& geometry, const Pose& at, double speed, double ax, double ay) {
  const auto time = boost::math::differentiation::make_fvar<double, 1>(0.0);
  const auto ex = cos(speed * time);
  const auto ey = sin(speed * time);
  const auto rx = at.radial + time * at.radial_velocity + geometry.reach * ex;
  const auto ry = at.tangential + time * at.tangential_velocity + geometry.reach * ey;
  const auto vx = at.radial_velocity + time * ax - speed * geometry.reach * ey;
  const auto vy = at.tangential_velocity + time * ay + speed * geometry.reach * ex;
  const auto slip = (rx * vy - ry * vx) / sqrt(rx * rx + ry * ry);
  return slip.derivative(1);
}

TEST(Sticking, TheCoefficientKeepsTheSlipVelocityAtRest) {
  const Geometry geometry = kDefaultRotor.geometry();
  const ElasticRingContact normal_force(geometry, 1e4, {0.0});
  const double force_unit = 1.0 / 100.0;
  RandomContacts contacts(kDefaultRotor, 0.25, 41);
  for (int i = 0; i < 3000; ++i) {
    const Pose at = contacts.next();
    const double speed = 0.1 + contacts.uniform();
    const BladeVector<double> other{0.2 * contacts.uniform() - 0.1, 0.2 * contacts.uniform() - 0.1};
    const double load = normal_force.force(at, 1.0, speed).normal * force_unit;
    const double c = slip_acceleration(geometry, at, speed, other) / load;
    // The whole force of a contact with this coefficient, its normal part included.
    const ElasticRingContact stuck(geometry, 1e4, Friction::coulomb(c));
    const TipForce force = stuck.force(at, 1.0, speed);
    const double rate = differentiated_slip(geometry, at, speed, other.along + force_unit * force.radial,
                                            other.across + force_unit * force.tangential);
    const double size = 1.0 + std::abs(c) * load;
    ASSERT_NEAR(rate, 0.0, 4e-15 * size) << i;
  }
}

/// The limit of a ring so large that it is a straight belt: a mass on a spring (both 1 in these units),
/// pressed on a belt that runs at `belt` against it.
class BeltOscillator {
 public:
  static constexpr double kRadius = 1e6;  // [m]
  static constexpr double kBelt = 0.02;   // Ω (rh+L) [m per unit τ]
  static constexpr double kLoad = 0.5;    // F/(m ωn²) [m per unit τ²]
  static constexpr double kSpeed = kBelt / kRadius;
  static constexpr Geometry kGeometry{kRadius, kRadius};

  [[nodiscard]] Pose pose() const { return {0.0, position, 0.0, velocity, 1.0}; }
  [[nodiscard]] double slip() const { return undeformed_slip_velocity(kGeometry, pose(), kSpeed); }
  [[nodiscard]] double sticking() const {
    return slip_acceleration(kGeometry, pose(), kSpeed, {0.0, -position}) / kLoad;
  }
  /// Exact motion under a constant friction coefficient, about x = −c F.
  void slide(double coefficient, double time) {
    const double centre = -coefficient * kLoad;
    const double from = position - centre;
    position = centre + from * std::cos(time) + velocity * std::sin(time);
    velocity = velocity * std::cos(time) - from * std::sin(time);
  }

  double position = 0.0;
  double velocity = -kBelt;
};

TEST(Sticking, FrictionOfATipThatSticksGrowsWithTheShaftsPull) {
  // Carried along by the belt, x = −vb τ: the coefficient is vb τ / F, and reaches μs at τ = μs F / vb.
  BeltOscillator rotor;
  for (double time = 0.0; time < 10.0; time += 0.5) {
    rotor.position = -BeltOscillator::kBelt * time;
    EXPECT_NEAR(rotor.slip(), 0.0, 1e-12);
    EXPECT_NEAR(rotor.sticking(), BeltOscillator::kBelt * time / BeltOscillator::kLoad, 1e-12);
  }
}

TEST(Sticking, StickSlipOscillatorHasItsTextbookPeriod) {
  // Leaves at μs, slips at μk < μs until v = 0 again. Period (mass and spring 1, belt vb, load F):
  // 2 D / vb + 2 (π − atan(D / vb)) with D = (μs − μk) F.
  constexpr double kStatic = 0.3;
  constexpr double kKinetic = 0.2;
  using boost::math::tools::bisect;
  using boost::math::tools::eps_tolerance;
  BeltOscillator rotor;
  double period = 0.0;
  double before = 0.0;
  double now = 0.0;
  for (int cycle = 0; cycle < 4; ++cycle) {
    // Stuck until the coefficient reaches μs: a root by bisection, as an integrator's event.
    const double from = rotor.position;
    const auto beyond_adhesion = [&](double stuck) {
      rotor.position = from - BeltOscillator::kBelt * stuck;
      return rotor.sticking() - kStatic;
    };
    const double stuck = bisect(beyond_adhesion, 0.0, 100.0, eps_tolerance<double>()).second;
    beyond_adhesion(stuck);
    now += stuck;
    // Slips with s = +1 until v = 0 for the first time again.
    const BeltOscillator left = rotor;
    double time = 1e-3;
    const auto slip_at = [&](double elapsed) {
      rotor = left;
      rotor.slide(kKinetic, elapsed);
      return rotor.slip();
    };
    ASSERT_GT(slip_at(time), 0.0) << "slips in the direction of the sign of c";
    while (slip_at(time + 1e-3) > 0.0) time += 1e-3;
    const double slipping = bisect(slip_at, time, time + 1e-3, eps_tolerance<double>()).second;
    slip_at(slipping);
    now += slipping;
    EXPECT_LT(std::abs(rotor.sticking()), kStatic) << "it can stick there";
    period = now - before;
    before = now;
  }
  const double drop = (kStatic - kKinetic) * BeltOscillator::kLoad / BeltOscillator::kBelt;
  EXPECT_NEAR(period, 2 * drop + 2 * (std::numbers::pi - std::atan(drop)), 1e-9);
}

}  // namespace
}  // namespace rubatlas::contact
