/// Several blades in contact by collocation, from one event to the next, against the same motion in steps of
/// the order-8 pair at a far lower tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "arc_of_rotor.hpp"
#include "several_blades.hpp"

namespace rubatlas::test {
namespace {

using collocation::ContactArc;
using collocation::Touch;
/// The motion between two events, while the same blades touch.
struct Phase {
  modes::Event start, end;
  std::vector<Touch> touching;  ///< without their bendings
};

/// Phases that begin and end within a revolution, in which several blades touch.
class Phases final : public modes::MotionListener {
 public:
  void event(const modes::Event& event) override {
    if (last_ && event.time > last_->time && touching_.size() >= 2)
      found.push_back({*last_, event, touching_});
    if (event.kind == modes::Guard::touch_down) touching_.push_back({event.blade, event.slip, 0.0});
    if (event.kind == modes::Guard::lift_off)
      std::erase_if(touching_, [&](const Touch& touch) { return touch.blade == event.blade; });
    if (event.kind == modes::Guard::slip_reversal)
      std::ranges::find(touching_, event.blade, &Touch::blade)->slip = event.slip;
    last_ = event;
  }
  void drops_last_event() { last_.reset(); }
  std::vector<Phase> found;

 private:
  std::vector<Touch> touching_;
  std::optional<modes::Event> last_;
};

contact::Pose pose_in(const Rotor& rotor, int blade, double time, const rotor::State& state) {
  return rotor::pose_of(rotor.constants, rotor.law.geometry(),
                        rotor.blades.direction(blade, rotor.blades.first(time)), state);
}

/// z'' while these blades touch.
std::complex<double> acceleration_of(const Rotor& rotor, const std::vector<Touch>& touching, double time,
                                     const rotor::State& state) {
  std::complex<double> force;
  for (const Touch& touch : touching) {
    const auto pose = pose_in(rotor, touch.blade, time, state);
    const auto bending = rotor.law.solve(pose, touch.slip);
    if (!bending) continue;
    force +=
        contact::on_rotor(rotor.law.constraint(pose, touch.slip, *bending, rotor.constants.speed_ratio).force,
                          rotor.blades.direction(touch.blade, rotor.blades.first(time)));
  }
  return rotor::shaft_acceleration(rotor.constants, state, force);
}

struct Outcome {
  bool made;      ///< up to an event
  bool the_same;  ///< event of the same blade
  double error;   ///< of the state there [clearances]
};

Outcome solve(const Rotor& rotor, const Phase& phase, double tolerance) {
  ArcOfRotor held(rotor.constants, rotor.blades.count(), rotor.law, nullptr, tolerance * kClearanceOfSeveral);
  ContactArc& arc = held.arc;
  std::vector<Touch> touching = phase.touching;
  for (Touch& touch : touching) {
    const auto pose = pose_in(rotor, touch.blade, phase.start.time, phase.start.state);
    const bool touches_down =
        phase.start.kind == modes::Guard::touch_down && phase.start.blade == touch.blade;
    const bool unloaded = touches_down && rotor.law.starts_unloaded(pose, touch.slip);
    touch.bending = unloaded ? 0.0 : rotor.law.solve(pose, touch.slip).value_or(0.0);
  }
  held.begin(phase.start.time, phase.start.state, touching);
  while (arc.ending().guard == ContactArc::Guard::none) {
    if (arc.make() != ContactArc::Outcome::made) return {false, false, 0.0};
  }
  const modes::Guard end = held.lifts_off() ? modes::Guard::lift_off
                           : arc.ending().guard == ContactArc::Guard::slip_reversal
                               ? modes::Guard::slip_reversal
                               : modes::Guard::touch_down;
  const bool same = phase.end.kind == end && phase.end.blade == arc.ending().blade;
  const rotor::State state = held.end_state();
  const std::complex<double> acceleration =
      acceleration_of(rotor, phase.touching, phase.end.time, phase.end.state);
  const rotor::State there =
      state + (phase.end.time - arc.end().time) *
                  rotor::State(state[2], state[3], acceleration.real(), acceleration.imag());
  return {true, same, (there - phase.end.state).abs().maxCoeff() / kClearanceOfSeveral};
}

std::vector<Phase> phases_of(const Rotor& rotor, const rotor::State& start) {
  const auto motion =
      hybrid_motion(rotor.constants, rotor.blades, rotor.law, kNoForcing, modes::ContactLimits{1e-15, 0.5});
  for (int k = 0; k < rotor.blades.count(); ++k) {
    if (pose_in(rotor, k, 0.0, start).gap > 0.0) return {};
  }
  if (motion->start(rotor::as_array(start)) != ending::StatusDetail::none) return {};
  Phases phases;
  constexpr int kRevolutions = 4;
  for (int i = 0; i < kRevolutions; ++i) {
    if (revolve(*motion, phases) != ending::PointStatus::done) break;
    phases.drops_last_event();
  }
  return phases.found;
}

struct Case {
  Rotor rotor;
  Phase phase;
};
std::vector<Case> cases(std::size_t wanted, Friction rubs) {
  constexpr std::size_t kMostOfOne = 10;
  std::mt19937_64 generator(11);
  std::vector<Case> result;
  while (result.size() < wanted) {
    const Rotor rotor = random_rotor(generator, rubs);
    const rotor::State start = random_start(generator);
    const auto phases = phases_of(rotor, start);
    for (std::size_t i = 0; i < std::min(phases.size(), kMostOfOne); ++i)
      result.push_back({rotor, phases[i]});
  }
  return result;
}

void expect_errors_by_the_tolerance(std::size_t wanted, Friction rubs) {
  const std::vector<Case> all = cases(wanted, rubs);
  for (const double tolerance : {1e-7, 1e-9, 1e-11}) {
    std::vector<double> errors;
    std::size_t given_up = 0;
    int other_event = 0;
    for (const Case& one : all) {
      const Outcome outcome = solve(one.rotor, one.phase, tolerance);
      if (outcome.made && outcome.the_same) errors.push_back(outcome.error);
      if (outcome.made && !outcome.the_same) ++other_event;
      if (!outcome.made) ++given_up;
    }
    std::ranges::sort(errors);
    SCOPED_TRACE(::testing::Message()
                 << "tolerance " << tolerance << ": median " << errors[errors.size() / 2] << ", largest "
                 << errors.back() << ", given up " << given_up << " of " << all.size());
    EXPECT_LE(errors[errors.size() / 2], tolerance);
    EXPECT_LE(errors.back(), 100.0 * tolerance);
    EXPECT_EQ(other_event, 0);
    EXPECT_LE(given_up, wanted / 10);
  }
}

TEST(SeveralBlades, ErrByTheToleranceFromEventToEvent) {
  expect_errors_by_the_tolerance(100, Friction::some);
}
TEST(SeveralBlades, OfColumnsErrByTheToleranceFromEventToEvent) {
  expect_errors_by_the_tolerance(100, Friction::none);
}
TEST(SeveralBladesSlow, ErrByTheToleranceFromEventToEvent) {
  expect_errors_by_the_tolerance(200, Friction::some);
}
TEST(SeveralBladesSlow, OfColumnsErrByTheToleranceFromEventToEvent) {
  expect_errors_by_the_tolerance(200, Friction::none);
}

}  // namespace
}  // namespace rubatlas::test
