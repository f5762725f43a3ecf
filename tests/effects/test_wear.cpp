// Blades that wear: what is worn off is the work of friction, and what is left is remembered.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "../observables/synthetic_motion.hpp"
#include "../settings/scene_error_text.hpp"
#include "assembly/make_line_solver.hpp"
#include "effect_scene.hpp"
#include "motion/changing_motion.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using motion::PointStart;
using nlohmann::json;

json worn(double rate, double speed, int revolutions) {
  return {{"grid", {{"speed_ratio", speed}}},
          {"wear", {{"rate", rate}, {"carries_over", true}}},
          {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", revolutions}}},
          {"observables", {"poincare", "max_displacement", "clearance_growth"}}};
}

double total(const motion::Memory& memory) {
  const auto lost = memory.view();
  return std::accumulate(lost.begin(), lost.end(), 0.0);
}

TEST(Wear, WorkOfATipThatTouchesAndLeavesLikeASquareRootIsSummedToTenDigits) {
  constexpr double kEnd = 0.7;
  observables::SyntheticPiece piece(
      0.0, kEnd, [](double) { return trajectory::State{}; },
      {{.blade = 1, .force = {}, .strain = {}, .peaks = true, .action = [](double time) {
          trajectory::ContactForce force{};
          force.normal = std::sqrt(time * (kEnd - time));
          force.slip_velocity = -1.0;
          force.friction = 1.0;
          return force;
        }}});
  motion::FrictionWork meter(3);
  modes::MotionListener nobody;
  meter.begin(nobody);
  meter.piece(piece);
  EXPECT_EQ(meter.of_blades()[0], 0.0);
  EXPECT_NEAR(meter.of_blades()[1], std::numbers::pi * kEnd * kEnd / 8.0, 1e-11);
}

/// Rigid blades on an elastic ring without damping: the energy of shaft and ring grows by the work of the
/// motor and falls by that of friction, and by nothing else.
TEST(Wear, FrictionTakesTheEnergyThatTheMotorGivesAndTheRotorLoses) {
  json content = worn(1e-6, 0.45, 1);
  content["rotor"]["damping_ratio"] = 0.0;
  content["contact"] = {{"law", "elastic_ring"}, {"friction", 0.2}};
  content["protocol"]["samples_per_revolution"] = 65536;
  const settings::Scene scene = parsed(content);
  const auto solver = solver_of_first_line(scene);
  const motion::SectionState start{2e-3, 1e-3, -1e-3, 2e-3};
  const auto outcome = solver->run(0.45, start);
  const auto orbit = solver->orbit(0.45, start);
  ASSERT_EQ(outcome.status, PointStatus::done);
  ASSERT_GT(outcome.work.touchdowns, 0U);
  ASSERT_EQ(outcome.work.slip_reversals, 0U);

  const double stiffness = scene.rotor.mass * scene.rotor.natural_frequency * scene.rotor.natural_frequency;
  const double reach = scene.blades.length;
  const auto tip = [&](const motion::SectionState& state, int blade, double angle) {
    const double phi = angle + 2.0 * std::numbers::pi * blade / 3.0;
    return std::array{state[0] + reach * std::cos(phi),
                      state[1] + scene.rotor.misalignment + reach * std::sin(phi), phi};
  };
  const auto energy = [&](const motion::SectionState& state) {
    double sum = 0.0;
    for (const double component : state) sum += 0.5 * stiffness * component * component;
    for (int blade = 0; blade < 3; ++blade) {
      const auto at = tip(state, blade, 0.0);
      const double depth = std::max(0.0, std::hypot(at[0], at[1]) - scene.ring.radius);
      sum += 0.5 * scene.ring.stiffness * depth * depth;
    }
    return sum;
  };
  // The motor holds against the forces on the tips, −F n − μ F t: per unit τ, Ω times their moment.
  double motor = 0.0;
  const double step = orbit.time[1] - orbit.time[0];
  for (std::size_t i = 0; i < orbit.time.size(); ++i) {
    for (int blade = 0; blade < 3; ++blade) {
      const double force = orbit.force[3 * i + static_cast<std::size_t>(blade)];
      const auto at = tip(orbit.state[i], blade, 0.45 * orbit.time[i]);
      const double distance = std::hypot(at[0], at[1]);
      const double nx = at[0] / distance;
      const double ny = at[1] / distance;
      const double fx = -force * (nx - scene.contact.friction * ny);
      const double fy = -force * (ny + scene.contact.friction * nx);
      motor -= step * 0.45 * reach * (std::cos(at[2]) * fy - std::sin(at[2]) * fx);
    }
  }
  const double friction = total(outcome.final_memory) / 1e-6;
  EXPECT_GT(friction, 1e-3) << "J";
  EXPECT_NEAR(friction, motor + energy(start) - energy(outcome.final_state), 1e-5 * friction);
}

TEST(Wear, LossOfARunIsRateTimesWorkToFirstOrder) {
  const auto work = [](double rate) {
    const auto outcome = run(parsed(worn(rate, 0.62, 4)));
    EXPECT_EQ(outcome.status, PointStatus::done);
    return total(outcome.final_memory) / rate;
  };
  const double exact = work(1e-10);
  const double departure = std::abs(work(1e-6) - exact);
  const double tenfold = std::abs(work(1e-5) - exact);
  EXPECT_LT(departure, 0.1 * exact);
  EXPECT_GT(tenfold, 5.0 * departure);
  EXPECT_LT(tenfold, 20.0 * departure);
}

TEST(Wear, BladesOnlyGetShorterAndALineGoesOnWithThem) {
  const settings::Scene one = parsed(worn(1e-4, 0.45, 1));
  const settings::Scene four = parsed(worn(1e-4, 0.45, 4));
  PointStart at;
  for (int revolution = 0; revolution < 4; ++revolution) {
    const auto outcome = run(one, at);
    ASSERT_EQ(outcome.status, PointStatus::done);
    ASSERT_EQ(outcome.final_memory.view().size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      const double before = at.memory.view().empty() ? 0.0 : at.memory.view()[k];
      EXPECT_GE(outcome.final_memory.view()[k], before);
    }
    at = {outcome.final_state, outcome.final_memory};
  }
  EXPECT_GT(total(at.memory), 0.0);
  const auto whole = run(four);
  EXPECT_LE(largest_difference(whole.final_state, at.state), 1e-12);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(whole.final_memory.view()[k], at.memory.view()[k], 1e-9 * total(at.memory));
  }
}

TEST(Wear, AWornRotorIsThatOfShorterBlades) {
  const std::vector<double> lost{1e-5, 0.0, 3e-5};
  // So slowly that nothing more is worn.
  const auto shorter = run(parsed(worn(1e-15, 0.62, 3)), {{}, motion::Memory(lost)});
  json content = worn(1.0, 0.62, 3);
  content.erase("wear");
  content["observables"] = {"poincare", "max_displacement"};
  content["unequal_blades"] = {{"length_errors", {-1e-5, 0.0, -3e-5}}};
  const auto made_so = run(parsed(content));
  ASSERT_EQ(shorter.status, PointStatus::done);
  ASSERT_GT(shorter.work.touchdowns, 0U);
  EXPECT_LE(largest_difference(shorter.final_state, made_so.final_state), 1e-10);
}

TEST(Wear, StartsAfreshAtEachPointUnlessItCarriesOver) {
  json content = worn(1e-4, 0.62, 2);
  const PointStart start({}, motion::Memory(std::vector{1e-4, 2e-4, 0.0}));
  const auto carried = run(parsed(content), start);
  content["wear"]["carries_over"] = false;
  const auto fresh = run(parsed(content), start);
  const auto of_new = run(parsed(content));
  EXPECT_EQ(fresh.rows, of_new.rows);
  EXPECT_EQ(fresh.final_state, of_new.final_state);
  EXPECT_GE(carried.final_memory.view()[1], 2e-4);
  EXPECT_LT(fresh.final_memory.view()[1], 2e-4);
  const auto growth = [](const point::PointOutcome& outcome, const std::vector<double>& before) {
    double largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      largest = std::max(largest, outcome.final_memory.view()[k] - before[k]);
    }
    return largest;
  };
  EXPECT_EQ(carried.rows[2][0], growth(carried, {1e-4, 2e-4, 0.0}));
  EXPECT_EQ(fresh.rows[2][0], growth(fresh, {0.0, 0.0, 0.0}));
  EXPECT_GT(fresh.rows[2][0], 0.0);
}

TEST(Wear, APointEndsWhereABladeHasLostMoreThanItsShare) {
  json content = worn(1e-4, 0.62, 50);
  content["wear"]["max_loss"] = 1e-6;
  const auto outcome = run(parsed(content));
  EXPECT_EQ(outcome.status, PointStatus::left_validity);
  EXPECT_GE(outcome.failed_revolution, 0);
  EXPECT_TRUE(outcome.final_memory.view().empty());
  EXPECT_TRUE(std::isnan(outcome.rows[2][0]));
}

TEST(Wear, FrictionlessTipsKeepTheirBlades) {
  json content = worn(1.0, 0.62, 3);
  content["contact"]["friction"] = 0.0;
  const auto outcome = run(parsed(content));
  ASSERT_GT(outcome.work.touchdowns, 0U);
  EXPECT_EQ(total(outcome.final_memory), 0.0);
}

TEST(Wear, SaysWhatItDoesNotGoWith) {
  const auto refusal = [](const json& content) { return settings::refusal(content.dump()); };
  json content = worn(1e-4, 0.62, 2);
  EXPECT_EQ(refusal(content), "accepted");
  content["sweep"] = "independent";
  EXPECT_EQ(refusal(content),
            R"(/wear/carries_over: the sweep is "independent"; no point comes after another)");
  content = worn(1e-4, 0.62, 2);
  content.erase("wear");
  EXPECT_EQ(refusal(content),
            "/observables: \"clearance_growth\" is that of blades that wear; there is no section /wear");
}

}  // namespace
}  // namespace rubatlas::test
