/// A ring that is one body, from a feather to an anvil, on springs from slack to stiff, in both laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "../support/honest_end.hpp"
#include "../support/point.hpp"
#include "assembly/make_line_solver.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using motion::PointStart;

/// Of shaft and ring [m].
double largest_difference_of_bodies(const point::PointOutcome& a, const point::PointOutcome& b) {
  double largest = largest_difference(a.final_state, b.final_state);
  const std::span<const double> ring = a.final_memory.view();
  const std::span<const double> other = b.final_memory.view();
  for (std::size_t i = 0; i < std::min(ring.size(), other.size()); ++i) {
    largest = std::max(largest, std::abs(ring[i] - other[i]));
  }
  return largest;
}

TEST(RingBodyOfAnyWeight, ConvergesWithBoundedWork) {
  // The ring's own frequency is 1/1000 to 1000 of the shaft's, its damping none, critical or beyond. Two
  // tolerances agree after a revolution as far as the motion lets errors be: starts that are shifted tell how
  // much it amplifies what each contact adds.
  constexpr double kTolerance = 1e-10;
  constexpr double kShift = 1e-9;
  constexpr double kSpeed = 0.62;
  int done = 0;
  int tried = 0;
  for (const auto law : {settings::ContactLaw::elastica, settings::ContactLaw::elastic_ring}) {
    for (const double mass : {1e-4, 1e-2, 1.0, 1e4}) {
      for (const double stiffness : {1.0, 1e3, 1e6}) {
        for (const double damping_ratio : {0.0, 1.0, 10.0}) {
          SCOPED_TRACE(::testing::Message()
                       << "law " << static_cast<int>(law) << ", ring of " << mass << " kg on " << stiffness
                       << " N/m, damping ratio " << damping_ratio);
          settings::Scene scene = default_rotor(1);
          scene.contact.law = law;
          scene.ring_body =
              effects::RingBody{mass, 1.0 / stiffness, 2.0 * damping_ratio * std::sqrt(mass * stiffness)};
          const auto run_at = [&](double tolerance, const PointStart& start) {
            scene.accuracy.tolerance = tolerance;
            return solver_of(scene)->run(kSpeed, start);
          };
          const auto loose = run_at(kTolerance, {});
          const auto tight = run_at(0.1 * kTolerance, {});
          ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, loose));
          ASSERT_NO_FATAL_FAILURE(expect_an_honest_end(scene, tight));
          EXPECT_EQ(loose.status, tight.status);
          EXPECT_NE(tight.status, PointStatus::integrator_failed);
          EXPECT_GT(tight.work.touchdowns, 0U);
          ++tried;
          if (loose.status != PointStatus::done || tight.status != PointStatus::done) continue;
          ++done;
          double growth = 1.0;
          for (std::size_t component = 0; component < 8; ++component) {
            PointStart start;
            std::vector<double> ring(4, 0.0);
            (component < 4 ? start.state[component] : ring[component - 4]) = kShift;
            start.memory = motion::Memory(ring);
            const auto shifted = run_at(0.1 * kTolerance, start);
            if (shifted.status != PointStatus::done) continue;
            growth = std::max(growth, largest_difference_of_bodies(shifted, tight) / kShift);
          }
          const double contacts = static_cast<double>(1 + tight.work.touchdowns);
          EXPECT_LE(largest_difference_of_bodies(loose, tight),
                    10.0 * contacts * kTolerance * scene.clearance() * growth);
          // A ring ν times as fast as the shaft is followed in steps of its own time while a blade touches.
          const double frequency = std::sqrt(stiffness / mass) / 10.0;
          EXPECT_LE(static_cast<double>(tight.work.right_hand_sides),
                    1000.0 * contacts * (1.0 + frequency * (1.0 + damping_ratio)))
              << contacts;
        }
      }
    }
  }
  EXPECT_GT(done, tried / 2);
}

}  // namespace
}  // namespace rubatlas::test
