/// Motions of the elastica law's other forms: axial compliance, a yielding ring, the beam-column, and
/// contacts that end at the fold of the force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "assembly/blade_tables.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/unequal_blades.hpp"
#include "modes/collocated.hpp"
#include "modes/contact_setup.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::test {
namespace {

using blade::Theory;
using contact::ElasticaContact;
using contact::Release;
using contact::Ring;
constexpr Ring kReleasedAtFold{.release = Release::at_fold};

constexpr contact::Geometry kGeometry{0.1, 0.11};
constexpr double kLength = 0.1;
constexpr double kThickness = 1e-3;
constexpr double kBendingStiffness = 206e9 * 0.01 * 1e-9 / 12.0;

rotor::RotorConstants rotor_at(double speed_ratio) {
  return {speed_ratio, 0.1, 0.01001, 0.01, 0.01};
}

ElasticaContact make(double friction, double share, Theory theory = Theory::elastica, const Ring& ring = {}) {
  static assembly::BladeTables tables;
  const double compliance = share * kThickness * kThickness / (12.0 * kLength * kLength);
  return {
      kGeometry, {kLength, kThickness, kBendingStiffness}, tables.curve(friction, theory, compliance), ring};
}

/// Keeps events, the force that ends each contact, and the ends of all pieces.
class Witness final : public modes::MotionListener {
 public:
  void piece(trajectory::MotionPiece& piece) override {
    forces_.assign(1000, 0.0);
    in_contact = std::max(in_contact, piece.contact_count());
    for (std::size_t i = 0; i < piece.contact_count(); ++i) {
      largest_force = std::max(largest_force, piece.normal_force(i, piece.end()));
      forces_[static_cast<std::size_t>(piece.blade(i))] = piece.normal_force(i, piece.end());
    }
    if (first_forces.empty() && piece.contact_count() > 0)
      first_forces.push_back(piece.normal_force(0, piece.begin()));
    const rotor::State begin = rotor::as_state(piece.state(piece.begin()));
    if (begin_known_) largest_jump = std::max(largest_jump, (begin - last_).abs().maxCoeff());
    last_ = rotor::as_state(piece.state(piece.end()));
    begin_known_ = true;
  }
  void event(const modes::Event& event) override {
    events.push_back(event);
    last_forces.push_back(forces_[static_cast<std::size_t>(event.blade)]);
  }
  std::vector<modes::Event> events;
  std::vector<double> last_forces;   ///< F at the end of the piece before each event [N]
  std::vector<double> first_forces;  ///< F where the first contact is first seen [N]
  double largest_force = 0.0;
  double largest_jump = 0.0;  ///< of a state's component from piece to piece
  std::size_t in_contact = 0;

 private:
  std::vector<double> forces_ = std::vector<double>(1000, 0.0);
  rotor::State last_ = rotor::State::Zero();
  bool begin_known_ = false;
};

template <class Law>
struct Run {
  ending::PointStatus status;
  rotor::State state;
  Witness witness;
};
template <class Law>
Run<Law> run(const Law& law, double speed_ratio, int revolutions, int blades = 3, double tolerance = 1e-12,
             const rotor::State& start = rotor::State::Zero()) {
  const auto motion = hybrid_motion(machine_of(rotor_at(speed_ratio), rotor::BladeSet(blades, speed_ratio)),
                                    law, {tolerance, 0.5}, true);
  Run<Law> result{};
  result.status = test::start(*motion, start);
  for (int i = 0; i < revolutions && result.status == ending::PointStatus::done; ++i)
    result.status = revolve(*motion, result.witness);
  result.state = rotor::shaft(motion->state());
  return result;
}

contact::Pose pose_at(double speed_ratio, int blades, const modes::Event& event, int blade) {
  const rotor::BladeSet set(blades, speed_ratio);
  return rotor::pose_of(rotor_at(speed_ratio), kGeometry, set.direction(blade, set.first(event.time)),
                        event.state);
}
contact::Pose pose_at(double speed_ratio, int blades, const modes::Event& event) {
  return pose_at(speed_ratio, blades, event, event.blade);
}

double difference(const rotor::State& one, const rotor::State& other) {
  return (one - other).abs().maxCoeff();
}

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

/// How one contact ends, from a state on.
struct Ended {
  modes::ModeEnd end;
  modes::Phase::End where;
};
Ended follow(modes::Phase& phase, modes::WorkMeter& meter, const modes::Phase::End& from,
             const modes::OpenContact& contact) {
  const modes::GoOn always;
  meter.begin_revolution(always);
  EXPECT_TRUE(phase.start(from.time, from.state, {contact}));
  modes::MotionListener nobody;
  const modes::ModeEnd end = phase.advance(1e3, nobody);
  return {end, phase.where_it_ended()};
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
  modes::Collocated collocated(machine, law->arcs(machine, limits.max_shortening), limits, meter);
  const auto stepped = assembly::phases_in_steps({&machine, law.get(), limits, &meter});
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
    const modes::Phase::End start{event.time, rotor::shaft_and_ring(event.state)};
    const Ended one = follow(collocated, meter, start, contact);
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
    EXPECT_GT(
        expect_both_solvers_agree(make(0.1, 1.0, Theory::beam_column, Ring{ring.stiffness, Release::at_fold}),
                                  speed, 10, kAllowed),
        10);
  }
}

/// Kicked columns, by collocation and in steps, for a revolution each.
struct Columns {
  std::ptrdiff_t snaps = 0;
  std::vector<double> differences;  ///< at the end [m]
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
    const auto revolved = [&](bool collocates) {
      const auto motion =
          hybrid_motion(machine_of(rotor_at(speed_ratio), rotor::BladeSet(blades, speed_ratio)), column,
                        {tolerance, 0.5}, collocates);
      Run<ElasticaContact> result{};
      result.status = test::start(*motion, start);
      if (result.status == ending::PointStatus::done) result.status = revolve(*motion, result.witness);
      result.state = rotor::shaft(motion->state());
      return result;
    };
    const auto arcs = revolved(true);
    const auto steps = revolved(false);
    ASSERT_EQ(arcs.status, steps.status);
    ASSERT_TRUE(std::ranges::equal(arcs.witness.events, steps.witness.events, {}, &modes::Event::kind,
                                   &modes::Event::kind));
    found.snaps += std::ranges::count(arcs.witness.events, modes::Guard::snap, &modes::Event::kind);
    found.differences.push_back(difference(arcs.state, steps.state));
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
  EXPECT_LT(all.differences.back(), 1e3 * kTolerance) << "steps at a tenth of it: 300";
}

/// Receding lift-offs of a motion that are at the fold; also how many while other blades touched.
struct Releases {
  int at_fold = 0;
  int beside_others = 0;
};
template <class Law>
Releases expect_releases_at_the_fold(const Law& law, double speed_ratio, int blades, int revolutions) {
  constexpr double kLocated = 1e-12;  // g [m²]: 2R times a few tolerances
  const auto motion = run(law, speed_ratio, revolutions, blades);
  EXPECT_LT(motion.witness.largest_jump, 1e-15) << "the state is continuous";
  Releases found;
  int open = 0;
  for (std::size_t i = 0; i < motion.witness.events.size(); ++i) {
    const modes::Event& event = motion.witness.events[i];
    contact::Pose at = pose_at(speed_ratio, blades, event);
    if (event.kind == modes::Guard::touch_down) {
      ++open;
      EXPECT_NEAR(at.gap, 0.0, 1e-16) << "touch-downs stay where they are";
    }
    if (event.kind != modes::Guard::lift_off) continue;
    --open;
    if (law.starts_unloaded(at, event.slip)) {
      EXPECT_NEAR(at.gap, 0.0, kLocated);
      if (law.curve().friction() > 0.0) {
        EXPECT_NEAR(motion.witness.last_forces[i], 0.0, 1e-5);
      }
      continue;
    }
    EXPECT_LT(at.gap, 0.0) << "held beyond the ring";
    const double gap = at.gap;
    at.gap = gap + kLocated;
    const auto before = law.solve(at, event.slip);
    EXPECT_TRUE(before.has_value()) << "there is a force up to the fold, event " << i;
    if (before) {
      // It vanishes from a finite value, at the end of a square root.
      const double force = law.constraint(at, event.slip, *before, speed_ratio).force.normal;
      EXPECT_GT(motion.witness.last_forces[i], 0.5 * force);
      EXPECT_LT(motion.witness.last_forces[i], force * (1 + 1e-9));
    }
    at.gap = gap - kLocated;
    EXPECT_FALSE(law.solve(at, event.slip).has_value()) << "and none beyond, event " << i;
    ++found.at_fold;
    if (open > 0) ++found.beside_others;
  }
  return found;
}

TEST(ReleaseAtFold, EndsContactsWhereTheForceDoes) {
  Releases all;
  int in_yielding_ring = 0;
  const auto yielding = make(0.1, 1.0, Theory::elastica, Ring{1e7, Release::at_fold});
  for (const auto& [speed, blades] : {std::pair{0.36, 10}, std::pair{0.5, 3}, std::pair{0.75, 10},
                                      std::pair{0.3, 10}, std::pair{0.36, 20}, std::pair{0.9, 10}}) {
    for (const double friction : {0.0, 0.1, 0.3}) {
      const auto found = expect_releases_at_the_fold(make(friction, 0.0, Theory::elastica, kReleasedAtFold),
                                                     speed, blades, 10);
      all.at_fold += found.at_fold;
      all.beside_others += found.beside_others;
    }
    in_yielding_ring += expect_releases_at_the_fold(yielding, speed, blades, 10).at_fold;
  }
  EXPECT_GT(all.at_fold, 200);
  EXPECT_GT(all.beside_others, 5);
  EXPECT_GT(in_yielding_ring, 20);
}

TEST(ReleaseAtFold, LetsContactsLastLongerOnTheRecedingSide) {
  for (const auto& [speed, blades] : {std::pair{0.36, 10}, std::pair{0.5, 3}, std::pair{0.75, 3}}) {
    const auto ring = run(make(0.1, 0.0), speed, 10, blades);
    const auto fold = run(make(0.1, 0.0, Theory::elastica, kReleasedAtFold), speed, 10, blades);
    const auto& events = ring.witness.events;
    const auto recedes = [speed = speed, blades = blades](const modes::Event& event) {
      return event.kind == modes::Guard::lift_off &&
             event.slip * pose_at(speed, blades, event).tangential < 0.0;
    };
    const auto receding = std::find_if(events.begin(), events.end(), recedes);
    ASSERT_NE(receding, events.end());
    const auto same = static_cast<std::size_t>(receding - events.begin());
    for (std::size_t i = 0; i < same; ++i)
      EXPECT_NEAR(fold.witness.events[i].time, events[i].time, 1e-9) << "one motion up to there";
    EXPECT_EQ(fold.witness.events[same].kind, modes::Guard::lift_off);
    EXPECT_EQ(fold.witness.events[same].blade, receding->blade);
    EXPECT_GT(fold.witness.events[same].time, receding->time + 1e-6);
  }
}

/// Events of one kind, with the blade and the time.
template <class Law>
std::vector<modes::Event> snaps_of(const Run<Law>& motion) {
  std::vector<modes::Event> snaps;
  for (const modes::Event& event : motion.witness.events) {
    if (event.kind == modes::Guard::snap) snaps.push_back(event);
  }
  return snaps;
}

TEST(Branches, AMotionGoesOnThroughTheFoldOfABladeInAYieldingRing) {
  const auto law = make(0.1, 0.0, Theory::elastica, Ring{1e5});
  const auto motion = run(law, 0.45, 3);
  EXPECT_EQ(motion.status, ending::PointStatus::done);
  const auto snaps = snaps_of(motion);
  ASSERT_FALSE(snaps.empty());
  for (const modes::Event& snap : snaps) {
    // There the branch from which it came ends: past it, along the way it moves, h has no root there.
    contact::Pose at = pose_at(0.45, 3, snap);
    EXPECT_GT(at.gap, 0.0);
    EXPECT_LT(snap.slip * at.tangential, 0.0) << "on the receding side";
  }
  EXPECT_LT(motion.witness.largest_jump, 1e-15) << "the state is continuous";
  // The time of the snap follows the tolerance.
  for (const double tolerance : {1e-11, 1e-10, 1e-9}) {
    const auto coarser = snaps_of(run(law, 0.45, 3, 3, tolerance));
    ASSERT_EQ(coarser.size(), snaps.size());
    for (std::size_t i = 0; i < snaps.size(); ++i)
      EXPECT_NEAR(coarser[i].time, snaps[i].time, 2e4 * tolerance) << tolerance;
  }
}

TEST(Branches, ABladeSnapsAtItsFoldBesideAnotherOneWhateverTheTolerance) {
  const auto law = make(0.1, 0.0, Theory::elastica, Ring{1e4});
  rotor::State start;
  start << 2e-3, -1e-3, 0.02, 0.03;
  const auto fine = snaps_of(run(law, 0.315, 1, 3, 1e-15, start));
  ASSERT_FALSE(fine.empty());
  EXPECT_EQ(fine[0].blade, 1);
  EXPECT_NEAR(fine[0].time, 0.32266046, 1e-8) << "the fold";
  for (const double tolerance : {1e-14, 1e-13, 1e-12, 1e-11, 1e-10}) {
    const auto snaps = snaps_of(run(law, 0.315, 1, 3, tolerance, start));
    ASSERT_EQ(snaps.size(), fine.size());
    EXPECT_NEAR(snaps[0].time, fine[0].time, 1e3 * tolerance + 1e-12) << tolerance;
  }
}

TEST(Branches, NoMotionIsLostAtAFold) {
  int snaps = 0;
  for (const double share : {100.0, 300.0, 1000.0}) {
    const auto law = make(0.1, share);
    for (int i = 0; i < 20; ++i) {
      const auto motion = run(law, 0.1 + 0.03 * i, 5, 3, 1e-11);
      EXPECT_EQ(motion.status, ending::PointStatus::done) << share << ", " << i;
      snaps += static_cast<int>(snaps_of(motion).size());
    }
  }
  EXPECT_GT(snaps, 2);
}

TEST(Branches, AColumnBucklesAndStraightensAtTheSameTimesWhateverTheTolerance) {
  const auto law = make(0.0, 0.0, Theory::elastica, Ring{1e5});
  rotor::State start;
  start << -0.0010026794376224251, -0.0039731201235519171, 0.020789851758929081, 0.02654179434526615;
  const auto fine = snaps_of(run(law, 0.208, 1, 10, 1e-15, start));
  ASSERT_FALSE(fine.empty());
  const contact::Pose at = pose_at(0.208, 10, fine[0]);
  EXPECT_LT(fine[0].slip * at.tangential, 0.0);
  for (const double tolerance : {1e-13, 1e-11}) {
    const auto snaps = snaps_of(run(law, 0.208, 1, 10, tolerance, start));
    ASSERT_FALSE(snaps.empty());
    EXPECT_NEAR(snaps[0].time, fine[0].time, 1e4 * tolerance) << tolerance;
  }
}

TEST(Branches, AContactThatIsOpenAtTheStartStandsOnTheRootThatLoadFromZeroMeetsFirst) {
  // Receding, lightly in, where the blade could be compressed or bent.
  const auto law = make(0.02, 1.0, Theory::elastica, Ring{1e5});
  const double tangential = -0.0142;
  const double penetration = 2e-5;
  const double radius = kGeometry.ring_radius + penetration;
  const double radial = std::sqrt(radius * radius - tangential * tangential) - kGeometry.reach;
  // Blade 0 points along x at the start; c = (x, y + y0).
  rotor::State start;
  start << radial, tangential - 0.01001, 0.0, 0.0;
  const auto motion = run(law, 0.3, 1, 1, 1e-13, start);
  ASSERT_FALSE(motion.witness.first_forces.empty());
  contact::Pose at{radial, tangential, 0.0, 0.0, penetration * (2 * kGeometry.ring_radius + penetration)};
  const double bending = law.solve(at, 1.0).value();
  EXPECT_LT(bending, 0.1) << "compressed";
  EXPECT_NEAR(motion.witness.first_forces[0], law.constraint(at, 1.0, bending, 0.3).force.normal, 1e-9);
}

}  // namespace
}  // namespace rubatlas::test
