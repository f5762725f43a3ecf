#include "honest_end.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace rubatlas::test {
namespace {

/// Observables of what may not occur on a motion: no tip passes the ring, none touches, or the tangents of
/// the motion are lost.
/// Their rows are then NaN as a whole.
bool may_be_without_value(std::string_view observable) {
  constexpr std::array<std::string_view, 5> kObservables{"nearest_miss", "lightest_touch", "lyapunov",
                                                         "lyapunov_error", "lyapunov_residual"};
  return std::ranges::count(kObservables, observable) > 0;
}

}  // namespace

void expect_an_honest_end(const settings::Scene& scene, const point::PointOutcome& outcome) {
  const bool done = outcome.status == ending::PointStatus::done;
  const auto descriptions = observables::descriptions(scene);
  ASSERT_EQ(outcome.rows.size(), descriptions.size());
  const auto as_the_status_says = [&](double value) {
    return done ? std::isfinite(value) : std::isnan(value);
  };
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    ASSERT_EQ(outcome.rows[i].size(), descriptions[i].row_size);
    const bool without_value = may_be_without_value(descriptions[i].name) && !outcome.rows[i].empty() &&
                               std::isnan(outcome.rows[i].front());
    const auto is_right = [&](double value) {
      return without_value ? std::isnan(value) : as_the_status_says(value);
    };
    ASSERT_TRUE(std::ranges::all_of(outcome.rows[i], is_right))
        << descriptions[i].name << ", " << (done ? "done" : "not done");
  }
  ASSERT_TRUE(std::all_of(outcome.final_state.begin(), outcome.final_state.end(), as_the_status_says));
  if (done) {
    ASSERT_EQ(outcome.failed_revolution, -1);
  } else {
    ASSERT_TRUE(outcome.status == ending::PointStatus::left_validity ||
                outcome.status == ending::PointStatus::integrator_failed);
    ASSERT_GE(outcome.failed_revolution, 0);
    ASSERT_LT(outcome.failed_revolution,
              scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions);
  }
}

}  // namespace rubatlas::test
