// Contacts that are hard to follow along an arc, by collocation and in steps.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>

#include <nlohmann/json.hpp>

#include "assembly/blade_tables.hpp"
#include "assembly/methods.hpp"
#include "motion/point_start.hpp"
#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"
#include "point/line_solver.hpp"
#include "settings/combinations.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::test {
namespace {

std::unique_ptr<point::LineSolver> on_arcs(const assembly::LineRequest& request) {
  return assembly::hybrid_solver(request, modes::phases_on_arcs);
}
std::unique_ptr<point::LineSolver> in_steps(const assembly::LineRequest& request) {
  return assembly::hybrid_solver(request, assembly::phases_in_steps);
}

/// The first point of a scene, from its initial state, by collocation and in steps, which end at most `apart`
/// [m, m per unit τ] from each other. Steps alone may run out of work.
motion::WorkCounts expect_to_move_as_in_steps(const settings::Scene& scene, assembly::BladeTables& tables,
                                              double apart) {
  const assembly::LineRequest request{scene, tables, settings::combination_of(scene)};
  const motion::PointStart start{{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy}};
  const double speed_ratio = scene.grid.speed_ratio.front();
  const auto arcs = on_arcs(request)->run(speed_ratio, start);
  const auto steps = in_steps(request)->run(speed_ratio, start);
  EXPECT_NE(arcs.status, ending::PointStatus::integrator_failed);
  if (steps.detail == ending::StatusDetail::contact_work) return arcs.work;
  EXPECT_EQ(arcs.detail, steps.detail);
  for (std::size_t i = 0; i < arcs.final_state.size() && arcs.detail == ending::StatusDetail::none; ++i)
    EXPECT_LE(std::abs(arcs.final_state[i] - steps.final_state[i]), apart);
  return arcs.work;
}

/// Random numbers, the same on every machine.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : bits_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1p-53;
  }

 private:
  std::mt19937_64 bits_;
};

settings::Scene of_revolutions(nlohmann::json document, int revolutions) {
  document["protocol"] = {{"transient_revolutions", 0}, {"sampled_revolutions", revolutions}};
  return settings::parse_scene(document.dump());
}

/// The same of as many scenes as there are starts, each drawn anew; how often their motions did what is
/// counted.
std::uint64_t counted_as_in_steps(int starts, int revolutions, double apart,
                                  const std::function<nlohmann::json()>& draw,
                                  std::uint64_t motion::WorkCounts::*counted) {
  assembly::BladeTables tables;
  std::uint64_t count = 0;
  for (int i = 0; i < starts; ++i) {
    SCOPED_TRACE(i);
    count += expect_to_move_as_in_steps(of_revolutions(draw(), revolutions), tables, apart).*counted;
  }
  return count;
}

TEST(HardContacts, OfTipsThatSkimMoveAsInSteps) {
  // An overdamped rotor that creeps.
  const nlohmann::json creeping = {{"rotor", {{"damping_ratio", 1.0}}},
                                   {"unbalance", {{"moment", 1e-4}}},
                                   {"grid", {{"speed_ratio", 0.005}}}};
  assembly::BladeTables tables;
  constexpr double kApart = 1e-9;
  EXPECT_GT(expect_to_move_as_in_steps(of_revolutions(creeping, 1), tables, kApart).touchdowns, 100U);
}

TEST(HardContacts, OnALightRingEndAsInSteps) {
  // A ring of two grams that bounces, on which a tip skims beside another blade, and rests as a stiff strut
  // between hub and ring. It touches ten thousand times, which magnifies errors.
  const nlohmann::json bouncing = {
      {"ring_body", {{"mass", 1.718e-3}, {"compliance", 1.72e-3}, {"damping", 3.822}}},
      {"contact", {{"friction", 0.1297}}},
      {"initial", {{"x", -5.234e-3}, {"y", 3.763e-3}, {"vx", 0.04395}, {"vy", -0.02827}}},
      {"grid", {{"speed_ratio", 0.3016}}}};
  assembly::BladeTables tables;
  constexpr double kApart = 1e-4;
  EXPECT_GT(expect_to_move_as_in_steps(of_revolutions(bouncing, 1), tables, kApart).touchdowns, 1000U);
}

/// The rig's soft blades often touch two at a time: with the jumps that sweeps leave at the start of an
/// interval arcs gave up at 14 of these points within 80 revolutions.
void expect_the_test_rig_to_be_followed(int transient_revolutions, int sampled_revolutions) {
  assembly::BladeTables tables;
  settings::Scene scene = settings::parse_scene(settings::read_text(RUBATLAS_SOURCE_DIR "/jobs/rig.json"));
  scene.protocol.transient_revolutions = transient_revolutions;
  scene.protocol.sampled_revolutions = sampled_revolutions;
  scene.observables = {"poincare"};
  const plan::Grid grid(scene);
  std::size_t points = 0;
  for (std::size_t number = 0; number < grid.line_count(); ++number) {
    const settings::Scene line = plan::scene_of_line(scene, grid.parameters(grid.point(number, 0)));
    const assembly::LineRequest request{line, tables, settings::combination_of(line)};
    motion::PointStart start;
    for (const double speed_ratio : scene.grid.speed_ratio) {
      const auto point = on_arcs(request)->run(speed_ratio, start);
      EXPECT_NE(point.status, ending::PointStatus::integrator_failed) << "speed ratio " << speed_ratio;
      const bool done = point.status == ending::PointStatus::done;
      start = done ? motion::PointStart{point.final_state, point.final_memory} : motion::PointStart{};
      ++points;
    }
  }
  EXPECT_GT(points, 100U);
}

TEST(HardContacts, OfTheTestRigAreFollowedInBothSweeps) {
  expect_the_test_rig_to_be_followed(20, 10);
}
TEST(HardContactsSlow, OfTheTestRigAreFollowedInBothSweepsOverManyRevolutions) {
  expect_the_test_rig_to_be_followed(60, 20);
}

TEST(HardContacts, OfSeveralBladesThatHardlyBendMoveAsInSteps) {
  // Thick blades on a soft ring, which touch ever more lightly; blades with next to no friction, whose load
  // all but jumps to Euler's; stiff columns that lift off while they are all but unbent.
  const nlohmann::json thick = {
      {"accuracy", {{"tolerance", 7e-4}}},
      {"rotor",
       {{"mass", 114}, {"damping_ratio", 0.97}, {"natural_frequency", 514}, {"misalignment", -1.012}}},
      {"blades",
       {{"count", 34},
        {"hub_radius", 0.0},
        {"length", 119.268},
        {"thickness", 15.8},
        {"width", 67.5},
        {"youngs_modulus", 1.24e12}}},
      {"ring", {{"radius", 120.28}}},
      {"contact", {{"friction", 0.01}}},
      {"yielding_ring", {{"compliance", 0.693}}},
      {"initial", {{"vy", -0.498}}},
      {"grid", {{"speed_ratio", 1.0}}}};
  const nlohmann::json stiff_columns = {
      {"accuracy", {{"tolerance", 7.9e-7}}},
      {"rotor",
       {{"mass", 0.04702},
        {"damping_ratio", 0.18},
        {"natural_frequency", 822.2},
        {"misalignment", -1.3812e-3}}},
      {"blades",
       {{"count", 7},
        {"hub_radius", 0.4471151},
        {"length", 1.8753045},
        {"thickness", 3.066e-3},
        {"width", 0.9656},
        {"youngs_modulus", 1e15}}},
      {"ring", {{"radius", 2.3238016}}},
      {"contact", {{"friction", 0.0}}},
      {"stribeck",
       {{"regularising_velocity", 0.0733}, {"static_friction", 5.2557e-4}, {"velocity", 2.8275e-3}}},
      {"gravity", {{"acceleration", 16.49}}},
      {"initial", {{"vx", 5.252e-4}}},
      {"grid", {{"speed_ratio", 2.3653}}}};
  const nlohmann::json next_to_no_friction = {
      {"accuracy", {{"tolerance", 1.205092118171626e-09}}},
      {"rotor",
       {{"mass", 0.008531761038513809},
        {"damping_ratio", 2.7989346407597495e-12},
        {"natural_frequency", 0.08301853322041257},
        {"misalignment", 0.005182058145319836}}},
      {"blades",
       {{"count", 16},
        {"hub_radius", 0.018466518947100052},
        {"length", 2.1700942630864217},
        {"thickness", 0.0153697096539276},
        {"width", 2.2753253038532318e-11},
        {"youngs_modulus", 7.188840437473722}}},
      {"ring", {{"radius", 2.1885946842923323}}},
      {"contact", {{"friction", 4.385437650827236e-08}}},
      {"yielding_ring", nlohmann::json::object()},
      {"speed_ramp", {{"rate", 0.024729000826420183}}},
      {"initial", {{"vx", 4.085296382469858e-09}, {"vy", 2.075223002143767e-10}}},
      {"grid", {{"speed_ratio", 664.7232317368299}}}};
  assembly::BladeTables tables;
  const auto expect_to_move_so = [&](nlohmann::json document, double apart) {
    document["validity"] = {{"max_shortening", 0.2}};
    SCOPED_TRACE(document.dump());
    EXPECT_GT(expect_to_move_as_in_steps(of_revolutions(document, 2), tables, apart).touchdowns, 1U);
  };
  constexpr double kApart = 1e-9;
  expect_to_move_so(next_to_no_friction, kApart);
  expect_to_move_so(stiff_columns, kApart);
  // The last contacts of thick blades move the shaft by less than that tolerance, which is all that is asked.
  constexpr double kClearance = 1.012;
  expect_to_move_so(thick, 7e-4 * kClearance);
  nlohmann::json exact = thick;
  exact["accuracy"]["tolerance"] = 1e-7;
  expect_to_move_so(exact, kApart);
}

/// Straight up to their Euler load, and bent beyond.
void expect_columns_on_dampers_to_move_as_in_steps(int starts) {
  Uniform uniform(3);
  constexpr double kApart = 1e-9;
  const auto draw = [&uniform]() -> nlohmann::json {
    return {{"rotor", {{"damping_ratio", uniform(0.02, 0.3)}}},
            {"blades", {{"count", 1 + static_cast<int>(uniform(0.0, 5.0))}}},
            {"contact", {{"friction", 0.0}}},
            {"yielding_ring", {{"compliance", std::pow(10.0, uniform(-5.0, -4.0))}}},
            {"contact_damping", {{"damping", std::pow(10.0, uniform(0.0, 2.0))}}},
            {"initial", {{"x", uniform(-5e-3, 5e-3)}, {"vy", uniform(-0.1, 0.1)}}},
            {"grid", {{"speed_ratio", uniform(0.05, 0.95)}}}};
  };
  EXPECT_GT(counted_as_in_steps(starts, 2, kApart, draw, &motion::WorkCounts::touchdowns),
            2U * static_cast<unsigned>(starts));
}

TEST(HardContacts, OfColumnsOnDampersMoveAsInSteps) {
  expect_columns_on_dampers_to_move_as_in_steps(80);
}
TEST(HardContactsSlow, OfManyColumnsOnDampersMoveAsInSteps) {
  expect_columns_on_dampers_to_move_as_in_steps(200);
}

TEST(HardContacts, OfBladesWithMuchFrictionThatBendFarMoveAsInSteps) {
  // Up to a shortening of 0.6 L, towards the end of the elastica where friction is large.
  Uniform uniform(4);
  constexpr int kStarts = 100;
  constexpr double kApart = 1e-9;
  const auto draw = [&uniform]() -> nlohmann::json {
    return {{"rotor", {{"damping_ratio", uniform(0.02, 0.3)}}},
            {"blades", {{"count", 1 + static_cast<int>(uniform(0.0, 5.0))}, {"thickness", 5e-4}}},
            {"contact", {{"friction", uniform(0.8, 2.0)}}},
            {"validity", {{"max_shortening", 0.6}}},
            {"initial", {{"x", uniform(-5e-3, 5e-3)}, {"vy", uniform(-0.15, 0.15)}}},
            {"grid", {{"speed_ratio", uniform(0.05, 0.95)}}}};
  };
  EXPECT_GT(counted_as_in_steps(kStarts, 1, kApart, draw, &motion::WorkCounts::touchdowns), 1U * kStarts);
}

/// Slow rotors kicked against their spin. Their tips come loose at the edge of the cone, where their place
/// is lost, and as a strut between hub and ring.
void expect_blades_at_rest_to_move_as_in_steps(int starts) {
  Uniform uniform(2);
  constexpr double kApart = 1e-8;
  const auto draw = [&uniform]() -> nlohmann::json {
    return {{"rotor", {{"damping_ratio", uniform(0.02, 0.3)}, {"misalignment", uniform(0.0, 0.012)}}},
            {"blades", {{"count", 1 + static_cast<int>(uniform(0.0, 8.0))}, {"thickness", 1e-3}}},
            {"contact", {{"law", "elastica"}, {"friction", uniform(0.2, 0.8)}}},
            {"stick", nlohmann::json::object()},
            {"initial",
             {{"x", uniform(-5e-3, 5e-3)},
              {"y", uniform(-5e-3, 5e-3)},
              {"vx", uniform(-0.04, 0.04)},
              {"vy", uniform(-0.04, 0.04)}}},
            {"grid", {{"speed_ratio", uniform(0.03, 0.6)}}}};
  };
  EXPECT_GT(counted_as_in_steps(starts, 1, kApart, draw, &motion::WorkCounts::slip_reversals),
            static_cast<unsigned>(starts));
}

TEST(HardContacts, OfElasticBladesAtRestMoveAsInSteps) {
  expect_blades_at_rest_to_move_as_in_steps(120);
}
TEST(HardContactsSlow, OfManyElasticBladesAtRestMoveAsInSteps) {
  expect_blades_at_rest_to_move_as_in_steps(300);
}

}  // namespace
}  // namespace rubatlas::test
