#include "mpi/job/trace_recorder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "analysis/rules/scene_tolerances.hpp"
#include "observables/list.hpp"

namespace rubatlas::mpi {
namespace {

constexpr std::string_view kSections = "poincare";
constexpr std::string_view kDisplacement = "max_displacement";

/// Tolerances of the integrator by which the ends of one periodic motion may differ. What differs by more has
/// not settled, and may still go elsewhere at the next point.
constexpr double kSame = 10.0;

}  // namespace

TraceRecorder::TraceRecorder(const settings::Scene& scene)
    : observed_(scene),
      closing_(analysis::closing_tolerance(scene)),
      same_(kSame * scene.accuracy.tolerance * analysis::length_scale(scene)) {
  const auto keeps = [&](std::string_view name) { return std::ranges::count(scene.observables, name) > 0; };
  for (const std::string_view name : {kSections, kDisplacement}) {
    if (!keeps(name)) observed_.observables.emplace_back(name);
  }
  const auto rows = observables::descriptions(observed_);
  for (std::size_t place = rows.size(); place-- > 0;) {
    const std::string& name = rows[place].name;
    if (name == kSections) sections_ = place;
    if (name == kDisplacement) displacement_ = place;
    if ((name == kSections || name == kDisplacement) && !keeps(name)) added_.push_back(place);
  }
}

analysis::MotionTrace TraceRecorder::trace(const point::PointOutcome& outcome) const {
  if (outcome.status != ending::PointStatus::done) return {};
  return analysis::trace_of(outcome.rows[sections_], outcome.rows[displacement_].front(), closing_);
}

bool TraceRecorder::is_same_motion(const point::PointOutcome& outcome,
                                   const analysis::MotionTrace& found) const {
  const analysis::MotionTrace mine = trace(outcome);
  if (!analysis::is_periodic(mine.motion) || !analysis::is_periodic(found.motion))
    return analysis::is_same_motion(mine, outcome.rows[sections_], found, closing_);
  double square = 0.0;
  for (std::size_t i = 0; i < mine.section.size(); ++i)
    square += (mine.section[i] - found.section[i]) * (mine.section[i] - found.section[i]);
  return mine.motion == found.motion && std::sqrt(square) <= same_;
}

void TraceRecorder::strip(point::PointOutcome& outcome) const {
  for (const std::size_t place : added_) {
    outcome.rows.erase(outcome.rows.begin() + static_cast<std::ptrdiff_t>(place));
  }
}

}  // namespace rubatlas::mpi
