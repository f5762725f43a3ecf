// Elastic blades whose tips stick: against friction that is ever steeper in the slip velocity, and what a tip
// at rest may never do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "directed_law.hpp"

namespace rubatlas::test {
namespace {

using modes::Event;
using modes::Guard;

auto elastic_sticking_law(const HardRotor& rotor, double static_ratio) {
  return directed_law(rotor, contact::Friction::sticking(rotor.friction, static_ratio * rotor.friction));
}

/// A kicked rotor whose tips come to rest.
struct Kicked {
  HardRotor rotor;
  rotor::State start;
};
/// One long blade, kicked against its spin: its first contact slips, rests through most of the rebound, and
/// slips again before it leaves the ring.
Kicked one_elastic_blade() {
  return {{.speed_ratio = 0.05, .misalignment = 0.0, .blades = 1, .friction = 0.3}, {0.005, 0.0, 0.0, -0.05}};
}
/// The same with more friction: two of eight contacts rest, and trial steps ahead of them find no blade on
/// its side.
Kicked one_blade_near_its_fold() {
  return {
      {.speed_ratio = 0.083, .damping_ratio = 0.071, .misalignment = 0.0095, .blades = 1, .friction = 0.49},
      {0.0012, -0.0065, -0.0123, -0.0085}};
}
/// Four of seven contacts rest; one slips both ways before.
Kicked three_blades() {
  return {{.speed_ratio = 0.172, .damping_ratio = 0.26, .misalignment = 0.0055, .friction = 0.43},
          {0.0009, 0.0025, 0.0243, -0.0354}};
}

/// The same under friction that turns round over a slip velocity v0.
RecordedMotion follow_steep(const Kicked& kicked, double velocity) {
  HardRotor rotor = kicked.rotor;
  rotor.tolerance = 1e-10;  // friction magnifies the rounding of v by 1/v0
  return follow(rotor, directed_law(rotor, contact::Friction::regularised(rotor.friction, velocity)),
                kNoForcing, kicked.start, 1, [](trajectory::MotionPiece&) {});
}

bool comes_to_rest(const RecordedEvent& entry) {
  return entry.event.kind == Guard::slip_reversal && entry.event.slip == 0.0;
}

TEST(ElasticStick, IsTheLimitOfFrictionThatTurnsRoundOverEverLowerSlip) {
  // A tip that turns round passes a fold of the steep law, which takes a time of order v0^(2/3).
  const auto nothing = [](trajectory::MotionPiece&) {};
  for (const Kicked& kicked : {one_elastic_blade(), one_blade_near_its_fold(), three_blades()}) {
    const HardRotor& rotor = kicked.rotor;
    SCOPED_TRACE(rotor.friction);
    const auto stuck = follow(rotor, elastic_sticking_law(rotor, 1.0), kNoForcing, kicked.start, 1, nothing);
    ASSERT_EQ(stuck.status, ending::PointStatus::done);
    const auto rest = std::ranges::find_if(stuck.events, comes_to_rest);
    ASSERT_NE(rest, stuck.events.end());
    const auto left = stuck.of_kind(Guard::lift_off);
    ASSERT_FALSE(left.empty());
    ASSERT_LT(rest->event.time, left[0].time) << "the first contact rests";
    double before = 0.0;
    for (const double velocity : {1e-3, 1e-4, 1e-5, 1e-6}) {
      const auto steep = follow_steep(kicked, velocity);
      ASSERT_EQ(steep.status, ending::PointStatus::done);
      const auto lifted = steep.of_kind(Guard::lift_off);
      ASSERT_FALSE(lifted.empty());
      const double apart = (lifted[0].state - left[0].state).abs().maxCoeff();
      if (before > 0.0) {
        EXPECT_LE(apart, 0.4 * before) << velocity;
      }
      before = apart;
    }
    EXPECT_LE(before, 5e-5);
  }
}

/// What is looked at in every piece of a stick: the slip velocity through the friction's power, and the load
/// on both sides of each change.
class RestWatch final : public modes::MotionListener {
 public:
  void piece(trajectory::MotionPiece& piece) override {
    if (piece.contact_count() == 0) return;
    const double begin = piece.normal_force(0, piece.begin());
    if (changed_) jump = std::max(jump, std::abs(begin - last_load_) / last_load_);
    changed_ = false;
    if (resting_) {
      for (int i = 0; i <= 4; ++i) {
        const double time = piece.begin() + (piece.end() - piece.begin()) * i / 4;
        EXPECT_GE(piece.normal_force(0, time), 0.0);
        power = std::max(power, std::abs(piece.contact_force(0, time).friction_power()));
        ++looks;
      }
    }
    last_load_ = piece.normal_force(0, piece.end());
  }
  void event(const Event& event) override {
    const bool rests = event.kind == Guard::slip_reversal && event.slip == 0.0;
    changed_ = rests || event.kind == Guard::comes_loose;
    if (event.kind == Guard::comes_loose) ++loosened;
    resting_ = rests;
  }
  double jump = 0.0;
  double power = 0.0;
  int looks = 0;
  int loosened = 0;

 private:
  bool resting_ = false;
  bool changed_ = false;
  double last_load_ = 0.0;
};

TEST(ElasticStick, LoadIsContinuousWhereATipComesToRestAndWhereItComesLooseAndNoneOfItSlidesInBetween) {
  const auto [rotor, start] = one_elastic_blade();
  const auto motion = hybrid_motion(rotor.constants(), rotor::BladeSet(rotor.blades, rotor.speed_ratio),
                                    elastic_sticking_law(rotor, 1.0), kNoForcing, rotor.limits());
  ASSERT_EQ(test::start(*motion, start), ending::PointStatus::done);
  RestWatch watch;
  ASSERT_EQ(revolve(*motion, watch), ending::PointStatus::done);
  EXPECT_GT(watch.looks, 100);
  EXPECT_GE(watch.loosened, 1);
  EXPECT_LE(watch.jump, 1e-6);
  EXPECT_LE(watch.power, 1e-13) << "v is zero to rounding";
}

TEST(ElasticStick, LeavesValidityWhereATipCanNeitherRestNorSlip) {
  // Its blade loses its place on one side, and slips against its direction on the other.
  Kicked kicked = three_blades();
  kicked.rotor.speed_ratio = 0.3;
  kicked.rotor.friction = 0.5;
  kicked.rotor.damping_ratio = 0.1;
  kicked.start = {0.002, 0.0, 0.03, -0.05};
  const auto nothing = [](trajectory::MotionPiece&) {};
  const auto stuck =
      follow(kicked.rotor, elastic_sticking_law(kicked.rotor, 1.0), kNoForcing, kicked.start, 1, nothing);
  EXPECT_EQ(stuck.status, ending::PointStatus::left_validity);
  const auto steep = follow_steep(kicked, 1e-6);
  EXPECT_EQ(steep.status, ending::PointStatus::left_validity);
  // The tip turns round once more, for 1e-4 in time, before it is found that it can do neither.
  EXPECT_LE((stuck.sections[0] - steep.sections[0]).head<2>().abs().maxCoeff(), 1e-5);
}

TEST(ElasticStick, WhereNoSlipComesToRestIsTheMotionOfTipsThatOnlySlide) {
  HardRotor rotor;
  rotor.speed_ratio = 0.6;
  const auto nothing = [](trajectory::MotionPiece&) {};
  const auto with =
      follow(rotor, elastic_sticking_law(rotor, 1.0), kNoForcing, rotor::State::Zero(), 3, nothing);
  const auto without = follow(rotor, directed_law(rotor, contact::Friction::coulomb(rotor.friction)),
                              kNoForcing, rotor::State::Zero(), 3, nothing);
  ASSERT_EQ(with.status, ending::PointStatus::done);
  EXPECT_GT(with.work.touchdowns, 3U);
  EXPECT_EQ(with.work.slip_reversals, 0U);
  for (std::size_t i = 0; i < with.sections.size(); ++i) {
    EXPECT_LE((with.sections[i] - without.sections[i]).abs().maxCoeff(), 1e-12) << i;
  }
}

}  // namespace
}  // namespace rubatlas::test
