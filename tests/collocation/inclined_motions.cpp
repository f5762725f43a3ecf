/// Motions under an inclined load, under friction with a velocity, and of tips that stick: by collocation as
/// in steps of the order-8 pair at a far lower tolerance, with unequal blades, a speed that ripples and an
/// unbalance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "collocation/interval.hpp"
#include "contact/directed_elastica.hpp"
#include "modes/phase.hpp"
#include "rotor/any_shaft.hpp"
#include "rotor/blade_set.hpp"

namespace rubatlas::test {
namespace {

constexpr double kClearanceOfMotions = 0.01;  // [m]
constexpr int kRevolutionsOfMotions = 2;

double random_between(std::mt19937_64& generator, double least, double most) {
  return least + (most - least) * static_cast<double>(generator() >> 11U) * 0x1p-53;
}

struct KickedRotor {
  using Laws = std::vector<contact::DirectedElastica>;
  rotor::RotorConstants rotor;
  rotor::BladeSet blades;
  Laws laws;
  rotor::AnyShaft shaft;
  trajectory::State start;

  /// States after revolutions by this tolerance [clearances]; fewer where the motion ends.
  [[nodiscard]] std::vector<trajectory::State> states(double tolerance, bool collocates,
                                                      modes::MotionListener& listener) const {
    const auto motion = hybrid_motion(rotor::Machine{rotor, blades, shaft, {}}, laws,
                                      {tolerance * kClearanceOfMotions, 0.5}, collocates);
    std::vector<trajectory::State> result;
    if (motion->start(start) != ending::StatusDetail::none) return result;
    for (int i = 0; i < kRevolutionsOfMotions; ++i) {
      if (revolve(*motion, listener) != ending::PointStatus::done) break;
      const auto state = motion->state();
      result.push_back({state[0], state[1], state[2], state[3]});
    }
    return result;
  }
};

template <class MakeFriction>
KickedRotor kicked_rotor(std::mt19937_64& generator, contact::LoadDirection direction, int fewest,
                         MakeFriction make_friction) {
  const auto between = [&](double least, double most) { return random_between(generator, least, most); };
  const double friction = std::pow(10.0, between(-2.0, -0.15));
  const double thickness = std::pow(10.0, between(-3.4, -2.7));
  const double stiffness = 206e9 * 0.01 * thickness * thickness * thickness / 12.0;
  const double speed = between(0.05, 1.0);
  const double damping = std::pow(10.0, between(-2.5, -0.3));
  const int count = fewest + static_cast<int>(between(0.0, 4.0));
  const contact::Friction of_tips = make_friction(friction);
  std::vector<contact::DirectedElastica> laws;
  for (int k = 0; k < count; ++k) {
    const double length = 0.1 + between(-1e-4, 1e-4);
    laws.emplace_back(direction, contact::Geometry{length, 0.11},
                      contact::ElasticaContact::Blade{length, thickness, stiffness}, of_tips);
  }
  const double moment = std::pow(10.0, between(-5.0, -3.0));
  const double ripple = between(0.0, 0.05);
  const rotor::RotorConstants rotor{speed, damping, kClearanceOfMotions * between(0.5, 1.5), 0.01,
                                    kClearanceOfMotions};
  const double kick = std::pow(10.0, between(-3.5, -2.0));
  trajectory::State start{};
  for (double& component : start) component = between(-kick, kick);
  effects::SpeedRipple speed_ripple;
  speed_ripple.amplitude = ripple;
  return KickedRotor{
      rotor,
      {rotor::equal_angles(count), speed, speed_ripple},
      std::move(laws),
      {rotor::Harmonics(std::vector<rotor::Harmonic>{rotor::RotatingUnbalance(moment, 0.3, speed, damping)})},
      start};
}

class CountedEvents final : public modes::MotionListener {
 public:
  void event(const modes::Event& event) override { ++count[static_cast<std::size_t>(event.kind)]; }
  void piece(trajectory::MotionPiece& piece) override {
    if (piece.contact_count() < 2) return;
    const double length = piece.end() - piece.begin();
    time_of_several += length;
    if (dynamic_cast<modes::Phase*>(&piece) != nullptr) collocated_time_of_several += length;
  }
  std::array<int, 32> count{};
  double time_of_several = 0.0;             ///< while several blades touch
  double collocated_time_of_several = 0.0;  ///< by collocation
};

double largest_difference(const std::vector<trajectory::State>& a, const std::vector<trajectory::State>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    for (std::size_t k = 0; k < a[i].size(); ++k)
      largest = std::max(largest, std::abs(a[i][k] - b[i][k]) / kClearanceOfMotions);
  }
  return largest;
}

/// Returns the events of the motions by collocation.
template <class MakeFriction>
CountedEvents expect_motions_as_in_steps(contact::LoadDirection direction, MakeFriction make_friction,
                                         int rotors, int fewest_blades = 2) {
  constexpr double kTolerance = 1e-9;
  std::mt19937_64 generator(11);
  CountedEvents events;
  std::vector<double> errors;
  std::vector<double> errors_of_steps;
  for (int i = 0; i < rotors; ++i) {
    const auto rotor = kicked_rotor(generator, direction, fewest_blades, make_friction);
    CountedEvents others;
    const auto expected = rotor.states(1e-3 * kTolerance, false, others);
    const auto found = rotor.states(kTolerance, true, events);
    EXPECT_EQ(found.size(), expected.size()) << i;
    // In some of the motions differences grow a millionfold: no solver has them, and rounding says how near
    // it comes.
    const double of_steps = largest_difference(rotor.states(kTolerance, false, others), expected);
    if (of_steps > 1e6 * kTolerance) continue;
    errors_of_steps.push_back(of_steps);
    errors.push_back(largest_difference(found, expected));
  }
  EXPECT_GT(static_cast<int>(errors.size()), rotors * 3 / 4);
  for (std::vector<double>* each : {&errors, &errors_of_steps}) std::ranges::sort(*each);
  EXPECT_LE(errors[errors.size() / 2], kTolerance);
  // Steps beside forces that start like roots of the time keep to a hundredth of the tolerance.
  const std::size_t place = errors.size() * 3 / 4;  // beyond it some are chaotic
  EXPECT_LE(errors[place], std::max(10.0 * kTolerance, 3.0 * errors_of_steps[place]));
  return events;
}

constexpr int kOfFewBlades = 80;
constexpr int kOfSeveral = 16;
constexpr int kOfManyRotors = 40;

TEST(InclinedMotions, UnderANormalLoadAreAsInSteps) {
  const CountedEvents events = expect_motions_as_in_steps(
      contact::LoadDirection::normal, [](double friction) { return contact::Friction::coulomb(friction); },
      kOfFewBlades);
  EXPECT_GT(events.count[static_cast<std::size_t>(modes::Guard::slip_reversal)], 0);
  EXPECT_GT(events.count[static_cast<std::size_t>(modes::Guard::snap)], 0);
}

TEST(InclinedMotions, OfTipsThatStickAreAsInSteps) {
  const CountedEvents events = expect_motions_as_in_steps(
      contact::LoadDirection::axial,
      [](double friction) { return contact::Friction::sticking(friction, 1.2 * friction); }, kOfFewBlades);
  EXPECT_GT(events.count[static_cast<std::size_t>(modes::Guard::slip_reversal)], 0);
  EXPECT_GT(events.count[static_cast<std::size_t>(modes::Guard::comes_loose)], 0);
}

TEST(InclinedMotions, UnderFrictionThatDependsOnTheVelocityAreAsInSteps) {
  const CountedEvents events = expect_motions_as_in_steps(
      contact::LoadDirection::axial,
      [](double friction) { return contact::Friction::regularised(friction, 0.01); }, kOfFewBlades);
  EXPECT_GT(events.count[static_cast<std::size_t>(modes::Guard::lift_off)], 0);
}

/// Eight to eleven blades, of which several touch at once; arcs take nearly all of that time.
template <class MakeFriction>
void expect_several_as_in_steps(contact::LoadDirection direction, MakeFriction make_friction, int rotors) {
  const CountedEvents events = expect_motions_as_in_steps(direction, make_friction, rotors, 8);
  constexpr double kShareOfArcs = 0.997;
  EXPECT_GE(events.collocated_time_of_several, kShareOfArcs * events.time_of_several)
      << events.time_of_several;
}

void expect_several_under_a_normal_load_as_in_steps(int rotors) {
  expect_several_as_in_steps(
      contact::LoadDirection::normal, [](double friction) { return contact::Friction::coulomb(friction); },
      rotors);
}
TEST(InclinedMotions, OfSeveralBladesUnderANormalLoadAreAsInSteps) {
  expect_several_under_a_normal_load_as_in_steps(kOfSeveral);
}
TEST(InclinedMotionsSlow, OfSeveralBladesUnderANormalLoadAreAsInSteps) {
  expect_several_under_a_normal_load_as_in_steps(kOfManyRotors);
}

void expect_several_that_stick_as_in_steps(int rotors) {
  expect_several_as_in_steps(
      contact::LoadDirection::axial,
      [](double friction) { return contact::Friction::sticking(friction, 1.2 * friction); }, rotors);
}
TEST(InclinedMotions, OfSeveralTipsThatStickAreAsInSteps) {
  expect_several_that_stick_as_in_steps(kOfSeveral);
}
TEST(InclinedMotionsSlow, OfSeveralTipsThatStickAreAsInSteps) {
  expect_several_that_stick_as_in_steps(kOfManyRotors);
}

void expect_several_under_stribeck_as_in_steps(int rotors) {
  for (const auto direction : {contact::LoadDirection::axial, contact::LoadDirection::normal}) {
    expect_several_as_in_steps(
        direction,
        [](double friction) { return contact::Friction::stribeck(2.0 * friction, friction, 0.03, 0.01); },
        rotors);
  }
}
TEST(InclinedMotions, OfSeveralTipsUnderFrictionThatDependsOnTheVelocityAreAsInSteps) {
  expect_several_under_stribeck_as_in_steps(kOfSeveral);
}
TEST(InclinedMotionsSlow, OfSeveralTipsUnderFrictionThatDependsOnTheVelocityAreAsInSteps) {
  expect_several_under_stribeck_as_in_steps(kOfManyRotors);
}

}  // namespace
}  // namespace rubatlas::test
