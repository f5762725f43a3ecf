#include "honest_end.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rubatlas::test {

void expect_an_honest_end(const settings::Scene& scene, const point::PointOutcome& outcome) {
  const bool done = outcome.status == point::PointStatus::done;
  const auto descriptions = observables::descriptions(scene);
  ASSERT_EQ(outcome.rows.size(), descriptions.size());
  const auto as_the_status_says = [&](double value) {
    return done ? std::isfinite(value) : std::isnan(value);
  };
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    ASSERT_EQ(outcome.rows[i].size(), descriptions[i].row_size);
    ASSERT_TRUE(std::all_of(outcome.rows[i].begin(), outcome.rows[i].end(), as_the_status_says))
        << descriptions[i].name << ", " << (done ? "done" : "not done");
  }
  ASSERT_TRUE(std::all_of(outcome.final_state.begin(), outcome.final_state.end(), as_the_status_says));
  if (done) {
    ASSERT_EQ(outcome.failed_revolution, -1);
  } else {
    ASSERT_TRUE(outcome.status == point::PointStatus::left_validity ||
                outcome.status == point::PointStatus::integrator_failed);
    ASSERT_GE(outcome.failed_revolution, 0);
    ASSERT_LT(outcome.failed_revolution,
              scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions);
  }
}

}  // namespace rubatlas::test
