/// Tangents of oscillators whose linearised flow is known: a shaft that moves along x towards a wall that
/// yields in proportion (a piecewise linear oscillator), and in the limit of a rigid wall an impact
/// oscillator.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "../support/point.hpp"
#include "observables/motion_piece.hpp"
#include "variation/tangent_flow.hpp"

namespace rubatlas::test {
namespace {

constexpr double kDamping = 0.07;
constexpr double kClearance = 0.01;  ///< [m]: from the shaft's place of rest to where the tip meets the ring
constexpr double kNearlyAtRest = 1e-12;  ///< Ω of a blade that stands on the x axis

/// One rigid blade along x. `stiffness`: of the ring, in that of the shaft.
settings::Scene shaft_before_a_wall(double stiffness) {
  settings::Scene scene = default_rotor(1);
  scene.contact.law = settings::ContactLaw::elastic_ring;
  scene.contact.friction = 0.0;
  scene.blades.count = 1;
  scene.rotor.misalignment = 0.0;
  scene.rotor.damping_ratio = kDamping;
  const double frequency = scene.rotor.natural_frequency;
  scene.ring.stiffness = stiffness * scene.rotor.mass * frequency * frequency;
  return scene;
}

/// x'' + 2ζ x' + (1 + κ) x = κ δc, κ the wall's stiffness in that of the shaft, or 0 away from it.
class AlongX final : public observables::MotionPiece {
 public:
  AlongX(double begin, double end, double stiffness, double x, double velocity)
      : begin_(begin),
        end_(end),
        stiffness_(stiffness),
        rest_(stiffness * kClearance / (1.0 + stiffness)),
        frequency_(std::sqrt(1.0 + stiffness - kDamping * kDamping)),
        x_(x - rest_),
        velocity_(velocity) {}

  [[nodiscard]] double begin() const override { return begin_; }
  [[nodiscard]] double end() const override { return end_; }
  [[nodiscard]] observables::State state(double time) override {
    const double elapsed = time - begin_;
    const double decay = std::exp(-kDamping * elapsed);
    const double cosine = decay * std::cos(frequency_ * elapsed);
    const double sine = decay * std::sin(frequency_ * elapsed) / frequency_;
    const double square = 1.0 + stiffness_;
    return {rest_ + cosine * x_ + sine * (velocity_ + kDamping * x_), 0.0,
            cosine * velocity_ - sine * (square * x_ + kDamping * velocity_), 0.0};
  }
  [[nodiscard]] double displacement_bound() const override { return 1.0; }
  [[nodiscard]] std::size_t contact_count() const override { return stiffness_ > 0.0 ? 1 : 0; }
  [[nodiscard]] int blade(std::size_t /*contact*/) const override { return 0; }
  [[nodiscard]] bool load_peaks(std::size_t /*contact*/) const override { return true; }
  [[nodiscard]] double normal_force(std::size_t /*contact*/, double time) override {
    constexpr double kShaft = 100.0;  // m ωn² [N/m]
    return kShaft * stiffness_ * (state(time)[0] - kClearance);
  }
  [[nodiscard]] double root_strain(std::size_t /*contact*/, double /*time*/) override { return 0.0; }
  [[nodiscard]] observables::ContactForce contact_force(std::size_t contact, double time) override {
    const double force = normal_force(contact, time);
    return {-force, force, 0.0, 1.0, 0.0, 0.0};
  }
  [[nodiscard]] observables::Tip tip(int /*blade*/, double time) override {
    const observables::State at = state(time);
    return {at[0] - kClearance, at[2], 0.0};
  }
  [[nodiscard]] bool path(double share, observables::PathPoint& point) override {
    point.time_rate = end_ - begin_;
    point.time = begin_ + share * point.time_rate;
    point.state = state(point.time);
    point.contacts.clear();
    if (stiffness_ > 0.0) point.contacts.push_back({0, 1.0, 0.0, 0.0, false});
    return true;
  }
  /// The first time after the beginning at which the shaft is at the wall.
  [[nodiscard]] double reaches_wall() {
    double low = begin_ + 1e-3 / frequency_;
    const bool inside = state(low)[0] < kClearance;
    const double step = 1e-3 / frequency_;
    double high = low;
    while ((state(high)[0] < kClearance) == inside) high += step;
    low = high - step;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((state(middle)[0] < kClearance) == inside ? low : high) = middle;
    }
    return high;
  }

 private:
  double begin_;
  double end_;
  double stiffness_;
  double rest_;       ///< [m]
  double frequency_;  ///< of the damped motion
  double x_;          ///< from there
  double velocity_;
};

/// The flow of x alone: rows and columns of x and x'.
Eigen::Matrix2d along_x(const variation::Tangents& tangents) {
  return (Eigen::Matrix2d() << tangents(0, 0), tangents(0, 2), tangents(2, 0), tangents(2, 2)).finished();
}
/// e^{At} of x'' + 2ζ x' + (1 + κ) x = 0.
Eigen::Matrix2d exponential(double stiffness, double duration) {
  const Eigen::Matrix2d system =
      (Eigen::Matrix2d() << 0.0, 1.0, -1.0 - stiffness, -2.0 * kDamping).finished();
  return (system * duration).eval().exp();
}

/// Flies from rest at `start` to the wall, is pressed in and let go; the tangents of contact alone, or of
/// all.
struct Bounce {
  Eigen::Matrix2d all;
  Eigen::Matrix2d contact;
  double flight;  ///< durations [τ]
  double pressed;
  double approach_speed;   ///< [m per unit τ]
  double departure_speed;  ///< likewise, away from the wall
};
Bounce bounce(double stiffness, double start) {
  variation::TangentFlow flow(shaft_before_a_wall(stiffness));
  flow.begin(kNearlyAtRest);
  AlongX probe(0.0, 10.0, 0.0, start, 0.0);
  const double touches = probe.reaches_wall();
  AlongX flight(0.0, touches, 0.0, start, 0.0);
  flow.piece(flight);
  const Eigen::Matrix2d before = along_x(flow.tangents());
  flow.passes_ring(0);
  const double approach = flight.state(touches)[2];
  AlongX pressed(touches, touches + 10.0, stiffness, kClearance, approach);
  const double leaves = pressed.reaches_wall();
  // In pieces, as an integrator makes them.
  constexpr int kPieces = 4;
  observables::State at{kClearance, 0.0, approach, 0.0};
  for (int i = 0; i < kPieces; ++i) {
    const double begin = touches + (leaves - touches) * i / kPieces;
    const double end = touches + (leaves - touches) * (i + 1) / kPieces;
    AlongX piece(begin, end, stiffness, at[0], at[2]);
    at = piece.state(end);
    flow.piece(piece);
  }
  flow.passes_ring(0);
  AlongX after(leaves, leaves + 1e-12, 0.0, at[0], at[2]);
  flow.piece(after);
  EXPECT_TRUE(flow.known());
  const Eigen::Matrix2d all = along_x(flow.tangents());
  return {all, all * before.inverse(), touches, leaves - touches, approach, -at[2]};
}

/// Shaw and Holmes, A periodically forced piecewise linear oscillator, J. Sound Vib. 90 (1983): the force is
/// continuous at the wall, so that the linearised map is the product of those of the linear pieces.
TEST(KnownOscillators, OfAPiecewiseLinearOscillatorTheTangentsAreTheProductOfThoseOfItsPieces) {
  for (const double stiffness : {0.5, 3.0, 40.0, 1000.0}) {
    const Bounce found = bounce(stiffness, -0.03);
    const Eigen::Matrix2d expected = exponential(stiffness, found.pressed) * exponential(0.0, found.flight);
    EXPECT_LE((found.all - expected).norm(), 1e-11 * expected.norm()) << stiffness;
  }
}

/// Müller, Calculation of Lyapunov exponents for dynamic systems with discontinuities, Chaos, Solitons &
/// Fractals 5 (1995); Shaw and Holmes (1983): an impact that turns v into −r v has the saltation matrix
/// ((−r, 0), ((a⁺ + r a⁻)/v, −r)), a± the accelerations just after and before.
TEST(KnownOscillators, OfAWallThatBecomesRigidTheTangentsBecomeThoseOfAnImpact) {
  double last = 0.0;
  for (const double stiffness : {1e4, 1e6, 1e8}) {
    const Bounce found = bounce(stiffness, -0.03);
    const double restitution = found.departure_speed / found.approach_speed;
    const double before = -kClearance - 2.0 * kDamping * found.approach_speed;
    const double after = -kClearance + 2.0 * kDamping * found.departure_speed;
    const Eigen::Matrix2d impact = (Eigen::Matrix2d() << -restitution, 0.0,
                                    (after + restitution * before) / found.approach_speed, -restitution)
                                       .finished();
    const double error = (found.contact - impact).norm();
    // The contact lasts π/√κ. What it takes in proportion to that is in r; the square of it is left.
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 100.0, 2.0) << stiffness;
    }
    last = error;
  }
  EXPECT_LT(last, 1e-5);
}

/// Without damping such a wall keeps phase volume, and the determinant of an impact is r².
TEST(KnownOscillators, OfAPieceInContactPhaseVolumeContractsByDampingAlone) {
  const Bounce found = bounce(200.0, -0.02);
  EXPECT_NEAR(found.all.determinant(), std::exp(-2.0 * kDamping * (found.flight + found.pressed)), 1e-12);
}

}  // namespace
}  // namespace rubatlas::test
