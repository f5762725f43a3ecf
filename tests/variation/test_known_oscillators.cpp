/// Tangents of oscillators whose linearised flow is known: a shaft that moves along x towards a wall that
/// yields in proportion (a piecewise linear oscillator), and in the limit of a rigid wall an impact
/// oscillator.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "../support/point.hpp"
#include "trajectory/motion_piece.hpp"
#include "variation/tangent_flow.hpp"

namespace rubatlas::test {
namespace {

constexpr double kDamping = 0.07;
constexpr double kNearlyAtRest = 1e-12;  ///< Ω of a blade that stands on the x axis

/// Where the tip meets the ring, from the shaft's place of rest [m]; and the ring's stiffness, in that of the
/// shaft.
struct Wall {
  double place = 0.01;
  double stiffness = 0.0;
};

/// One rigid blade along x.
settings::Scene shaft_before(const Wall& wall) {
  settings::Scene scene = default_rotor(1);
  scene.contact.law = settings::ContactLaw::elastic_ring;
  scene.contact.friction = 0.0;
  scene.blades.count = 1;
  scene.rotor.misalignment = 0.0;
  scene.rotor.damping_ratio = kDamping;
  const double frequency = scene.rotor.natural_frequency;
  scene.ring.stiffness = wall.stiffness * scene.rotor.mass * frequency * frequency;
  scene.ring.radius = scene.blades.hub_radius + scene.blades.length + wall.place;
  return scene;
}

/// s'' + 2ζ s' + (1 + κ) s = −(place of the wall), s the shaft's way beyond the wall, κ the wall's stiffness,
/// or 0 away from it.
class AlongX final : public trajectory::MotionPiece {
 public:
  enum class Phase : std::uint8_t { flight, contact };
  AlongX(double begin, double end, const Wall& wall, Phase phase, double beyond, double velocity)
      : begin_(begin),
        end_(end),
        wall_(wall.place),
        stiffness_(phase == Phase::contact ? wall.stiffness : 0.0),
        rest_(-wall_ / (1.0 + stiffness_)),
        frequency_(std::sqrt(1.0 + stiffness_ - kDamping * kDamping)),
        from_rest_(beyond - rest_),
        velocity_(velocity) {}

  /// s and s' [m, m per unit τ]: with more digits than the place, where the wall is stiff.
  [[nodiscard]] std::array<double, 2> beyond(double time) const {
    const double elapsed = time - begin_;
    const double decay = std::exp(-kDamping * elapsed);
    const double cosine = decay * std::cos(frequency_ * elapsed);
    const double sine = decay * std::sin(frequency_ * elapsed) / frequency_;
    return {rest_ + cosine * from_rest_ + sine * (velocity_ + kDamping * from_rest_),
            cosine * velocity_ - sine * ((1.0 + stiffness_) * from_rest_ + kDamping * velocity_)};
  }
  [[nodiscard]] double begin() const override { return begin_; }
  [[nodiscard]] double end() const override { return end_; }
  [[nodiscard]] trajectory::State state(double time) override {
    const auto [place, velocity] = beyond(time);
    return {wall_ + place, 0.0, velocity, 0.0};
  }
  [[nodiscard]] double displacement_bound() const override { return 1.0; }
  [[nodiscard]] std::size_t contact_count() const override { return stiffness_ > 0.0 ? 1 : 0; }
  [[nodiscard]] int blade(std::size_t /*contact*/) const override { return 0; }
  [[nodiscard]] bool load_peaks(std::size_t /*contact*/) const override { return true; }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t /*contact*/, double time) override {
    constexpr double kShaft = 100.0;  // m ωn² [N/m]
    const double force = kShaft * stiffness_ * beyond(time)[0];
    return {-force, force, 0.0, 1.0, 0.0, 0.0};
  }
  [[nodiscard]] trajectory::Tip tip(int /*blade*/, double time) override {
    const auto [place, velocity] = beyond(time);
    return {place, velocity, 0.0};
  }
  void path(double share, trajectory::PathPoint& point,
            std::vector<trajectory::ContactForce>* /*forces*/) override {
    point.time_rate = end_ - begin_;
    point.time = begin_ + share * point.time_rate;
    point.state = state(point.time);
    point.contacts.clear();
    if (stiffness_ > 0.0) point.contacts.push_back({0, 1.0, 0.0, 0.0, false});
  }
  /// The first time after the beginning at which the shaft is at the wall; `step`: shorter than it stays
  /// away.
  [[nodiscard]] double reaches_wall(double step) {
    const auto inside = [&](double time) { return beyond(time)[0] < 0.0; };
    double low = begin_ + step;
    const bool side = inside(low);
    while (inside(low + step) == side) low += step;
    double high = low + step;
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      (inside(middle) == side ? low : high) = middle;
    }
    return high;
  }

 private:
  double begin_;
  double end_;
  double wall_;  ///< [m]
  double stiffness_;
  double rest_;       ///< s at rest [m]
  double frequency_;  ///< of the damped motion
  double from_rest_;  ///< at the beginning [m]
  double velocity_;
};

/// The flow of x alone: rows and columns of x and x'.
Eigen::Matrix2d along_x(const variation::Tangents& tangents) {
  return (Eigen::Matrix2d() << tangents(0, 0), tangents(0, 2), tangents(2, 0), tangents(2, 2)).finished();
}
/// e^{At} of x'' + 2ζ x' + (1 + κ) x = 0.
Eigen::Matrix2d exponential(double stiffness, double duration) {
  const double frequency = std::sqrt(1.0 + stiffness - kDamping * kDamping);
  const double cosine = std::cos(frequency * duration);
  const double sine = std::sin(frequency * duration) / frequency;
  const Eigen::Matrix2d turned = (Eigen::Matrix2d() << cosine + kDamping * sine, sine,
                                  -(1.0 + stiffness) * sine, cosine - kDamping * sine)
                                     .finished();
  return std::exp(-kDamping * duration) * turned;
}

/// Flies to the wall, is pressed in and let go; the tangents of contact alone, and of all.
struct Bounce {
  Eigen::Matrix2d all;
  Eigen::Matrix2d contact;
  double flight;  ///< durations [τ]
  double pressed;
  double approach_speed;   ///< [m per unit τ]
  double departure_speed;  ///< likewise, away from the wall
};
Bounce bounce(const Wall& wall, double start, double velocity = 0.0, double flight_step = 1e-3) {
  using Phase = AlongX::Phase;
  variation::TangentFlow flow(shaft_before(wall));
  flow.begin(kNearlyAtRest);
  const double touches =
      AlongX(0.0, 10.0, wall, Phase::flight, start - wall.place, velocity).reaches_wall(flight_step);
  AlongX flight(0.0, touches, wall, Phase::flight, start - wall.place, velocity);
  flow.piece(flight);
  const Eigen::Matrix2d before = along_x(flow.tangents());
  flow.passes_ring(0);
  const double approach = flight.state(touches)[2];
  const double contact_step = 1e-3 / std::sqrt(1.0 + wall.stiffness);
  const double leaves =
      AlongX(touches, touches + 10.0, wall, Phase::contact, 0.0, approach).reaches_wall(contact_step);
  // In pieces, as an integrator makes them.
  constexpr int kPieces = 4;
  std::array<double, 2> at{0.0, approach};
  for (int i = 0; i < kPieces; ++i) {
    const double begin = touches + (leaves - touches) * i / kPieces;
    const double end = touches + (leaves - touches) * (i + 1) / kPieces;
    AlongX piece(begin, end, wall, Phase::contact, at[0], at[1]);
    at = piece.beyond(end);
    flow.piece(piece);
  }
  flow.passes_ring(0);
  AlongX after(leaves, leaves, wall, Phase::flight, at[0], at[1]);
  flow.piece(after);
  EXPECT_TRUE(flow.known());
  const Eigen::Matrix2d all = along_x(flow.tangents());
  return {all, all * before.inverse(), touches, leaves - touches, approach, -at[1]};
}

/// Shaw and Holmes, A periodically forced piecewise linear oscillator, J. Sound Vib. 90 (1983): the force is
/// continuous at the wall, so that the linearised map is the product of those of the linear pieces.
TEST(KnownOscillators, OfAPiecewiseLinearOscillatorTheTangentsAreTheProductOfThoseOfItsPieces) {
  for (const double stiffness : {0.5, 3.0, 40.0, 1000.0}) {
    const Bounce found = bounce({.stiffness = stiffness}, -0.03);
    const Eigen::Matrix2d expected = exponential(stiffness, found.pressed) * exponential(0.0, found.flight);
    EXPECT_LE((found.all - expected).norm(), 1e-11 * expected.norm()) << stiffness;
  }
}

/// Müller, Calculation of Lyapunov exponents for dynamic systems with discontinuities, Chaos, Solitons &
/// Fractals 5 (1995); Shaw and Holmes (1983): an impact that turns v into −r v has the saltation matrix
/// ((−r, 0), ((a⁺ + r a⁻)/v, −r)), a± the accelerations just after and before.
TEST(KnownOscillators, OfAWallThatBecomesRigidTheTangentsBecomeThoseOfAnImpact) {
  double last = 0.0;
  for (const double stiffness : {1e3, 1e5, 1e7}) {
    const Bounce found = bounce({.stiffness = stiffness}, -0.03);
    const double restitution = found.departure_speed / found.approach_speed;
    const double before = -Wall().place - 2.0 * kDamping * found.approach_speed;
    const double after = -Wall().place + 2.0 * kDamping * found.departure_speed;
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

/// Guckenheimer and Holmes, Nonlinear Oscillations, Dynamical Systems, and Bifurcations of Vector Fields,
/// section 2.4: a ball that leaves a rigid table with the speed v comes back after T = 2v/a. With places in
/// v²/a and speeds in v a hop and an impact without loss have the linear map ((−1, −2), (2, 3)), whose
/// multipliers are both one.
TEST(KnownOscillators, OfAHopThatIsSmallAgainstTheLoadTheTangentsBecomeThoseOfABouncingBall) {
  double last = 0.0;
  for (const double speed : {1e-2, 1e-3}) {
    // The shaft's spring presses it, 1 cm from its place of rest, against the wall.
    const Wall wall{.place = -0.01, .stiffness = 1e14};
    const double load = -wall.place;
    const double velocity = speed * load;
    const Bounce found = bounce(wall, wall.place, -velocity, 0.1 * speed);
    EXPECT_NEAR(found.flight, 2.0 * velocity / load, speed * found.flight);
    const Eigen::Vector2d units(velocity * velocity / load, velocity);
    const Eigen::Matrix2d scaled = units.cwiseInverse().asDiagonal() * found.all * units.asDiagonal();
    const double error = (scaled - (Eigen::Matrix2d() << -1.0, -2.0, 2.0, 3.0).finished()).norm();
    // Damping is left, in proportion to the time of a hop.
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 10.0, 0.5);
    }
    last = error;
  }
  EXPECT_LT(last, 1e-2);
}

/// Without damping such a wall keeps phase volume, and the determinant of an impact is r².
TEST(KnownOscillators, OfAPieceInContactPhaseVolumeContractsByDampingAlone) {
  const Bounce found = bounce({.stiffness = 200.0}, -0.02);
  EXPECT_NEAR(found.all.determinant(), std::exp(-2.0 * kDamping * (found.flight + found.pressed)), 1e-12);
}

}  // namespace
}  // namespace rubatlas::test
