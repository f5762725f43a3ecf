/// The hybrid method with pairs of order 5(4) and 3(2) in contact: the same motions, for more steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../support/point.hpp"
#include "reference_case.hpp"

namespace rubatlas::test {
namespace {

struct Figures {
  double error;  ///< of the first ten sections, relative to the clearance
  double steps;
};

Figures run(settings::Method method, double tolerance) {
  const ReferenceCase& c = reference_case("default_Om0.62");
  settings::Scene scene = c.scene;
  scene.accuracy.method = method;
  scene.accuracy.tolerance = tolerance;
  scene.observables = {"poincare"};
  scene.protocol = {0, 10, 64};
  const auto outcome = test::run(scene, c.speed_ratio, c.start);
  const auto& row = outcome.rows.at(0);
  Figures result{0.0, static_cast<double>(outcome.work.steps)};
  for (std::size_t i = 0; i < c.first_sections.size(); ++i) {
    result.error =
        std::max(result.error,
                 largest_difference({row.at(4 * i), row.at(4 * i + 1), row.at(4 * i + 2), row.at(4 * i + 3)},
                                    c.first_sections[i]));
  }
  result.error /= c.scene.clearance();
  return result;
}

TEST(LowerOrders, StepsGrowWithTheToleranceAsTheOrderSays) {
  // A local error of size^p wants tolerance^(-1/p) steps: over four decades 6.3 times as many at p = 5, 21.5
  // at p = 3. On an elastic ring, whose force has no roots of the time.
  const auto growth = [](settings::Method method) {
    const ReferenceCase& c = reference_case("default_Om0.62");
    settings::Scene scene = c.scene;
    scene.contact.law = settings::ContactLaw::elastic_ring;
    scene.ring.stiffness = 1e3;
    scene.accuracy.method = method;
    scene.protocol = {0, 100, 64};
    const auto steps = [&](double tolerance) {
      scene.accuracy.tolerance = tolerance;
      return static_cast<double>(test::run(scene, c.speed_ratio, c.start).work.steps);
    };
    return steps(1e-9) / steps(1e-5);
  };
  EXPECT_NEAR(growth(settings::Method::hybrid_54), std::pow(1e4, 1.0 / 5), 0.6);
  EXPECT_NEAR(growth(settings::Method::hybrid_32), std::pow(1e4, 1.0 / 3), 2.0);
}

TEST(LowerOrders, ReachTheReferenceInMoreStepsThanOrderEight) {
  const double most = 100.0;  // tolerances: measured up to 10
  for (const double tolerance : {1e-6, 1e-9}) {
    const Figures eight = run(settings::Method::hybrid, tolerance);
    const Figures five = run(settings::Method::hybrid_54, tolerance);
    const Figures three = run(settings::Method::hybrid_32, tolerance);
    EXPECT_LE(five.error, most * tolerance);
    EXPECT_LE(three.error, most * tolerance);
    EXPECT_GT(five.steps, 2.0 * eight.steps) << tolerance;
    EXPECT_GT(three.steps, 4.0 * five.steps) << tolerance;
  }
}

}  // namespace
}  // namespace rubatlas::test
