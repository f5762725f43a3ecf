/// Motions of the elastica law's other forms: axial compliance, a yielding ring, the beam-column.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "compliant_motion.hpp"
#include "modes/phase.hpp"

namespace rubatlas::test::compliant {
namespace {

TEST(CompliantBlades, MoveLikeTheInextensibleOnesToFirstOrder) {
  // Before chaos or a graze can tell them apart: two revolutions.
  for (const double friction : {0.0, 0.1}) {
    const rotor::State exact = run(make(friction, 0.0), 0.62, 2).state;
    double before = 0.0;
    for (const double share : {0.01, 0.001, 0.0001}) {
      const auto with = run(make(friction, share), 0.62, 2);
      ASSERT_EQ(with.status, ending::PointStatus::done);
      const double off = difference(with.state, exact);
      if (before > 0.0) {
        EXPECT_NEAR(before / off, 10.0, 0.2) << friction << ", " << share;
      }
      before = off;
    }
  }
}

TEST(CompliantBlades, InAStiffRingMoveLikeInARigidOneToFirstOrder) {
  for (const double friction : {0.0, 0.1}) {
    const rotor::State exact = run(make(friction, 0.0), 0.62, 2).state;
    double before = 0.0;
    for (const double stiffness : {1e9, 1e10, 1e11}) {
      const auto with = run(make(friction, 0.0, Theory::elastica, Ring{stiffness}), 0.62, 2);
      ASSERT_EQ(with.status, ending::PointStatus::done);
      const double off = difference(with.state, exact);
      if (before > 0.0) {
        EXPECT_NEAR(before / off, 10.0, 0.2) << friction << ", " << stiffness;
      }
      before = off;
    }
  }
}

struct Place {
  double time;
  rotor::ShaftAndRing state;
};
/// How one contact ends, from a state on.
struct Ended {
  modes::ModeEnd end;
  Place where;
};
Ended follow(modes::Phase& phase, modes::WorkMeter& meter, const Place& from,
             const modes::OpenContact& contact) {
  const modes::GoOn always;
  meter.begin_revolution(always);
  EXPECT_EQ(phase.start(from.time, from.state, {contact}), ending::StatusDetail::none);
  modes::MotionListener nobody;
  const modes::ModeEnd end = phase.advance(1e3, nobody);
  Ended result{end, from};
  std::vector<modes::OpenContact> contacts;
  phase.hand_over(result.where.time, result.where.state, contacts);
  return result;
}

/// Every touch-down of a motion on which no other tip is in the ring, followed to its end by collocation and
/// in steps whose forces are solved for.
int expect_both_solvers_agree(const ElasticaContact& blade, double speed_ratio, int blades, double allowed) {
  constexpr double kFastest = 0.5;  // m per unit τ²: what 50 N do to the rotor
  const auto motion = run(blade, speed_ratio, 4, blades);
  const auto law = law_of(laws_of(blade, blades));
  const rotor::Machine machine = machine_of(rotor_at(speed_ratio), rotor::BladeSet(blades, speed_ratio));
  modes::WorkMeter meter;
  const modes::ContactLimits limits{1e-13, 0.5};
  const modes::ContactSetup setup{&machine, law.get(), limits, &meter};
  const auto collocated = modes::phases_on_arcs(setup);
  const auto stepped = assembly::phases_in_steps(setup);
  int compared = 0;
  for (const modes::Event& event : motion.witness.events) {
    if (event.kind != modes::Guard::touch_down) continue;
    bool is_alone = true;
    for (int k = 0; k < blades; ++k)
      is_alone = is_alone && (k == event.blade || pose_at(speed_ratio, blades, event, k).gap < 0.0);
    if (!is_alone) continue;
    modes::OpenContact contact{event.blade, event.slip, 0.0};
    const contact::Pose at = pose_at(speed_ratio, blades, event);
    if (!blade.starts_unloaded(at, contact.slip)) contact.bending = blade.solve(at, contact.slip).value();
    const Place start{event.time, rotor::shaft_and_ring(event.state)};
    const Ended one = follow(collocated->of({contact}), meter, start, contact);
    const Ended other = follow(stepped->of({contact}), meter, start, contact);
    EXPECT_EQ(one.end.guard, other.end.guard);
    EXPECT_EQ(one.end.blade, other.end.blade);
    EXPECT_LT(std::abs(one.where.time - other.where.time), allowed);
    EXPECT_LT(difference(rotor::shaft(one.where.state), rotor::shaft(other.where.state)), kFastest * allowed);
    if (one.end.guard == modes::Guard::lift_off) ++compared;
  }
  return compared;
}

TEST(CompliantBlades, CollocationAndStepsAgree) {
  constexpr double kAllowed = 1e-9;  // of τ: steps have no order where a contact begins head-on
  const Ring ring{1e5};
  for (const double speed : {0.36, 0.62}) {
    EXPECT_GT(expect_both_solvers_agree(make(0.1, 1.0), speed, 10, kAllowed), 10);
    EXPECT_GT(expect_both_solvers_agree(make(0.1, 0.0, Theory::beam_column), speed, 10, kAllowed), 10);
    EXPECT_GT(expect_both_solvers_agree(make(0.1, 1.0, Theory::elastica, ring), speed, 10, kAllowed), 10);
    EXPECT_GT(
        expect_both_solvers_agree(make(0.1, 0.0, Theory::elastica, kReleasedAtFold), speed, 10, kAllowed),
        10);
    EXPECT_GT(expect_both_solvers_agree(make(0.1, 1.0, Theory::beam_column, Ring{ring.stiffness, true}),
                                        speed, 10, kAllowed),
              10);
  }
}

/// Kicked columns, by collocation and in steps, for a revolution each.
struct Columns {
  std::ptrdiff_t snaps = 0;
  std::vector<double> differences;  ///< at the end [m]
  double largest_of_drift = 0.0;    ///< the largest one, over that of steps of a smaller tolerance
};
void compare_columns(const ElasticaContact& column, int blades, double tolerance, Columns& found) {
  constexpr int kStarts = 60;
  constexpr double kFastest = 3e-3;  // [m per unit τ]
  std::mt19937 random(7);            // NOLINT(bugprone-random-generator-seed)
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int i = 0; i < kStarts; ++i) {
    SCOPED_TRACE(::testing::Message() << blades << " blades, start " << i);
    const double speed_ratio = 0.65 + 0.3 * share(random);
    const rotor::State start(0.0, 0.0, kFastest * share(random), kFastest * share(random));
    const auto revolved = [&](bool collocates, double allowed) {
      const auto motion =
          hybrid_motion(machine_of(rotor_at(speed_ratio), rotor::BladeSet(blades, speed_ratio)), column,
                        {allowed, 0.5}, collocates);
      Run<ElasticaContact> result{};
      result.status = test::start(*motion, start);
      if (result.status == ending::PointStatus::done) result.status = revolve(*motion, result.witness);
      result.state = rotor::shaft(motion->state());
      return result;
    };
    const auto arcs = revolved(true, tolerance);
    const auto steps = revolved(false, tolerance);
    ASSERT_EQ(arcs.status, steps.status);
    ASSERT_TRUE(std::ranges::equal(arcs.witness.events, steps.witness.events, {}, &modes::Event::kind,
                                   &modes::Event::kind));
    found.snaps += std::ranges::count(arcs.witness.events, modes::Guard::snap, &modes::Event::kind);
    const double apart = difference(arcs.state, steps.state);
    found.differences.push_back(apart);
    // In some motions errors grow a thousandfold, as steps of a smaller tolerance show.
    const double drift = difference(revolved(false, 0.1 * tolerance).state, steps.state);
    found.largest_of_drift = std::max(found.largest_of_drift, apart / std::max(10.0 * tolerance, drift));
  }
}

TEST(CompliantBlades, ColumnsThatAreCompressedStraightBeforeTheyBuckleMoveAsInSteps) {
  constexpr double kTolerance = 1e-11;  // [m]
  Columns all;
  for (const int blades : {3, 10}) {
    for (const ElasticaContact& column :
         {make(0.0, 1.0), make(0.0, 0.0, Theory::elastica, Ring{1e5}),
          make(0.0, 1.0, Theory::elastica, Ring{1e5}), make(0.0, 1.0, Theory::elastica, Ring{1e7})})
      compare_columns(column, blades, kTolerance, all);
  }
  std::ranges::sort(all.differences);
  EXPECT_GT(all.snaps, 50);
  EXPECT_LT(all.differences[all.differences.size() / 2], kTolerance);
  EXPECT_LT(all.largest_of_drift, 10.0);
}

}  // namespace
}  // namespace rubatlas::test::compliant
