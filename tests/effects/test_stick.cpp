// Tips that stick: against the closed form of a rotor that rolls on a held tip, against friction that is
// steep in the slip velocity, and against what friction may never do.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "../hard/recorded_motion.hpp"
#include "../settings/scene_error_text.hpp"
#include "compared/sticking.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "rotor/blade_set.hpp"

namespace rubatlas::test {
namespace {

using modes::Event;
using modes::Guard;
using modes::OpenContact;
using rotor::ContactState;
using Point = std::complex<double>;

contact::ElasticRingContact sticking_law(const HardRotor& rotor, double static_ratio) {
  return {rotor.geometry(), rotor.ring_stiffness,
          contact::Friction::sticking(rotor.friction, static_ratio * rotor.friction)};
}

/// Kicked against its spin, faster than the tips run.
HardRotor rolling_rotor(double speed_ratio, double friction) {
  HardRotor rotor;
  rotor.speed_ratio = speed_ratio;
  rotor.friction = friction;
  rotor.misalignment = 0.0;
  return rotor;
}
rotor::State kick(double speed_ratio, double excess) {
  return {0.0099, 0.0, 0.0, -excess * 0.1 * speed_ratio};
}

bool begins_to_stick(const Event& event) {
  return event.kind == Guard::slip_reversal && event.slip == 0.0;
}

double slip_of(const HardRotor& rotor, int blade, double time, const rotor::State& state) {
  return contact::undeformed_slip_velocity(rotor.geometry(), pose_at(rotor, blade, time, state),
                                           rotor.speed_ratio);
}

/// While the only blade sticks its tip stays at one angle of the ring, r = ρ n, and
///     ρ'' + 2ζρ' + ρ + κ (ρ − R) = n·[(rh+L)(1 − Ω² + 2iζΩ) e^{iΩτ} + i y0],   κ = kr/(m ωn²),
/// with the friction q = t·[...]: a driven oscillator, in closed form.
class HeldTip {
 public:
  HeldTip(const HardRotor& rotor, double time, const rotor::State& state) : rotor_(rotor), start_(time) {
    const double speed = rotor.speed_ratio;
    const Point arm = std::polar(rotor.length, speed * time);
    const Point tip = Point(state[0], state[1] + rotor.misalignment) + arm;
    const Point velocity = Point(state[2], state[3]) + Point(0.0, speed) * arm;
    normal_ = tip / std::abs(tip);
    decay_ = rotor.damping_ratio;
    compliance_ = rotor.ring_stiffness * rotor.constants().force_unit;
    frequency_ = std::sqrt(1.0 + compliance_ - decay_ * decay_);
    const double from = std::abs(tip) - driven(time).real();
    const double rate = (velocity * std::conj(normal_)).real() - driven_rate(time);
    cosine_ = from;
    sine_ = (rate + decay_ * from) / frequency_;
  }

  [[nodiscard]] double radius(double time) const {
    const double elapsed = time - start_;
    return driven(time).real() + std::exp(-decay_ * elapsed) * (cosine_ * std::cos(frequency_ * elapsed) +
                                                                sine_ * std::sin(frequency_ * elapsed));
  }
  /// Shaft's centre.
  [[nodiscard]] Point position(double time) const {
    return radius(time) * normal_ - std::polar(rotor_.length, rotor_.speed_ratio * time) -
           Point(0.0, rotor_.misalignment);
  }
  /// c that holds the tip.
  [[nodiscard]] double coefficient(double time) const {
    const Point tangent = normal_ * Point(0.0, 1.0);
    const double pull = (std::conj(tangent) * push(time)).real();
    return pull / (compliance_ * (radius(time) - rotor_.ring_radius));
  }

 private:
  [[nodiscard]] Point factor() const {
    const double speed = rotor_.speed_ratio;
    return {1.0 - speed * speed, 2.0 * decay_ * speed};
  }
  [[nodiscard]] Point push(double time) const {
    return rotor_.length * factor() * std::polar(1.0, rotor_.speed_ratio * time) +
           Point(0.0, rotor_.misalignment);
  }
  /// The harmonic part of the driven motion along n, as a complex amplitude that turns.
  [[nodiscard]] Point turning(double time) const {
    return std::conj(normal_) * rotor_.length * factor() * std::polar(1.0, rotor_.speed_ratio * time) /
           (factor() + compliance_);
  }
  [[nodiscard]] Point driven(double time) const {
    const double still = (std::conj(normal_) * Point(0.0, rotor_.misalignment)).real();
    return turning(time) + (compliance_ * rotor_.ring_radius + still) / (1.0 + compliance_);
  }
  [[nodiscard]] double driven_rate(double time) const {
    return (Point(0.0, rotor_.speed_ratio) * turning(time)).real();
  }

  HardRotor rotor_;
  double start_;
  Point normal_;
  double decay_ = 0.0;
  double compliance_ = 0.0;  ///< κ: ring against shaft
  double frequency_ = 0.0;
  double cosine_ = 0.0;
  double sine_ = 0.0;
};

/// Compares each stick with the closed form, from its first instant to the last.
class HeldTipWatch final : public modes::MotionListener {
 public:
  HeldTipWatch(const HardRotor& rotor, double static_friction)
      : rotor_(rotor), static_friction_(static_friction) {}

  void piece(trajectory::MotionPiece& piece) override {
    if (!held_) return;
    for (int i = 0; i <= 20; ++i) {
      const double time = piece.begin() + (piece.end() - piece.begin()) * i / 20;
      const rotor::State state = rotor::as_state(piece.state(time));
      const double total = time + turned;
      EXPECT_LE(std::abs(held_->position(total) - Point(state[0], state[1])), 1e-13);
      EXPECT_NEAR(piece.normal_force(0, time),
                  rotor_.ring_stiffness * (held_->radius(total) - rotor_.ring_radius), 1e-9);
      EXPECT_LE(std::abs(slip_of(rotor_, 0, time, state)), 1e-15) << "at rest on the ring";
      EXPECT_LE(std::abs(held_->coefficient(total)), static_friction_ * (1.0 + 1e-8)) << "within the cone";
      ++looks;
    }
    longest = std::max(longest, piece.end() + turned - since_);
  }
  void event(const Event& event) override {
    if (begins_to_stick(event)) {
      since_ = event.time + turned;
      held_.emplace(rotor_, since_, event.state);
      EXPECT_LE(std::abs(held_->coefficient(since_)), static_friction_);
      return;
    }
    if (held_ && event.kind == Guard::comes_loose) {
      const double coefficient = held_->coefficient(event.time + turned);
      EXPECT_NEAR(std::abs(coefficient), static_friction_, 1e-7 * static_friction_);
      EXPECT_EQ(event.slip, coefficient > 0.0 ? 1.0 : -1.0) << "the way it is pulled";
      ++loosened;
    }
    held_.reset();
  }

  double turned = 0.0;  ///< τ of the revolutions before
  double longest = 0.0;
  int looks = 0;
  int loosened = 0;

 private:
  HardRotor rotor_;
  double static_friction_;
  double since_ = 0.0;
  std::optional<HeldTip> held_;
};

TEST(Stick, RollsOnTheHeldTipAsTheClosedFormSaysUntilTheConeEnds) {
  int loosened = 0;
  int looks = 0;
  double longest = 0.0;
  for (const double speed : {0.05, 0.3, 0.62}) {
    for (const double friction : {0.2, 0.5, 1.0}) {
      for (const double ratio : {1.0, 1.5}) {
        for (const double excess : {0.5, 1.0, 1.5, 2.0}) {
          SCOPED_TRACE(::testing::Message() << "speed " << speed << ", friction " << friction << ", ratio "
                                            << ratio << ", kick " << excess);
          HardRotor rotor = rolling_rotor(speed, friction);
          rotor.blades = 1;
          rotor.misalignment = 1e-3;
          const auto motion = hybrid_motion(rotor.constants(), rotor::BladeSet(1, speed),
                                            sticking_law(rotor, ratio), kNoForcing, rotor.limits());
          HeldTipWatch watch(rotor, ratio * friction);
          ending::PointStatus status = start(*motion, kick(speed, excess));
          for (int revolution = 0; revolution < 3 && status == ending::PointStatus::done; ++revolution) {
            status = revolve(*motion, watch);
            watch.turned += rotor.constants().period();
          }
          EXPECT_NE(status, ending::PointStatus::integrator_failed);
          loosened += watch.loosened;
          looks += watch.looks;
          longest = std::max(longest, watch.longest);
        }
      }
    }
  }
  EXPECT_GT(loosened, 10);
  EXPECT_GT(looks, 1000);
  EXPECT_GT(longest, 0.05);
}

/// Largest power of friction on the tips, −s μ F v, over a motion of rigid blades [N m per unit τ]; none on a
/// tip with s = 0.
struct FrictionAtWork {
  double largest;
  motion::WorkCounts work;
};

template <class Law>
FrictionAtWork friction_at_work(const HardRotor& rotor, const Law& law, const rotor::State& start) {
  class Watch final : public modes::MotionListener {
   public:
    explicit Watch(const HardRotor& of) : rotor(of), slips(static_cast<std::size_t>(of.blades), 0.0) {}
    void piece(trajectory::MotionPiece& piece) override {
      for (std::size_t i = 0; i < piece.contact_count(); ++i) {
        const int blade = piece.blade(i);
        for (int part = 1; part < 8; ++part) {
          const double time = piece.begin() + (piece.end() - piece.begin()) * part / 8;
          const double slip = slip_of(rotor, blade, time, rotor::as_state(piece.state(time)));
          const double load = std::max(0.0, piece.normal_force(i, time));
          largest = std::max(largest, -slips[static_cast<std::size_t>(blade)] * rotor.friction * load * slip);
        }
      }
    }
    void event(const Event& event) override { slips[static_cast<std::size_t>(event.blade)] = event.slip; }
    HardRotor rotor;
    std::vector<double> slips;
    double largest = 0.0;
  };
  Watch watch(rotor);
  const auto motion = hybrid_motion(rotor.constants(), rotor::BladeSet(rotor.blades, rotor.speed_ratio), law,
                                    kNoForcing, rotor.limits());
  ending::PointStatus status = test::start(*motion, start);
  for (int revolution = 0; revolution < 3 && status == ending::PointStatus::done; ++revolution) {
    status = revolve(*motion, watch);
  }
  EXPECT_NE(status, ending::PointStatus::integrator_failed);
  return {watch.largest, motion->work()};
}

TEST(Stick, FrictionNeverDrivesATipWhereTurningItRoundDoes) {
  double turned_round = 0.0;
  std::uint64_t reversals = 0;
  for (const double speed : {0.05, 0.3, 0.62}) {
    for (const double friction : {0.1, 0.5, 1.0, 2.0}) {
      for (const double excess : {0.5, 1.0, 1.5, 2.0}) {
        const HardRotor rotor = rolling_rotor(speed, friction);
        SCOPED_TRACE(::testing::Message()
                     << "speed " << speed << ", friction " << friction << ", kick " << excess);
        const auto with = friction_at_work(rotor, sticking_law(rotor, 1.0), kick(speed, excess));
        const auto without = friction_at_work(rotor, rotor.elastic_ring(), kick(speed, excess));
        EXPECT_LE(with.largest, 1e-15);
        turned_round = std::max(turned_round, without.largest);
        reversals += with.work.slip_reversals;
        EXPECT_LE(with.work.slip_reversals, 20U * (1U + with.work.touchdowns));
      }
    }
  }
  EXPECT_GT(reversals, 20U);
  EXPECT_GT(turned_round, 1e-6) << "MODEL 4.4 keeps the slip direction that it has turned to";
}

TEST(Stick, IsTheLimitOfFrictionThatTurnsRoundOverEverLowerSlip) {
  // A few contacts with five sticks: no whirl in which errors grow.
  const HardRotor rotor = rolling_rotor(0.05, 0.3);
  const auto nothing = [](trajectory::MotionPiece&) {};
  const rotor::State start{0.005, 0.0, 0.0, -0.05};
  const auto stuck = follow(rotor, sticking_law(rotor, 1.0), kNoForcing, start, 1, nothing);
  ASSERT_EQ(stuck.status, ending::PointStatus::done);
  ASSERT_GE(
      std::ranges::count_if(stuck.events, [](const auto& entry) { return begins_to_stick(entry.event); }), 1);
  std::vector<double> distances;
  for (const double velocity : {1e-4, 1e-5, 1e-6}) {
    const contact::ElasticRingContact law(rotor.geometry(), rotor.ring_stiffness,
                                          contact::Friction::regularised(rotor.friction, velocity));
    const auto steep = follow(rotor, law, kNoForcing, start, 1, nothing);
    ASSERT_EQ(steep.status, ending::PointStatus::done);
    distances.push_back((steep.sections[0] - stuck.sections[0]).abs().maxCoeff());
  }
  EXPECT_LE(distances[1], 0.2 * distances[0]);
  EXPECT_LE(distances[2], 0.2 * distances[1]);
  EXPECT_GT(distances[2], 1e-12) << "the two laws differ";
}

/// dv/dτ of a blade along the motion that a right-hand side makes, by central differences.
template <class System, class Blades>
double slip_rate(System& system, const HardRotor& rotor, const Blades& blades, int blade,
                 const ContactState& state) {
  ContactState rate;
  system(state, rate);
  const auto slip = [&](double step) {
    // Positions to second order: velocities enter the slip directly.
    ContactState there = state + step * rate;
    there.head<2>() += 0.5 * step * step * rate.segment<2>(2);
    const auto er = blades.direction(blade, blades.first(there[rotor::kTime]));
    return contact::undeformed_slip_velocity(
        rotor.geometry(), rotor::pose_of(rotor.constants(), rotor.geometry(), er, there.head<4>()),
        blades.angular_speed(there[rotor::kTime]));
  };
  const double step = 1e-4;
  return (slip(step) - slip(-step)) / (2.0 * step);
}

template <class Blades>
void expect_two_tips_at_rest(const HardRotor& rotor, const Blades& blades) {
  const auto law = law_of(laws_of(sticking_law(rotor, 1e3), rotor.blades));
  const rotor::Machine machine = machine_of(rotor.constants(), blades);
  modes::WorkMeter meter;
  compared::Sticking mode({&machine, law.get(), rotor.limits(), &meter});
  const std::vector<OpenContact> contacts{{0, 0.0, 0.0}, {1, 0.0, 0.0}};
  ContactState state;
  mode.open(0.11, rotor::shaft_and_ring({0.006, 0.0045, 0.01, -0.02}), contacts, state);
  EXPECT_GT(std::abs(slip_of(rotor, 0, state[rotor::kTime], state.head<4>())), 1e-3);
  mode.project(state);
  for (const int blade : {0, 1}) {
    const auto er = blades.direction(blade, blades.first(state[rotor::kTime]));
    const auto at = rotor::pose_of(rotor.constants(), rotor.geometry(), er, state.head<4>());
    EXPECT_NEAR(
        contact::undeformed_slip_velocity(rotor.geometry(), at, blades.angular_speed(state[rotor::kTime])),
        0.0, 1e-16);
    EXPECT_NEAR(slip_rate(mode, rotor, blades, blade, state), 0.0, 1e-7);
  }
  // Beyond the cone of both, one after the other is let go.
  std::vector<OpenContact> settled = contacts;
  const auto slippery = law_of(laws_of(sticking_law(rotor, 1e-9), rotor.blades));
  modes::RestOfRigidBlades judge(machine, *slippery);
  EXPECT_TRUE(judge.settle(state, settled));
  for (const OpenContact& contact : settled) EXPECT_EQ(std::abs(contact.slip), 1.0);
}

TEST(Stick, TwoTipsCanBeHeldAtOnceAtASteadyAndAtARipplingSpeed) {
  HardRotor rotor;
  rotor.misalignment = 0.005;
  rotor.blades = 5;
  expect_two_tips_at_rest(rotor, rotor::BladeSet(rotor.blades, rotor.speed_ratio));
  const auto angles = rotor::equal_angles(rotor.blades);
  expect_two_tips_at_rest(rotor, rotor::BladeSet(angles, rotor.speed_ratio, {0.3, 2, 0.4}));
}

TEST(Stick, OfTheMirroredRotorIsTheMirrorImage) {
  const auto nothing = [](trajectory::MotionPiece&) {};
  int sticks = 0;
  for (const double excess : {0.5, 1.0, 1.5, 2.0}) {
    HardRotor rotor = rolling_rotor(0.3, 0.5);
    rotor.misalignment = 2e-3;
    HardRotor image = rotor;
    image.speed_ratio = -image.speed_ratio;
    image.misalignment = -image.misalignment;
    const rotor::State start = kick(0.3, excess);
    const auto motion = follow(rotor, sticking_law(rotor, 1.2), kNoForcing, start, 2, nothing);
    const auto mirrored = follow(image, sticking_law(image, 1.2), kNoForcing,
                                 {start[0], -start[1], start[2], -start[3]}, 2, nothing);
    ASSERT_EQ(motion.events.size(), mirrored.events.size());
    for (std::size_t i = 0; i < motion.events.size(); ++i) {
      const Event& one = motion.events[i].event;
      const Event& other = mirrored.events[i].event;
      EXPECT_EQ(one.kind, other.kind);
      EXPECT_EQ(one.slip, -other.slip);
      EXPECT_EQ((one.blade + other.blade) % rotor.blades, 0);
      EXPECT_NEAR(one.time, other.time, 1e-9);
      sticks += begins_to_stick(one) ? 1 : 0;
    }
  }
  EXPECT_GE(sticks, 2);
}

TEST(Stick, RefusesASecondLawOfFrictionAMachineThatChangesAndOtherBladesThanPlainOnes) {
  const auto refusal = [](const std::string& sections) {
    return settings::refusal(R"({"grid": {"speed_ratio": 0.5}, "stick": {}, )" + sections + "}");
  };
  for (const std::string blades : {R"("contact": {"law": "beam_column"})", R"("axial_compliance": {})",
                                   R"("yielding_ring": {})", R"("release": {})"}) {
    EXPECT_EQ(refusal(blades),
              "/stick: combines with inextensible elastica in a rigid ring only: no axial_compliance, "
              "yielding_ring, release or law \"beam_column\"");
  }
  EXPECT_EQ(refusal(R"("contact": {"law": "elastic_ring"}, "stribeck": {"static_friction": 0.3})"),
            "/stick: stands beside /stribeck; friction has one law");
  EXPECT_EQ(refusal(R"("contact": {"law": "elastic_ring"}, "regularised_friction": {"velocity": 0.1})"),
            "/stick: stands beside /regularised_friction; friction has one law");
  EXPECT_EQ(
      refusal(R"("contact": {"law": "elastic_ring"}, "speed_ramp": {"rate": 0.001})"),
      "/stick: stands beside /speed_ramp, whose changes between revolutions would make tips at rest slip");
  EXPECT_EQ(refusal(R"("load_direction": {})"),
            "/stick: holds tips under the axial load only, not beside /load_direction");
  for (const std::string law : {"elastic_ring", "elastica"}) {
    EXPECT_EQ(refusal(R"("contact": {"law": ")" + law + R"("})"), "accepted");
  }
}

}  // namespace
}  // namespace rubatlas::test
