// The ring as one body, from point to point: what it remembers, and what it does not stand beside.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "../settings/scene_error_text.hpp"
#include "assembly/make_line_solver.hpp"
#include "effect_scene.hpp"
#include "rotor/ring_body.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using motion::PointStart;
using nlohmann::json;

json in_ring_body(double speed, int revolutions) {
  return {{"grid", {{"speed_ratio", speed}}},
          {"ring_body", {{"mass", 2.0}, {"compliance", 2e-4}, {"damping", 4.0}}},
          {"accuracy", {{"tolerance", 1e-13}}},
          {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", revolutions}}},
          {"observables", {"poincare", "max_displacement"}}};
}

point::PointOutcome run_on(const json& content, const PointStart& start) {
  return run(parsed(content), start);
}

double memory_difference(const motion::Memory& a, const motion::Memory& b) {
  EXPECT_EQ(a.view().size(), 4U);
  EXPECT_EQ(b.view().size(), 4U);
  return test::largest_difference(std::vector(a.view().begin(), a.view().end()),
                                  std::vector(b.view().begin(), b.view().end()));
}

TEST(RingBody, GoesOnMovingFromPointToPoint) {
  PointStart at;
  std::uint64_t touchdowns = 0;
  for (int revolution = 0; revolution < 4; ++revolution) {
    const auto outcome = run_on(in_ring_body(0.62, 1), at);
    ASSERT_EQ(outcome.status, PointStatus::done);
    touchdowns += outcome.work.touchdowns;
    at = {outcome.final_state, outcome.final_memory};
  }
  const auto whole = run_on(in_ring_body(0.62, 4), {});
  ASSERT_EQ(whole.work.touchdowns, touchdowns);
  EXPECT_GT(touchdowns, 4U);
  EXPECT_LE(test::largest_difference(whole.final_state, at.state), 1e-12);
  EXPECT_LE(memory_difference(whole.final_memory, at.memory), 1e-12);
  // Forgotten in between, the motion is another.
  const auto three = run_on(in_ring_body(0.62, 3), {});
  const auto forgotten = run_on(in_ring_body(0.62, 1), three.final_state);
  EXPECT_GT(test::largest_difference(whole.final_state, forgotten.final_state), 1e-7);
}

/// The cycle of period 1 at Ω = 0.56, whose nearest pass another program, with steps of Runge and Kutta's
/// method, finds to be 5.8365 mm. The ring moves to and fro several times while a tip passes.
TEST(RingBody, ThatMovesFastHidesNoTipThatPasses) {
  for (const char* method : {"collocation", "hybrid"}) {
    json content = in_ring_body(0.56, 1);
    content["contact"] = {{"law", "elastic_ring"}};
    content["ring_body"] = {{"mass", 0.3}, {"damping", 2.0}};
    content["accuracy"] = {{"method", method}};
    content["protocol"]["transient_revolutions"] = 200;
    content["observables"] = {"nearest_miss"};
    const auto outcome = run_on(content, {});
    ASSERT_EQ(outcome.status, PointStatus::done) << method;
    EXPECT_NEAR(outcome.rows[0][0], 5.8365e-3, 1e-7) << method;
  }
}

TEST(RingBody, ThatNobodyTouchesComesFromMemoryAndReturnsThereInClosedForm) {
  json content = in_ring_body(0.5, 1);
  content["rotor"]["misalignment"] = 0.002;  // the blades stay clear
  const std::array<double, 4> start{1e-3, -2e-4, 3e-3, 1e-3};
  const auto outcome = run_on(content, {{}, motion::Memory(start)});
  ASSERT_EQ(outcome.status, PointStatus::done);
  EXPECT_EQ(outcome.work.touchdowns, 0U);
  const rotor::RingBody ring(2.0, 5000.0, 4.0, 10.0);
  const auto exact = ring.free(Eigen::Array4d(start.data()), 4.0 * std::numbers::pi);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(outcome.final_memory.view()[i], exact[static_cast<Eigen::Index>(i)], 1e-16) << i;
    EXPECT_EQ(outcome.final_state[i], 0.0) << "the shaft knows nothing of it";
  }
}

TEST(RingBody, OfWhichNothingIsRememberedStartsAtRest) {
  const auto fresh = run_on(in_ring_body(0.62, 2), {});
  const auto at_rest = run_on(in_ring_body(0.62, 2), {{}, motion::Memory(std::vector(4, 0.0))});
  EXPECT_EQ(fresh.final_state, at_rest.final_state);
  EXPECT_EQ(memory_difference(fresh.final_memory, at_rest.final_memory), 0.0);
  // A point that has left validity leaves nothing to remember: here the ring starts beyond the shaft.
  const auto left = run_on(in_ring_body(0.62, 2), {{}, motion::Memory(std::array{0.2, 0.0, 0.0, 0.0})});
  EXPECT_EQ(left.status, PointStatus::left_validity);
  EXPECT_TRUE(left.final_memory.view().empty());
}

TEST(RingBody, SaysWhatItDoesNotStandBeside) {
  const auto refusal = [](const json& content) { return settings::refusal(content.dump()); };
  EXPECT_EQ(refusal(in_ring_body(0.62, 2)), "accepted");
  for (const std::string section : {"yielding_ring", "release", "load_direction", "regularised_friction",
                                    "stribeck", "wear", "speed_ramp", "stick"}) {
    json content = in_ring_body(0.62, 2);
    content[section] = json::object();
    if (section == "stick") content["contact"]["law"] = "elastic_ring";
    EXPECT_EQ(refusal(content),
              "/ring_body: stands beside /" + section + "; the ring moves as one body without it only");
  }
  json content = in_ring_body(0.62, 2);
  content["ring_body"]["mass"] = 0.0;
  EXPECT_EQ(refusal(content),
            "/ring_body/mass: 0 goes with the contact law \"elastic_ring\" only; under elastic blades "
            "/yielding_ring is a ring without mass");
  content["contact"]["law"] = "elastic_ring";
  EXPECT_EQ(refusal(content),
            "/ring_body/damping: 4 beside a mass of 0; a ring without mass has no damping here");
  content["ring_body"]["damping"] = 0.0;
  EXPECT_EQ(refusal(content), "accepted");
}

}  // namespace
}  // namespace rubatlas::test
