#include "mpi/job/rounds.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>

#include "analysis/rules/class.hpp"
#include "analysis/rules/scene_tolerances.hpp"
#include "assembly/make_line_solver.hpp"
#include "observables/list.hpp"
#include "plan/scene_of_line.hpp"

namespace rubatlas::mpi {
namespace {

constexpr const char* kObserved = "poincare";

template <typename T>
std::string to_bytes(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::string bytes(values.size_bytes(), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

template <typename T>
std::vector<T> from_bytes(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
  return values;
}

/// To observe a motion never changes it.
settings::Scene with_sections_only(settings::Scene scene) {
  scene.observables = {kObserved};
  return scene;
}

}  // namespace

Rounds::Rounds(const Session& session, const settings::Scene& scene)
    : session_(session), scene_(with_sections_only(scene)), grid_(scene_) {
  const auto rows = observables::descriptions(scene_);
  const auto place = std::ranges::find(rows, kObserved, [](const auto& row) { return row.name; });
  sections_ = static_cast<std::size_t>(place - rows.begin());
}

RoundResult Rounds::compute(const RoundPoint& point, const GoOn& go_on) {
  if (!line_ || line_->line != point.line) {
    const auto parameters = grid_.parameters(grid_.point(point.line, 0));
    line_.emplace(LineSolver{point.line, plan::scene_of_line(scene_, parameters),
                             assembly::make_line_solver(scene_, parameters, tables_),
                             assembly::initial_state(scene_, parameters)});
  }
  const auto outcome =
      line_->solver->run(point.speed_ratio, point.from_initial != 0 ? line_->initial : point.start, go_on);
  RoundResult result{.status = outcome.status, .motion = 0, .end = {}};
  if (outcome.status != ending::PointStatus::done) return result;
  result.motion = analysis::classify(outcome.rows[sections_], analysis::closing_tolerance(line_->scene));
  result.end = motion::PointStart(outcome.final_state, outcome.final_memory);
  return result;
}

std::vector<RoundResult> Rounds::compute_share(std::span<const RoundPoint> points, const GoOn& go_on,
                                               const std::function<void(const RoundResult&)>& after_point) {
  const auto ranks = static_cast<std::size_t>(session_.size());
  std::vector<RoundResult> results;
  for (auto i = static_cast<std::size_t>(session_.rank()); i < points.size(); i += ranks) {
    results.push_back(go_on() ? compute(points[i], go_on) : RoundResult{});
    if (after_point) after_point(results.back());
  }
  return results;
}

std::vector<RoundResult> Rounds::compute(std::span<const RoundPoint> points, const GoOn& go_on,
                                         const std::function<void(const RoundResult&)>& after_point) {
  session_.wait_for_all();
  static_cast<void>(session_.broadcast(to_bytes(points)));
  std::vector<RoundResult> results(points.size());
  if (points.empty()) return results;
  const auto own = compute_share(points, go_on, after_point);
  session_.wait_for_all();
  const auto shares = session_.gather(to_bytes(std::span<const RoundResult>(own)));
  for (std::size_t rank = 0; rank < shares.size(); ++rank) {
    std::size_t place = rank;
    for (const auto& result : from_bytes<RoundResult>(shares[rank])) {
      results[place] = result;
      place += shares.size();
    }
  }
  return results;
}

void Rounds::take_part(const GoOn& go_on) {
  while (true) {
    session_.wait_for_all();
    const auto points = from_bytes<RoundPoint>(session_.broadcast(std::string()));
    if (points.empty()) return;
    const auto own = compute_share(points, go_on, {});
    session_.wait_for_all();
    static_cast<void>(session_.gather(to_bytes(std::span<const RoundResult>(own))));
  }
}

}  // namespace rubatlas::mpi
