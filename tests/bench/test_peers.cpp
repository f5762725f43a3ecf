/// The comparison is of equal things: every peer integrates the motion that `hybrid` does.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "accuracy.hpp"

namespace rubatlas::bench {
namespace {

constexpr double kStepLimit = 0.02;

std::vector<std::shared_ptr<const Peer>> all_peers() {
  return {make_hybrid(),  make_collocation(), make_odeint_dopri5(),         make_odeint_dopri5_located(),
          make_arkode(8), make_arkode(5),     make_cvode(Multistep::adams), make_cvode(Multistep::bdf)};
}

class PeerOnPeriodicMotion : public ::testing::TestWithParam<std::shared_ptr<const Peer>> {};

TEST_P(PeerOnPeriodicMotion, AgreesWithTheReferenceOverTenRevolutions) {
  // A peer that steps over one contact is off by a tenth of the clearance; the worst of them, at a tolerance
  // of 1e-11, by 1e-6.
  const Accuracy accuracy = accuracy_of(*GetParam(), {1e-11, kStepLimit});
  EXPECT_TRUE(accuracy.completed);
  EXPECT_LT(accuracy.largest_error, 3e-6);
  EXPECT_GT(accuracy.largest_displacement, 0.5 * reference_displacement());
}

TEST_P(PeerOnPeriodicMotion, ErrorFallsWithTheTolerance) {
  const Accuracy loose = accuracy_of(*GetParam(), {1e-7, kStepLimit});
  const Accuracy tight = accuracy_of(*GetParam(), {1e-11, kStepLimit});
  EXPECT_LT(tight.typical_error, 0.1 * loose.typical_error);
}

TEST_P(PeerOnPeriodicMotion, FindsTheTouchdownsThatHybridFinds) {
  const std::vector<double> speed_ratios = reference_speed_ratios();
  const auto expected = touchdowns_of(*make_hybrid(), {1e-12, kStepLimit}, speed_ratios);
  EXPECT_EQ(touchdowns_of(*GetParam(), {1e-11, kStepLimit}, speed_ratios), expected);
}

INSTANTIATE_TEST_SUITE_P(Peers, PeerOnPeriodicMotion, ::testing::ValuesIn(all_peers()),
                         [](const ::testing::TestParamInfo<std::shared_ptr<const Peer>>& instance) {
                           std::string name = instance.param->name();
                           std::erase_if(name, [](unsigned char letter) { return !std::isalnum(letter); });
                           return name;
                         });

TEST(MatchedAccuracy, IsTheLoosestToleranceThatReachesTheTarget) {
  const auto peer = make_odeint_dopri5_located();
  const double target = 1e-7;
  const PeerSettings matched = match_accuracy(*peer, {1e-8, kStepLimit}, target);
  EXPECT_LE(accuracy_of(*peer, matched).typical_error, target);
  PeerSettings looser = matched;
  looser.tolerance *= std::sqrt(10.0);
  EXPECT_GT(accuracy_of(*peer, looser).typical_error, target);
}

TEST(ErrorControlAlone, StepsOverEveryContactAndReportsTheRotorAtRest) {
  const auto peer = make_odeint_dopri5();
  const Accuracy accuracy = accuracy_of(*peer, {1e-9, std::numeric_limits<double>::infinity()});
  EXPECT_TRUE(accuracy.completed);
  EXPECT_EQ(accuracy.largest_displacement, 0.0);
}

}  // namespace
}  // namespace rubatlas::bench
