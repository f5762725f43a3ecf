// Elastic blades whose tips stick: against friction that is ever steeper in the slip velocity, and what a tip
// at rest may never do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../hard/recorded_motion.hpp"
#include "contact/directed_elastica.hpp"

namespace rubatlas::test {
namespace {

using solve::Event;
using solve::PhaseEvent;

template <class Friction, class Direction = contact::AxialLoad>
contact::DirectedElastica<Direction, Friction> elastic_law(const HardRotor& rotor, const Friction& friction) {
  return {rotor.geometry(), {rotor.length, rotor.thickness, rotor.bending_stiffness}, friction};
}
auto elastic_sticking_law(const HardRotor& rotor, double static_ratio) {
  return elastic_law(rotor, contact::StickingFriction{rotor.friction, static_ratio * rotor.friction});
}

/// One long blade, kicked against its spin: its first contact slips, rests through most of the rebound, and
/// slips again before it leaves the ring.
HardRotor one_elastic_blade() {
  HardRotor rotor;
  rotor.speed_ratio = 0.05;
  rotor.friction = 0.3;
  rotor.misalignment = 0.0;
  rotor.blades = 1;
  return rotor;
}
const solve::State kAgainstTheSpin{0.005, 0.0, 0.0, -0.05};

bool comes_to_rest(const RecordedEvent& entry) {
  return entry.event.kind == PhaseEvent::slip_reversal && entry.event.slip == 0.0;
}

TEST(ElasticStick, IsTheLimitOfFrictionThatTurnsRoundOverEverLowerSlip) {
  const HardRotor rotor = one_elastic_blade();
  const auto nothing = [](observables::MotionPiece&) {};
  const auto stuck =
      follow(rotor, elastic_sticking_law(rotor, 1.0), effects::NoForcing{}, kAgainstTheSpin, 1, nothing);
  ASSERT_EQ(stuck.status, solve::PointStatus::done);
  ASSERT_EQ(std::ranges::count_if(stuck.events, comes_to_rest), 1);
  const auto left = stuck.of_kind(PhaseEvent::lift_off);
  ASSERT_FALSE(left.empty());
  double before = 0.0;
  for (const double velocity : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const auto law = elastic_law(rotor, contact::RegularisedFriction{rotor.friction, velocity});
    const auto steep = follow(rotor, law, effects::NoForcing{}, kAgainstTheSpin, 1, nothing);
    ASSERT_EQ(steep.status, solve::PointStatus::done);
    const auto lifted = steep.of_kind(PhaseEvent::lift_off);
    ASSERT_FALSE(lifted.empty());
    const double apart = (lifted[0].state - left[0].state).abs().maxCoeff();
    if (before > 0.0) {
      EXPECT_LE(apart, 0.5 * before) << velocity;
    }
    before = apart;
  }
  EXPECT_LE(before, 1e-4);
}

/// What is looked at in every piece of a stick: the slip velocity through the friction's power, and the load
/// on both sides of each change.
class RestWatch final : public solve::MotionListener {
 public:
  void piece(observables::MotionPiece& piece) override {
    const double begin = piece.normal_force(0, piece.begin());
    if (changed_) jump = std::max(jump, std::abs(begin - last_load_) / last_load_);
    changed_ = false;
    if (resting_) {
      for (int i = 0; i <= 4; ++i) {
        const double time = piece.begin() + (piece.end() - piece.begin()) * i / 4;
        EXPECT_GE(piece.normal_force(0, time), 0.0);
        power = std::max(power, piece.friction_power(0, time));
        ++looks;
      }
    }
    last_load_ = piece.contact_count() > 0 ? piece.normal_force(0, piece.end()) : 0.0;
  }
  void event(const Event& event) override {
    const bool rests = event.kind == PhaseEvent::slip_reversal && event.slip == 0.0;
    changed_ = rests || event.kind == PhaseEvent::comes_loose;
    if (event.kind == PhaseEvent::comes_loose) ++loosened;
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
  const HardRotor rotor = one_elastic_blade();
  using Law = decltype(elastic_sticking_law(rotor, 1.0));
  solve::Motion<Law, effects::NoForcing> motion(rotor.constants(), {rotor.blades, rotor.speed_ratio},
                                                elastic_sticking_law(rotor, 1.0), {}, rotor.limits());
  ASSERT_EQ(motion.start(kAgainstTheSpin), solve::PointStatus::done);
  RestWatch watch;
  // The pieces of flight have no contact to ask.
  class ContactsOnly final : public solve::MotionListener {
   public:
    explicit ContactsOnly(RestWatch& watch) : watch_(watch) {}
    void piece(observables::MotionPiece& piece) override {
      if (piece.contact_count() > 0) watch_.piece(piece);
    }
    void event(const Event& event) override { watch_.event(event); }

   private:
    RestWatch& watch_;
  } contacts(watch);
  ASSERT_EQ(motion.revolution(contacts), solve::PointStatus::done);
  EXPECT_GT(watch.looks, 100);
  EXPECT_GE(watch.loosened, 1);
  EXPECT_LE(watch.jump, 1e-6);
  EXPECT_LE(watch.power, 1e-13) << "v is zero to rounding";
}

TEST(ElasticStick, WhereNoSlipComesToRestIsTheMotionOfTipsThatOnlySlide) {
  HardRotor rotor;
  rotor.speed_ratio = 0.6;
  const auto nothing = [](observables::MotionPiece&) {};
  const auto with =
      follow(rotor, elastic_sticking_law(rotor, 1.0), effects::NoForcing{}, solve::State::Zero(), 3, nothing);
  const auto without = follow(rotor, elastic_law(rotor, contact::CoulombFriction{rotor.friction}),
                              effects::NoForcing{}, solve::State::Zero(), 3, nothing);
  ASSERT_EQ(with.status, solve::PointStatus::done);
  EXPECT_GT(with.work.touchdowns, 3U);
  EXPECT_EQ(with.work.slip_reversals, 0U);
  for (std::size_t i = 0; i < with.sections.size(); ++i) {
    EXPECT_LE((with.sections[i] - without.sections[i]).abs().maxCoeff(), 1e-12) << i;
  }
}

}  // namespace
}  // namespace rubatlas::test
